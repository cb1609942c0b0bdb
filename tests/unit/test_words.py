"""The closest words: those that share most letters in order, the likest first."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.words import LONGEST, alike, closest, cut, did_you_mean, likest, shortened


@pytest.mark.parametrize(
    ("word", "known", "found"),
    [
        ("onoin", ["onion", "bacon", "leek"], "; closest: onion"),
        (
            "whiped cream",
            ["cream", "ice", "whipped cream", "heavy cream"],
            "; closest: whipped cream, heavy cream",
        ),
        ("pam", ["spam", "pan", "ham", "palm", "plum"], "; closest: palm, spam, ham"),
        ("fork", ["plate"], ""),
        # They share three letters of five in order, and nobody types the one for the other.
        ("apple", ["ladle"], ""),
        ("apple", ["ladle", "appel", "apples", "pineapple"], "; closest: apples, appel"),
        ("lettus", ["lettuce", "letter"], "; closest: lettuce, letter"),
        ("onion", ["lion", "union"], "; closest: union"),
        ("onion [raw]", ["onion [whole]", "iron [raw]"], "; closest: iron [raw], onion [whole]"),
        ("choc", ["chocolate"], "; closest: chocolate"),
        ("chiken", ["chive", "chicken broth", "chickpea"], "; closest: chive, chicken broth"),
        ("wok", ["work surface", "pot"], ""),
        ("fork", [], ""),
    ],
)
def test_closest_words(word: str, known: list[str], found: str) -> None:
    assert closest(word, known) == found
    assert closest(word, reversed(known)) == found


def test_how_alike_words_must_be() -> None:
    # Two letters of four and four are half of all.
    assert alike("abcd", ["abxy"], 1, 0.5) == ["abxy"]
    assert alike("abcd", ["abxy"], 1, 0.51) == []


def test_what_is_long_is_cut() -> None:
    assert cut("a" * LONGEST) == "a" * LONGEST
    for text in ("a" * (LONGEST + 1), "\n" * 20_000):
        assert cut(text) == text[: LONGEST - 1] + "…"
        assert len(closest("a" * 5_000, ["a" * 5_001])) < 2 * LONGEST
        assert len(shortened([text] * 100)) < 4 * LONGEST


def test_did_you_mean() -> None:
    assert did_you_mean("--meth", ["--method", "--goals"]) == "; did you mean --method?"
    assert did_you_mean("--zzz", ["--method", "--goals"]) == ""


@given(st.lists(st.text("abc ", max_size=6), max_size=30), st.sets(st.text("abc ", max_size=6), max_size=20))
def test_many_words_have_the_likest_that_each_has(words: list[str], known: set[str]) -> None:
    each = [(word, near[0]) for word in words if (near := alike(word, known, 1, 0.75))]
    assert list(likest(words, known, 0.75)) == each
