"""The tables of encodings/README.md say what the files say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from support.encoding_files import FILES, FOLDER, NAMES, all_statements, file_of, shown
from support.paths import ROOT

PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")


def rows(*heads: str) -> list[list[str]]:
    """Return the rows of the table with these heads."""
    lines = PAGE.splitlines()
    start = lines.index(f"| {' | '.join(heads)} |") + 2
    end = next(place for place in range(start, len(lines) + 1) if not "".join(lines[place : place + 1]))
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[start:end]]


FILE_ROWS = {row[0].strip("`"): row for row in rows("file", "what it says", "includes", "loaded by")}
ATOM_ROWS = rows("atom", "shown by", "read by", "becomes")


def named(cell: str) -> set[str]:
    return set(re.findall(r"`([^`]+)`", cell))


def test_the_first_table_has_every_file_once() -> None:
    assert sorted(FILE_ROWS) == NAMES
    assert len(rows("file", "what it says", "includes", "loaded by")) == len(FILES)


@pytest.mark.parametrize("path", FILES, ids=NAMES)
def test_what_a_file_includes_is_in_the_table(path: Path) -> None:
    """A file reaches exactly what the files in its row, and in the rows of those, name."""
    own = path.relative_to(FOLDER).as_posix()
    includes = {
        (path.parent / name).resolve().relative_to(FOLDER.resolve()).as_posix()
        for name in re.findall(r'^#include "([^"]+)"\.$', path.read_text("utf-8"), re.MULTILINE)
    }
    assert named(FILE_ROWS[own][2]) == includes
    reached, open_ = {own}, [own]
    while open_:
        for each in named(FILE_ROWS[open_.pop()][2]) - reached:
            reached.add(each)
            open_.append(each)
    assert {file_of(each) for each in all_statements(path)} <= reached


@pytest.mark.parametrize("name", NAMES)
def test_every_file_is_loaded_or_included(name: str) -> None:
    loaded = FILE_ROWS[name][3]
    includers = [other for other, row in FILE_ROWS.items() if name in named(row[2])]
    assert re.search(r"`[a-z_/]+\.py`", loaded) or (includers and loaded == "the files that include it")


def test_the_second_table_has_every_shown_atom_and_its_files() -> None:
    listed = {
        (name, 1 + arguments.count(",")): named(row[1])
        for row in ATOM_ROWS
        for name, arguments in re.findall(r"^`(\w+)\(([^)]*)\)`$", row[0])
    }
    found: dict[tuple[str, int], set[str]] = {}
    for path, name in zip(FILES, NAMES, strict=True):
        for signature in shown(path):
            found.setdefault(signature, set()).add(name)
    assert len(listed) == len(ATOM_ROWS)
    assert listed == found


MODULES = {
    path.relative_to(ROOT / "foon_asp").as_posix(): path.read_text("utf-8")
    for path in (ROOT / "foon_asp").rglob("*.py")
}


@pytest.mark.parametrize("name", NAMES)
def test_whoever_loads_a_file_names_it(name: str) -> None:
    """A module that loads a file has its name as a text; criteria are loaded by what is asked for."""
    modules = {module for module in named(FILE_ROWS[name][3]) if module in MODULES}
    modules.discard("asp/facts.py")
    loading = {module for module, text in MODULES.items() if f'"{name}"' in text}
    if name.startswith("criteria/") and 'f"criteria/{name}.lp"' in MODULES["asp/program.py"]:
        modules.discard("asp/program.py")
        loading.discard("asp/program.py")
    # The one reads all files, the other says of some what rules may speak of.
    loading -= {"asp/encodings.py", "asp/heads.py"}
    assert modules == loading


@pytest.mark.parametrize("row", ATOM_ROWS, ids=[row[0] for row in ATOM_ROWS])
def test_whoever_reads_an_atom_names_it(row: list[str]) -> None:
    predicate = row[0].strip("`").partition("(")[0]
    for module in named(row[2]):
        assert f'"{predicate}"' in MODULES[module], module
