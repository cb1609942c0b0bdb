"""The FOON itself: object nodes, functional units, and the graph they form. Pure data, no I/O.

Object nodes and functional units are small values, made when they are asked for; the graph itself is kept in
arrays, so that a million units fit into memory and are searched quickly.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from itertools import compress
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

from foon_asp.errors import QueryError
from foon_asp.model.arrays import K, Mask, Numbers, Rows, V
from foon_asp.model.node import NO_MARK, Annotation, FunctionalUnit, Mark, ObjectId, ObjectNode, UnitId
from foon_asp.model.numbering import Numbering, RowNumbering, with_set
from foon_asp.model.tables import Notes, ObjectTable, StateTable, UnitTable
from foon_asp.values import a_list, said

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    from foon_asp.draw.formats import Drawing

T = TypeVar("T")


@dataclass(frozen=True, slots=True, repr=False)
class Foon:
    """A FOON: object nodes and functional units, each named by its index.

    `builder.FoonBuilder` makes one, or `store.open_store` from tables on disk.
    """

    objects: ObjectTable
    units: UnitTable
    duplicates: int = 0

    def draw(
        self, around: ObjectNode | str | None = None, hops: int = 1, *, dark: bool | None = None
    ) -> Drawing:
        """Return the FOON as a picture (of a large one an overview), or what is `around` an object of it.

        The units that make or need the object are one hop away.
        """
        from foon_asp.draw.views import foon_drawing

        return foon_drawing(self, around, hops, dark)

    def to_frame(self) -> pd.DataFrame:
        """Return the units as a table, a row each: motion, inputs, outputs, times, rate, source, video."""
        from foon_asp.render.frames import foon_frame

        return foon_frame(self)

    def to_networkx(self) -> nx.DiGraph:
        """Return the FOON as a directed graph: object nodes, and the ids of units between them."""
        from foon_asp.render.graphs import foon_graph

        return foon_graph(self)

    def __repr__(self) -> str:
        return f"<Foon: {len(self.units):,} units, {len(self.objects):,} objects>"

    def _repr_html_(self) -> str:
        from foon_asp.render.notebook import foon_html

        return foon_html(self)

    def _repr_svg_(self) -> str | None:
        from foon_asp.draw.views import svg_unasked

        return svg_unasked(self.units, self.draw)

    def id_of(self, node: ObjectNode) -> ObjectId | None:
        """Return the id of a node, or None if the FOON does not know it."""
        return self.objects.number_of(node)

    def labelled(self, label: str) -> list[ObjectNode]:
        """Return all object nodes with a label."""
        return [self.objects[number] for number in self.objects.labelled(label)]

    @property
    def motions(self) -> list[str]:
        """All motion labels, sorted."""
        return sorted(self.units.motions)

    @property
    def labels(self) -> set[str]:
        """The labels of all object nodes."""
        return set(self.objects.labels)

    @property
    def named_labels(self) -> set[str]:
        """Every label that an object node names: its own, those of relata and of contents."""
        return self.labels | self.objects.kinds.named

    def goal_marks(self) -> dict[ObjectNode, set[str]]:
        """Return what annotators marked as intended goals, in file order, and how: `!` or a dish category."""
        notes = self.units.notes
        goals = [mark.goal for mark in notes.marks]
        is_goal = np.array([bool(goal) for goal in goals], np.bool_)
        found: list[tuple[UnitId, int, ObjectId, str]] = []
        for side, (ports, codes) in enumerate(
            ((self.units.inputs, notes.in_marks), (self.units.outputs, notes.out_marks))
        ):
            chosen = np.flatnonzero(is_goal[codes])
            owners, values = ports.owners[chosen].tolist(), ports.values[chosen].tolist()
            marks = map(goals.__getitem__, codes[chosen].tolist())
            found += [
                (unit, side, port, mark) for unit, port, mark in zip(owners, values, marks, strict=True)
            ]
        marked: dict[ObjectId, set[str]] = {}
        # Sorting keeps the order of the ports of one side.
        for _, _, port, mark in sorted(found, key=lambda each: each[:2]):
            marked.setdefault(port, set()).add(mark)
        return {self.objects[port]: names for port, names in marked.items()}

    def marked_goals(self) -> list[ObjectNode]:
        """Return the same without the marks."""
        return list(self.goal_marks())


class Added(Enum):
    """What became of a unit that was added to a FOON."""

    NEW = auto()
    """Its inputs, motion and outputs were not there."""
    AGAIN = auto()
    """It was there before; what only the later one notes beside its rate is dropped."""
    OTHER_RATE = auto()
    """It was there before with another success rate, or with none; the better rate is kept."""


@dataclass(frozen=True, slots=True)
class UnitColumns:
    """Many units at once, by the numbers that a builder has given to their words, objects, marks and files.

    A side lists an object once. As in `Notes`, times and rates that are not known are NaN, `times` are rows
    of numbers into `start` and `end`, and marks run parallel to the values of a side. `places` are where the
    units were read: the place of the unit in these columns, file, line and video.
    """

    motion: Numbers
    inputs: Rows[int, ObjectId]
    outputs: Rows[int, ObjectId]
    in_marks: Numbers
    out_marks: Numbers
    composite: npt.NDArray[np.bool_]
    times: Rows[Any, int]
    start: npt.NDArray[np.float64]
    end: npt.NDArray[np.float64]
    rate: npt.NDArray[np.float64]
    agent: Numbers
    places: tuple[Numbers, Numbers, Numbers, Numbers]


@dataclass(frozen=True, slots=True)
class Repeat:
    """A unit that was there before: where it stands in its columns, its id, and the rate that is kept."""

    place: int
    unit: UnitId
    added: Added
    rate: float


class FoonBuilder:
    """Collects objects and units into a `Foon`. `read` counts the units, duplicates too.

    Objects and units are given one by one (`object`, `unit`), or many at once in columns (`objects`,
    `units`), by the numbers that words, states and marks have here. What of these no object and no unit has
    is left out in the end. With `repeats` a unit that is there already is added once more, as in a list of
    steps; without, it is one unit with a further place.
    """

    def __init__(self, *, repeats: bool = False) -> None:
        self._repeats = repeats
        self.labels: Numbering[str] = Numbering()
        self.words: Numbering[str] = Numbering()
        self.motions: Numbering[str] = Numbering()
        self.agents: Numbering[str] = Numbering()
        self.marks: Numbering[Mark] = Numbering([NO_MARK])
        self.files: Numbering[str] = Numbering()
        self.videos: Numbering[str] = Numbering()
        self.read = 0
        self._states = RowNumbering()
        self._nodes = RowNumbering()
        self._units = RowNumbering()
        self._motion = array("i")
        self._inputs: _Ragged[UnitId, ObjectId] = _Ragged()
        self._outputs: _Ragged[UnitId, ObjectId] = _Ragged()
        self._in_marks = array("i")
        self._out_marks = array("i")
        self._composite = array("b")
        self._times: _Ragged[UnitId, int] = _Ragged()
        self._start = array("d")
        self._end = array("d")
        self._rate = array("d")
        self._agent = array("i")
        self._places = _Places()

    def state(self, name: str, relatum: str | None, contents: Sequence[str] | None) -> int:
        """Return the number of a state of these words; contents are sorted."""
        words = self.words
        place = -1 if relatum is None else words[relatum]
        return self._states.number(
            (words[name], place, contents is not None, *map(words.__getitem__, contents or ()))
        )

    def object(self, node: ObjectNode) -> ObjectId:
        """Return the id of a node, a new one if it was not seen before."""
        states = (self.state(state.name, state.relatum, state.contents) for state in node.states)
        return ObjectId(self._nodes.number(with_set(self.labels[node.label], states)))

    def objects(self, label: Numbers, states: Rows[int, int]) -> Numbers:
        """Return the ids of many nodes: the label of each, and its states in any order."""
        return self._nodes.numbers(Rows.headed((label,), states.as_sets()))[0]

    def unit(
        self, motion: str, inputs: Sequence[ObjectId], outputs: Sequence[ObjectId], note: Annotation
    ) -> tuple[UnitId, Added]:
        """Add a unit. Return its id, and what became of it."""
        self.read += 1
        number = UnitId(len(self._motion))
        label = self.motions[motion]
        known = number
        if not self._repeats:
            row = with_set(label, (*inputs, *(~output for output in outputs)))
            known = UnitId(self._units.number(row))
        for source in note.sources:
            self._places.add(known, self.files[source.file], source.line, self.videos[source.video])
        if known != number:
            return known, self._again(known, note.rate)
        marks = [self.marks[mark] for mark in note.marks] or [0] * (len(inputs) + len(outputs))
        for side, ports, column, codes in (
            (inputs, self._inputs, self._in_marks, marks[: len(inputs)]),
            (outputs, self._outputs, self._out_marks, marks[len(inputs) :]),
        ):
            first = dict(zip(reversed(side), reversed(codes), strict=True))
            kept = list(dict.fromkeys(side))
            ports.append(kept)
            column.extend(map(first.__getitem__, kept))
        self._motion.append(label)
        self._composite.append(note.composite)
        self._times.append(range(len(self._start), len(self._start) + len(note.times)))
        for interval in note.times:
            self._start.append(math.nan if interval.start is None else interval.start)
            self._end.append(math.nan if interval.end is None else interval.end)
        self._rate.append(math.nan if note.rate is None else note.rate)
        self._agent.append(self.agents[note.agent])
        return number, Added.NEW

    def units(self, units: UnitColumns) -> list[Repeat]:
        """Add many units. Return those that were there before, in order."""
        self.read += len(units.motion)
        found, new = self._numbers_of(units)
        place, file, line, video = units.places
        self._places.extend(found[place], file, line, video)
        for side, marks, rows, column in (
            (units.inputs, units.in_marks, self._inputs, self._in_marks),
            (units.outputs, units.out_marks, self._outputs, self._out_marks),
        ):
            rows.extend(side.chosen(new))
            _extend(column, marks[np.repeat(new, side.lengths)])
        _extend(self._motion, units.motion[new])
        _extend(self._composite, units.composite[new].view(np.int8))
        times = units.times.chosen(new)
        known = len(self._start)
        _extend(self._start, units.start[times.values])
        _extend(self._end, units.end[times.values])
        self._times.extend(Rows(times.offsets, np.arange(known, len(self._start), dtype=np.int32)))
        _extend(self._rate, units.rate[new])
        _extend(self._agent, units.agent[new])
        return [
            self._repeat(place, UnitId(int(found[place])), float(units.rate[place]))
            for place in np.flatnonzero(~new).tolist()
        ]

    def _numbers_of(self, units: UnitColumns) -> tuple[Numbers, Mask]:
        """Return the ids that units have or get, and which of them are new."""
        if self._repeats:
            begin, count = len(self._motion), len(units.motion)
            return np.arange(begin, begin + count, dtype=np.int32), np.ones(count, np.bool_)
        outputs: Rows[int, ObjectId] = Rows(units.outputs.offsets, ~units.outputs.values)
        ports: Rows[int, ObjectId] = Rows.joined(units.inputs, outputs)
        return self._units.numbers(Rows.headed((units.motion,), ports.as_sets()))

    def _repeat(self, place: int, unit: UnitId, rate: float) -> Repeat:
        added = self._again(unit, None if math.isnan(rate) else rate)
        return Repeat(place, unit, added, self._rate[unit])

    def _again(self, unit: UnitId, rate: float | None) -> Added:
        """Keep the better of a unit's rates; one of its own is better than none."""
        before = self._rate[unit]
        # What has no rate is no number, which equals nothing.
        if rate is None or rate == before:
            return Added.AGAIN if rate == before or math.isnan(before) else Added.OTHER_RATE
        self._rate[unit] = rate if math.isnan(before) else max(rate, before)
        return Added.OTHER_RATE

    def rate(self, unit: UnitId) -> float:
        """Return the success rate that a unit has now; no number (NaN) if it has none of its own."""
        return self._rate[unit]

    def include(self, foon: Foon) -> list[tuple[UnitId, FunctionalUnit]]:
        """Add every unit of another FOON. Return those that were there with another rate, and their ids."""
        objects, units, notes = foon.objects, foon.units, foon.units.notes
        states = self._include_states(objects.kinds)
        label = self.labels.of(objects.labels)[objects.label]
        ids = self.objects(label, Rows(objects.states.offsets, states[objects.states.values]))
        marks = self.marks.of(notes.marks)
        places = notes.sources.values
        columns = UnitColumns(
            self.motions.of(units.motions)[units.motion],
            Rows(units.inputs.offsets, ids[units.inputs.values]),
            Rows(units.outputs.offsets, ids[units.outputs.values]),
            marks[notes.in_marks],
            marks[notes.out_marks],
            notes.composite,
            notes.times,
            notes.start,
            notes.end,
            notes.rate,
            self.agents.of(notes.agents)[notes.agent],
            (
                notes.sources.owners,
                self.files.of(notes.files)[notes.file[places]],
                notes.line[places],
                self.videos.of(notes.videos)[notes.video[places]],
            ),
        )
        return [
            (repeat.unit, units[UnitId(repeat.place)])
            for repeat in self.units(columns)
            if repeat.added is Added.OTHER_RATE
        ]

    def _include_states(self, kinds: StateTable) -> Numbers:
        """Return the numbers of all states of another FOON."""
        words = self.words.of(kinds.words)
        heads = (
            words[kinds.name],
            np.append(words, np.int32(-1))[kinds.relatum],
            kinds.braces.astype(np.int32),
        )
        contents: Rows[int, int] = Rows(kinds.contents.offsets, words[kinds.contents.values])
        return self._states.numbers(Rows.headed(heads, contents))[0]

    def build(self) -> Foon:
        """Return what was collected; each unit knows all places where it was read."""
        (label,), states = self._nodes.rows.split(1)
        labels, label = _used(self.labels, label)
        kinds, states = self._used_states(states)
        objects = ObjectTable(labels, label, kinds, kinds.in_order(states))
        agents, agent = _used(self.agents, _ints(self._agent))
        sources, file, line, video = self._places.columns(len(self._motion))
        files, file = _used(self.files, file)
        videos, video = _used(self.videos, video)
        notes = Notes(
            np.array(self._composite, dtype=np.bool_),
            self._times.rows(),
            np.array(self._start, dtype=np.float64),
            np.array(self._end, dtype=np.float64),
            np.array(self._rate, dtype=np.float64),
            agent,
            agents,
            _ints(self._in_marks),
            _ints(self._out_marks),
            list(self.marks),
            sources,
            file,
            line,
            video,
            files,
            videos,
        )
        motions, motion = _used(self.motions, _ints(self._motion))
        units = UnitTable(motions, motion, self._inputs.rows(), self._outputs.rows(), notes)
        return Foon(objects, units, self.read - len(units))

    def _used_states(self, states: Rows[ObjectId, int]) -> tuple[StateTable, Rows[ObjectId, int]]:
        """Return the table of those states that object nodes have, and the numbers that they have there."""
        numbers, values = _used(range(len(self._states)), states.values)
        is_used = np.zeros(len(self._states), np.bool_)
        is_used[numbers] = True
        (name, relatum, braces), contents = self._states.rows.chosen(is_used).split(3)
        named = relatum >= 0
        words, codes = _used(self.words, np.concatenate((name, relatum[named], contents.values)))
        name, relatum[named], content = np.split(codes, [len(name), len(name) + np.count_nonzero(named)])
        table = StateTable(words, name, relatum, Rows(contents.offsets, content), braces > 0)
        return table, Rows(states.offsets, values)


