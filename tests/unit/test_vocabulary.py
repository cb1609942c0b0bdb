"""Words of older FOON files: read as the current ones, each with a finding, or left as they are."""

from __future__ import annotations

import re

import pytest

import foon_asp as fa
from foon_asp.io.vocabulary import CURRENT
from foon_asp.model.node import UnitId
from support.paths import ROOT
from support.reading_checks import check

UNIT = "O\tbowl\n{}\nM\tpick + place\nO\tbowl\n//\n"
STATES = [
    ("S\tingredients inside\t{x,y}", "bowl {x, y}", "ingredients inside {x, y}"),
    ("S182\tIngredients Inside  {x}", "bowl {x}", "ingredients inside {x}"),
    ("S\tingredients on top\t{x}", "bowl {x}", "ingredients on top {x}"),
    ("S215\tno state\t", "bowl", "bowl [no state]"),
    ("S\tin foil\t{x}", "bowl in [foil]{x}", "in foil {x}"),
    ("S\tattached to  lid\t{x}", "bowl attached to [lid]{x}", "attached to  lid"),
    # Newer files have these, too, and what says two things at once has no current word.
    ("S\tin foil", "bowl in [foil]", "bowl in [foil]"),
    ("S\tingredients mixed inside\t{x}", "ingredients mixed inside", "ingredients mixed inside"),
    ("S\tin\t{x,y}", "{x, y}", "{x, y}"),
]


@pytest.mark.parametrize(("row", "current", "written"), STATES)
def test_states(row: str, current: str, written: str) -> None:
    text = UNIT.format(row)
    read, left = fa.read(text), fa.read(text, vocabulary="as-written")
    assert (read.motions, left.motions) == (["pick-and-place"], ["pick + place"])
    said, kept = (str(foon.objects[foon.units[UnitId(0)].inputs[0]]) for foon in (read, left))
    assert current in said
    assert written in kept
    files = check(text.encode())
    assert files is not None
    assert [f.line for f in files.findings if f.code == "older-word"] == [2] * (said != kept) + [3]


def test_an_unknown_vocabulary_is_refused() -> None:
    with pytest.raises(fa.QueryError, match=r"no vocabulary 'old'; there are current, as-written"):
        fa.read("", vocabulary="old")  # type: ignore[arg-type]


def test_the_page_has_the_whole_table() -> None:
    page = (ROOT / "docs" / "format.md").read_text(encoding="utf-8")
    [table] = re.findall(r"^\| older \| is read as \|\n((?:\|.*\n)+)", page, re.MULTILINE)
    for word, current in {**CURRENT.states, **CURRENT.motions}.items():
        [row] = [row for row in table.splitlines() if f"`{word}" in row]
        assert current in row
