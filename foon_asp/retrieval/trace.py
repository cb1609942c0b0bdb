"""What iterative deepening explores: for each limit of depth the objects, depth first.

`retrieval/ids.lp` says which tree the method `ids` finds. Here the search is walked as the seed paper walks
it, so that a person can follow it. Plain Python, no clingo.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World

Visit = tuple[ObjectId, int]
"""An object and how many units it is away from the goal on the way that the search took."""


@dataclass(frozen=True, slots=True)
class Bound:
    """What the search explored with at most `limit` units in depth, in order, and if it made the goal."""

    limit: int
    explored: tuple[Visit, ...]
    reached: bool


def trace(world: World, goal: ObjectId) -> list[Bound]:
    """Return what the search explores with the limits 0, 1, 2, …, up to the first that reaches the goal.

    For a goal that the kitchen cannot make, the last limit is the first at which nothing new is explored.
    On a chain of n units this is n²/2 visits: where that is too much, take `bounds`, or one by `explore`.
    """
    return list(bounds(world, goal))


def bounds(world: World, goal: ObjectId) -> Iterator[Bound]:
    """Yield what `trace` returns, each limit as soon as it was searched."""
    possible = goal in world.closure.available
    known: set[ObjectId] = set()
    limit = 0
    while True:
        bound = explore(world, goal, limit)
        yield bound
        fresh = {object_id for object_id, _ in bound.explored} - known
        if bound.reached or not (possible or fresh):
            return
        known |= fresh
        limit += 1


def explore(world: World, goal: ObjectId, limit: int) -> Bound:
    """Search depth first for a way to make the goal that is at most `limit` units deep.

    An object at hand is a leaf, and so is one with no depth left. Of any other the units that make it are
    tried in file order, until one is found whose needs can all be made with one unit of depth less. Of each
    unit that is tried all needs are explored, in the order of its inputs, even if one of them failed.

    The same object comes up many times. What was explored before with at least as much depth left is not
    explored again, but for one case: it can be made with the depth left now, though what it was made of then
    is too deep for that. Without this case the search would pass over parts of the tree that it ends with.
    So there are at most as many visits as objects times depth, most often far fewer.
    """
    search = _Search(world, limit)
    search.run(goal)
    return Bound(limit, tuple(search.explored), world.closure.available.get(goal, limit + 1) <= limit)


_Task = tuple[ObjectId, int, UnitId | None]
"""An object, the depth left, and the unit that made it once its needs were explored (None: explore it)."""


class _Search:
    """One depth-bounded search, with a stack of its own: FOONs may be deeper than Python recurses.

    Whether an object or a unit comes within a depth is read off the rounds of the closure: it is what the
    search would find out below, and it says when to stop trying units.
    """

    def __init__(self, world: World, limit: int) -> None:
        self.limit = limit
        self.explored: list[Visit] = []
        self._reading = world.units
        self._stock = world.stock
        self._closure = world.closure
        # For each object the depths left with which it was explored, and how deep what it was made of is.
        self._seen: dict[ObjectId, dict[int, int]] = {}
        self._never = limit + 1

    def run(self, goal: ObjectId) -> None:
        open_: list[_Task] = [(goal, self.limit, None)]
        while open_:
            object_id, left, unit = open_.pop()
            if unit is not None:
                needs = self._reading.needs[unit]
                self._seen[object_id][left] = 1 + max(
                    (self._depth(need, left - 1) for need in needs), default=0
                )
            elif not self._skips(object_id, left):
                open_ += reversed(self._visit(object_id, left))

    def _skips(self, object_id: ObjectId, left: int) -> bool:
        seen = self._seen.get(object_id)
        if seen is None:
            return False
        if object_id in self._stock or object_id not in self._reading.makers:
            return True  # A leaf, whatever depth is left.
        if max(seen) < left:
            return False
        fails = self._closure.available.get(object_id, self._never) > left
        return fails or self._depth(object_id, left) <= left

    def _visit(self, object_id: ObjectId, left: int) -> list[_Task]:
        """Explore an object and return what to do next, in order."""
        self.explored.append((object_id, self.limit - left))
        self._seen.setdefault(object_id, {})[left] = self._never
        todo: list[_Task] = []
        if left == 0 or object_id in self._stock:
            return todo
        for unit in self._reading.makers.of(object_id):
            todo += [(need, left - 1, None) for need in self._reading.needs[unit]]
            if self._closure.executable.get(unit, self._never) <= left:
                todo.append((object_id, left, unit))
                break
        return todo

    def _depth(self, object_id: ObjectId, left: int) -> int:
        """Return how deep what an object was made of is, if that fits into the depth left.

        What was made with more depth left, and still fits, is what the search would make now.
        """
        if object_id in self._stock:
            return 0
        depths = (depth for before, depth in self._seen[object_id].items() if before >= left)
        return next((depth for depth in depths if depth <= left), self._never)
