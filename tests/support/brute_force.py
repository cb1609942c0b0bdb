"""The best task trees of a small FOON, by trying every set of its units.

Written from the definitions alone: an input is needed unless it is an implied view, an output is made
unless it is bare and only listed again; on level 1 it always is. Shares nothing with `foon_asp.units` or the
encodings.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from math import prod

from foon_asp.model.node import FunctionalUnit, ObjectNode, UnitId
from foon_asp.model.world import World

Costs = dict[str, int | Fraction]
"""What a tree costs by each criterion; `success` is the exact product of the rates."""


def needs(world: World, unit: FunctionalUnit) -> set[ObjectNode]:
    return needed(world, [world.foon.objects[number] for number in unit.inputs])


def needed(world: World, inputs: Sequence[ObjectNode]) -> set[ObjectNode]:
    if world.strict:
        return set(inputs)
    return {thing for thing in inputs if not _implied(world, thing, inputs)}


def _implied(world: World, vessel: ObjectNode, inputs: Sequence[ObjectNode]) -> bool:
    if vessel.label not in world.kitchen.utensils:
        return False
    contents = {
        content for state in vessel.states if state.name == "contains" for content in state.contents or ()
    }
    places = {
        (thing.label, state.relatum) for thing in inputs for state in thing.states if state.name == "in"
    }
    return len(contents) == 1 and all((content, vessel.label) in places for content in contents)


def makes(world: World, unit: FunctionalUnit) -> set[ObjectNode]:
    inputs, outputs = ([world.foon.objects[o] for o in ports] for ports in (unit.inputs, unit.outputs))
    return made(world, inputs, outputs)


def made(world: World, inputs: Sequence[ObjectNode], outputs: Sequence[ObjectNode]) -> set[ObjectNode]:
    if world.labels_only:
        return set(outputs)
    there = {thing.label for thing in inputs} | world.kitchen.utensils
    return {thing for thing in outputs if thing.states or thing.label not in there}


def closure(world: World, units: Iterable[UnitId]) -> tuple[dict[ObjectNode, int], dict[UnitId, int]]:
    """Return what the units make from the kitchen, and who took part, each with the round of it."""
    waiting = [world.foon.units[number] for number in units]
    at_hand = dict.fromkeys(world.kitchen.objects, 0)
    done: dict[UnitId, int] = {}
    for turn in range(1, len(waiting) + 1):
        ready = [unit for unit in waiting if unit.id not in done and needs(world, unit) <= at_hand.keys()]
        for unit in ready:
            done[unit.id] = turn
            for thing in makes(world, unit):
                at_hand.setdefault(thing, turn)
    return at_hand, done


def replays(world: World, goal: ObjectNode, order: Iterable[UnitId]) -> bool:
    """Say whether the units can be executed one by one, in this order, and bring the goal about."""
    at_hand = set(world.kitchen.objects)
    for number in order:
        unit = world.foon.units[number]
        if not needs(world, unit) <= at_hand:
            return False
        at_hand |= makes(world, unit)
    return goal in at_hand


def sums(world: World, units: Iterable[UnitId]) -> Costs:
    """Return what a set of units costs by the criteria that do not ask whether it can be executed."""
    used = [world.foon.units[number] for number in units]
    rates = [Fraction(round(world.kitchen.rates[unit.motion] * 1000), 1000) for unit in used]
    listed = [world.foon.objects[o] for unit in used for o in (*unit.inputs, *unit.outputs)]
    states = [(thing, state) for thing in listed for state in thing.states]
    handled = {thing.label for thing in listed} | {state.relatum for _, state in states if state.relatum}
    holding = {thing.label for thing, state in states if state.name == "contains" and state.contents}
    holding |= {state.relatum for _, state in states if state.name == "in" and state.relatum}
    paid = sum((Fraction(str(world.kitchen.costs.get(unit.motion, 0))) for unit in used), Fraction(0))
    return {
        "units": len(used),
        "success": prod(rates, start=Fraction(1)),
        "inputs": sum(len(unit.inputs) for unit in used),
        "tools": sum(label in world.kitchen.utensils for label in handled),
        "dirty": sum(label in world.kitchen.utensils for label in holding),
        "motions": len({unit.motion for unit in used}),
        **({"cost": paid} if world.kitchen.costs else {}),
    }


def costs(world: World, goal: ObjectNode, units: Collection[UnitId]) -> Costs | None:
    """Return what a set of units costs; None if not all can be executed or the goal is not made."""
    at_hand, done = closure(world, units)
    if goal not in at_hand or done.keys() != set(units):
        return None
    return sums(world, units) | {"depth": max(done.values(), default=0)}


def every_unit(world: World) -> Sequence[UnitId]:
    """Return the ids of all units."""
    return world.foon.units.ids


def every_set(world: World) -> Iterator[tuple[UnitId, ...]]:
    """Yield every set of units, the smaller ones first."""
    numbers = every_unit(world)
    return (units for size in range(len(numbers) + 1) for units in combinations(numbers, size))


def trees(world: World, goal: ObjectNode) -> list[Costs]:
    """Return the costs of every task tree there is."""
    return [found for units in every_set(world) if (found := costs(world, goal, units)) is not None]


def tree_sets(world: World, goals: Collection[ObjectNode]) -> dict[frozenset[UnitId], Costs]:
    """Return the units and costs of every task tree that makes all goals."""
    found: dict[frozenset[UnitId], Costs] = {}
    for units in every_set(world):
        at_hand, done = closure(world, units)
        if done.keys() == set(units) and all(goal in at_hand for goal in goals):
            found[frozenset(units)] = sums(world, units) | {"depth": max(done.values(), default=0)}
    return found


def best(found: Iterable[Costs], by: Sequence[str]) -> Costs:
    """Return the first of the trees that are best by the criteria, the most important first."""
    return min(found, key=lambda each: [-each[name] if name == "success" else each[name] for name in by])
