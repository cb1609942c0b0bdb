"""The units that never run, what each of them lacks, and how they become fewer by edits."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.reachability import Closure
from foon_asp.model.units import Units


class ClosedUnits:
    """The units that never run. What is lacking stays so while all that makes it is closed.

    `lacks`: what each needs that cannot be had. `makes`: what it would make that others may lack. `users` and
    `makers` are the same from the side of the objects; nothing makes an object that is not among the latter.
    """

    def __init__(self, units: Units, closure: Closure) -> None:
        closed = [unit for unit in units.foon.units.ids if unit not in closure.executable]
        self.lacks: dict[UnitId, dict[ObjectId, None]] = {}
        self.users: dict[ObjectId, dict[UnitId, None]] = {}
        for unit in closed:
            self.lacks[unit] = dict.fromkeys(
                need for need in units.needs[unit] if need not in closure.available
            )
            for need in self.lacks[unit]:
                self.users.setdefault(need, {})[unit] = None
        self.makes = {unit: [made for made in units.makes[unit] if made in self.users] for unit in closed}
        self.makers: dict[ObjectId, list[UnitId]] = {}
        for unit, objects in self.makes.items():
            for made in objects:
                self.makers.setdefault(made, []).append(unit)
        self._held = {unit: sum(need in self.makers for need in lacks) for unit, lacks in self.lacks.items()}
        self._holding = {made: len(makers) for made, makers in self.makers.items()}
        self._let_go([unit for unit, count in self._held.items() if not count])

    @property
    def circling(self) -> Collection[UnitId]:
        """The units that a circle keeps closed: each lacks something that one of them makes."""
        return self._held.keys()

    def groups(self, units: Iterable[UnitId]) -> Iterator[list[UnitId]]:
        """Yield units in groups: what one of a group makes or lacks has nothing to do with another group."""
        seen: set[UnitId] = set()
        for start in units:
            if start in seen:
                continue
            seen.add(start)
            group, asked = [start], set[ObjectId]()
            for unit in group:
                for shared in {*self.makes[unit], *self.lacks[unit]}.difference(asked):
                    asked.add(shared)
                    if shared not in self.makers or shared not in self.users:
                        continue
                    near = {*self.makers[shared], *self.users[shared]}.difference(seen)
                    seen.update(near)
                    group += near
            yield group

    def open(self, units: Collection[UnitId]) -> None:
        """Take units away, and what they make from all that is lacking."""
        for unit in units:
            self._held.pop(unit, None)
        loose = []
        for made in (made for unit in units for made in self.makes[unit]):
            for user in self.users.pop(made, ()):
                del self.lacks[user][made]
                if user in self._held and self._holding[made]:
                    self._held[user] -= 1
                    if not self._held[user]:
                        loose.append(user)
        for unit in units:
            for need in self.lacks.pop(unit):
                del self.users[need][unit]
        self._let_go(loose)

    def _let_go(self, loose: list[UnitId]) -> None:
        """Leave units out that lack nothing that those in a circle make, and what only they hold up."""
        for unit in loose:
            del self._held[unit]
            for made in self.makes[unit]:
                self._holding[made] -= 1
                if self._holding[made]:
                    continue
                for user in self.users.get(made, ()):
                    self._held[user] -= 1
                    if not self._held[user]:
                        loose.append(user)
