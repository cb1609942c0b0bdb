"""The tables of a compiled store, and the way from a FOON to them and back.

Each table can be used by itself: ids are written out, and words are words. docs/scale.md describes them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.compute as pc

from foon_asp.io.findings import Finding, Severity
from foon_asp.io.store_checks import check_columns, check_foon
from foon_asp.model.arrays import Numbers, Rows, V
from foon_asp.model.foon import Foon
from foon_asp.model.node import Mark, ObjectId, UnitId
from foon_asp.model.tables import Notes, ObjectTable, StateTable, UnitTable

_ID = pa.int32()
_WORD = pa.dictionary(pa.int32(), pa.string())
_TIMES = (("start", pa.float64()), ("end", pa.float64()))
_PORTS = pa.schema([("unit", _ID), ("object", _ID), ("moves", pa.bool_()), ("goal", _WORD)])

SCHEMAS: Mapping[str, pa.Schema] = {
    "objects": pa.schema([("object", _ID), ("label", _WORD), ("states", pa.list_(_ID))]),
    "states": pa.schema(
        [("state", _ID), ("name", _WORD), ("relatum", _WORD), ("contents", pa.list_(pa.string()))]
    ),
    "units": pa.schema(
        [
            ("unit", _ID),
            ("motion", _WORD),
            ("composite", pa.bool_()),
            ("agent", _WORD),
            ("rate", pa.float64()),
        ]
    ),
    "times": pa.schema([("unit", _ID), *_TIMES]),
    "inputs": _PORTS,
    "outputs": _PORTS,
    "provenance": pa.schema([("unit", _ID), ("file", _WORD), ("line", _ID), ("video", _WORD)]),
    "findings": pa.schema(
        [
            ("code", _WORD),
            ("severity", _WORD),
            ("file", _WORD),
            ("line", _ID),
            ("message", pa.string()),
            ("mend", pa.string()),
        ]
    ),
}
"""The columns of each table. The states of an object are ids into `states`, in their canonical order; the
times, inputs, outputs and places of a unit stand together, in their order."""

FIRST_SCHEMAS: Mapping[str, pa.Schema] = {
    **{name: schema for name, schema in SCHEMAS.items() if name != "times"},
    "units": pa.schema([*list(SCHEMAS["units"])[:3], *_TIMES, *list(SCHEMAS["units"])[3:]]),
}
"""The columns of the first version, in which a unit had one interval, beside what else was noted of it."""


def to_tables(foon: Foon, findings: Sequence[Finding]) -> dict[str, pa.Table]:
    """Return the tables of a FOON, and of what was odd in its files."""
    columns = {
        "objects": _objects(foon.objects),
        "states": _states(foon.objects.kinds),
        "units": _units(foon.units),
        "times": _times(foon.units.notes),
        "inputs": _ports(foon.units.inputs, foon.units.notes.in_marks, foon.units.notes.marks),
        "outputs": _ports(foon.units.outputs, foon.units.notes.out_marks, foon.units.notes.marks),
        "provenance": _provenance(foon.units.notes),
        "findings": _findings(findings),
    }
    return {name: pa.table(columns[name], schema=schema) for name, schema in SCHEMAS.items()}


def _objects(objects: ObjectTable) -> list[pa.Array]:
    states = objects.states
    lists = pa.ListArray.from_arrays(pa.array(states.offsets.astype(np.int32)), pa.array(states.values))
    return [_ids(len(objects)), _words(objects.label, objects.labels), lists]


def _states(kinds: StateTable) -> list[pa.Array]:
    words = pa.array(kinds.words, pa.string())
    relatum = pa.array(kinds.relatum, mask=kinds.relatum < 0)
    return [
        _ids(len(kinds)),
        _words(kinds.name, kinds.words),
        pa.DictionaryArray.from_arrays(relatum, words),
        pa.ListArray.from_arrays(
            pa.array(kinds.contents.offsets.astype(np.int32)),
            words.take(pa.array(kinds.contents.values)),
            mask=pa.array(~kinds.braces),
        ),
    ]


def _units(units: UnitTable) -> list[pa.Array]:
    notes = units.notes
    return [
        _ids(len(units)),
        _words(units.motion, units.motions),
        pa.array(notes.composite),
        _words(notes.agent, notes.agents),
        pa.array(notes.rate, from_pandas=True),
    ]


def _times(notes: Notes) -> list[pa.Array]:
    places = notes.times.values
    columns = (notes.start[places], notes.end[places])
    return [pa.array(notes.times.owners), *(pa.array(each, from_pandas=True) for each in columns)]


def _ports(ports: Rows[UnitId, ObjectId], codes: Numbers, marks: Sequence[Mark]) -> list[pa.Array]:
    moves = pa.array([mark.moves for mark in marks], pa.bool_())
    goals = _encoded(mark.goal or None for mark in marks)
    chosen = pa.array(codes)
    return [pa.array(ports.owners), pa.array(ports.values), moves.take(chosen), goals.take(chosen)]


def _provenance(notes: Notes) -> list[pa.Array]:
    places = notes.sources.values
    return [
        pa.array(notes.sources.owners),
        _words(notes.file[places], notes.files),
        pa.array(notes.line[places]),
        _words(notes.video[places], notes.videos),
    ]


def _findings(findings: Sequence[Finding]) -> list[pa.Array]:
    return [
        _encoded(finding.code for finding in findings),
        _encoded(finding.severity.word for finding in findings),
        _encoded(finding.file for finding in findings),
        pa.array([finding.line for finding in findings], _ID),
        pa.array([finding.message for finding in findings], pa.string()),
        pa.array([finding.mend for finding in findings], pa.string()),
    ]


def _ids(count: int) -> pa.Array:
    return pa.array(np.arange(count, dtype=np.int32))


def _words(codes: Numbers, words: Sequence[str]) -> pa.Array:
    return pa.DictionaryArray.from_arrays(pa.array(codes), pa.array(words, pa.string()))


def _encoded(words: Iterable[str | None]) -> pa.Array:
    return pa.array(list(words), pa.string()).dictionary_encode()


def from_tables(tables: Mapping[str, pa.Table]) -> tuple[Foon, list[Finding]]:
    """Return the FOON of some tables, and what was odd in its files.

    Those of the first version are read, too. Raises `ValueError` if the tables do not fit together, or say
    what no file could have said.
    """
    check_columns(tables, SCHEMAS if "times" in tables else FIRST_SCHEMAS)
    objects = _read_objects(tables["objects"], _read_states(tables["states"]))
    units = tables["units"]
    count = len(units)
    _check_ids(units, "unit")
    motion, motions = _codes(units, "motion")
    agent, agents = _codes(units, "agent")
    marks = {Mark(): 0}
    sources: Rows[UnitId, int] = _rows(
        tables["provenance"], np.arange(len(tables["provenance"]), dtype=np.int32), count
    )
    file, files = _codes(tables["provenance"], "file")
    video, videos = _codes(tables["provenance"], "video")
    times, start, end = _read_times(tables, count)
    notes = Notes(
        units["composite"].to_numpy(),
        times,
        start,
        end,
        _known(units, "rate"),
        agent,
        agents,
        _read_marks(tables["inputs"], marks),
        _read_marks(tables["outputs"], marks),
        list(marks),
        sources,
        file,
        _numbers(tables["provenance"], "line"),
        video,
        files,
        videos,
    )
    inputs, outputs = (_read_ports(tables[name], count, len(objects)) for name in ("inputs", "outputs"))
    foon = Foon(objects, UnitTable(motions, motion, inputs, outputs, notes))
    check_foon(foon)
    return foon, _read_findings(tables["findings"])


def _read_states(table: pa.Table) -> StateTable:
    _check_ids(table, "state")
    codes: dict[str, int] = {}

    def renumbered(numbers: Numbers, words: Sequence[str]) -> Numbers:
        """Return the numbers of the same words in one list of all words; -1 stays."""
        return np.array([*(codes.setdefault(word, len(codes)) for word in words), -1], np.int32)[numbers]

    name, relatum = (renumbered(*_codes(table, column)) for column in ("name", "relatum"))
    lists = _whole(table, "contents")
    contents = lists.values.dictionary_encode()
    values = renumbered(contents.indices.to_numpy(), contents.dictionary.to_pylist())
    return StateTable(
        list(codes),
        name,
        relatum,
        Rows(lists.offsets.to_numpy().astype(np.int64), values),
        lists.is_valid().to_numpy(zero_copy_only=False),
    )


def _read_objects(table: pa.Table, kinds: StateTable) -> ObjectTable:
    _check_ids(table, "object")
    label, labels = _codes(table, "label")
    lists = _whole(table, "states")
    states: Rows[ObjectId, int] = Rows(lists.offsets.to_numpy().astype(np.int64), lists.values.to_numpy())
    _check_range(states.values, len(kinds), "states")
    return ObjectTable(labels, label, kinds, states)


def _read_times(
    tables: Mapping[str, pa.Table], units: int
) -> tuple[Rows[UnitId, int], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return the intervals of each unit, and when each starts and ends."""
    table = tables.get("times", tables["units"])
    start, end = _known(table, "start"), _known(table, "end")
    places = np.arange(len(table), dtype=np.int32)
    if "times" in tables:
        return _rows(table, places, units), start, end
    rows: Rows[UnitId, int] = Rows.parted(places, np.ones(units, np.int64))
    return rows.where(~(np.isnan(start) & np.isnan(end))), start, end


