"""The best replacements in a small FOON, by trying all of them with every set of units.

Written from the definitions of docs/substituting.md alone; shares nothing with
`foon_asp.retrieval.substitute`, `foon_asp.model.replacing` or the encodings.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from itertools import combinations, permutations, product

from foon_asp.model.node import FunctionalUnit, ObjectNode, State, UnitId
from foon_asp.model.world import World
from foon_asp.query.substitution import Replacement
from foon_asp.retrieval.tree import TaskTree
from support import brute_force

Labels = Mapping[str, str | None]


def every_replacement(rows: Iterable[Replacement]) -> Iterator[tuple[Replacement, ...]]:
    """Yield all choices of replacements, one a label, none of which replaces a replacement."""
    options: dict[str, list[Replacement | None]] = {}
    for row in rows:
        options.setdefault(row.label, [None]).append(row)
    for choice in product(*options.values()):
        made = tuple(row for row in choice if row is not None)
        if not {row.label for row in made} & {row.by for row in made}:
            yield made


def cost(rows: Iterable[Replacement]) -> int:
    return sum(max(1, round(1000 * (1 - row.likeness))) for row in rows)


def counts(world: World, tree: TaskTree, units: int) -> bool:
    """Whether a tree has so many steps; fewer, if what is replaced may have made some of them the same."""
    made = [row.by for row in tree.replacements if row.by is not None]
    may_be_same = len(set(made)) < len(made) or not world.foon.named_labels.isdisjoint(made)
    return len(tree) == units or (may_be_same and 0 < len(tree) < units)


def dish(world: World, goal: ObjectNode) -> set[str]:
    contents = set(goal.contents)
    return contents if goal.label in world.kitchen.utensils and len(contents) == 1 else {goal.label}


def _united(one: str, other: str, labels: Labels) -> bool:
    return one == other or labels.get(one, one) == other or labels.get(other, other) == one


def _same_labels(mine: Iterable[str], theirs: Iterable[str], labels: Labels) -> bool:
    """Whether labels are the same but for pairs of which one is replaced by the other."""
    left, right = list(mine), list(theirs)
    for label in list(left):
        if label in right:
            left.remove(label)
            right.remove(label)
    return len(left) == len(right) and any(
        all(_united(one, other, labels) for one, other in zip(left, order, strict=True))
        for order in permutations(right)
    )


def _same_state(mine: State, theirs: State, labels: Labels) -> bool:
    if mine.name != theirs.name or (mine.contents is None) != (theirs.contents is None):
        return False
    if (mine.relatum is None) != (theirs.relatum is None):
        return False
    return _same_labels([mine.relatum or ""], [theirs.relatum or ""], labels) and _same_labels(
        mine.contents or (), theirs.contents or (), labels
    )


def stands_for(one: ObjectNode, other: ObjectNode, labels: Labels) -> bool:
    if one == other:
        return True
    names = [[state.name for state in node.states] for node in (one, other)]
    if sorted(names[0]) != sorted(names[1]) or any(len(set(each)) < len(each) for each in names):
        return False
    pairs = zip(
        sorted(one.states, key=lambda state: state.name),
        sorted(other.states, key=lambda state: state.name),
        strict=True,
    )
    return _same_labels([one.label], [other.label], labels) and all(
        _same_state(mine, theirs, labels) for mine, theirs in pairs
    )


def permitted(world: World, unit: FunctionalUnit, labels: Labels, without: Collection[str]) -> bool:
    """Whether a unit with its labels replaced touches nothing forbidden, and renames nothing it brings."""
    nodes = [world.foon.objects[o] for o in (*unit.inputs, *unit.outputs)]
    touched = {labels.get(label, label) for node in nodes for label in node.named_labels}
    return not touched & set(without) and not any(map(labels.get, made_new(world, unit)))


def made_new(world: World, unit: FunctionalUnit) -> set[str]:
    """Return the labels that a unit makes of things that do not name them."""
    inputs = (world.foon.objects[number] for number in unit.inputs)
    before = {label for node in inputs for label in node.named_labels}
    return {label for node in brute_force.makes(world, unit) for label in node.named_labels} - before


def makes_goal(
    world: World,
    goal: ObjectNode,
    units: Collection[UnitId],
    labels: Labels,
    brought: Collection[ObjectNode] = (),
) -> bool:
    """Whether the units can all be executed with the labels replaced, and bring the goal about."""
    waiting, there = executed(world, units, labels, brought)
    return not waiting and there(goal)


def executed(
    world: World,
    units: Collection[UnitId],
    labels: Labels,
    brought: Collection[ObjectNode] = (),
    gone: Callable[[ObjectNode], bool] = lambda _: False,
    free: Callable[[ObjectNode], bool] = lambda _: False,
) -> tuple[list[FunctionalUnit], Callable[[ObjectNode], bool]]:
    """Execute units with labels replaced as far as that goes: return those that are left, and what is there.

    Beside the kitchen there is what becomes of the nodes that are `brought`. What is `gone` is never there,
    and what is `free` always.
    """
    stock = world.kitchen.objects
    sources = {node for node in stock if node in brought or not labels.keys() & set(node.named_labels)}
    waiting = [world.foon.units[number] for number in units]

    def there(node: ObjectNode) -> bool:
        if labels.get(node.label, node.label) is None or free(node):
            return True
        if gone(node):
            return False
        return node in brought or any(stands_for(each, node, labels) for each in sources if not gone(each))

    while ready := [unit for unit in waiting if all(map(there, brute_force.needs(world, unit)))]:
        waiting = [unit for unit in waiting if unit not in ready]
        for unit in ready:
            sources |= brute_force.makes(world, unit)
    return waiting, there


def best(
    world: World, goal: ObjectNode, rows: Iterable[Replacement], without: Collection[str] = ()
) -> tuple[int, int] | None:
    """Return the least that replacements cost, and the fewest units with any of these; None if none do."""
    kept = dish(world, goal)
    found: dict[int, list[Labels]] = {}
    for made in every_replacement(row for row in rows if row.label not in kept):
        found.setdefault(cost(made), []).append({row.label: row.by for row in made})
    for price in sorted(found):
        for size in range(len(world.foon.units) + 1):
            for labels in found[price]:
                allowed = [unit.id for unit in world.foon.units if permitted(world, unit, labels, without)]
                if any(makes_goal(world, goal, units, labels) for units in combinations(allowed, size)):
                    return price, size
    return None
