"""The best task trees of a small FOON, by trying every set of its units.

Written from the definitions alone: an input is needed unless it is an implied view, an output is made
unless it is bare. Shares nothing with `foon_asp.reading` or the encodings.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from math import prod

from foon_asp.graph import FunctionalUnit, ObjectNode
from foon_asp.problem import Domain

Costs = dict[str, int | Fraction]
"""What a tree costs by each criterion; `success` is the exact product of the rates."""


def needs(domain: Domain, unit: FunctionalUnit) -> set[ObjectNode]:
    inputs = [domain.foon.objects[number] for number in unit.inputs]
    if domain.strict:
        return set(inputs)
    return {thing for thing in inputs if not _implied(domain, thing, inputs)}


def _implied(domain: Domain, vessel: ObjectNode, inputs: Sequence[ObjectNode]) -> bool:
    if vessel.label not in domain.kitchen.utensils:
        return False
    contents = {
        content for state in vessel.states if state.name == "contains" for content in state.contents or ()
    }
    places = {
        (thing.label, state.relatum) for thing in inputs for state in thing.states if state.name == "in"
    }
    return len(contents) == 1 and all((content, vessel.label) in places for content in contents)


def makes(domain: Domain, unit: FunctionalUnit) -> set[ObjectNode]:
    outputs = [domain.foon.objects[number] for number in unit.outputs]
    return {thing for thing in outputs if thing.states}


def closure(domain: Domain, units: Iterable[int]) -> tuple[dict[ObjectNode, int], set[int]]:
    """Return what the units make from the kitchen, with the round it is there, and who took part."""
    waiting = [domain.foon.units[number] for number in units]
    at_hand = dict.fromkeys(domain.kitchen.objects, 0)
    done: set[int] = set()
    for turn in range(1, len(waiting) + 1):
        ready = [unit for unit in waiting if unit.id not in done and needs(domain, unit) <= at_hand.keys()]
        for unit in ready:
            done.add(unit.id)
            for thing in makes(domain, unit):
                at_hand.setdefault(thing, turn)
    return at_hand, done


def replays(domain: Domain, goal: ObjectNode, order: Iterable[int]) -> bool:
    """Say whether the units can be executed one by one, in this order, and bring the goal about."""
    at_hand = set(domain.kitchen.objects)
    for number in order:
        unit = domain.foon.units[number]
        if not needs(domain, unit) <= at_hand:
            return False
        at_hand |= makes(domain, unit)
    return goal in at_hand


def sums(domain: Domain, units: Iterable[int]) -> Costs:
    """Return what a set of units costs by the criteria that do not ask whether it can be executed."""
    used = [domain.foon.units[number] for number in units]
    rates = [Fraction(round(domain.kitchen.rates[unit.motion] * 1000), 1000) for unit in used]
    listed = [domain.foon.objects[o] for unit in used for o in (*unit.inputs, *unit.outputs)]
    states = [(thing, state) for thing in listed for state in thing.states]
    handled = {thing.label for thing in listed} | {state.relatum for _, state in states if state.relatum}
    holding = {thing.label for thing, state in states if state.name == "contains" and state.contents}
    holding |= {state.relatum for _, state in states if state.name == "in" and state.relatum}
    return {
        "units": len(used),
        "success": prod(rates, start=Fraction(1)),
        "inputs": sum(len(unit.inputs) for unit in used),
        "tools": sum(label in domain.kitchen.utensils for label in handled),
        "dirty": sum(label in domain.kitchen.utensils for label in holding),
        "motions": len({unit.motion for unit in used}),
    }


def costs(domain: Domain, goal: ObjectNode, units: Collection[int]) -> Costs | None:
    """Return what a set of units costs; None if not all can be executed or the goal is not made."""
    at_hand, done = closure(domain, units)
    if goal not in at_hand or done != set(units):
        return None
    return sums(domain, units) | {"depth": at_hand[goal]}


def every_set(domain: Domain) -> Iterator[tuple[int, ...]]:
    """Yield every set of units, the smaller ones first."""
    numbers = range(len(domain.foon.units))
    return (units for size in range(len(numbers) + 1) for units in combinations(numbers, size))


def trees(domain: Domain, goal: ObjectNode) -> list[Costs]:
    """Return the costs of every task tree there is."""
    return [found for units in every_set(domain) if (found := costs(domain, goal, units)) is not None]


def tree_sets(domain: Domain, goals: Collection[ObjectNode]) -> dict[frozenset[int], Costs]:
    """Return the units and costs of every task tree that makes all goals; `depth` is that of the last."""
    found: dict[frozenset[int], Costs] = {}
    for units in every_set(domain):
        at_hand, done = closure(domain, units)
        if done == set(units) and all(goal in at_hand for goal in goals):
            depth = max(at_hand[goal] for goal in goals)
            found[frozenset(units)] = sums(domain, units) | {"depth": depth}
    return found


def best(found: Iterable[Costs], by: Sequence[str]) -> Costs:
    """Return the first of the trees that are best by the criteria, the most important first."""
    return min(found, key=lambda each: [-each[name] if name == "success" else each[name] for name in by])