def _read_ports(table: pa.Table, units: int, objects: int) -> Rows[UnitId, ObjectId]:
    object_ids = _numbers(table, "object")
    _check_range(object_ids, objects, "objects")
    return _rows(table, object_ids, units)


def _rows(table: pa.Table, values: Numbers, units: int) -> Rows[UnitId, V]:
    """Return the values of each unit; the lines of a unit stand together."""
    owners = _numbers(table, "unit")
    _check_range(owners, units, "units")
    if (np.diff(owners) < 0).any():
        raise ValueError("the lines of a unit do not stand together")
    ends = np.cumsum(np.bincount(owners, minlength=units), dtype=np.int64)
    return Rows(np.concatenate((np.zeros(1, np.int64), ends)), values)


def _read_marks(table: pa.Table, marks: dict[Mark, int]) -> Numbers:
    """Return the number of the mark of each line; marks that are new get the next numbers."""
    moves = np.asarray(pc.fill_null(_whole(table, "moves").cast(pa.int8()), -1).to_numpy()) + 1
    goal, goals = _codes(table, "goal")
    keys = moves + 3 * (goal.astype(np.int64) + 1)
    numbers = np.zeros(int(keys.max(initial=0)) + 1, dtype=np.int32)
    for key in np.flatnonzero(np.bincount(keys)).tolist():
        moved = None if key % 3 == 0 else key % 3 == 2
        numbers[key] = marks.setdefault(Mark(moved, goals[key // 3 - 1] if key >= 3 else ""), len(marks))
    return numbers[keys]


def _read_findings(table: pa.Table) -> list[Finding]:
    columns: list[list[Any]] = [table[name].to_pylist() for name in SCHEMAS["findings"].names]
    return [
        Finding(code, Severity[severity.upper()], file, line, message, mend)
        for code, severity, file, line, message, mend in zip(*columns, strict=True)
    ]


def _whole(table: pa.Table, name: str) -> Any:
    """Return a column in one piece."""
    column = table[name]
    if pa.types.is_dictionary(column.type):
        column = column.unify_dictionaries()
    return column.chunk(0) if column.num_chunks == 1 else column.combine_chunks()


def _numbers(table: pa.Table, name: str) -> Numbers:
    values: Numbers = _whole(table, name).to_numpy()
    return values


def _known(table: pa.Table, name: str) -> npt.NDArray[np.float64]:
    """Return numbers, NaN where there is none."""
    values: npt.NDArray[np.float64] = _whole(table, name).to_numpy(zero_copy_only=False)
    return values


def _codes(table: pa.Table, name: str) -> tuple[Numbers, list[str]]:
    """Return a column of words as numbers into the words there are; -1 where there is none."""
    column = _whole(table, name)
    return pc.fill_null(column.indices, -1).to_numpy(), column.dictionary.to_pylist()


def _check_ids(table: pa.Table, name: str) -> None:
    if not np.array_equal(_numbers(table, name), np.arange(len(table))):
        raise ValueError(f"the {name}s are not numbered 0, 1, 2, …")


def _check_range(values: Numbers, count: int, what: str) -> None:
    if len(values) and not 0 <= values.min() <= values.max() < count:
        raise ValueError(f"some {what} are missing")
