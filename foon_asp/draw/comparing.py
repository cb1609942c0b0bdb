"""Two task trees over each other: what both do, what only the first does, and what only the second does."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from foon_asp.draw.picture import Picture, Side
from foon_asp.draw.units import Drawn, Scene, drawn
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.retrieval.check import Check
from foon_asp.retrieval.tree import TaskTree
from foon_asp.words import cut, listed

_NAME = 30
"""How many letters of the name of a tree are shown."""


@dataclass(frozen=True, slots=True)
class Version:
    """One of two trees: its units in their order, the FOON that they are of, and what it is for.

    `at_hand` is what it takes for granted.
    """

    name: str
    foon: Foon
    units: Sequence[FunctionalUnit]
    goals: Sequence[ObjectNode]
    at_hand: Sequence[ObjectNode]
    utensils: frozenset[str]

    @classmethod
    def of_tree(cls, name: str, tree: TaskTree) -> Version:
        """Return a task tree as a version."""
        world = tree.world
        goals = [world.node(goal) for goal in tree.goals]
        return cls(
            name, world.foon, tree.functional_units, goals, world.kitchen.objects, world.kitchen.utensils
        )

    @classmethod
    def of_check(cls, check: Check) -> Version:
        """Return a tree that someone else made as a version."""
        world = check.world
        units = [step.unit for step in check.steps]
        return cls(check.name, world.foon, units, check.goals, check.needs, world.kitchen.utensils)


def comparison_picture(first: Version, second: Version) -> Picture:
    """Return two trees over each other. What only one of them does keeps its colours and says whose it is.

    What both do is pale. The outlines and arrows of what only the second does are dashed.
    """
    builder = FoonBuilder()
    ids = [_added(builder, version) for version in (first, second)]
    at_hand = dict.fromkeys([*first.at_hand, *second.at_hand])
    kitchen = Kitchen(tuple(at_hand), first.utensils | second.utensils)
    world = World.of(builder.build(), kitchen)
    places: list[dict[UnitId, int]] = [{}, {}]
    for found, order in zip(places, ids, strict=True):
        for place, unit in enumerate(order, 1):
            found.setdefault(unit, place)
    names = [cut(version.name, _NAME) for version in (first, second)]
    units = [
        Drawn(unit, _place(unit, places), mark=_mark(_side(unit, places), names), side=_side(unit, places))
        for unit in dict.fromkeys([*ids[0], *ids[1]])
    ]
    wanted = (world.foon.id_of(node) for node in (*first.goals, *second.goals))
    goals = [goal for goal in wanted if goal is not None]
    nodes, edges = drawn(
        Scene(world, units, dict.fromkeys(goals), world.stock, sides=dict(_object_sides(world, units)))
    )
    shared = sum(each.side is Side.BOTH for each in units)
    counts = [len(places[0]) - shared, len(places[1]) - shared]
    said = f"{shared} steps in both, {counts[0]} only in {names[0]}, {counts[1]} only in {names[1]}"
    head = listed(list(dict.fromkeys(world.node(goal).label for goal in goals)))
    return Picture(f"{head}: {said}", f"Two task trees: {said}.", nodes, edges)


def _added(builder: FoonBuilder, version: Version) -> list[UnitId]:
    """Add the units of a version, and return their ids in its order."""
    found = []
    for unit in version.units:
        inputs, outputs = (
            [builder.object(version.foon.objects[number]) for number in side]
            for side in (unit.inputs, unit.outputs)
        )
        found.append(builder.unit(unit.motion, inputs, outputs, unit.annotation)[0])
    return found


def _side(unit: UnitId, places: Sequence[dict[UnitId, int]]) -> Side:
    if unit in places[0] and unit in places[1]:
        return Side.BOTH
    return Side.HERE if unit in places[0] else Side.THERE


def _place(unit: UnitId, places: Sequence[dict[UnitId, int]]) -> str:
    return "/".join(dict.fromkeys(str(found[unit]) for found in places if unit in found))


def _mark(side: Side, names: Sequence[str]) -> str:
    return "" if side is Side.BOTH else f"only in {names[side is Side.THERE]}"


def _object_sides(world: World, units: Iterable[Drawn]) -> Iterable[tuple[ObjectId, Side]]:
    """Yield for each object that some units touch the trees that it is in."""
    found: dict[ObjectId, set[Side]] = {}
    for each in units:
        for number in (*world.units.needs[each.unit], *world.units.makes[each.unit]):
            found.setdefault(number, set()).add(each.side)
    for number, sides in found.items():
        yield number, sides.pop() if len(sides) == 1 else Side.BOTH
