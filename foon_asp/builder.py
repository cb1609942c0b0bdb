"""Building a FOON: every object node once, every functional unit once."""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterable, Sequence

import numpy as np

from foon_asp.arrays import Numbers, Rows
from foon_asp.graph import Annotation, Foon, Mark, ObjectNode, Source, State
from foon_asp.tables import Notes, ObjectTable, StateTable, UnitTable

_NO_MARK = Mark()


class FoonBuilder:
    """Collects objects and units into a `Foon`. `read` counts the units, duplicates too."""

    def __init__(self) -> None:
        self._labels: dict[str, int] = {}
        self._kinds: dict[State, int] = {}
        self._nodes: dict[tuple[int, ...], int] = {}
        self._label = array("i")
        self._states = _Ragged()
        self._motions: dict[str, int] = {}
        self._units: dict[tuple[int, ...], int] = {}
        self._motion = array("i")
        self._inputs = _Ragged()
        self._outputs = _Ragged()
        self._composite = array("b")
        self._start = array("d")
        self._end = array("d")
        self._rate = array("d")
        self._agents: dict[str, int] = {}
        self._agent = array("i")
        self._marks: dict[int, tuple[Mark, ...]] = {}
        self._places = _Places()
        self.read = 0

    def object(self, node: ObjectNode) -> int:
        """Return the id of a node, a new one if it was not seen before."""
        label = self._labels.setdefault(node.label, len(self._labels))
        kinds = self._kinds
        states = [kinds.setdefault(state, len(kinds)) for state in node.states]
        number = self._nodes.setdefault((label, *states), len(self._label))
        if number == len(self._label):
            self._label.append(label)
            self._states.append(states)
        return number

    def unit(
        self, motion: str, inputs: Sequence[int], outputs: Sequence[int], note: Annotation
    ) -> tuple[int, bool]:
        """Add a unit. Return its id, and whether it is new: its inputs, motion and outputs were not there."""
        return self.add(motion, inputs, outputs, note, note.sources, note.marks)

    def add(
        self,
        motion: str,
        inputs: Sequence[int],
        outputs: Sequence[int],
        note: Annotation,
        sources: Iterable[Source],
        marks: Sequence[Mark] = (),
    ) -> tuple[int, bool]:
        """Do the same with sources and marks other than those of the note, which many units may share."""
        self.read += 1
        number = len(self._motion)
        label = self._motions.setdefault(motion, len(self._motions))
        before, behind = set(inputs), set(outputs)
        if len(before) != len(inputs) or len(behind) != len(outputs):
            inputs, outputs, marks = _without_repeats(inputs, outputs, marks)
        known = self._units.setdefault((label, *sorted(before), -1, *sorted(behind)), number)
        self._places.add(known, sources)
        if known != number:
            return known, False
        self._motion.append(label)
        self._inputs.append(inputs)
        self._outputs.append(outputs)
        self._composite.append(note.composite)
        self._start.append(math.nan if note.start is None else note.start)
        self._end.append(math.nan if note.end is None else note.end)
        self._rate.append(math.nan if note.rate is None else note.rate)
        self._agent.append(self._agents.setdefault(note.agent, len(self._agents)))
        if marks:
            self._marks[number] = tuple(marks)
        return number, True

    def include(self, foon: Foon) -> None:
        """Add every unit of another FOON."""
        ids = [self.object(node) for node in foon.objects]
        for unit in foon.units:
            self.unit(
                unit.motion,
                [ids[number] for number in unit.inputs],
                [ids[number] for number in unit.outputs],
                unit.annotation,
            )

    def build(self) -> Foon:
        """Return what was collected; each unit knows all places where it was read."""
        objects = ObjectTable(
            list(self._labels), _ints(self._label), StateTable.of(self._kinds), self._states.rows()
        )
        inputs, outputs = self._inputs.rows(), self._outputs.rows()
        sources, file, line, video = self._places.columns(len(self._motion))
        in_marks, out_marks, marks = self._mark_columns(inputs, outputs)
        notes = Notes(
            np.array(self._composite, dtype=np.bool_),
            np.array(self._start, dtype=np.float64),
            np.array(self._end, dtype=np.float64),
            np.array(self._rate, dtype=np.float64),
            _ints(self._agent),
            list(self._agents),
            in_marks,
            out_marks,
            marks,
            sources,
            file,
            line,
            video,
            list(self._places.files),
            list(self._places.videos),
        )
        motions = list(self._motions)
        units = UnitTable(motions, _ints(self._motion), inputs, outputs, notes)
        return Foon(objects, units, self.read - len(units))

    def _mark_columns(self, inputs: Rows, outputs: Rows) -> tuple[Numbers, Numbers, list[Mark]]:
        """Return the marks of all inputs and all outputs, as numbers into the marks that there are."""
        codes = {_NO_MARK: 0}
        columns = np.zeros(len(inputs.values), np.int32), np.zeros(len(outputs.values), np.int32)
        before = inputs.lengths
        for unit, marks in self._marks.items():
            numbers = [codes.setdefault(mark, len(codes)) for mark in marks]
            split = int(before[unit])
            for ports, column, part in (
                (inputs, columns[0], numbers[:split]),
                (outputs, columns[1], numbers[split:]),
            ):
                column[ports.offsets[unit] : ports.offsets[unit + 1]] = part
        return *columns, list(codes)


