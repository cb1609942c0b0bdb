"""The nearest adaptation of a dish in a small FOON, by trying every change with every set of units.

Written from the definitions of docs/adapting.md alone; shares nothing with `foon_asp.retrieval.adapt`,
`foon_asp.retrieval.substitute` or the encodings.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import combinations, product

from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.substitution import Replacement
from support import brute_force
from support.brute_substitution import (
    Labels,
    cost,
    dish,
    every_replacement,
    executed,
    made_new,
    makes_goal,
    permitted,
)

Beside = Mapping[str, str]
"""What is added, each beside which label."""


def _food(world: World, node: ObjectNode) -> set[str]:
    return set(node.named_labels) - world.kitchen.utensils


def may_go(world: World, goal: ObjectNode, without: Collection[str]) -> set[str]:
    """Return what may be replaced: what is avoided, and food that the dish cannot have without that."""
    stock = set(world.kitchen.objects)
    steps: set[UnitId] = set()
    wanted = {goal} - stock
    while True:
        more = {unit.id for unit in world.foon.units if brute_force.makes(world, unit) & wanted}
        if more <= steps:
            break
        steps |= more
        for number in more:
            wanted |= brute_force.needs(world, world.foon.units[number]) - stock
    units = [world.foon.units[number] for number in steps]
    clean = [unit.id for unit in units if permitted(world, unit, {}, without)]
    there, _ = brute_force.closure(world, clean)
    lacking = [need for unit in units for need in brute_force.needs(world, unit) if need not in there]
    single = [food for food in (_food(world, need) for need in lacking) if len(food) == 1]
    return set(without).union(*single)


def _brought(world: World, labels: Labels, wanted: Collection[str]) -> set[ObjectNode]:
    """Return the nodes that are at hand for the sake of what they become: something wanted."""
    made = {node for unit in world.foon.units for node in brute_force.makes(world, unit)}
    found = set()
    for node in (*world.foon.objects, *world.kitchen.objects):
        becomes = {label: labels.get(label, label) for label in node.named_labels}
        if node in world.kitchen.objects:
            changed = [by for label, by in becomes.items() if by != label]
            if changed and all(by in wanted for by in changed):
                found.add(node)
        elif node not in made:
            food = _food(world, node)
            if food and all(becomes[label] in wanted for label in food):
                found.add(node)
    return found


def _shows(node: ObjectNode, label: str, labels: Labels, beside: Beside) -> bool:
    named = {labels.get(each, each) for each in node.named_labels}
    return label in named or (label in beside and beside[label] in named)


def _tool(world: World, node: ObjectNode) -> bool:
    return node.label in world.kitchen.utensils and not any(state.contents for state in node.states)


def _missing(
    world: World,
    goal: ObjectNode,
    units: Collection[UnitId],
    labels: Labels,
    beside: Beside,
    wanted: Collection[str],
) -> int:
    """Return how many labels are wanted that the units do not need for the dish."""
    brought = _brought(world, labels, wanted)

    def lacks(label: str) -> bool:
        def gone(node: ObjectNode) -> bool:
            return _shows(node, label, labels, beside)

        def free(node: ObjectNode) -> bool:
            return node != goal and _tool(world, node)

        _, there = executed(world, units, labels, brought, gone, free)
        return there(goal)

    return sum(map(lacks, wanted))


def _additions(near: Mapping[tuple[str, str], int], wanted: Iterable[str]) -> Iterator[dict[str, str]]:
    """Yield all choices of what to add beside what."""
    wanted = list(wanted)
    options = [[None, *(label for label, by in near if by == each)] for each in wanted]
    for choice in product(*options):
        yield {each: label for each, label in zip(wanted, choice, strict=True) if label is not None}


def best(
    world: World,
    goal: ObjectNode,
    rows: Iterable[Replacement],
    wanted: Collection[str],
    without: Collection[str],
) -> tuple[int, int] | None:
    """Return the least distance in thousandths, and the fewest units with it; None if there is no tree."""
    rows = list(rows)
    kept = dish(world, goal)
    listed = {row.label for row in rows if row.by is None}
    every = [*rows, *(Replacement(label, None, 0.0) for label in without if label not in listed)]
    free = may_go(world, goal, without) - kept - set(wanted)
    near = {
        (row.label, row.by): cost([row])
        for row in rows
        if row.by in wanted and row.by is not None and row.label not in kept
    }
    changes: list[tuple[int, int, Labels, Beside]] = []
    for made in every_replacement(row for row in every if row.label in free):
        replaced: Labels = {row.label: row.by for row in made}
        for added in _additions(near, wanted):
            if not set(added.values()) & ({*replaced} | {*replaced.values()}):
                paid = cost(made) + len(made) + sum(near[label, by] for by, label in added.items())
                changes.append((paid, len(changes), replaced, added))
    found: tuple[int, int] | None = None
    for paid, _, labels, beside in sorted(changes, key=lambda each: each[:2]):
        if found is not None and paid > found[0]:
            break
        units = [
            unit.id
            for unit in world.foon.units
            if permitted(world, unit, labels, without) and not made_new(world, unit) & set(beside.values())
        ]
        brought = _brought(world, labels, wanted)
        for size in range(len(units) + 1):
            for some in combinations(units, size):
                if makes_goal(world, goal, some, labels, brought):
                    total = paid + 1000 * _missing(world, goal, some, labels, beside, wanted)
                    if found is None or (total, size) < found:
                        found = total, size
    return found
