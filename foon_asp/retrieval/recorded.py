"""Answers read back from JSON: the tree in a small world of its own, made of what the tree says."""

from __future__ import annotations

import msgspec

from foon_asp.errors import QueryError
from foon_asp.io.object_wire import ObjectJson
from foon_asp.io.objects import object_from_json
from foon_asp.model.foon import Added, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectId, ObjectNode, Source, UnitId
from foon_asp.model.reachability import within
from foon_asp.model.relations import MATCHINGS
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.query.objective import Costs
from foon_asp.retrieval.tree import Record, Replay, TaskTree, replay
from foon_asp.retrieval.wire import CostsJson, RetrievalJson, TreeUnitJson


def read_retrieval(text: str | bytes) -> RetrievalJson:
    """Read what `retrieve --format json` wrote for one goal; raise `QueryError` if it is something else."""
    try:
        return msgspec.json.decode(text, type=RetrievalJson)
    except msgspec.DecodeError as error:
        raise QueryError(f"this is no answer of foon-asp retrieve: {error}") from None


def recorded_tree(value: RetrievalJson) -> TaskTree | None:
    """Return the tree of an answer, replayed in a kitchen that has what the tree takes and does not make.

    The utensils are not known there, nor success rates: costs and depth are those of the record. Raises
    `QueryError` if the units do not make the goal though the record says so.
    """
    if value.costs is None:
        return None
    builder = FoonBuilder()
    goal = recorded_node(value.goal)
    builder.object(goal)
    order = []
    products: set[tuple[UnitId, ObjectId]] = set()
    for unit in value.units:
        source = Source(unit.source.file, unit.source.line, unit.source.video)
        inputs, outputs = (
            [builder.object(recorded_node(each)) for each in side] for side in (unit.inputs, unit.outputs)
        )
        number, added = builder.unit(unit.motion, inputs, outputs, Annotation(sources=(source,)))
        if added is not Added.NEW:
            raise QueryError(f"the answer has the unit {unit.id} twice")
        order.append(number)
        products.update((number, made) for made in _products(unit, builder))
    foon = builder.build()
    labels_only = all(node.bare for node in foon.objects)
    for matching in MATCHINGS:
        # How relations were matched is not written down; loosely only if they had to be.
        units = Units(foon, (), labels_only=labels_only, match_relations=matching, products=products)
        world = World(units, Kitchen(tuple(_taken(units, goal, order, executable=value.executable))))
        if replay(world, (world.id_of(goal),), order).executable == value.executable:
            break
    rounds = within(units, world.stock, order).executable
    goals = (world.id_of(goal),)
    ended = replay(world, goals, order)
    if value.executable and not ended.executable:
        raise QueryError(f"the units of this answer do not make {goal}")
    if not value.executable and ended.executable:
        # It lacked something raw, which is not written down.
        ended = Replay(False, None, ())
    return TaskTree(
        world,
        goals,
        tuple(order),
        tuple(rounds.get(number, 0) for number in order),
        ended,
        frozenset(number for number, unit in zip(order, value.units, strict=True) if unit.agent == "human"),
        Record(tuple(UnitId(unit.id) for unit in value.units), _costs(value.costs), value.depth),
    )


def _products(unit: TreeUnitJson, builder: FoonBuilder) -> list[ObjectId]:
    """Return the bare outputs that a unit makes: what is a utensil is told by the record alone."""
    kept = {node.label for node in (*unit.inputs, *(unit.tools or ()))}
    nodes = (recorded_node(node) for node in unit.outputs if node.label not in kept)
    return [builder.object(node) for node in nodes if node.bare]


def _taken(units: Units, goal: ObjectNode, order: list[UnitId], *, executable: bool) -> list[ObjectNode]:
    """Return what the units take and the kitchen must have had.

    If they can be executed in their order, that is all that no unit before makes; else all that none makes.
    """
    made = {number for unit in order for number in units.makes[unit]}
    if executable:
        made = set()
    taken: dict[ObjectId, None] = {}
    for unit in order:
        taken.update((number, None) for number in units.takes[unit] if number not in made)
        if executable:
            made.update(units.makes[unit])
    objects = [units.foon.objects[number] for number in taken]
    return objects if order else [goal]


def recorded_node(value: ObjectJson) -> ObjectNode:
    """Return the object node that was written."""
    return object_from_json(msgspec.to_builtins(value))


def _costs(value: CostsJson) -> Costs:
    return Costs(**msgspec.structs.asdict(value))
