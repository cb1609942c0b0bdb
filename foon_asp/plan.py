"""Plans: units in the order of execution, where things are used up and units may come again."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence, Set
from dataclasses import dataclass
from typing import TypeVar

from foon_asp.effects import Effects
from foon_asp.problem import Domain
from foon_asp.tree import Replay

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Plan:
    """Units in the order of execution; a unit may occur several times.

    `steps` says for each occurrence in which parallel step it is done, from 1: all units of a step can be
    executed in any order, or at once. `replay` is how executing the plan ends, under `semantics`.
    """

    domain: Domain
    goals: tuple[int, ...]
    semantics: str
    units: tuple[int, ...]
    steps: tuple[int, ...]
    replay: Replay

    @classmethod
    def of(
        cls, effects: Effects, goals: Iterable[int], units: Iterable[int], steps: Iterable[int] = ()
    ) -> Plan:
        """Replay units in the given order; without `steps` each is put into the earliest step it fits in."""
        goals, units = tuple(goals), tuple(units)
        placed = tuple(steps) or tuple(_earliest(effects, units))
        return cls(
            effects.domain, goals, effects.semantics, units, placed, replay_plan(effects, goals, units)
        )

    @property
    def executable(self) -> bool:
        return self.replay.executable

    @property
    def makespan(self) -> int:
        """How many parallel steps it takes."""
        return max(self.steps, default=0)


class Store:
    """What is at hand while units are executed.

    Of a counted object that is at hand both as a product and in the kitchen, the product is used first.
    """

    def __init__(self, effects: Effects) -> None:
        self.effects = effects
        self.made: set[int] = set()
        self.left = dict(effects.counted)

    def has(self, thing: int) -> bool:
        return thing in self.effects.endless or thing in self.made or self.left.get(thing, 0) > 0

    def execute(self, unit: int) -> list[int]:
        """Execute a unit, or return what it lacks and change nothing."""
        lacking = [thing for thing in self.effects.needs(unit) if not self.has(thing)]
        if lacking:
            return lacking
        for thing in self.effects.deletes(unit):
            if thing in self.made:
                self.made.remove(thing)
            elif self.left.get(thing, 0) > 0:
                self.left[thing] -= 1
        self.made.update(self.effects.adds(unit))
        return []


def replay_plan(effects: Effects, goals: Iterable[int], units: Iterable[int]) -> Replay:
    """Execute units one by one from the kitchen; plain Python, knows no planner."""
    store = Store(effects)
    node = effects.domain.node
    for place, unit in enumerate(units):
        lacking = store.execute(unit)
        if lacking:
            return Replay(False, place, tuple(map(node, lacking)))
    lacking = [goal for goal in goals if not store.has(goal)]
    return Replay(not lacking, None, tuple(map(node, lacking)))


def hopeless(
    effects: Effects, goals: Iterable[int], units: Iterable[int], states: int, deadline: float = math.inf
) -> bool:
    """Say whether executing units one by one, in whatever order, is certain never to reach the goals.

    Every state of the store is visited, up to so many, or until the deadline (`time.monotonic()` seconds);
    if there are more it is not certain. To have more never hurts. So units that use up nothing that matters
    are executed as soon as they can be, and a unit that makes nothing new is not executed.
    """
    goals, units = set(goals) - effects.endless, list(units)
    needs = {unit: frozenset(effects.needs(unit)) - effects.endless for unit in units}
    wanted = goals.union(*needs.values())
    adds = {unit: wanted.intersection(effects.adds(unit)) for unit in units}
    deletes = {unit: wanted.intersection(effects.deletes(unit)) for unit in units}
    costly = [unit for unit in units if deletes[unit]]
    free = [unit for unit in units if not deletes[unit]]

    def settled(made: set[int], left: dict[int, int]) -> tuple[frozenset[int], frozenset[tuple[int, int]]]:
        size = -1
        while size < len(made):
            size = len(made)
            for unit in free:
                if needs[unit] <= made | left.keys():
                    made |= adds[unit]
        return frozenset(made), frozenset(left.items())

    start = settled(set(), {thing: count for thing, count in effects.counted.items() if thing in wanted})
    queue, seen = [start], {start}
    for made, counts in queue:
        at_hand = made.union(thing for thing, _ in counts)
        if goals <= at_hand or len(queue) > states or time.monotonic() > deadline:
            return False
        for unit in costly:
            if needs[unit] <= at_hand and not adds[unit] <= made:
                left = {
                    thing: count - (thing in deletes[unit] and thing not in made) for thing, count in counts
                }
                after = settled(
                    set(made - deletes[unit]) | adds[unit], {thing: n for thing, n in left.items() if n > 0}
                )
                if after not in seen:
                    seen.add(after)
                    queue.append(after)
    return True


def orderings(effects: Effects, units: Iterable[int]) -> list[tuple[int, int]]:
    """Return pairs of places in a plan: the first must be executed before the second.

    Two units may be swapped unless one makes what the other needs or takes away, or one takes away what the
    other needs, takes away or makes.
    """
    order = list(units)
    needs = [set(effects.needs(unit)) - effects.endless for unit in order]
    adds = [set(effects.adds(unit)) - effects.endless for unit in order]
    return held_in_order(needs, adds, [set(effects.deletes(unit)) for unit in order])


def held_in_order(
    needs: Sequence[Set[T]], adds: Sequence[Set[T]], deletes: Sequence[Set[T]]
) -> list[tuple[int, int]]:
    """Return the pairs of places of which the first must come before the second.

    What is needed, made and taken away at each place may be of any kind.
    """
    return [
        (before, after)
        for after in range(len(needs))
        for before in range(after)
        if adds[before] & (needs[after] | deletes[after])
        or deletes[before] & (needs[after] | deletes[after] | adds[after])
        or needs[before] & deletes[after]
    ]


def _earliest(effects: Effects, units: tuple[int, ...]) -> list[int]:
    """Return for each occurrence the earliest parallel step that keeps all orderings."""
    steps = [1] * len(units)
    for before, after in orderings(effects, units):
        steps[after] = max(steps[after], steps[before] + 1)
    return steps
