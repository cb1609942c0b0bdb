"""Columns of tables, and how lists and places are worded."""

from __future__ import annotations

import pytest

from foon_asp.render.table import Cell, table
from foon_asp.words import WIDTH, listed, short_source, shortened, wrapped


@pytest.mark.parametrize(
    ("rows", "columns", "lines"),
    [
        pytest.param([("a", "bc"), ("abc", "d")], ("<", "<"), ["a    bc", "abc  d "], id="left"),
        pytest.param([("a", "bc"), ("abc", "d")], (">", ">"), ["  a  bc", "abc   d"], id="right"),
        pytest.param([("a", "x y")], ("<4",), ["a     x y"], id="at least so wide, and a column as it is"),
        pytest.param([(7, "7"), ("oven", 10)], ("=", "="), ["   7  7 ", "oven  10"], id="numbers right"),
        pytest.param([("goal",), ("a", "b")], ("<",), ["goal", "a     b"], id="a short row"),
        pytest.param([], ("<",), [], id="no row"),
    ],
)
def test_cells_stand_in_columns(
    rows: list[tuple[Cell, ...]], columns: tuple[str, ...], lines: list[str]
) -> None:
    assert table(rows, *columns) == lines


def test_the_gap_stands_between_columns() -> None:
    assert table([("a", "b"), ("ab", "c")], "<", gap=" | ") == ["a  | b", "ab | c"]


def test_lists_are_cut() -> None:
    names = ["a", "b", "c", "d"]
    assert [listed(names[:count]) for count in range(5)] == [
        "",
        "a",
        "a and b",
        "a, b and c",
        "a, b, c and 1 more",
    ]
    assert listed(names, 4) == "a, b, c and d"
    assert shortened(names, 2) == "a, b and 2 more"
    assert shortened(names, 2, ";") == "a; b; and 2 more"
    assert shortened(names, 4, ";") == "a; b; c; d"


def test_places_are_named_without_folders() -> None:
    assert short_source("some/folder/FOON.txt", 7) == "FOON.txt:7"
    assert short_source("FOON.txt", 0) == "FOON.txt"
    assert short_source("", 0) == ""


def test_no_word_is_broken() -> None:
    long = "non-stick-" * WIDTH
    assert wrapped(f"a {long} b", "  - ", "    ") == ["  - a", f"    {long}", "    b"]
