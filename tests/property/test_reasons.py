"""The sentence that says why a goal cannot be made, against trying what could be bought."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from itertools import combinations
from random import Random

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.unreachable import unreachable_reason
from support import brute_force
from support.small_foons import node, world

NAMES = [
    "milk",
    "salt",
    "soup",
    "bowl",
    "bowl[empty]",
    "bowl[dirty]",
    "bowl{x}",
    "x@bowl",
    "(knife)",
    "egg[raw]",
    "egg[cooked]",
]


def drawn(seed: int) -> World:
    random = Random(seed)
    pool = random.sample(NAMES, 6)
    few = [1, 1, 2]
    units = [
        f"{' + '.join(random.sample(pool, random.choice(few)))} -do{number}-> "
        + " + ".join(random.sample(pool, random.choice(few)))
        for number in range(random.choice([2, 3, 4, 5]))
    ]
    return world(units, random.choice([random.choice(pool), ""]), utensils=["bowl"])


def buyable(where: World, goal: ObjectNode) -> list[ObjectNode]:
    """Return what nobody has done anything to: no unit makes it, or it is an empty bowl in whatever state."""
    made = set[ObjectNode]().union(*(brute_force.makes(where, unit) for unit in where.foon.units))
    empty = {node("bowl[empty]"), node("bowl[dirty]"), node("bowl")}
    return [thing for thing in where.foon.objects if thing != goal and (thing not in made or thing in empty)]


def enough(where: World, goal: ObjectNode) -> Iterator[set[ObjectNode]]:
    """Yield every set of such objects with which the goal can be made."""
    every = brute_force.every_unit(where)
    raw = buyable(where, goal)
    for size in range(len(raw) + 1):
        for some in combinations(raw, size):
            supplied = where.with_stock((*where.kitchen.objects, *some))
            if goal in brute_force.closure(supplied, every)[0]:
                yield set(some)


def test_the_reason_is_what_trying_everything_says() -> None:
    kinds: Counter[str] = Counter()
    for seed in range(700):
        where = drawn(seed)
        for goal in where.foon.objects:
            reason = unreachable_reason(Problem.of(where, [goal]))
            if not reason or reason.startswith("no unit makes"):
                continue
            sets = list(enough(where, goal))
            kinds[reason.split()[0]] += 1
            if not sets:
                assert reason.startswith("locked in a circle"), (seed, goal)
                continue
            needed = set[ObjectNode].intersection(*sets)
            if not needed:
                assert reason.startswith("whichever way"), (seed, goal)
                assert not reason.endswith(f"like {goal}")
                continue
            named = reason.removeprefix("the kitchen lacks ").split(", and no unit")[0]
            expected = {str(thing) for thing in needed}
            assert set(re.split(", | and ", named)) == expected or len(needed) > 3, (seed, goal, reason)
    assert min(kinds[kind] for kind in ("locked", "whichever", "the")) > 100
