"""Circles that keep units closed: every unit of one lacks something that a unit of it makes."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping

from foon_asp import limits
from foon_asp.audit.closed_units import ClosedUnits
from foon_asp.model.node import ObjectId, UnitId


class Circles:
    """Finds smallest circles among closed units: a way back along makers, and a ring where it ends.

    Edits only take rings away. So how many units a ring through one has at least is remembered for good.
    """

    def __init__(self, closed: ClosedUnits) -> None:
        self._closed = closed
        self._least: dict[UnitId, int] = {}

    def smallest(self, units: Iterable[UnitId]) -> list[UnitId]:
        """Return the smallest circle with one of some units, that one first: of several the lowest one.

        The list is empty if none of the units is circling.
        """
        circle: list[UnitId] = []
        size, first = len(self._closed.lacks) + 1, UnitId(0)
        layer = sorted(units)
        begins = {unit: unit for unit in layer}
        came: dict[UnitId, UnitId] = {}
        asked: set[ObjectId] = set()
        depth = 0
        while layer and depth < size:
            for unit in layer:
                # A ring through what holds up a single unit goes through that, too, which is nearer.
                if depth and self._only_user(unit) is not None:
                    continue
                if (depth + self._least.get(unit, 1), begins[unit]) < (size, first):
                    ring = self._ring(unit, size - depth)
                    if ring and (depth + len(ring), begins[unit]) < (size, first):
                        size, first = depth + len(ring), begins[unit]
                        circle = [*reversed(_way(unit, came)), *ring[1:]]
            layer = self._behind(layer, came, asked, begins)
            begins.update((unit, begins[came[unit]]) for unit in layer)
            depth += 1
        return circle

    def _ring(self, start: UnitId, most: int) -> list[UnitId]:
        """Return a shortest ring through a unit, which comes first; none that has more than so many units."""
        limits.check()
        made = set(self._closed.makes[start])
        came: dict[UnitId, UnitId] = {}
        asked: set[ObjectId] = set()
        layer = [start]
        for length in range(1, most + 1):
            last = next((unit for unit in layer if not made.isdisjoint(self._closed.lacks[unit])), None)
            if last is not None:
                ring = [start, *reversed(_way(last, came)[:-1])]
                self._remember(ring)
                return ring
            if length < most:
                layer = self._behind(layer, came, asked, came)
        self._least[start] = most + 1 if layer else len(self._closed.lacks) + 1
        return []

    def _remember(self, ring: list[UnitId]) -> None:
        """Note that no ring through the first unit is shorter, nor any that must go through it."""
        for unit in ring:
            if unit != ring[0] and self._only_user(unit) is None:
                return
            self._least[unit] = max(self._least.get(unit, 1), len(ring))

    def _behind(
        self,
        layer: Iterable[UnitId],
        came: dict[UnitId, UnitId],
        asked: set[ObjectId],
        known: Container[UnitId],
    ) -> list[UnitId]:
        """Return what makes something that the units of a layer lack, and note for which unit it came.

        No object is asked for again, and what is known is left out.
        """
        reached = []
        for unit in layer:
            for need in self._closed.lacks[unit]:
                if need in asked:
                    continue
                asked.add(need)
                for maker in self._closed.makers.get(need, ()):
                    if maker not in known and maker not in came:
                        came[maker] = unit
                        reached.append(maker)
        return reached

    def _only_user(self, unit: UnitId) -> UnitId | None:
        """Return the only unit that lacks what a unit makes, if it is one alone."""
        only = None
        for made in self._closed.makes[unit]:
            for user in self._closed.users.get(made, ()):
                if only not in (None, user):
                    return None
                only = user
        return only


def _way(unit: UnitId, came: Mapping[UnitId, UnitId]) -> list[UnitId]:
    """Return a unit, where it came from, and so on."""
    way = [unit]
    while way[-1] in came:
        way.append(came[way[-1]])
    return way
