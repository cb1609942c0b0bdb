"""Which words of several trees mean the same thing."""

from __future__ import annotations

from collections import Counter

import pytest

from foon_asp.model.alignment import Aligned, Measure, align, plurals
from foon_asp.resources import lexicon


def trees(*words: str) -> list[Counter[str]]:
    """Return a tree for each text, with the words that are separated by commas."""
    return [Counter(word.strip() for word in text.split(",")) for text in words]


@pytest.mark.parametrize(
    ("one", "other", "why"),
    [
        ("cutting board", "cuttingboard", "spelling"),
        ("pick-and-place", "Pick and_place", "spelling"),
        ("blueberry", "blueberries", "number"),
        ("tomato", "tomatoes", "number"),
        ("bay leaf", "bay leaves", "number"),
        ("knife", "knives", "number"),
        ("green onion", "greenonions", "number"),
        ("spinach", "spinnach", "misspelling"),
    ],
)
def test_words_that_are_the_same(one: str, other: str, why: str) -> None:
    """Of two words that each stand in a tree the one that stands in more is kept."""
    assert align(trees(one, one, other), (), lexicon()) == [Aligned(other, one, why)]
    assert align(trees(other, one, one), (), lexicon()) == [Aligned(other, one, why)]


def test_what_is_misspelt_is_never_kept() -> None:
    assert align(trees("spinnach", "spinnach", "spinach"), (), lexicon()) == [
        Aligned("spinnach", "spinach", "misspelling")
    ]


@pytest.mark.parametrize(
    "words",
    [
        "can, cane",
        "pea, pear",
        "glass, glas s es",
        "rice, ice",
        "bun, bus",
        "olive, olive oil",
        "salt, salad",
    ],
)
def test_words_that_are_not(words: str) -> None:
    assert align(trees(words, words), (), lexicon()) == []


def test_words_beside_the_trees_are_brought_to_theirs() -> None:
    """What a model says is aligned, and does not count where the trees have a word."""
    assert align(trees("cuttingboard", "bowl"), ("cutting board", "cutting boards")) == [
        Aligned("cutting board", "cuttingboard", "spelling"),
        Aligned("cutting boards", "cuttingboard", "number"),
    ]


LIKENESS = {
    frozenset(("milk", "cream")): 0.9,
    frozenset(("milk", "yogurt")): 0.85,
    frozenset(("ice", "egg")): 0.1,
}


def likeness(one: str, other: str) -> float:
    return LIKENESS.get(frozenset((one, other)), 0.0)


def test_a_measure_of_likeness_joins_the_most_alike_first() -> None:
    measure = Measure(likeness, 0.8)
    assert align(trees("milk", "milk, ice", "cream", "egg"), (), (), measure) == [
        Aligned("cream", "milk", "likeness")
    ]
    assert align(trees("milk", "cream"), (), (), Measure(likeness, 0.95)) == []


def test_two_things_of_one_tree_are_two_however_alike() -> None:
    """Yogurt is taken for milk; cream, which stands beside yogurt, then is not."""
    measure = Measure(likeness, 0.8)
    assert align(trees("milk, cream", "milk"), (), (), measure) == []
    assert align(trees("milk", "milk", "cream, yogurt"), (), (), measure) == [
        Aligned("cream", "milk", "likeness")
    ]


def test_plurals() -> None:
    assert plurals("berry") == {"berrys", "berries"}
    assert plurals("half") == {"halfs", "halves"}
    assert plurals("dish") == {"dishs", "dishes"}
