"""The least fixpoint over all units: what a kitchen can make, and in which round."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, cast

import numpy as np

from foon_asp.arrays import Numbers, Rows

_WIDE = 64
"""From how many things on a round is left to numpy, which takes as long for one thing as for that many."""


def fixpoint(needs: Rows, users: Rows, makes: Rows, kitchen: Iterable[int]) -> tuple[Numbers, Numbers]:
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
    fresh: Any = np.unique(stock[stock < known])
    ready: Any = np.flatnonzero(missing == 0)
    depth = 1
    while len(fresh) or len(ready):
        step = rounds.wide if len(fresh) + len(ready) >= _WIDE else rounds.narrow
        fresh = step(fresh, ready, depth)
        ready = ()
        depth += 1
    return available, executable


class _Rounds:
    """The rounds of a search, each on whole arrays or on single numbers in the same arrays."""

    def __init__(
        self, users: Rows, makes: Rows, available: Numbers, executable: Numbers, missing: Numbers
    ) -> None:
        self._users, self._makes = users, makes
        self._available, self._executable, self._missing = available, executable, missing
        self._numbers = [memoryview(cast(Any, each)) for each in (available, executable, missing)]

    def wide(self, fresh: Any, ready: Any, depth: int) -> Any:
        """Execute the units that are ready, or become so by what is fresh. Return what is new by them."""
        units, times = np.unique(self._users.gather(np.asarray(fresh, dtype=np.int64)), return_counts=True)
        self._missing[units] -= times.astype(np.int32)
        done = np.concatenate([units[self._missing[units] == 0], np.asarray(ready, dtype=np.int64)])
        self._executable[done] = depth
        made = self._makes.gather(done)
        new = np.unique(made[self._available[made] < 0])
        self._available[new] = depth
        return new

    def narrow(self, fresh: Any, ready: Any, depth: int) -> Any:
        """Do the same one by one."""
        available, executable, missing = self._numbers
        done = [int(unit) for unit in ready]
        for thing in fresh:
            for unit in self._users[thing]:
                missing[unit] -= 1
                if not missing[unit]:
                    done.append(unit)
        new: list[int] = []
        for unit in done:
            executable[unit] = depth
            for thing in self._makes[unit]:
                if available[thing] < 0:
                    available[thing] = depth
                    new.append(thing)
        return new
