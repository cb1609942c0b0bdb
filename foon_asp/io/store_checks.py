"""Whether tables say what a FOON file could have said: a seal only tells that they are whole."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from foon_asp.characters import one_line
from foon_asp.io.findings import ODDITIES, Severity
from foon_asp.io.syntax import LABEL_MARKS, LONGEST_TIME, clean, split_motion
from foon_asp.model.arrays import Rows, distinct
from foon_asp.model.foon import Foon
from foon_asp.model.notation import PLACES
from foon_asp.model.tables import ObjectTable, StateTable, UnitTable

_MAY_BE_NULL = frozenset({"relatum", "contents", "start", "end", "rate", "moves", "goal"})
_SEVERITIES = frozenset(severity.word for severity in Severity)


def check_columns(tables: Mapping[str, pa.Table], schemas: Mapping[str, pa.Schema]) -> None:
    """Raise `ValueError` if a table has other columns, or what no column may hold."""
    for name, schema in schemas.items():
        table = tables[name]
        if not table.schema.equals(schema):
            raise ValueError(f"the table {name!r} has other columns")
        table.validate(full=True)
        for column in schema.names:
            _check_column(table[column], f"{name}.{column}", may_be_null=column in _MAY_BE_NULL)
    _check_known(tables["findings"]["code"], ODDITIES, "findings.code")
    _check_known(tables["findings"]["severity"], _SEVERITIES, "findings.severity")
    for name in ("inputs", "outputs"):
        _check_words(tables[name]["goal"], _is_goal, f"{name}.goal")


def _check_column(column: pa.ChunkedArray, name: str, *, may_be_null: bool) -> None:
    if column.null_count and not may_be_null:
        raise ValueError(f"a value of {name} is missing")
    for chunk in column.chunks:
        if pa.types.is_dictionary(column.type):
            words = chunk.dictionary
            if words.null_count or len(words.unique()) != len(words):
                raise ValueError(f"a word of {name} is missing or there twice")
        elif pa.types.is_list(column.type) and chunk.values.null_count:
            raise ValueError(f"a value in {name} is missing")


def _check_known(column: pa.ChunkedArray, known: Iterable[str], name: str) -> None:
    words = set(known)
    _check_words(column, words.__contains__, name)


def _check_words(column: pa.ChunkedArray, good: Callable[[str], bool], name: str) -> None:
    """Raise `ValueError` if a word of a column is not a good one."""
    for word in column.unique().to_pylist():
        if word is not None and not good(word):
            raise ValueError(f"{name} says {word[:60]!r}")


def _is_goal(word: str) -> bool:
    return word in ("", "!") or word.isdigit()


def check_foon(foon: Foon) -> None:
    """Raise `ValueError` if a FOON of some tables is none that the readers make of a file."""
    _check_states(foon.objects.kinds)
    _check_objects(foon.objects)
    _check_units(foon.units)


def _check_states(kinds: StateTable) -> None:
    words = kinds.words
    said = set(kinds.name.tolist())
    placed = set(kinds.relatum[kinds.relatum >= 0].tolist())
    held = set(kinds.contents.values.tolist())
    _each([words[code] for code in said | placed | held], _is_state_word, "state")
    _each([words[code] for code in held], lambda word: "," not in word, "content")
    ranks = np.argsort(np.array(sorted(range(len(words)), key=words.__getitem__), dtype=np.int64))
    before, after = _neighbours(kinds.contents)
    if (ranks[before] > ranks[after]).any():
        raise ValueError("the contents of a state are not sorted")
    _check_places(kinds)
    if kinds.repeats():
        raise ValueError("a state is there twice")


def _check_places(kinds: StateTable) -> None:
    """Raise `ValueError` for contents in brackets or a place in braces, which readers put right."""
    relative = kinds.relatum >= 0
    places = [code for code, word in enumerate(kinds.words) if word in PLACES]
    holding = [code for code, word in enumerate(kinds.words) if word == "contains"]
    counts = np.bincount(kinds.contents.owners, minlength=len(kinds))
    if (np.isin(kinds.name, holding) & relative & ~kinds.braces).any():
        raise ValueError("the contents of a state are a place")
    if (np.isin(kinds.name, places) & ~relative & (counts == 1)).any():
        raise ValueError("the place of a state is among its contents")


def _check_objects(objects: ObjectTable) -> None:
    _each(objects.labels, _is_label, "object label")
    before, after = _neighbours(objects.states)
    kinds = objects.kinds
    ranks = kinds.ranks
    one, other = ranks[before], ranks[after]
    # Only of states that differ in nothing but their contents the contents must be compared.
    alike = one == other
    pairs = distinct(before[alike].astype(np.int64) << 32 | after[alike]).tolist()
    if (one > other).any() or any(
        not kinds[pair >> 32].sort_key < kinds[pair & 0xFFFFFFFF].sort_key for pair in pairs
    ):
        raise ValueError("the states of an object are not in their order")
    if objects.repeats():
        raise ValueError("an object is there twice")


def _check_units(units: UnitTable) -> None:
    _each(units.motions, _is_motion, "motion")
    notes = units.notes
    _check_between(notes.rate, 1, "success rates")
    _check_between(notes.start, LONGEST_TIME, "start times")
    _check_between(notes.end, LONGEST_TIME, "end times")
    places, said = notes.times.values, np.zeros(len(units), np.bool_)
    said[notes.times.owners[~(np.isnan(notes.start[places]) & np.isnan(notes.end[places]))]] = True
    if (~said & (notes.times.lengths > 0)).any():
        raise ValueError("a unit has times of which nothing is known")
    if (units.inputs.lengths == 0).any():
        raise ValueError("a unit has no input")
    _each(notes.agents, _is_field, "agent")
    _each(notes.videos, _is_field, "video")
    if len(notes.line) and notes.line.min() < 0:
        raise ValueError("a line has a number below 0")
    for ports in (units.inputs, units.outputs):
        keys = np.sort(ports.owners.astype(np.int64) << 32 | ports.values)
        if (keys[1:] == keys[:-1]).any():
            raise ValueError("a unit lists an object twice")
    if units.repeats():
        raise ValueError("a unit is there twice")


def _neighbours(table: Rows[Any, int]) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Return the values that stand behind one another in a row."""
    owners = table.owners
    together = owners[1:] == owners[:-1]
    return table.values[:-1][together], table.values[1:][together]


def _check_between(values: npt.NDArray[np.float64], most: float, what: str) -> None:
    known = values[~np.isnan(values)]
    if len(known) and not 0 <= known.min() <= known.max() <= most:
        raise ValueError(f"some {what} are not between 0 and {most}")


def _each(words: Sequence[str], good: Callable[[str], bool], what: str) -> None:
    for word in words:
        if not good(word):
            raise ValueError(f"{word[:60]!r} is no {what} that a file could have")


def _is_label(word: str) -> bool:
    return bool(word) and clean(word) == word


def _is_state_word(word: str) -> bool:
    return _is_label(word) and not LABEL_MARKS.search(word)


def _is_motion(word: str) -> bool:
    return _is_label(word) and split_motion(word) == (word, False)


def _is_field(word: str) -> bool:
    return one_line(word) == word
