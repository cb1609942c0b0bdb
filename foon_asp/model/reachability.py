"""What a kitchen can make, and in which round; which units can matter for a goal. Plain graph search.

`encodings/reachability.lp` says the same declaratively; the tests hold both equal. Here it decides which part
of a FOON is worth giving to the solver.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

import numpy as np

from foon_asp.model.arrays import Mask, Numbers, Rounds, Rows, counts, distinct, numbers
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.units import Units


@dataclass(frozen=True, slots=True)
class Closure:
    """What can be reached from a kitchen, with the round (1, 2, …) in which it first can be."""

    available: Mapping[ObjectId, int]
    executable: Mapping[UnitId, int]


def forward(units: Units, kitchen: Iterable[ObjectId]) -> Closure:
    """Return the least fixpoint from the kitchen, over all units."""
    available, executable = fixpoint(units.needs, units.users.rows, units.makes, kitchen)
    return Closure(Rounds(available), Rounds(executable))


def within(units: Units, kitchen: Container[ObjectId], some: Iterable[UnitId]) -> Closure:
    """Return the least fixpoint from the kitchen over some units; it takes as long as these are many.

    What none of the units needs of the kitchen is left out.
    """
    users: dict[ObjectId, list[UnitId]] = {}
    available: dict[ObjectId, int] = {}
    executable: dict[UnitId, int] = {}
    missing: dict[UnitId, int] = {}
    needed, makes = units.needed, units.made
    for unit in some:
        needs = needed[unit]
        available.update((object_id, 0) for object_id in needs if object_id in kitchen)
        lacking = [object_id for object_id in needs if object_id not in available]
        missing[unit] = len(lacking)
        for object_id in lacking:
            users.setdefault(object_id, []).append(unit)
    ready = [unit for unit, count in missing.items() if count == 0]
    depth = 0
    while ready:
        depth += 1
        executable.update((unit, depth) for unit in ready)
        made = dict.fromkeys(object_id for unit in ready for object_id in makes[unit])
        fresh = [object_id for object_id in made if object_id not in available and object_id not in kitchen]
        available.update((object_id, depth) for object_id in fresh)
        ready = []
        for unit in (unit for object_id in fresh for unit in users.get(object_id, ())):
            missing[unit] -= 1
            if missing[unit] == 0:
                ready.append(unit)
    return Closure(available, executable)


def backward(
    units: Units,
    goals: Iterable[ObjectId],
    kitchen: Collection[ObjectId],
    among: Collection[UnitId] | None = None,
) -> list[UnitId]:
    """Return, sorted, the units that can matter for the goals, among all or the given ones.

    A unit matters if it makes a goal, or something that a unit which matters needs and the
    kitchen does not have. What is found from so many objects at once that it pays is found on whole arrays.
    """
    search = _Backward(units, kitchen, among)
    fresh: Any = list(dict.fromkeys(goal for goal in goals if goal not in kitchen))
    while len(fresh):
        fresh = (search.wide if len(fresh) >= _WIDE else search.narrow)(fresh)
    return search.units()


class _Backward:
    """A search from what is wanted to what leads there, each step on whole arrays or on single numbers."""

    def __init__(self, units: Units, kitchen: Collection[ObjectId], among: Collection[UnitId] | None) -> None:
        self._units, self._kitchen, self._among = units, kitchen, among
        self._found = np.zeros(len(units.needs), dtype=np.bool_)
        self._wanted = np.zeros(len(units.foon.objects), dtype=np.bool_)
        self._few: list[UnitId] | None = []

    def units(self) -> list[UnitId]:
        """Return all that was found, sorted."""
        if self._few is not None:
            return sorted(self._few)
        return cast(list[UnitId], np.flatnonzero(self._found).tolist())

    @cached_property
    def _closed(self) -> Mask:
        """Say of each object whether nothing need make it."""
        closed = np.zeros(len(self._wanted), dtype=np.bool_)
        there = numbers(self._kitchen)
        closed[there[there < len(closed)]] = True
        return closed

    @cached_property
    def _open(self) -> Mask:
        """Say of each unit whether it may be found."""
        if isinstance(self._among, Rounds):
            return self._among.rounds >= 0
        open_ = np.full(len(self._found), self._among is None, dtype=np.bool_)
        open_[numbers(self._among or ())] = True
        return open_

    def wide(self, fresh: Any) -> Any:
        """Return what is wanted anew by the makers of what was wanted anew."""
        makers = self._units.makers.rows.gather(np.asarray(fresh, dtype=np.int64))
        units = distinct(makers[self._open[makers] & ~self._found[makers]])
        self._found[units] = True
        self._few = None
        needs = self._units.needs.gather(units)
        new = distinct(needs[~(self._wanted[needs] | self._closed[needs])])
        self._wanted[new] = True
        return new

    def narrow(self, fresh: Any) -> Any:
        """Do the same one by one."""
        making, needed, kitchen, among = self._units.making, self._units.needed, self._kitchen, self._among
        found, wanted = (memoryview(cast(Any, each)) for each in (self._found, self._wanted))
        few = [] if self._few is None else self._few
        new: list[ObjectId] = []
        for object_id in fresh:
            for unit in making[object_id]:
                if found[unit] or (among is not None and unit not in among):
                    continue
                found[unit] = True
                few.append(unit)
                for need in needed[unit]:
                    if not wanted[need] and need not in kitchen:
                        wanted[need] = True
                        new.append(need)
        return new


_WIDE = 64
"""From how many ids on a round is left to numpy, which takes as long for one id as for that many."""


def fixpoint(
    needs: Rows[UnitId, ObjectId],
    users: Rows[ObjectId, UnitId],
    makes: Rows[UnitId, ObjectId],
    kitchen: Iterable[ObjectId],
) -> tuple[Numbers, Numbers]:
    """Return for each object, and for each unit, the round in which it is first there, or -1.

    Kitchen objects are there in round 0; ids behind those of the FOON's objects are fine. A round that
    has much to do works on whole arrays, one that has little on single numbers: a chain of 100,000 units
    is as many rounds of one unit each.
    """
    stock = np.fromiter(kitchen, dtype=np.int64)
    known = len(users)
    available = np.full(max(known, stock.max(initial=-1) + 1), -1, dtype=np.int32)
    executable = np.full(len(needs), -1, dtype=np.int32)
    missing = needs.lengths.astype(np.int32)
    available[stock] = 0
    rounds = _Rounds(users, makes, available, executable, missing)
    fresh: Any = distinct(stock[stock < known])
    ready: Any = np.flatnonzero(missing == 0)
    depth = 1
    while len(fresh) or len(ready):
        turn = rounds.wide if len(fresh) + len(ready) >= _WIDE else rounds.narrow
        fresh = turn(fresh, ready, depth)
        ready = ()
        depth += 1
    return available, executable


class _Rounds:
    """The rounds of a search, each on whole arrays or on single numbers in the same arrays."""

    def __init__(
        self,
        users: Rows[ObjectId, UnitId],
        makes: Rows[UnitId, ObjectId],
        available: Numbers,
        executable: Numbers,
        missing: Numbers,
    ) -> None:
        self._users, self._makes = users, makes
        self._available, self._executable, self._missing = available, executable, missing
        self._numbers = [memoryview(cast(Any, each)) for each in (available, executable, missing)]

    def wide(self, fresh: Any, ready: Any, depth: int) -> Any:
        """Execute the units that are ready, or become so by what is fresh. Return what is new by them."""
        units, times = counts(self._users.gather(np.asarray(fresh, dtype=np.int64)))
        self._missing[units] -= times.astype(np.int32)
        done = np.concatenate([units[self._missing[units] == 0], np.asarray(ready, dtype=np.int64)])
        self._executable[done] = depth
        made = self._makes.gather(done)
        new = distinct(made[self._available[made] < 0])
        self._available[new] = depth
        return new

    def narrow(self, fresh: Any, ready: Any, depth: int) -> Any:
        """Do the same one by one."""
        available, executable, missing = self._numbers
        done = cast(list[UnitId], [int(unit) for unit in ready])
        for object_id in fresh:
            for unit in self._users[object_id]:
                missing[unit] -= 1
                if not missing[unit]:
                    done.append(unit)
        new: list[ObjectId] = []
        for unit in done:
            executable[unit] = depth
            for object_id in self._makes[unit]:
                if available[object_id] < 0:
                    available[object_id] = depth
                    new.append(object_id)
        return new
