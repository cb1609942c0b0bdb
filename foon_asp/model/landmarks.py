"""Landmarks: what every way to make something, or to do something, has in common.

An object or a unit is a landmark of another one if that is never had without it. Landmarks are the greatest
fixpoint of "its own, with what all its makers have in common, or with what any of its needs has" (Zhu and
Givan, Landmark extraction via planning graph propagation, 2003; Keyder, Richter, Helmert, Sound and complete
landmarks for and/or graphs, 2010). Sets are bit masks here; a few passes in the order of the rounds settle
them.
"""

from __future__ import annotations

import threading
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import reduce
from operator import and_

from foon_asp import limits
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.units import Units

_MOST_BITS = 1 << 13
"""How long the masks may become that are kept; there are as many of them."""


@dataclass(slots=True)
class Landmarks:
    """The landmarks of some objects and units as bit masks, and the bit that stands for each."""

    object_bits: dict[ObjectId, int] = field(default_factory=dict)
    unit_bits: dict[UnitId, int] = field(default_factory=dict)
    objects: dict[ObjectId, int] = field(default_factory=dict)
    units: dict[UnitId, int] = field(default_factory=dict)

    def number(self, objects: Iterable[ObjectId], units: Iterable[UnitId]) -> None:
        """Give a bit to each object and unit that has none yet."""
        for object_id in objects:
            if object_id not in self.object_bits:
                self.object_bits[object_id] = 1 << len(self.object_bits) + len(self.unit_bits)
        for unit in units:
            if unit not in self.unit_bits:
                self.unit_bits[unit] = 1 << len(self.object_bits) + len(self.unit_bits)

    def find(
        self, needs: Mapping[UnitId, Iterable[ObjectId]], makes: Mapping[UnitId, Iterable[ObjectId]]
    ) -> None:
        """Work out the landmarks of some units and of what they make; what cannot be had has none.

        What is there already of an object is of makers that are not among these units.
        """
        objects, units = self.objects, self.units
        object_bits, unit_bits = self.object_bits, self.unit_bits
        changed = True
        while changed:
            limits.check()
            changed = False
            for unit, needed in needs.items():
                mask = unit_bits[unit]
                for object_id in needed:
                    known = objects.get(object_id)
                    if known is None:
                        break
                    mask |= known
                else:
                    if units.get(unit) != mask:
                        units[unit] = mask
                        changed = True
                        for object_id in makes[unit]:
                            objects[object_id] = objects.get(object_id, -1) & mask | object_bits[object_id]

    def late(self, makes: Mapping[UnitId, Iterable[ObjectId]]) -> list[tuple[UnitId, ObjectId]]:
        """Return which units are never the first to make something that they make: it was there before."""
        bits, units = self.object_bits, self.units
        return [
            (unit, object_id)
            for unit, made in makes.items()
            if (mask := units.get(unit))
            for object_id in made
            if bits[object_id] & mask
        ]


@dataclass(slots=True)
class Known:
    """What units need and make besides the kitchen, who makes an object, and the landmarks of all of them.

    No unit makes what was there before it in any case.
    """

    needs: dict[UnitId, list[ObjectId]] = field(default_factory=dict)
    makes: dict[UnitId, set[ObjectId]] = field(default_factory=dict)
    makers: dict[ObjectId, set[UnitId]] = field(default_factory=dict)
    landmarks: Landmarks = field(default_factory=Landmarks)


class Ways:
    """The ways to make things in a world, as far as they were asked for.

    The landmarks of an object depend on what leads to it, and on no goal. So they are worked out once. What
    is known of an object is known of all that leads to it. Threads may share this.
    """

    def __init__(self, reading: Units, stock: Collection[ObjectId], executable: Mapping[UnitId, int]) -> None:
        self._reading, self._stock, self._executable = reading, stock, executable
        self._lock = threading.Lock()
        self._known = Known()

    def __reduce__(self) -> tuple[type[Ways], tuple[Units, Collection[ObjectId], Mapping[UnitId, int]]]:
        # The lock stays in its process; what is known is soon learnt again.
        return Ways, (self._reading, self._stock, self._executable)

    def to(self, goals: Iterable[ObjectId]) -> Known:
        """Return what is known, with all that leads to goals that the kitchen can make, and does not have."""
        with self._lock:
            if len(self._known.makers) + len(self._known.needs) > _MOST_BITS:
                # Whoever has what was known keeps it.
                self._known = Known()
            fresh = [goal for goal in goals if goal not in self._known.makers]
            if fresh:
                self._learn(self._known, fresh)
            return self._known

    def _learn(self, known: Known, open_: list[ObjectId]) -> None:
        """Learn all of some objects, and of what leads to them."""
        making, needed, executable = self._reading.making, self._reading.needed, self._executable
        makers: dict[ObjectId, set[UnitId]] = {}
        units: dict[UnitId, list[ObjectId]] = {}
        while open_:
            object_id = open_.pop()
            if object_id in makers or object_id in known.makers:
                continue
            makers[object_id] = {unit for unit in making[object_id] if unit in executable}
            for unit in makers[object_id]:
                if unit not in units and unit not in known.needs:
                    units[unit] = [need for need in needed[unit] if need not in self._stock]
                    open_ += units[unit]
        needs = {unit: units[unit] for unit in sorted(units, key=executable.__getitem__)}
        makes: dict[UnitId, set[ObjectId]] = {unit: set() for unit in needs}
        for object_id, able in makers.items():
            for unit in able:
                (makes if unit in makes else known.makes)[unit].add(object_id)
        known.landmarks.number(makers, needs)
        while self._settled(known.landmarks, needs, makes, makers):
            pass
        known.needs |= needs
        known.makes |= makes
        known.makers |= makers

    def _settled(
        self,
        landmarks: Landmarks,
        needs: Mapping[UnitId, list[ObjectId]],
        makes: Mapping[UnitId, set[ObjectId]],
        makers: Mapping[ObjectId, set[UnitId]],
    ) -> bool:
        """Find the landmarks of further objects and units, and leave out who is late; return if any was."""
        for unit in needs:
            landmarks.units.pop(unit, None)
        for object_id, able in makers.items():
            landmarks.objects.pop(object_id, None)
            if before := [landmarks.units[unit] for unit in able if unit not in needs]:
                landmarks.objects[object_id] = reduce(and_, before) | landmarks.object_bits[object_id]
        landmarks.find(needs, makes)
        late = landmarks.late(makes)
        for unit, object_id in late:
            makes[unit].discard(object_id)
            makers[object_id].discard(unit)
        return bool(late)
