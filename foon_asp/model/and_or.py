"""Which units can matter at all: what is in every task tree, and who can be the first to make something.

Some units of a FOON are an and/or graph: a unit takes all its needs, an object one of its makers.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping

from foon_asp.model.landmarks import Landmarks, Ways
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
        self.needs = {unit: [o for o in reading.needed[unit] if o not in stock] for unit in order}
        self.makes = {unit: {o for o in reading.made[unit] if o not in stock} for unit in order}
        self.makers: dict[ObjectId, set[UnitId]] = {}
        for unit, made in self.makes.items():
            for object_id in made:
                self.makers.setdefault(object_id, set()).add(unit)
        self._settle()

    @classmethod
    def known(cls, ways: Ways, goals: Iterable[ObjectId], rounds: Mapping[UnitId, int]) -> AndOrGraph:
        """Return what all units are at first that lead to some goals, which the kitchen can make."""
        graph = cls.__new__(cls)
        graph._goals, graph._demanded = list(goals), ()
        known = ways.to(graph._goals)
        found, wanted = graph._leading(known.needs, known.makers)
        order = sorted(found, key=rounds.__getitem__)
        graph.needs = {unit: known.needs[unit] for unit in order}
        graph.makes = {unit: known.makes[unit] & wanted for unit in order}
        graph.makers = {object_id: known.makers[object_id] & found for object_id in wanted}
        graph._take(known.landmarks)
        return graph

    @property
    def units(self) -> list[UnitId]:
        """The units that are left, in the order of the file."""
        return sorted(self.needs)

    @property
    def forced(self) -> set[UnitId]:
        """The units that every tree has."""
        return self._forced

    def leave_made(self) -> bool:
        """Take each object that a forced unit makes from that unit alone, if nothing that it needs takes it.

        A tree without superfluous units has no other unit in order to make that object: the forced one is in
        it, and is done without it, so the object is there anyway. It may be there later, though. Say whether
        there was anything to leave out.
        """
        forced = self._forced
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
        bits, units = self._landmarks.object_bits, self._landmarks.units
        for unit in sorted(self.needs, reverse=True):
            makes = self.makes[unit]
            if unit in self._demanded or not makes:
                continue
            before = units[unit]
            rarest = next(iter(makes))
            if len(makes) > 1:
                rarest = min(makes, key=lambda object_id: (len(self.makers[object_id]), object_id))
            able = self.makers[rarest]
            for other in able if len(able) > 1 else ():
                if (
                    other != unit
                    and makes <= self.makes[other]
                    and all(bits[need] & before for need in self.needs[other])
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
            landmarks = Landmarks()
            landmarks.number(self.makers, self.needs)
            landmarks.find(self.needs, self.makes)
            never = self.needs.keys() - landmarks.units.keys()
            late = landmarks.late(self.makes)
            late += [(unit, object_id) for unit in never for object_id in self.makes[unit]]
            for unit, object_id in late:
                self._drop(unit, object_id)
            if not late and not never:
                self._take(landmarks)
                return

    def _drop(self, unit: UnitId, object_id: ObjectId) -> None:
        """Say that a unit is not there to make an object."""
        self.makes[unit].discard(object_id)
        self.makers[object_id].discard(unit)

    def _lead(self) -> None:
        """Leave out the units that do not lead to a goal, and of what they make what nobody needs."""
        found, wanted = self._leading(self.needs, self.makers)
        self.needs = {unit: needs for unit, needs in self.needs.items() if unit in found}
        self.makes = {unit: self.makes[unit] & wanted for unit in self.needs}
        self.makers = {object_id: self.makers.get(object_id, set()) & found for object_id in wanted}

    def _leading(
        self, needs: Mapping[UnitId, list[ObjectId]], makers: Mapping[ObjectId, set[UnitId]]
    ) -> tuple[set[UnitId], set[ObjectId]]:
        """Return the units that lead to a goal, or are demanded, and all that they or the goals need."""
        found = set(self._demanded)
        open_ = [*self._goals, *(need for unit in found for need in needs[unit])]
        wanted = set(open_)
        while open_:
            for unit in makers.get(open_.pop(), ()):
                if unit not in found:
                    found.add(unit)
                    fresh = [need for need in needs[unit] if need not in wanted]
                    wanted.update(fresh)
                    open_ += fresh
        return found, wanted

    def _take(self, landmarks: Landmarks) -> None:
        """Take the landmarks of what is left, and note which units are those of all that must be there."""
        common = 0
        for goal in self._goals:
            common |= landmarks.objects.get(goal, 0)
        for unit in self._demanded:
            common |= landmarks.units.get(unit, 0)
        self._landmarks = landmarks
        self._forced = {unit for unit in self.needs if landmarks.unit_bits[unit] & common}

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
