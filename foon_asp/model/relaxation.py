"""What it takes at least to make things, and about how much: shortest ways through some units of a FOON.

Where nothing is used up a FOON is a planning problem without deletes, an and/or graph. Its heuristics are
fixpoints over whole arrays: h_max, what a chain of units costs that something cannot do without, and h_add,
what it costs if nothing is shared (Bonet and Geffner, Planning as heuristic search, 2001). By h_add each
object has a best maker; the units that the goals lead to by these are a relaxed plan (Hoffmann and Nebel, The
FF planning system, 2001).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from foon_asp import limits
from foon_asp.model.arrays import Mask, Numbers, Rows, distinct, numbers, places
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.units import Units

Amounts = npt.NDArray[np.float64]
"""What something costs: a number for each unit, or for each object, of a part."""

_MOST_TURNS = 2_000
"""How often whole arrays are gone over: a chain of more units is no matter for them."""

_SHARE = 1e-6
"""What is added to each price of a plan, by the mean: then no circle of units is free."""


@dataclass(frozen=True, eq=False)
class Part:
    """Some units of a FOON and the goals that they make, on numberings of their own, which are places.

    `units` and `objects` are the ids at these places. There are only objects that matter: goals, and what
    some unit needs; none of them is in the kitchen. `needs` has the objects of each unit, `makers` the units
    of each object; `goals` are objects, and `demanded` units that must be done, whatever they are good for.
    """

    units: Numbers
    objects: Numbers
    needs: Rows[int, int]
    makers: Rows[int, int]
    goals: Numbers
    demanded: Numbers

    @classmethod
    def of(
        cls,
        reading: Units,
        stock: Mask,
        units: Sequence[UnitId],
        goals: Iterable[ObjectId],
        demanded: Iterable[UnitId] = (),
    ) -> Part:
        """Cut a part out of a FOON; `stock` says of each object whether it is at hand."""
        ids = numbers(units)
        wanted = numbers(goals)
        wanted = wanted[~stock[wanted]]
        needing, needed = _values(reading.needs, ids, ~stock)
        objects = distinct(np.concatenate((needed, wanted)))
        making, made = _values(reading.makes, ids, ~stock)
        where, matters = places(made, objects)
        return cls(
            ids,
            objects,
            Rows.of(needing, np.searchsorted(objects, needed).astype(np.int32), len(ids)),
            Rows.of(where[matters].astype(np.int32), making[matters], len(objects)),
            np.searchsorted(objects, wanted).astype(np.int32),
            np.searchsorted(ids, numbers(demanded)).astype(np.int32),
        )

    @cached_property
    def makes(self) -> Rows[int, int]:
        """The objects that each unit makes."""
        return Rows.of(self.makers.values, self.makers.owners, len(self.units))

    @cached_property
    def users(self) -> Rows[int, int]:
        """The units that need each object."""
        return Rows.of(self.needs.values, self.needs.owners, len(self.objects))

    def least_chain(self, prices: Amounts) -> Amounts | None:
        """Return for each unit the dearest chain of units, itself the last, that it cannot be done without.

        Of the cheapest such chains, for there may be several ways to make a need: h_max. None where the
        chains are too long to be looked at like this.
        """
        return self._made(prices, np.maximum)

    def least_onward(self, prices: Amounts) -> Amounts | None:
        """Return for each unit the cheapest chain, itself the first, by which it leads to a goal.

        Infinity where there is none; a unit that is demanded leads to itself.
        """
        units = np.full(len(self.units), np.inf)
        for _ in range(_MOST_TURNS):
            limits.check()
            objects = _reduced(np.minimum, units[self.users.values], self.users, np.inf)
            objects[self.goals] = 0
            after = _reduced(np.minimum, objects[self.makes.values], self.makes, np.inf)
            after[self.demanded] = 0
            after += prices
            if np.array_equal(after, units):
                return units
            units = after
        return None

    def plan(self, prices: Amounts) -> list[UnitId] | None:
        """Return a relaxed plan: what the goals lead to, if each object is made as is cheapest by itself.

        None if not every goal can be made, or if the chains are too long.
        """
        finite = prices[np.isfinite(prices)]
        prices = prices + _SHARE * max(float(finite.mean()) if len(finite) else 0.0, _SHARE)
        units = self._made(prices, np.add)
        if units is None:
            return None
        cost = units[self.makers.values]
        least = _reduced(np.minimum, cost, self.makers, np.inf)
        best = np.flatnonzero((cost == least[self.makers.owners]) & np.isfinite(cost))
        maker = np.full(len(self.objects), -1, dtype=np.int64)
        # Of makers that are as cheap the first in the file counts.
        maker[self.makers.owners[best][::-1]] = self.makers.values[best][::-1]
        found = dict.fromkeys(self.demanded.tolist())
        open_ = [*self.goals.tolist(), *(need for unit in found for need in self.needs[unit])]
        while open_:
            unit = int(maker[open_.pop()])
            if unit < 0:
                return None
            if unit not in found:
                found[unit] = None
                open_ += self.needs[unit]
        return sorted(UnitId(int(self.units[unit])) for unit in found)

    def _made(self, prices: Amounts, combine: np.ufunc) -> Amounts | None:
        """Return what it costs to do each unit, if needs are combined like this and made as is cheapest.

        The least fixpoint, by value iteration from above: each turn can only find something cheaper.
        """
        objects = np.full(len(self.objects), np.inf)
        for _ in range(_MOST_TURNS):
            limits.check()
            units = prices + _reduced(combine, objects[self.needs.values], self.needs, 0.0)
            after = _reduced(np.minimum, units[self.makers.values], self.makers, np.inf)
            if np.array_equal(after, objects):
                return units
            objects = after
        return None


def _values(table: Rows[Any, Any], rows: Numbers, wanted: Mask) -> tuple[Numbers, Numbers]:
    """Return the wanted values of some rows, and before that the place of the row that each is in."""
    values = table.gather(rows)
    lengths = table.offsets[rows + 1] - table.offsets[rows]
    owners = np.repeat(np.arange(len(rows), dtype=np.int32), lengths)
    keep = wanted[values]
    return owners[keep], values[keep]


def _reduced(combine: np.ufunc, values: Amounts, table: Rows[int, int], empty: float) -> Amounts:
    """Return what comes of the values of each row; `empty` for a row without any."""
    found = np.full(len(table), empty)
    filled = table.offsets[1:] > table.offsets[:-1]
    if len(values):
        found[filled] = combine.reduceat(values, table.offsets[:-1][filled])
    return found
