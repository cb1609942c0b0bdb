"""Selections: one unit for each object that is needed and not in the kitchen.

`encodings/retrieval/selection.lp` says the same declaratively. Here a selection is settled object by object.
Whether the rest can still be completed takes no search: an object that is not settled may be made by any of
its units, so a least fixpoint tells.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World


class Selection:
    """A unit for each object that is settled and, if it is `founded`, for every object that can be made.

    All of these can be traced back to the kitchen along their units. An object that is not settled has the
    unit that makes it in the earliest round, or another one where the settled ones ask for that. So at any
    time there is a task tree: the units that the goals are traced back along. What is not founded may be
    settled in any way, in circles too.
    """

    def __init__(self, world: World, *, founded: bool = True) -> None:
        self._world = world
        self._founded = founded
        self._maker: dict[ObjectId, UnitId] = {}
        self._settled: set[ObjectId] = set()

    def candidates(self, object_id: ObjectId) -> list[UnitId]:
        """Return the units that may make an object, in file order."""
        makers = self._world.units.makers.of(object_id)
        executable = self._world.closure.executable if self._founded else makers
        return [unit for unit in makers if unit in executable]

    def needs(self, unit: UnitId) -> list[ObjectId]:
        """Return what a unit needs besides the kitchen."""
        return [need for need in self._world.units.needs[unit] if need not in self._world.stock]

    def maker(self, object_id: ObjectId) -> UnitId:
        """Return the unit that makes an object."""
        unit = self._maker.get(object_id)
        if unit is None:
            closure = self._world.closure
            first = closure.available[object_id]
            makers = self.candidates(object_id)
            unit = self._maker[object_id] = next(each for each in makers if closure.executable[each] == first)
        return unit

    def traced(self, goals: Iterable[ObjectId]) -> set[UnitId]:
        """Return the units that some objects, which are not in the kitchen, are traced back along."""
        wanted = list(goals)
        units: set[UnitId] = set()
        while wanted:
            unit = self.maker(wanted.pop())
            if unit not in units:
                units.add(unit)
                wanted += self.needs(unit)
        return units

    def settle(self, object_id: ObjectId, unit: UnitId) -> bool:
        """Settle that a unit makes an object for good, if the settled ones allow it; say whether they do."""
        if self._founded and self.maker(object_id) != unit:
            others = self._others(object_id, unit)
            if others is None:
                return False
            self._maker.update(others)
        self._maker[object_id] = unit
        self._settled.add(object_id)
        return True

    def possible(self, object_id: ObjectId, unit: UnitId, free: Collection[ObjectId]) -> bool:
        """Say whether a unit could make an object if some of those that are settled were not."""
        return self._others(object_id, unit, free) is not None

    def _others(
        self, object_id: ObjectId, unit: UnitId, free: Collection[ObjectId] = ()
    ) -> dict[ObjectId, UnitId] | None:
        """Return the units by which others must be made so that a unit can make an object; None if none do.

        The object may be made by the unit exactly if all that the unit needs can be had without the object.
        Then nothing is lost by it: what could be made of the object still can be. Whatever is not traced back
        to the object stays as it is. Of the rest only what the unit needs, by whichever units, is looked at.
        """
        hanging = _Hanging(self, object_id)
        wanted = hanging.among(self.needs(unit))
        queue = list(wanted)
        seen = {object_id, *queue}
        options: dict[UnitId, list[ObjectId]] = {}
        users: dict[ObjectId, list[UnitId]] = {}
        lacking: dict[UnitId, int] = {}
        ready: list[UnitId] = []
        for each in queue:
            if each == object_id:
                continue
            settled = each in self._settled and each not in free
            for other in [self.maker(each)] if settled else self.candidates(each):
                options.setdefault(other, []).append(each)
                if other in lacking:
                    continue
                needs = hanging.among(self.needs(other))
                lacking[other] = len(needs)
                if not needs:
                    ready.append(other)
                for need in needs:
                    users.setdefault(need, []).append(other)
                    if need not in seen:
                        seen.add(need)
                        queue.append(need)
        found: dict[ObjectId, UnitId] = {}
        while ready:
            other = ready.pop()
            for each in options[other]:
                if each not in found:
                    found[each] = other
                    for user in users.get(each, ()):
                        lacking[user] -= 1
                        if not lacking[user]:
                            ready.append(user)
        return found if all(each in found for each in wanted) else None


class _Hanging:
    """What a selection traces back to an object, found out for as many as are asked for."""

    def __init__(self, selection: Selection, object_id: ObjectId) -> None:
        self._selection = selection
        self._hanging = {object_id}
        self._seen = {object_id}

    def among(self, objects: list[ObjectId]) -> list[ObjectId]:
        """Return those of some objects that are traced back to the object, or are it."""
        fresh = [each for each in objects if each not in self._seen]
        self._seen.update(fresh)
        users: dict[ObjectId, list[ObjectId]] = {}
        for each in fresh:
            for need in self._selection.needs(self._selection.maker(each)):
                users.setdefault(need, []).append(each)
                if need not in self._seen:
                    self._seen.add(need)
                    fresh.append(need)
        reached = [need for need in users if need in self._hanging]
        for need in reached:
            more = [user for user in users.get(need, ()) if user not in self._hanging]
            self._hanging.update(more)
            reached += more
        return [each for each in objects if each in self._hanging]