class _Ragged:
    """Rows that grow at their end."""

    def __init__(self) -> None:
        self._values = array("i")
        self._ends = array("q", [0])

    def append(self, row: Sequence[int]) -> None:
        self._values.extend(row)
        self._ends.append(len(self._values))

    def rows(self) -> Rows:
        return Rows(np.array(self._ends, dtype=np.int64), _ints(self._values))


class _Places:
    """The places that units were read at, in the order of reading."""

    def __init__(self) -> None:
        self.files: dict[str, int] = {}
        self.videos: dict[str, int] = {}
        self._unit = array("i")
        self._file = array("i")
        self._line = array("i")
        self._video = array("i")

    def add(self, unit: int, sources: Iterable[Source]) -> None:
        for source in sources:
            self._unit.append(unit)
            self._file.append(self.files.setdefault(source.file, len(self.files)))
            self._line.append(source.line)
            self._video.append(self.videos.setdefault(source.video, len(self.videos)))

    def columns(self, units: int) -> tuple[Rows, Numbers, Numbers, Numbers]:
        """Return the places of each unit, each once, and their file, line and video."""
        columns = np.stack([_ints(each) for each in (self._unit, self._file, self._line, self._video)])
        order = np.lexsort(columns[::-1])
        columns_in_order = columns[:, order]
        again = np.zeros(len(order), dtype=np.bool_)
        again[1:] = (columns_in_order[:, 1:] == columns_in_order[:, :-1]).all(axis=0)
        unit, file, line, video = np.delete(columns, order[again], axis=1)
        return Rows.of(unit, np.arange(len(unit), dtype=np.int32), units), file, line, video


def _ints(values: array[int]) -> Numbers:
    return np.array(values, dtype=np.int32)


def _without_repeats(
    inputs: Sequence[int], outputs: Sequence[int], marks: Sequence[Mark]
) -> tuple[list[int], list[int], list[Mark]]:
    """Keep the first of each object on either side, and the marks that belong to those kept."""
    keep_in = _first_places(inputs)
    keep_out = _first_places(outputs)
    places = keep_in + [len(inputs) + place for place in keep_out]
    return (
        [inputs[place] for place in keep_in],
        [outputs[place] for place in keep_out],
        [marks[place] for place in places] if marks else [],
    )


def _first_places(items: Sequence[int]) -> list[int]:
    first: dict[int, int] = {}
    for place, item in enumerate(items):
        first.setdefault(item, place)
    return list(first.values())


def merge(foons: Iterable[Foon]) -> Foon:
    """Return the universal FOON: the union, duplicate units removed, the earliest kept."""
    builder = FoonBuilder()
    for foon in foons:
        builder.include(foon)
        builder.read += foon.duplicates
    return builder.build()
