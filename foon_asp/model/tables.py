"""The tables behind a FOON: numpy columns that look like sequences of states, object nodes and units."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from operator import eq
from typing import Any, Generic, TypeVar, cast, overload

import numpy as np
import numpy.typing as npt

from foon_asp.model.arrays import K, Mask, Numbers, Places, Rows, distinct, numbers, places, rows
from foon_asp.model.node import (
    Annotation,
    FunctionalUnit,
    Interval,
    Mark,
    ObjectId,
    ObjectNode,
    Source,
    State,
    UnitId,
)

T = TypeVar("T")

_KEPT = 1 << 16
"""How many values a table keeps once they were made."""


_UNASKED = cast(Any, object())
"""Stands for the number of a node that was not asked for."""


class _Table(Sequence[T], Generic[K, T]):
    """A sequence whose values are made from arrays when they are asked for, and kept for a while."""

    def __init__(self) -> None:
        self._made: dict[int, T] = {}

    def _make(self, number: K) -> T:
        raise NotImplementedError

    @property
    def ids(self) -> Sequence[K]:
        """The numbers of all values, in order."""
        return cast(Sequence[K], range(len(self)))

    # Narrower than that of a sequence: not any integer is a number of this table.
    @overload  # type: ignore[override]
    def __getitem__(self, number: K) -> T: ...
    @overload
    def __getitem__(self, number: slice) -> list[T]: ...
    def __getitem__(self, number: K | slice) -> T | list[T]:
        if isinstance(number, slice):
            return [self[cast(K, each)] for each in range(len(self))[number]]
        value = self._made.get(number)
        if value is None:
            if not -len(self) <= number < len(self):
                raise IndexError(number)
            if len(self._made) >= _KEPT:
                self._made.clear()
            value = self._made[number] = self._make(cast(K, number % len(self)))
        return value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and len(self) == len(other) and all(map(eq, self, other))

    __hash__ = None  # type: ignore[assignment]


class StateTable(_Table[int, State]):
    """States: numbers into `words` for the name, the relatum (-1 for none) and the contents.

    `braces` says which states have contents at all, be they empty. No two states are equal.
    """

    def __init__(
        self, words: list[str], name: Numbers, relatum: Numbers, contents: Rows[int, int], braces: Mask
    ) -> None:
        super().__init__()
        self.words = words
        self.name = name
        self.relatum = relatum
        self.contents = contents
        self.braces = braces

    def __len__(self) -> int:
        return len(self.name)

    def _make(self, number: int) -> State:
        words, relatum = self.words, self.relatum[number]
        contents = tuple(words[word] for word in self.contents[number]) if self.braces[number] else None
        return State(words[self.name[number]], None if relatum < 0 else words[relatum], contents)

    @cached_property
    def codes(self) -> dict[str, int]:
        """The number of each word."""
        return {word: code for code, word in enumerate(self.words)}

    @property
    def _keys(self) -> Keys:
        return _state_keys(self.name, self.relatum, self.contents, self.braces)

    @cached_property
    def _index(self) -> _KeyIndex[int]:
        return _KeyIndex(self._keys)

    def find(self, states: Sequence[State]) -> list[int]:
        """Return the numbers of some states, -1 for one that is not here."""
        unknown = len(self.words)
        keys = _state_keys(*_state_columns(states, lambda word: self.codes.get(word, unknown)))
        return self._index.find(keys, lambda place, number: self[number] == states[place])

    def repeats(self) -> bool:
        """Tell whether a state is there twice."""
        return _repeats(self._keys, lambda number: self[number])

    @property
    def ranks(self) -> Places:
        """Numbers in the order of `State.sort_key`, alike for states that differ in contents alone."""
        place = np.empty(len(self.words) + 1, np.int64)
        place[sorted(range(len(self.words)), key=self.words.__getitem__)] = np.arange(len(self.words))
        place[-1] = -1
        kind = np.where(self.braces, 2, self.relatum >= 0)
        ranks: Places = kind << 60 | place[self.name] << 30 | place[self.relatum] + 1
        return ranks

    def in_order(self, table: Rows[K, int]) -> Rows[K, int]:
        """Return rows of states in their canonical order, that of `State.sort_key`."""
        _, rank = np.unique(self.ranks, return_inverse=True)
        keys = table.owners.astype(np.int64) << 32 | rank[table.values]
        order = np.argsort(keys)
        values = table.values[order]
        # Only of states that differ in nothing but their contents the contents must be compared.
        for row in distinct(table.owners[1:][np.diff(keys[order]) == 0]).tolist():
            part = slice(table.offsets[row], table.offsets[row + 1])
            values[part] = sorted(values[part].tolist(), key=lambda number: self[number].sort_key)
        return Rows(table.offsets, values)

    @property
    def named(self) -> set[str]:
        """All words that states name as relatum or contents."""
        used = distinct(np.concatenate((self.relatum, self.contents.values)))
        return {self.words[word] for word in used.tolist() if word >= 0}


def _state_columns(
    states: Sequence[State], code: Callable[[str], int]
) -> tuple[Numbers, Numbers, Rows[int, int], Mask]:
    contents = [state.contents or () for state in states]
    return (
        numbers(code(state.name) for state in states),
        numbers(-1 if state.relatum is None else code(state.relatum) for state in states),
        Rows.parted(numbers(map(code, chain.from_iterable(contents))), map(len, contents)),
        np.array([state.contents is not None for state in states], dtype=np.bool_),
    )


class ObjectTable(_Table[ObjectId, ObjectNode]):
    """Object nodes: each a number into `labels`, and a row of numbers into `kinds`, the states there are.

    The states of a row are in their canonical order, and no two nodes are equal.
    """

    def __init__(
        self, labels: list[str], label: Numbers, kinds: StateTable, states: Rows[ObjectId, int]
    ) -> None:
        super().__init__()
        self.labels = labels
        self.label = label
        self.kinds = kinds
        self.states = states
        self._numbers: dict[ObjectNode, ObjectId | None] = {}

    def __len__(self) -> int:
        return len(self.label)

    def _make(self, number: ObjectId) -> ObjectNode:
        states = tuple(self.kinds[kind] for kind in self.states[number])
        return ObjectNode.in_order(self.labels[self.label[number]], states)

    @cached_property
    def _codes(self) -> dict[str, int]:
        return {label: code for code, label in enumerate(self.labels)}

    @cached_property
    def _index(self) -> _KeyIndex[ObjectId]:
        return _KeyIndex(self._keys)

    @property
    def _keys(self) -> Keys:
        return _node_keys(self.label, self.states)

    def number_of(self, node: ObjectNode) -> ObjectId | None:
        """Return the number of a node, None if it is not here; what was asked is known for a while."""
        found: ObjectId | None = self._numbers.get(node, _UNASKED)
        if found is _UNASKED:
            found = self.find([node])[0]
            if len(self._numbers) >= _KEPT:
                self._numbers.clear()
            self._numbers[node] = found
        return found

    def find(self, nodes: Sequence[ObjectNode]) -> list[ObjectId | None]:
        """Return the numbers of some nodes, None for one that is not here."""
        kinds = iter(self.kinds.find([state for node in nodes for state in node.states]))
        states: Rows[int, int] = rows([next(kinds) for _ in node.states] for node in nodes)
        label = numbers(self._codes.get(node.label, len(self.labels)) for node in nodes)
        found = self._index.find(
            _node_keys(label, states), lambda place, number: self[number] == nodes[place]
        )
        return [None if number < 0 else number for number in found]

    def repeats(self) -> bool:
        """Tell whether an object node is there twice."""
        return _repeats(self._keys, lambda number: self[number])

    def labelled(self, label: str) -> list[ObjectId]:
        """Return the numbers of all nodes with a label."""
        code = self._codes.get(label)
        return [] if code is None else cast(list[ObjectId], np.flatnonzero(self.label == code).tolist())


class _KeyIndex(Generic[K]):
    """Finds rows of a table by keys, which hardly any two rows share."""

    def __init__(self, keys: Keys) -> None:
        self._order = np.argsort(keys, kind="stable")
        self._keys = keys[self._order]

    def find(self, wanted: Keys, same: Callable[[int, K], bool]) -> list[K]:
        """Return for each wanted key, at a place, the number of the row that is the same, or -1."""
        begins = np.searchsorted(self._keys, wanted, side="left")
        ends = np.searchsorted(self._keys, wanted, side="right")
        spans = zip(begins.tolist(), ends.tolist(), strict=True)
        rows_of_keys: Iterator[list[K]] = (self._order[begin:end].tolist() for begin, end in spans)
        return [
            next((number for number in candidates if same(place, number)), cast(K, -1))
            for place, candidates in enumerate(rows_of_keys)
        ]


def _repeats(keys: Keys, value: Callable[[Any], object]) -> bool:
    """Tell whether two rows that share a key have the same value."""
    # To sort numbers takes a tenth of the time that it takes to say in which order they are.
    ordered = np.sort(keys)
    shared = distinct(ordered[1:][ordered[1:] == ordered[:-1]])
    _, doubtful = places(keys, shared)
    numbers = np.flatnonzero(doubtful)
    return len({(int(keys[number]), value(number)) for number in numbers.tolist()}) < len(numbers)


Keys = npt.NDArray[np.uint64]
_ODD = np.uint64(0x9E3779B97F4A7C15)
_OTHER = np.uint64(0xD1B54A32D192ED03)


def _node_keys(label: Numbers, states: Rows[Any, int]) -> Keys:
    return _mixed(label) * _ODD + _sums(states)


def _state_keys(name: Numbers, relatum: Numbers, contents: Rows[int, int], braces: Mask) -> Keys:
    return _mixed(name) * _ODD + _mixed(relatum) * _OTHER + _sums(contents) + braces


def _sums(table: Rows[Any, Any]) -> Keys:
    """Return a key for each row, whatever the order of its values."""
    sums = np.concatenate((np.zeros(1, np.uint64), np.cumsum(_mixed(table.values))))
    return sums[table.offsets[1:]] - sums[table.offsets[:-1]]


def _mixed(codes: Numbers) -> Keys:
    """Spread small numbers over 64 bits, so that sums of them hardly ever meet (splitmix64, Steele 2014)."""
    mixed = (codes.astype(np.uint64) + np.uint64(1)) * _ODD
    mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return mixed ^ (mixed >> np.uint64(31))


@dataclass(frozen=True, slots=True)
class Notes:
    """What annotators noted of each unit, as columns; a time or rate that is not known is NaN.

    `times` are the rows of the intervals that each unit took: numbers into `start` and `end`. `agent` are
    numbers into `agents`. `in_marks` and `out_marks` are numbers into `marks` for each value of the unit's
    inputs and outputs; the mark 0 says nothing. `sources` are the rows of the places that each unit was read
    at: numbers into `file`, `line` and `video`, of which `file` and `video` are again numbers into `files`
    and `videos`.
    """

    composite: npt.NDArray[np.bool_]
    times: Rows[UnitId, int]
    start: npt.NDArray[np.float64]
    end: npt.NDArray[np.float64]
    rate: npt.NDArray[np.float64]
    agent: Numbers
    agents: list[str]
    in_marks: Numbers
    out_marks: Numbers
    marks: list[Mark]
    sources: Rows[UnitId, int]
    file: Numbers
    line: Numbers
    video: Numbers
    files: list[str]
    videos: list[str]

    def place(self, number: int) -> Source:
        """Return one of the places that units were read at."""
        file, video = self.files[self.file[number]], self.videos[self.video[number]]
        return Source(file, int(self.line[number]), video)

    def interval(self, number: int) -> Interval:
        """Return one of the intervals that units took."""
        return Interval(_known(self.start[number]), _known(self.end[number]))

    @property
    def durations(self) -> npt.NDArray[np.float64]:
        """How many seconds each unit took, all its intervals together; 0 if that is not known."""
        seconds = np.nan_to_num(np.maximum(0.0, np.round(self.end) - np.round(self.start)))
        places = self.times.values
        sums: npt.NDArray[np.float64]
        sums = np.bincount(self.times.owners, weights=seconds[places], minlength=len(self.times)).astype(
            float
        )
        return sums


class UnitTable(_Table[UnitId, FunctionalUnit]):
    """Functional units: each a number into `motions`, and rows of object ids; `notes` are beside them."""

    def __init__(
        self,
        motions: list[str],
        motion: Numbers,
        inputs: Rows[UnitId, ObjectId],
        outputs: Rows[UnitId, ObjectId],
        notes: Notes,
    ) -> None:
        super().__init__()
        self.motions = motions
        self.motion = motion
        self.inputs = inputs
        self.outputs = outputs
        self.notes = notes

    def __len__(self) -> int:
        return len(self.motion)

    def _make(self, number: UnitId) -> FunctionalUnit:
        motion = self.motions[self.motion[number]]
        return FunctionalUnit(
            number, motion, self.inputs[number], self.outputs[number], self._annotation(number)
        )

    def repeats(self) -> bool:
        """Tell whether a unit is there twice, whatever was noted of it."""
        keys: Keys = _mixed(self.motion) * _ODD + _sums(self.inputs) * _OTHER + _sums(self.outputs)
        return _repeats(
            keys,
            lambda number: (
                self.motion[number],
                frozenset(self.inputs[number]),
                frozenset(self.outputs[number]),
            ),
        )

    def _annotation(self, number: UnitId) -> Annotation:
        notes = self.notes
        return Annotation(
            tuple(map(notes.place, notes.sources[number])),
            bool(notes.composite[number]),
            tuple(map(notes.interval, notes.times[number])),
            notes.agents[notes.agent[number]],
            _known(notes.rate[number]),
            self._marks(number),
        )

    def _marks(self, number: UnitId) -> tuple[Mark, ...]:
        marks: list[int] = []
        for ports, codes in ((self.inputs, self.notes.in_marks), (self.outputs, self.notes.out_marks)):
            marks += codes[ports.offsets[number] : ports.offsets[number + 1]].tolist()
        return tuple(self.notes.marks[mark] for mark in marks) if any(marks) else ()


def _known(value: float) -> float | None:
    return None if math.isnan(value) else float(value)
