"""Task trees and plans as pictures."""

from __future__ import annotations

from collections.abc import Mapping

from foon_asp.draw.picture import Node, Picture, Role
from foon_asp.draw.units import Drawn, Scene, drawn
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.plan import Plan
from foon_asp.retrieval.tree import Replay, TaskTree
from foon_asp.words import counted, listed


def tree_picture(tree: TaskTree, marks: Mapping[UnitId, str] | None = None) -> Picture:
    """Return a task tree as a picture; `marks` are said above some of its units."""
    world = tree.world
    units = [
        Drawn(
            unit,
            place,
            mark=", ".join(
                filter(None, [(marks or {}).get(unit, ""), "human" if unit in tree.human else ""])
            ),
            faults=_faults(tree.replay, place),
            lacks=lacking(world, tree.replay, place),
        )
        for place, unit in enumerate(tree.units, 1)
    ]
    nodes, edges = drawn(Scene(world, units, tree.goals, world.stock))
    if tree.replacements:
        said = tuple(map(str, tree.replacements))
        nodes.append(Node("n0", Role.NOTE, "replaced", said, title="\n".join(said)))
    return Picture(
        title(world, tree.goals), _summary("task tree", world, tree.goals, len(tree)), nodes, edges
    )


def title(world: World, goals: tuple[ObjectId, ...]) -> str:
    """Return what is said above a picture of some goals: their labels."""
    return listed(list(dict.fromkeys(world.node(goal).label for goal in goals)))


def _summary(what: str, world: World, goals: tuple[ObjectId, ...], steps: int) -> str:
    return f"A {what} of {counted(steps, 'step')} for {listed([world.node(goal) for goal in goals])}."


def _faults(replay: Replay, place: int) -> tuple[str, ...]:
    return ("cannot be executed",) if replay.failed_at == place - 1 else ()


def lacking(world: World, replay: Replay, place: int) -> frozenset[ObjectId]:
    """Return the ids of what the step at a place lacks, where a replay failed."""
    if replay.failed_at != place - 1:
        return frozenset()
    return frozenset(map(world.id_of, replay.missing))


def plan_picture(plan: Plan, effects: Effects) -> Picture:
    """Return a plan as a picture: each thing as often as it is made, with what is used up in the titles."""
    world = plan.world
    maker: dict[ObjectId, int] = {}
    supply = Supply(effects)
    units = []
    for place, number in enumerate(plan.units, 1):
        gone = frozenset(supply.used_up(number))
        supply.execute(number)
        units.append(
            Drawn(
                number,
                place,
                dict(maker),
                faults=_faults(plan.replay, place),
                lacks=lacking(world, plan.replay, place),
                uses_up=gone,
            )
        )
        for object_id in gone:
            maker.pop(object_id, None)
        makes = world.units.makes[number]
        maker.update((object_id, place) for object_id in makes if object_id not in effects.endless)
    nodes, edges = drawn(Scene(world, units, plan.goals, world.stock))
    return Picture(
        title(world, plan.goals), _summary("plan", world, plan.goals, len(plan.units)), nodes, edges
    )
