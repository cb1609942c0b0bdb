"""A tree that someone else made, replayed in its own order: what each step lacks, and what it is good for."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.supply import Supply
from foon_asp.model.world import World


@dataclass(frozen=True, slots=True)
class Judgement:
    """What is said of the step at a place (1, 2, …).

    `missing` is what it needs and nobody has made by then. `doubtful` is what a kitchen must have had that
    nobody named, though steps before have had the same in another state or place. `there` is all that is at
    hand before the step. `idle`: it brings about nothing that was not there. `unused`: no later step takes
    what it makes, and the tree is not for it.
    """

    place: int
    unit: UnitId
    missing: tuple[ObjectId, ...]
    doubtful: tuple[ObjectId, ...]
    there: frozenset[ObjectId]
    idle: bool
    unused: bool


def raw_objects(world: World, semantics: str, units: Iterable[UnitId]) -> list[ObjectId]:
    """Return what units need and none of them makes, in the order in which it is needed."""
    effects = Effects(world.with_stock(()), semantics)
    listed = list(dict.fromkeys(units))
    made = {object_id for unit in listed for object_id in effects.adds(unit)}
    needed = dict.fromkeys(object_id for unit in listed for object_id in effects.needs(unit))
    return [object_id for object_id in needed if object_id not in made]


def inferred_kitchen(world: World, semantics: str, units: Iterable[UnitId]) -> list[ObjectId]:
    """Return what units need from the kitchen in their order: what no earlier one has made."""
    supply = Supply(Effects(world.with_stock(()), semantics))
    found: dict[ObjectId, None] = {}
    for unit in units:
        found.update(dict.fromkeys(supply.lacks(unit)))
        supply.pretend(unit)
    return list(found)


def purpose(world: World, units: Sequence[UnitId], marked: Iterable[ObjectNode]) -> list[ObjectId]:
    """Return what a tree is for: marked goals that it makes, else what the last step makes that makes any."""
    makes = world.units.makes
    made = {object_id for unit in units for object_id in makes[unit]}
    goals = [goal for node in marked if (goal := world.id_of(node)) in made]
    last = next((makes[unit] for unit in reversed(units) if makes[unit]), ())
    return goals or list(last)


def judge(
    effects: Effects, units: Sequence[UnitId], goals: Iterable[ObjectId], *, named: bool
) -> list[Judgement]:
    """Replay units in their order; one that lacks something is gone on from as if it had been executed.

    `named` says that the kitchen was, so that nothing which it has is doubtful.
    """
    world = effects.world
    last_use = {need: place for place, unit in enumerate(units, 1) for need in effects.needs(unit)}
    last_use |= dict.fromkeys(goals, len(units) + 1)
    vessels = _vessels(world, units)
    before: dict[tuple[str, str], set[ObjectId]] = {}
    supply = Supply(effects)

    def doubtful(need: ObjectId) -> bool:
        seen = [before.get(kind, set()) for kind in _kinds(world.node(need), vessels)]
        return need in world.stock and any(seen) and not any(need in each for each in seen)

    found = []
    for place, unit in enumerate(units, 1):
        adds = effects.adds(unit)
        idle = not supply.used_up(unit) and all(map(supply.has, adds))
        used = any(last_use.get(object_id, 0) > place for object_id in adds)
        found.append(
            Judgement(
                place,
                unit,
                missing=tuple(supply.lacks(unit)),
                doubtful=() if named else tuple(filter(doubtful, effects.needs(unit))),
                there=supply.at_hand,
                idle=idle,
                unused=not (idle or used),
            )
        )
        supply.pretend(unit)
        for object_id in (*world.units.takes[unit], *world.units.makes[unit]):
            for kind in _kinds(world.node(object_id), vessels):
                before.setdefault(kind, set()).add(object_id)
    return found


def _kinds(node: ObjectNode, vessels: Container[str]) -> list[tuple[str, str]]:
    """Return what an object is by name: its label; each content of a vessel; nothing for a tool."""
    if node.label in vessels:
        return [(node.label, content) for content in node.contents]
    return [] if node.bare else [(node.label, "")]


def _vessels(world: World, units: Iterable[UnitId]) -> set[str]:
    """Return the labels of utensils and of all that holds something, of which a kitchen has several."""
    listed = {
        object_id for unit in units for object_id in (*world.units.takes[unit], *world.units.gives[unit])
    }
    states = [(node.label, state) for node in map(world.node, listed) for state in node.states]
    holding = {label for label, state in states if state.contents}
    related = {state.relatum for _, state in states if state.relatum is not None}
    return {*world.kitchen.utensils, *holding, *related}