class _Ragged(Generic[K, V]):
    """Rows that grow at their end."""

    def __init__(self) -> None:
        self._values = array("i")
        self._ends = array("q", [0])

    def append(self, row: Sequence[V]) -> None:
        self._values.extend(row)
        self._ends.append(len(self._values))

    def extend(self, rows: Rows[Any, V]) -> None:
        _extend(self._ends, rows.offsets[1:] + len(self._values))
        _extend(self._values, rows.values)

    def rows(self) -> Rows[K, V]:
        return Rows(np.array(self._ends, dtype=np.int64), _ints(self._values))


class _Places:
    """The places that units were read at, in the order of reading."""

    def __init__(self) -> None:
        self._columns = tuple(array("i") for _ in range(4))

    def add(self, *place: int) -> None:
        """Add a unit with the file, line and video of one of its places."""
        for column, value in zip(self._columns, place, strict=True):
            column.append(value)

    def extend(self, *columns: Numbers) -> None:
        """Add the same in columns."""
        for column, values in zip(self._columns, columns, strict=True):
            _extend(column, values)

    def columns(self, units: int) -> tuple[Rows[UnitId, int], Numbers, Numbers, Numbers]:
        """Return the places of each unit, each once, and their file, line and video."""
        columns = np.stack([_ints(each) for each in self._columns])
        order = np.lexsort(columns[::-1])
        columns_in_order = columns[:, order]
        again = np.zeros(len(order), dtype=np.bool_)
        again[1:] = (columns_in_order[:, 1:] == columns_in_order[:, :-1]).all(axis=0)
        unit, file, line, video = np.delete(columns, order[again], axis=1)
        return Rows.of(unit, np.arange(len(unit), dtype=np.int32), units), file, line, video


def _ints(values: array[int]) -> Numbers:
    return np.array(values, dtype=np.int32)


def _extend(column: array[Any], values: npt.NDArray[Any]) -> None:
    """Append numbers to a column of the same kind."""
    assert column.itemsize == values.itemsize
    column.frombytes(values.tobytes())


def _used(things: Collection[T], codes: Numbers) -> tuple[list[T], Numbers]:
    """Leave out the things that no code is the number of. Return the others, and their codes."""
    used = np.bincount(codes, minlength=len(things)) > 0
    if used.all():
        return list(things), codes
    return list(compress(things, used.tolist())), (np.cumsum(used, dtype=np.int32) - 1)[codes]


def merge(foons: Iterable[Foon]) -> Foon:
    """Return the union, the universal FOON; of units that are alike the earliest, with their best rate."""
    builder = FoonBuilder()
    for foon in a_list(foons, "foons", "FOONs"):
        if not isinstance(foon, Foon):
            raise QueryError(f"a FOON is a Foon, not {said(foon)}; read one with foon_asp.read")
        builder.include(foon)
        builder.read += foon.duplicates
    return builder.build()
