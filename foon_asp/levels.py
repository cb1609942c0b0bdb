"""Levels of detail: the same FOON with all it says (3), without contents (2), as labels alone (1)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from foon_asp.arrays import Ids
from foon_asp.builder import FoonBuilder
from foon_asp.errors import QueryError
from foon_asp.graph import Annotation, Foon, FunctionalUnit, ObjectNode, State
from foon_asp.kitchen import Kitchen
from foon_asp.reading import Reading

LEVELS = (1, 2, 3)
FULL = 3


def check_level(level: int) -> int:
    """Return the level; raise `QueryError` if there is no such one."""
    if level not in LEVELS:
        raise QueryError(f"there is no level {level}; levels: 1 (labels), 2 (and states), 3 (and contents)")
    return level


def project(node: ObjectNode, level: int) -> ObjectNode:
    """Return what a level shows of an object node."""
    if level == FULL:
        return node
    if level == 1:
        return ObjectNode(node.label)
    if all(state.contents is None for state in node.states):
        return node
    return ObjectNode.of(node.label, (State(state.name, state.relatum) for state in node.states))


def at_level(foon: Foon, level: int) -> Foon:
    """Return a FOON at a level: every object projected, units that become equal merged, the earliest kept.

    `duplicates` counts the units that were merged, here and before. What units need and make is not
    looked at: to plan on a level, give it to a `Domain`.
    """
    if check_level(level) == FULL:
        return foon
    inputs = [unit.inputs for unit in foon.units]
    outputs = [unit.outputs for unit in foon.units]
    return _view(foon, inputs, outputs, level)[0]


def planning_view(foon: Foon, reading: Reading, level: int) -> tuple[Foon, list[int]]:
    """Return a FOON whose inputs are the projected needs, and whose outputs all that is made, projected.

    Also return for each unit of the full FOON the id of its image.
    """
    return _view(foon, reading.needs, reading.makes, level)


def project_kitchen(kitchen: Kitchen, level: int) -> Kitchen:
    """Return a kitchen with its objects projected, each once; there is plenty if there is of one of them."""
    if level == FULL:
        return kitchen
    stock: dict[ObjectNode, int | None] = {}
    for node in kitchen.objects:
        quantity, image = kitchen.quantities.get(node), project(node, level)
        before = stock.get(image, 0)
        stock[image] = None if before is None or quantity is None else before + quantity
    quantities = {node: quantity for node, quantity in stock.items() if quantity is not None}
    return replace(kitchen, objects=tuple(stock), quantities=quantities)


def _view(foon: Foon, inputs: Sequence[Ids], outputs: Sequence[Ids], level: int) -> tuple[Foon, list[int]]:
    """Build a FOON of the given ports of each unit, projected."""
    builder = FoonBuilder()
    ids = [builder.object(project(node, level)) for node in foon.objects]
    images: list[int] = []
    for unit in foon.units:
        before, behind = inputs[unit.id], outputs[unit.id]
        note = _note(unit, before, behind)
        image, _ = builder.unit(unit.motion, [ids[o] for o in before], [ids[o] for o in behind], note)
        images.append(image)
    builder.read += foon.duplicates
    return builder.build(), images


def _note(unit: FunctionalUnit, inputs: Iterable[int], outputs: Iterable[int]) -> Annotation:
    """Return the annotation of a unit with the marks of the ports that are kept."""
    marks = unit.annotation.marks
    if not marks:
        return unit.annotation
    split = len(unit.inputs)
    before = dict(zip(unit.inputs, marks[:split], strict=True))
    behind = dict(zip(unit.outputs, marks[split:], strict=True))
    kept = (*(before[port] for port in inputs), *(behind[port] for port in outputs))
    return replace(unit.annotation, marks=kept)
