"""A store whose seals are right is still read as strictly as a text file: it opens as what it was, or not."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.errors import InputError
from foon_asp.io.findings import Finding
from foon_asp.io.open import FoonReader
from foon_asp.io.store import open_store
from foon_asp.io.store_tables import SCHEMAS, from_tables, to_tables
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon
from support.examples import many
from support.stores import UNITS, seal, write_sealed, write_small_store


@pytest.fixture
def small(tmp_path: Path) -> Path:
    return write_small_store(tmp_path)


def change(folder: Path, table: str, column: str, edit: Callable[[list[Any]], list[Any]]) -> None:
    path = folder / f"{table}.parquet"
    before = pq.read_table(path)
    values = edit(before[column].to_pylist())
    columns = {name: before[name].to_pylist() for name in before.column_names} | {column: values}
    pq.write_table(pa.table(columns, schema=SCHEMAS[table]), path)
    seal(folder)


def first(value: object) -> Callable[[list[Any]], list[Any]]:
    """Put a value into the first row."""
    return lambda values: [value, *values[1:]]


HOSTILE: list[tuple[str, str, object]] = [
    *((table, column, None) for table in SCHEMAS for column in SCHEMAS[table].names),
    *(("units", "rate", rate) for rate in (5.0, -1.0, math.inf)),
    *(("times", column, time) for column in ("start", "end") for time in (-1.0, math.inf, 1e300)),
    *(("units", "motion", motion) for motion in ("", "a\nb", "a\0b", "Chop", " chop", "chop*", "a\tb")),
    *(("objects", "label", label) for label in ("", "a\nM\tb", "a\0b", "Egg", "egg ", "\x1b[31m")),
    *(("states", "name", name) for name in ("", "a\nb", "a [b]", "A")),
    *(("states", "relatum", name) for name in ("", "a]", "b\0")),
    ("states", "contents", ["b", "a"]),
    ("states", "contents", ["a,b"]),
    ("states", "contents", [None]),
    ("objects", "states", [1, 0]),
    ("objects", "states", [0, 0]),
    ("objects", "states", [99]),
    ("objects", "states", [-1]),
    ("inputs", "object", -1),
    ("inputs", "object", 99),
    ("inputs", "goal", "yes\n"),
    ("outputs", "unit", -1),
    ("provenance", "unit", 99),
    ("provenance", "line", -1),
    ("provenance", "video", "a\nO\tb"),
    ("findings", "severity", "fatal"),
    ("findings", "code", "no-such-code"),
]
MAY_BE_NULL = {"relatum", "contents", "start", "end", "rate", "moves", "goal"}


@pytest.mark.parametrize(("table", "column", "value"), HOSTILE)
def test_what_no_file_could_say_is_refused(small: Path, table: str, column: str, value: object) -> None:
    change(small, table, column, first(value))
    if value is None and column in MAY_BE_NULL:
        open_store(small)
        return
    with pytest.raises(InputError, match="a damaged store: ") as told:
        open_store(small)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("table", "column"), [("objects", "label"), ("units", "motion"), ("inputs", "object"), ("states", "name")]
)
def test_the_same_thing_twice_is_refused(small: Path, table: str, column: str) -> None:
    """All rows are made alike, so that objects, states, units or the inputs of a unit are there twice."""
    for each, other in ((table, column), ("objects", "states")):
        change(small, each, other, lambda values: [values[0]] * len(values))
    if table == "units":
        for ports in ("inputs", "outputs"):
            change(small, ports, "object", lambda values: [values[0]] * len(values))
    with pytest.raises(InputError, match=r"a damaged store: .*(twice|order)"):
        open_store(small)


@pytest.mark.parametrize(
    ("old", "new", "contents"),
    [("on", "contains", None), ("contains", "in", ["egg"])],
    ids=["held", "placed"],
)
def test_contents_and_places_are_not_confused(
    old: str, new: str, contents: list[str] | None, small: Path
) -> None:
    """What readers of text put right, no store says."""
    if contents:
        change(small, "states", "contents", lambda values: [contents if each else each for each in values])
    open_store(small)
    change(small, "states", "name", lambda values: [new if each == old else each for each in values])
    with pytest.raises(InputError, match=r"a damaged store: .*contents"):
        open_store(small)


@pytest.mark.parametrize(
    "edit",
    [
        {"units_read": "many"},
        {"units_read": True},
        {"units_read": -1},
        {"units_read": 0},
        {"units_reported": None},
        {"tables": {}},
        {"tables": []},
        {"tables": {"units": 3}},
        {"sources": 1},
        {"sources": ["\ud800"]},
        {"units_read": "\ud800"},
    ],
)
def test_a_manifest_that_says_something_else(small: Path, edit: dict[str, Any]) -> None:
    path = small / "manifest.json"
    write_sealed(path, json.loads(path.read_text()) | edit)
    with pytest.raises(InputError, match="a damaged store: "):
        open_store(small)


@many(300)
@given(st.data())
def test_a_store_that_was_changed_says_what_text_can_say(data: st.DataObject) -> None:
    """A value of a random table is put in another place; what opens all the same is as good as text."""
    foon, findings = _read(UNITS.encode())
    tables = to_tables(foon, findings)
    name = data.draw(st.sampled_from(sorted(SCHEMAS)))
    column = data.draw(st.sampled_from(SCHEMAS[name].names))
    columns = {each: tables[name][each].to_pylist() for each in SCHEMAS[name].names}
    rows = len(columns[column])
    place = data.draw(st.integers(0, rows - 1)) if rows else 0
    columns[column][place : place + 1] = [
        data.draw(st.sampled_from([*columns[column], None])) if rows else None for _ in range(min(1, rows))
    ]
    tables[name] = pa.table(columns, schema=SCHEMAS[name])
    try:
        changed, _ = from_tables(tables)
    except (ValueError, pa.ArrowException):
        return
    written = write_text(changed, changed.units, dialect="A")
    read, _ = _read(written.encode())
    assert [(unit.motion, nodes(read, unit.inputs), nodes(read, unit.outputs)) for unit in read.units] == [
        (unit.motion, nodes(changed, unit.inputs), nodes(changed, unit.outputs)) for unit in changed.units
    ]


def nodes(foon: Foon, numbers: tuple[Any, ...]) -> list[object]:
    return [foon.objects[number] for number in numbers]


def _read(data: bytes) -> tuple[Foon, list[Finding]]:
    reader = FoonReader()
    try:
        reader.read_data(data, Path("drawn.txt"))
    except InputError:
        reader = FoonReader()
        reader.read_data(UNITS.encode(), Path("drawn.txt"))
    files = reader.finish()
    return files.foon, list(files.findings)
