"""What each step of a task tree is for, and the best tree without it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree, makers, origins


@dataclass(frozen=True, slots=True)
class Taken:
    """An input of a step. `step` is the place (1, 2, …) of the step that makes it, None for the kitchen.

    If the kitchen does not have it either (`at_hand` is false), another input shows the same object.
    """

    node: ObjectNode
    step: int | None
    at_hand: bool


@dataclass(frozen=True, slots=True)
class Made:
    """What a step makes, the places of the later steps that take it, and whether it is a goal."""

    node: ObjectNode
    steps: tuple[int, ...]
    goal: bool


@dataclass(frozen=True, slots=True)
class StepRole:
    """What a step of a task tree is in it for.

    `way` are the places of the steps by which what it makes gets into a goal, itself the first: the shortest
    way there is. It is empty if no goal needs what the step makes.
    """

    place: int
    unit: FunctionalUnit
    takes: tuple[Taken, ...]
    makes: tuple[Made, ...]
    way: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Instead:
    """The best tree without a unit, if there is one; the units that go and those that come, by id."""

    unit: UnitId
    answer: Answer
    goes: tuple[UnitId, ...]
    comes: tuple[UnitId, ...]


def explain_steps(tree: TaskTree) -> tuple[StepRole, ...]:
    """Say of each step of a task tree what it takes from where, and what it makes for which steps."""
    world = tree.world
    reading = world.units
    maker = makers(reading, tree.units, world.stock)
    users: dict[ObjectId, list[int]] = {}
    takes: list[tuple[Taken, ...]] = []
    for place, (unit, origin) in enumerate(zip(tree.functional_units, origins(tree), strict=True), 1):
        takes.append(
            tuple(
                Taken(world.node(object_id), origin.get(read), read in world.stock)
                for object_id in unit.inputs
                for read in (reading.read(object_id),)
            )
        )
        for object_id in reading.needs[unit.id]:
            if object_id in origin:
                users.setdefault(object_id, []).append(place)
    makes = []
    for place, unit in enumerate(tree.functional_units, 1):
        mine = [object_id for object_id in reading.makes[unit.id] if maker.get(object_id) == place]
        makes.append(
            tuple(
                Made(
                    world.node(object_id),
                    tuple(users.get(object_id, ())) if object_id in mine else (),
                    object_id in mine and object_id in tree.goals,
                )
                for object_id in reading.makes[unit.id]
            )
        )
    ways = _ways(makes)
    return tuple(
        StepRole(place, unit, takes[place - 1], makes[place - 1], ways[place - 1])
        for place, unit in enumerate(tree.functional_units, 1)
    )


def _ways(makes: Sequence[tuple[Made, ...]]) -> list[tuple[int, ...]]:
    """Return for each step the shortest way over later steps to a goal."""
    ways: list[tuple[int, ...]] = [()] * len(makes)
    # Users of an object come later, so going backwards their ways are known.
    for place in range(len(makes), 0, -1):
        made = makes[place - 1]
        if any(each.goal for each in made):
            ways[place - 1] = (place,)
            continue
        onward = [ways[user - 1] for each in made for user in each.steps if ways[user - 1]]
        if onward:
            ways[place - 1] = (place, *min(onward, key=lambda way: (len(way), way)))
    return ways


def without_unit(result: Answer, unit: UnitId) -> Instead:
    """Retrieve the best tree that does without a unit of a tree, by the same criteria and constraints."""
    tree = result.tree
    assert tree is not None
    avoided = (*result.query.constraints.avoid_units, unit)
    other = retrieve(tree.world, result.query.replace(avoid_units=avoided))
    units = other.tree.units if other.tree else ()
    goes = tuple(each for each in tree.units if each not in units) if other.tree else ()
    comes = tuple(each for each in units if each not in tree.units)
    return Instead(unit, other, goes, comes)
