"""The functional units of a text, in columns: which lines belong to which unit, and which units are whole.

Nothing is read here but the numbers of lines, and what `Lines` says of each. A unit goes to its `//` line, an
object to the next line that is no state. What depends on several lines is decided here, and only here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from foon_asp.io.lines import END, MOTION, OBJECT, ORIGIN, REST, VIDEO, Columns
from foon_asp.model.arrays import Mask, Numbers, Places, Rows
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.node import ObjectId

Kinds = npt.NDArray[np.int8]


@dataclass(frozen=True, slots=True)
class Side:
    """The inputs or the outputs of all whole units, each once, and their marks.

    `listed` is what the lines list, and `odd` says which units list nothing, or one thing twice.
    """

    objects: Rows[int, ObjectId]
    marks: Numbers
    listed: Rows[int, ObjectId]
    odd: Mask

    @classmethod
    def of(cls, listed: Rows[int, ObjectId], marks: Numbers) -> Side:
        """Keep the first of each object."""
        again = listed.repeated()
        odd = listed.lengths == 0
        odd[listed.owners[again]] = True
        return cls(listed.where(~again), marks[~again], listed, odd)


class Units:
    """The units of some lines of a file, numbered 0, 1, …; the last one may lack its `//`.

    Places are those of lines, counted from the first one here; `nowhere` is behind all.
    """

    def __init__(self, lines: Numbers, known: Columns, video: int) -> None:
        """Find the units of some lines, at least one; `video` is that of the lines before."""
        kind = known.kind[lines]
        self.lines = lines
        self.known = known
        self.nowhere = len(lines)
        self.ends = np.flatnonzero(kind == END)
        closed = int(self.ends[-1]) + 1 == len(lines) if len(self.ends) else False
        self.count = len(self.ends) + (not closed)
        self.closing = np.append(self.ends, self.nowhere)[: self.count]
        """The place of the `//` of each unit."""
        self._find_objects_and_motions(kind)
        self._find_states(kind)
        self._find_comments(kind, video)

    def _find_objects_and_motions(self, kind: Kinds) -> None:
        known, lines = self.known, self.lines
        self.objects = np.flatnonzero(kind == OBJECT)
        self.motions = np.flatnonzero(kind == MOTION)
        self.unit_of_object = np.searchsorted(self.ends, self.objects)
        unit_of_motion = np.searchsorted(self.ends, self.motions)
        """The places of all motions; `motion` is the first of each unit."""
        self.motion = self._firsts(unit_of_motion, self.motions)
        self.first = np.minimum(self.motion, self._firsts(self.unit_of_object, self.objects))
        """The place of the first object or motion of each unit."""
        self.found = self.first < self.nowhere
        """Which units are no mere `//`."""
        self.motion_count = np.bincount(unit_of_motion, minlength=self.count)
        self.readable = self.motion_count == 1
        """Which units have one motion, and objects with labels."""
        self.readable[self.unit_of_object[known.code[lines[self.objects]] < 0]] = False
        self.whole = self.readable.copy()
        """Which of these also have a motion with a label and an input: the units that there are."""
        self.whole[self.readable] = known.code[lines[self.motion[self.readable]]] >= 0
        self.is_from_nothing = self.whole & (self.motion <= self.first)
        """Which of these have no input. They are left out, too: nothing is made from nothing."""
        self.whole &= ~self.is_from_nothing

    def _find_states(self, kind: Kinds) -> None:
        """Tell the states of objects from lines that stand elsewhere."""
        rest = np.flatnonzero(kind == REST)
        heads = np.flatnonzero(kind != REST)
        above = np.append(np.int8(END), kind[heads])[np.searchsorted(heads, rest)]
        self.is_stray = np.zeros(self.nowhere, np.bool_)
        self.is_stray[rest[above != OBJECT]] = True
        states = rest[above == OBJECT]
        states = states[self.known.code[self.lines[states]] >= 0]
        owners = np.searchsorted(self.objects, states) - 1
        self.states: Rows[int, int] = Rows.of(owners, self.known.code[self.lines[states]], len(self.objects))
        """What the states of each object are."""
        self.is_repeated = np.zeros(self.nowhere, np.bool_)
        self.is_repeated[states[self.states.repeated()]] = True
        odd = self.known.odd[self.lines] | self.is_stray | self.is_repeated
        # What is odd in a motion counts only where the unit is read.
        odd[self.motions] = False
        self.odd_lines = np.flatnonzero(odd)

    def _find_comments(self, kind: Kinds, video: int) -> None:
        """Find which video each unit was seen in, and where comments say that units come from."""
        code = self.known.code[self.lines]
        changes = np.flatnonzero(kind == VIDEO)
        videos = np.append(np.int32(video), code[changes])
        self.video = videos[np.searchsorted(changes, self.closing)]
        origins = np.flatnonzero(kind == ORIGIN)
        unit = np.searchsorted(self.ends, origins)
        counts = self.whole[unit] & (origins < self.first[unit])
        origins = origins[counts]
        self.unit_of_origin = unit[counts]
        self.origin = code[origins]
        self.video_of_origin = videos[np.searchsorted(changes, origins)]

    def _firsts(self, units: Places, places: Places) -> Places:
        """Return the first of the places that each unit has."""
        first = np.full(self.count, self.nowhere)
        first[units[::-1]] = places[::-1]
        return first

    def sides(self, builder: FoonBuilder) -> tuple[Side, Side]:
        """Number the objects of whole units, in order; return their inputs and their outputs."""
        kept = self.whole[self.unit_of_object]
        unit = ranks(self.whole)[self.unit_of_object[kept]]
        lines = self.lines[self.objects[kept]]
        ids = builder.objects(self.known.code[lines], self.states.chosen(kept))
        behind = self.objects[kept] > self.motion[self.unit_of_object[kept]]
        marks = self.known.mark[lines]
        count = int(np.count_nonzero(self.whole))
        inputs, outputs = (
            Side.of(Rows.of(unit[side], ids[side], count), marks[side]) for side in (~behind, behind)
        )
        return inputs, outputs


def ranks(chosen: Mask) -> Numbers:
    """Return the numbers 0, 1, … that those that are chosen get."""
    return np.cumsum(chosen, dtype=np.int32) - np.int32(1)
