"""Which units can matter at all: what is in every task tree, and who can be the first to make something.

Some units of a FOON are an and/or graph: a unit takes all its needs, an object one of its makers. An object
or a unit is a landmark of another one if that is never had without it. Landmarks are the greatest fixpoint of
"its own, with what all its makers have in common, or with what any of its needs has" (Zhu and Givan, Landmark
extraction via planning graph propagation, 2003; Keyder, Richter, Helmert, Sound and complete landmarks for
and/or graphs, 2010). Sets are bit masks here; a few passes in the order of the rounds settle them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping

from foon_asp import limits
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.units import Units


class AndOrGraph:
    """What some units need and make besides the kitchen, with the goals and units that must be done.

    It only shrinks, from the start by what no tree can do with or is better off with: units that do not lead
    to a goal, units that cannot be done, and who is never the first to make something. Trees without
    superfluous units stay as they are by that, and so does each round in which something is done.

    `makes` and `makers` are what is left. `rounds` say in which order units are looked at; any order will do,
    that of the forward closure is the fastest.
    """

    def __init__(
        self,
        reading: Units,
        stock: Collection[ObjectId],
        units: Iterable[UnitId],
        goals: Iterable[ObjectId],
        demanded: Collection[UnitId],
        rounds: Mapping[UnitId, int],
    ) -> None:
        self._goals = [goal for goal in goals if goal not in stock]
        self._demanded = demanded
        order = sorted(units, key=lambda unit: rounds.get(unit, 0))
        self.needs = {unit: [o for o in reading.needs[unit] if o not in stock] for unit in order}
        self.makes = {unit: {o for o in reading.makes[unit] if o not in stock} for unit in order}
        self.makers: dict[ObjectId, set[UnitId]] = {}
        self._objects: dict[ObjectId, int] = {}
        self._units: dict[UnitId, int] = {}
        self._settle()

    @property
    def units(self) -> list[UnitId]:
        """The units that are left, in the order of the file."""
        return sorted(self.needs)

    @property
    def forced(self) -> set[UnitId]:
        """The units that every tree has."""
        common = self._common()
        return {unit for unit in self.needs if self._unit_bits[unit] & common}

    def leave_made(self) -> bool:
        """Take each object that a forced unit makes from that unit alone, if nothing that it needs takes it.

        A tree without superfluous units has no other unit in order to make that object: the forced one is in
        it, and is done without it, so the object is there anyway. It may be there later, though. Say whether
        there was anything to leave out.
        """
        forced = self.forced
        fewer = False
        for object_id, makers in self.makers.items():
            if len(makers) > 1:
                sure = sorted(makers & forced)
                after = self._after(object_id) if sure else set()
                first = next((unit for unit in sure if unit not in after), None)
                for unit in makers - {first} if first is not None else ():
                    self._drop(unit, object_id)
                    fewer = True
        if fewer:
            self._settle()
        return fewer

    def leave_dominated(self, no_dearer: Callable[[UnitId, UnitId], bool]) -> bool:
        """Leave out each unit that another one can stand in for, which makes all that it makes.

        The other needs only what is always there before the first, and is no dearer. So it can be done as
        early, and a tree with it instead is no worse. Of two that can stand in for each other the first in
        the file stays (dominance: Imai and Fukunaga, On a practical, integer-linear programming model for
        delete-free tasks and its use as a heuristic for cost-optimal planning, 2015). Say whether any went.
        """
        fewer = False
        for unit in sorted(self.needs, reverse=True):
            makes = self.makes[unit]
            if unit in self._demanded or not makes:
                continue
            before = self._units[unit]
            rarest = min(makes, key=lambda object_id: (len(self.makers[object_id]), object_id))
            for other in self.makers[rarest]:
                if (
                    other != unit
                    and makes <= self.makes[other]
                    and all(self._object_bits[need] & before for need in self.needs[other])
                    and no_dearer(other, unit)
                ):
                    for object_id in list(makes):
                        self._drop(unit, object_id)
                    fewer = True
                    break
        if fewer:
            self._settle()
        return fewer

    def _settle(self) -> None:
        """Leave out what does not matter until nothing more goes."""
        while True:
            self._lead()
            self._find_landmarks()
            for unit in self.needs.keys() - self._units.keys():
                self.makes[unit].clear()
            late = [
                (unit, object_id)
                for unit, mask in self._units.items()
                for object_id in self.makes[unit]
                if self._object_bits[object_id] & mask
            ]
            for unit, object_id in late:
                self._drop(unit, object_id)
            if not late and len(self._units) == len(self.needs):
                return

    def _drop(self, unit: UnitId, object_id: ObjectId) -> None:
        """Say that a unit is not there to make an object."""
        self.makes[unit].discard(object_id)
        self.makers[object_id].discard(unit)

    def _lead(self) -> None:
        """Leave out the units that do not lead to a goal, and of what they make what nobody needs."""
        able: dict[ObjectId, list[UnitId]] = {}
        for unit, made in self.makes.items():
            for object_id in made:
                able.setdefault(object_id, []).append(unit)
        found = set(self._demanded)
        open_ = [*self._goals, *(need for unit in found for need in self.needs[unit])]
        wanted = set(open_)
        while open_:
            for unit in able.get(open_.pop(), ()):
                if unit not in found:
                    found.add(unit)
                    fresh = [need for need in self.needs[unit] if need not in wanted]
                    wanted.update(fresh)
                    open_ += fresh
        self.needs = {unit: needs for unit, needs in self.needs.items() if unit in found}
        self.makes = {unit: self.makes[unit] & wanted for unit in self.needs}
        self.makers = {object_id: found.intersection(able.get(object_id, ())) for object_id in wanted}

    def _find_landmarks(self) -> None:
        """Work out the landmarks of each object and unit; what cannot be had is left out."""
        self._object_bits = {object_id: 1 << place for place, object_id in enumerate(self.makers)}
        self._unit_bits = {unit: 1 << place for place, unit in enumerate(self.needs, len(self.makers))}
        objects: dict[ObjectId, int] = {}
        units: dict[UnitId, int] = {}
        changed = True
        while changed:
            limits.check()
            changed = False
            for unit, needs in self.needs.items():
                mask = self._unit_bits[unit]
                for object_id in needs:
                    known = objects.get(object_id)
                    if known is None:
                        break
                    mask |= known
                else:
                    if units.get(unit) != mask:
                        units[unit] = mask
                        changed = True
                        for object_id in self.makes[unit]:
                            objects[object_id] = (
                                objects.get(object_id, -1) & mask | self._object_bits[object_id]
                            )
        self._objects, self._units = objects, units

    def _common(self) -> int:
        """Return the landmarks of all that must be made or done."""
        common = 0
        for goal in self._goals:
            common |= self._objects.get(goal, 0)
        for unit in self._demanded:
            common |= self._units.get(unit, 0)
        return common

    def _after(self, object_id: ObjectId) -> set[UnitId]:
        """Return the units that may be done with the help of an object, directly or not."""
        users: dict[ObjectId, list[UnitId]] = {}
        for unit, needs in self.needs.items():
            for need in needs:
                users.setdefault(need, []).append(unit)
        found: set[UnitId] = set()
        open_ = [object_id]
        seen = {object_id}
        while open_:
            for unit in users.get(open_.pop(), ()):
                if unit not in found:
                    found.add(unit)
                    fresh = self.makes[unit] - seen
                    seen |= fresh
                    open_ += fresh
        return found
