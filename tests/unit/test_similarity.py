"""Which labels are alike: by a table, by the vectors of their words, by their uses in a FOON."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest

from foon_asp.errors import InputError, QueryError
from foon_asp.io import similar
from foon_asp.io.similar import ingredient_vectors
from foon_asp.model.similarity import Likeness, Similar, Table, Uses, Words
from foon_asp.query.substitution import Replacement, read_substitutes
from support.small_foons import foon

FRUIT = foon(
    "lime[whole] + (knife) -cut-> lime[halved]",
    "lemon[whole] + (knife) -cut-> lemon[halved]",
    "lemon[halved] + (cup) -squeeze-> lemon[squeezed]",
    "egg[whole] -crack-> egg[cracked]",
    "knife[dirty] -wash-> knife[clean]",
)


def test_labels_with_the_same_uses_are_alike() -> None:
    uses = Uses(FRUIT, {"knife"})
    found = uses.likeness("lime", "lemon")
    assert found is not None
    assert 0.25 < found.value < 0.5
    assert found == uses.likeness("lemon", "lime")
    assert uses.likeness("egg", "lemon") is None
    # Nothing is known of utensils, nor of what is in no unit.
    assert not uses.knows("knife", "lemon")
    assert uses.likeness("knife", "lemon") is None
    assert not uses.knows("cup", "mango")


def test_the_same_uses_count_half() -> None:
    found = Uses(foon("a[raw] -fry-> a[done]", "b[raw] -fry-> b[done]", "c -mix-> c[mixed]"), ()).likeness(
        "a", "b"
    )
    assert found == Likeness(0.5, "same motions in the same states")


def test_words_are_compared_by_their_stems() -> None:
    words = Words(
        {"chees": np.array([3.0, 4.0]), "feta": np.array([4.0, 3.0]), "berri": np.array([0.0, -1.0])}
    )
    found = words.likeness("cheese", "feta cheese")
    # The mean of two directions lies between them: cos(θ/2), where cos(θ) is 0.96.
    assert found is not None
    assert found.value == pytest.approx(np.sqrt((1 + 24 / 25) / 2), abs=1e-3)
    assert words.knows("cheeses", "berry")
    assert words.likeness("cheese", "berry") is None
    assert not words.knows("cheese", "cheesemonger")
    assert words.likeness("cheese", "oil") is None
    assert words.likeness("", "cheese") is None


def test_the_first_measure_that_knows_a_pair_judges_it() -> None:
    words = Words({"lime": np.array([1.0, 0.0]), "lemon": np.array([0.0, 1.0])})
    uses = Uses(FRUIT, ())
    table = Table({("lemon", "lime"): Likeness(0.9, "both sour")})
    assert Similar([table, words, uses]).likeness("lemon", "lime") == Likeness(0.9, "both sour")
    # A table goes one way, and the words say no.
    assert Similar([table, words, uses]).likeness("lime", "lemon") is None
    assert Similar([uses]).replacements("lime", ["egg", "lemon", "lime"]) == [
        ("lemon", uses.likeness("lime", "lemon"))
    ]


def written(folder: Path, text: str) -> Path:
    path = folder / "table.tsv"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_table_of_substitutes(tmp_path: Path) -> None:
    text = "# fats\nButter\tmargarine\t0.9\tin cakes\nbutter\toil\t.5\n\nparsley\t-\t0.8\n"
    assert read_substitutes(written(tmp_path, text)) == [
        Replacement("butter", "margarine", 0.9, "in cakes"),
        Replacement("butter", "oil", 0.5, "as the table says"),
        Replacement("parsley", None, 0.8),
    ]


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("butter\tmargarine", "cannot read 'butter\\tmargarine'; write label<tab>replaced by<tab>"),
        ("butter margarine 0.9", "cannot read"),
        ("butter\tmargarine\t0", "cannot read"),
        ("butter\tmargarine\t1.1", "cannot read"),
        ("butter\tmargarine\tnan", "cannot read"),
        ("butter\t\t0.9", "cannot read"),
        ("\tbutter\t0.9", "cannot read"),
        ("butter\toil\t0.9\tnote\tmore", "cannot read"),
        ("butter\toil\t0.9\t\x1b[2J", "cannot read"),
        ("butter\tButter\t0.9", "cannot read"),
        ("a\tb\t0.1\nbutter\toil\t0.9\nbutter\toil\t0.8", "'butter' by 'oil' stands twice"),
    ],
)
def test_a_table_that_is_none(tmp_path: Path, line: str, complaint: str) -> None:
    with pytest.raises(InputError) as raised:
        read_substitutes(written(tmp_path, f"# table\n{line}\n"))
    assert complaint in str(raised.value)
    assert len(str(raised.value).splitlines()) == 1


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"text",
        gzip.compress(b"", mtime=0),
        gzip.compress(b"2 2\na 1 2\nb 1", mtime=0),
        gzip.compress(b"1 2\na x y", mtime=0),
        gzip.compress(b"7", mtime=0),
    ],
)
def test_vectors_that_cannot_be_read(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "vectors.gz"
    path.write_bytes(data)
    with pytest.raises(InputError, match="no vectors can be read"):
        similar._read_vectors(path)


def test_vectors_that_are_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(similar, "_PACKAGE", "no-such-package")
    with pytest.raises(QueryError, match=r"pip install 'foon-asp\[similar\]'"):
        ingredient_vectors()


@pytest.fixture(scope="module")
def recipes() -> Words:
    return Words(ingredient_vectors())


@pytest.mark.parametrize(
    ("label", "near", "far"),
    [
        ("butter", "heavy cream", "lettuce"),
        ("banana", "mango", "onion"),
        ("cheese", "feta cheese", "sugar"),
        ("lemon", "lime", "milk"),
    ],
)
def test_ingredients_by_their_vectors(recipes: Words, label: str, near: str, far: str) -> None:
    assert recipes.likeness(label, near) is not None
    assert recipes.knows(label, far)
    assert recipes.likeness(label, far) is None
