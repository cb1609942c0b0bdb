"""Measured tables go to their place in a page, and nowhere else."""

from __future__ import annotations

from pathlib import Path

import pytest
from tables import put_table, with_table

from support.paths import ROOT

PAGE = "EXECUTABLE\n<!-- table: commands -->\n\nold\n\n<!-- end of table: commands -->\nNOT EXECUTABLE\n"


def test_a_table_takes_the_place_of_the_old_one(tmp_path: Path) -> None:
    new = PAGE.replace("old", "| new |\n|---|")
    assert with_table(PAGE, "commands", ["| new |", "|---|"]) == new
    assert with_table(new, "commands", ["old"]) == PAGE
    path = tmp_path / "page.md"
    path.write_text(PAGE, encoding="utf-8")
    put_table(path, "commands", ["| new |", "|---|"])
    assert path.read_text(encoding="utf-8") == new


@pytest.mark.parametrize(
    "page",
    [
        "EXECUTABLE table: commands\n",
        PAGE + PAGE,
        PAGE.replace("<!-- end of table: commands -->\n", ""),
        PAGE.replace("<!-- table: commands -->\n", ""),
        PAGE.replace("<!-- table: commands -->", "`<!-- table: commands -->`"),
        "<!-- end of table: commands -->\n<!-- table: commands -->\n",
    ],
)
def test_exactly_one_place_or_an_error(page: str, tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    path.write_text(page, encoding="utf-8")
    with pytest.raises(ValueError, match="not exactly one place for the table 'commands'"):
        put_table(path, "commands", ["| new |"])
    assert path.read_text(encoding="utf-8") == page


def test_another_table_is_an_error() -> None:
    with pytest.raises(ValueError, match="not exactly one place for the table 'goals'"):
        with_table(PAGE, "goals", ["| new |"])
    with pytest.raises(ValueError, match="no name of a table"):
        with_table(PAGE, "TABLE -->", ["| new |"])


@pytest.mark.parametrize(("page", "name"), [("benchmarks/README.md", "commands")])
def test_the_pages_have_the_places(page: str, name: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    start, end = f"<!-- table: {name} -->\n\n", f"\n\n<!-- end of table: {name} -->"
    assert with_table(text, name, text[text.index(start) + len(start) : text.index(end)].splitlines()) == text
