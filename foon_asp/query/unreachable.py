"""Why a goal cannot be made, by plain graph search: said in one sentence, before any solver is asked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.reachability import backward, within
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.words import listed

_SHOWN = 3
"""How many objects a sentence names."""


@dataclass(frozen=True, slots=True)
class Lack:
    """What stands in the way of a goal that units make, but none that can be executed.

    `units` can matter for the goal. `raw` is what they need, is not available and could simply be bought,
    never the goal itself; `available` is what they could do with all of that, and with what the kitchen can
    make as it is.
    """

    goal: ObjectId
    units: list[UnitId]
    raw: list[ObjectId]
    available: Mapping[ObjectId, int]
    executable: Mapping[UnitId, int]

    @classmethod
    def of(cls, world: World, goal: ObjectId) -> Lack:
        """Work out what stands in the way of a goal in a world."""
        reading = world.units
        available = world.closure.available
        units = backward(reading, [goal], available)
        needed = {object_id for unit in units for object_id in reading.needs[unit]}
        raw = sorted(
            object_id
            for object_id in needed
            if object_id not in available and object_id != goal and is_raw(world, object_id)
        )
        closure = within(reading, {*needed & available.keys(), *raw}, units)
        return cls(goal, units, raw, closure.available, closure.executable)

    @property
    def circular(self) -> bool:
        """Whether even all raw objects together are not enough."""
        return self.goal not in self.available


@dataclass(frozen=True, slots=True)
class Circle:
    """A shortest ring of units that hold each other up, in a group of objects that nothing else makes.

    Each unit makes the object at the same place, and needs the object at the next place; the last one needs
    the first. `others` are further units that make any of the objects: they need something of the group, too.
    """

    objects: tuple[ObjectId, ...]
    units: tuple[UnitId, ...]
    others: tuple[UnitId, ...]


def is_raw(world: World, object_id: ObjectId) -> bool:
    """Whether nothing has been done to an object: no unit makes it, or it is a utensil with nothing in it."""
    node = world.node(object_id)
    return object_id not in world.units.makers or (
        node.label in world.kitchen.utensils
        and not any(state.relatum or state.contents or state.name == "contains" for state in node.states)
    )


def unreachable_reason(problem: Problem) -> str:
    """Say in one sentence why no task tree can exist, or return nothing if one can."""
    world = problem.world
    makers = world.units.makers
    for goal in problem.goals:
        if goal in world.stock:
            continue
        node = world.node(goal)
        if goal not in makers:
            return f"no unit makes {node}" + (
                "; it is bare (has no states), so only the kitchen can have it"
                if node.bare and not world.labels_only
                else ""
            )
        if problem.founded and goal not in world.closure.available:
            return _locked(world, Lack.of(world, goal))
    return ""


def _locked(world: World, lack: Lack) -> str:
    if lack.circular:
        circle = circles(world, lack)[0]
        places = ", ".join(str(world.foon.units[unit].source) or f"unit {unit}" for unit in circle.units)
        return f"locked in a circle: {world.node(circle.objects[0])} is needed to make itself ({places})"
    needed = essential(world, lack)
    if not needed:
        example = min(lack.raw, key=lambda object_id: _telling(world, object_id))
        return f"whichever way it is made, the kitchen lacks something, like {world.node(example)}"
    needed.sort(key=lambda object_id: _telling(world, object_id))
    text = "the kitchen lacks " + listed([world.node(object_id) for object_id in needed], _SHOWN)
    if any(object_id in world.units.makers for object_id in needed):
        return text
    return f"{text}, and no unit makes {'it' if len(needed) == 1 else 'them'}"


def _telling(world: World, object_id: ObjectId) -> tuple[bool, ObjectId]:
    """Sort key: food before utensils, then as the files have it."""
    node = world.node(object_id)
    return node.bare or node.label in world.kitchen.utensils, object_id


def essential(world: World, lack: Lack) -> list[ObjectId]:
    """Return the raw objects that every way of making the goal needs.

    A set of objects is a bit mask. What an object takes for certain is what all of its makers do, or the
    object itself where it can be bought; passes go on until no mask loses a bit.
    """
    reading = world.units
    masks = {object_id: 1 << place for place, object_id in enumerate(lack.raw)}
    everything = (1 << len(lack.raw)) - 1
    there = world.closure.available
    order = sorted(lack.executable, key=lack.executable.__getitem__)
    changed = True
    while changed:
        changed = False
        for unit in order:
            mask = 0
            for object_id in reading.needs[unit]:
                mask |= masks.get(object_id, 0)
            for object_id in reading.makes[unit]:
                if object_id in there:
                    continue
                old = masks.get(object_id, everything)
                masks[object_id] = old & mask
                changed |= masks[object_id] != old
    found = masks[lack.goal]
    return [object_id for place, object_id in enumerate(lack.raw) if found >> place & 1]


def circles(world: World, lack: Lack) -> list[Circle]:
    """Return what locks a goal for which even all raw objects are not enough, the nearest to it first.

    Of the objects that cannot be had, some need only each other: no object of such a group can be made
    without having one of them before. There is one circle for each group.
    """
    reading = world.units
    there = world.closure.available
    makers: dict[ObjectId, list[UnitId]] = {}
    needs: dict[UnitId, list[ObjectId]] = {}
    for unit in lack.units:
        if unit in lack.executable:
            continue
        needs[unit] = [
            object_id
            for object_id in reading.needs[unit]
            if object_id not in lack.available and object_id not in there
        ]
        for object_id in reading.makes[unit]:
            makers.setdefault(object_id, []).append(unit)
    lacking = {
        object_id: _distinct(need for unit in units for need in needs[unit])
        for object_id, units in makers.items()
    }
    found = []
    for group in _closed_groups(lack.goal, lacking):
        object_ids, units = _ring(group, makers, needs)
        others = {unit for object_id in object_ids for unit in makers[object_id]} - set(units)
        found.append(Circle(object_ids, units, tuple(sorted(others))))
    return found


def _distinct(items: Iterable[ObjectId]) -> list[ObjectId]:
    return list(dict.fromkeys(items))


def _closed_groups(start: ObjectId, needs: Mapping[ObjectId, Sequence[ObjectId]]) -> list[list[ObjectId]]:
    """Return the strongly connected groups that nothing leads out of, the nearest to the start first.

    The first of each group is the nearest.
    """
    # It takes a quarter of a second to be imported, and most goals lack something else.
    import networkx as nx

    graph = nx.from_dict_of_lists(needs, nx.DiGraph)
    near = [start, *(object_id for _, object_id in nx.bfs_edges(graph, start))]
    place = {object_id: number for number, object_id in enumerate(near)}
    closed = nx.attracting_components(graph.subgraph(near))
    groups = [sorted(group, key=place.__getitem__) for group in closed]
    return sorted(groups, key=lambda group: place[group[0]])


def _ring(
    group: Sequence[ObjectId],
    makers: Mapping[ObjectId, Sequence[UnitId]],
    needs: Mapping[UnitId, Sequence[ObjectId]],
) -> tuple[tuple[ObjectId, ...], tuple[UnitId, ...]]:
    """Return the objects and units of a shortest ring through the first object of a group."""
    start = group[0]
    came: dict[ObjectId, tuple[ObjectId, UnitId]] = {}
    queue = [start]
    for object_id in queue:
        for unit in makers[object_id]:
            for need in needs[unit]:
                if need not in came:
                    came[need] = (object_id, unit)
                    queue.append(need)
        if start in came:
            break
    object_ids: list[ObjectId] = []
    units: list[UnitId] = []
    object_id = start
    while not object_ids or object_id != start:
        object_id, unit = came[object_id]
        object_ids.append(object_id)
        units.append(unit)
    return tuple(reversed(object_ids)), tuple(reversed(units))
