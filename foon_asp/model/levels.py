"""Levels of detail: the same FOON with all it says (3), without contents (2), as labels alone (1)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from foon_asp.errors import QueryError
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.node import Annotation, FunctionalUnit, ObjectId, ObjectNode, State, UnitId
from foon_asp.model.units import Units
from foon_asp.values import said

LEVELS = (1, 2, 3)
FULL = 3

_Ports = Sequence[tuple[ObjectId, ...]]
"""The objects of each unit on one side of it."""


def check_level(level: int) -> int:
    """Return the level; raise `QueryError` if there is no such one."""
    if type(level) is not int or level not in LEVELS:
        known = "1 (labels), 2 (and states), 3 (and contents)"
        raise QueryError(f"there is no level {said(level)}; levels: {known}")
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
    looked at: to plan on a level, give it to a `World`.
    """
    if check_level(level) == FULL:
        return foon
    inputs = [unit.inputs for unit in foon.units]
    outputs = [unit.outputs for unit in foon.units]
    return _view(foon, inputs, outputs, level)[0]


def planning_view(foon: Foon, reading: Units, level: int) -> tuple[Foon, list[UnitId]]:
    """Return a FOON whose inputs are the projected needs, and whose outputs all that is made, projected.

    Also return for each unit of the full FOON the id of its image.
    """
    return _view(foon, reading.needs, reading.makes, level)


def lasting(nodes: Iterable[ObjectNode], level: int) -> set[ObjectNode]:
    """Return which images of object nodes are never used up: those of several nodes, and those of a tool.

    Where all nodes are bare they were cut down to their labels before: none is a tool by that.
    """
    images: dict[ObjectNode, list[ObjectNode]] = {}
    for node in nodes:
        images.setdefault(project(node, level), []).append(node)
    cut = all(node.bare for origins in images.values() for node in origins)
    return {image for image, origins in images.items() if len(origins) > 1 or (origins[0].bare and not cut)}


def _view(foon: Foon, inputs: _Ports, outputs: _Ports, level: int) -> tuple[Foon, list[UnitId]]:
    """Build a FOON of the given ports of each unit, projected."""
    builder = FoonBuilder()
    ids = [builder.object(project(node, level)) for node in foon.objects]
    images: list[UnitId] = []
    for unit in foon.units:
        before, behind = inputs[unit.id], outputs[unit.id]
        note = _note(unit, before, behind)
        image, _ = builder.unit(unit.motion, [ids[o] for o in before], [ids[o] for o in behind], note)
        images.append(image)
    builder.read += foon.duplicates
    return builder.build(), images


def _note(unit: FunctionalUnit, inputs: Iterable[ObjectId], outputs: Iterable[ObjectId]) -> Annotation:
    """Return the annotation of a unit with the marks of the ports that are kept."""
    marks = unit.annotation.marks
    if not marks:
        return unit.annotation
    split = len(unit.inputs)
    before = dict(zip(unit.inputs, marks[:split], strict=True))
    behind = dict(zip(unit.outputs, marks[split:], strict=True))
    kept = (*(before[port] for port in inputs), *(behind[port] for port in outputs))
    return replace(unit.annotation, marks=kept)
