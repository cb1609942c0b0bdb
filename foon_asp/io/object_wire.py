"""Object nodes and units as JSON, declared and written; `foon_asp.io.objects` reads them."""

from __future__ import annotations

from typing import Annotated, Any, TypeVar

from foon_asp.io.wire import Count, JsonObject, Text, means
from foon_asp.model.foon import Foon
from foon_asp.model.node import FunctionalUnit, ObjectNode, State

U = TypeVar("U", bound="UnitJson")


class ObjectJson(JsonObject):
    """An object node: a label and a set of states, written as the kitchen and goal files write it."""

    label: Annotated[Text, means("What the object is, lower case.")]
    states: Annotated[
        list[Text],
        means(
            "Its states. Those that fit neither `ingredients` nor `container` are written in full, e.g. "
            '"on [plate]" or "seasoned {salt}".'
        ),
    ]
    ingredients: Annotated[
        list[str], means("The contents of the state `contains`, sorted; empty if there is none.")
    ]
    container: Annotated[str | None, means("The object that this one is in; null if it has no state `in`.")]


class SourceJson(JsonObject):
    """A place in a FOON file."""

    file: Annotated[str, means("The path of the file; empty if the unit comes from none.")]
    line: Annotated[Count, means("The line of its first object, from 1; 0 if unknown.")]
    video: Annotated[str, means("What the file names as the source of the annotation; may be empty.")]


class UnitJson(JsonObject):
    """A functional unit."""

    id: Annotated[Count, means("Its place among the distinct units of the FOON, from 0; the U of the facts.")]
    motion: Annotated[Text, means("The motion.")]
    inputs: Annotated[list[ObjectJson], means("The objects listed before the motion, as annotated.")]
    outputs: Annotated[list[ObjectJson], means("The objects listed behind the motion, as annotated.")]
    source: Annotated[SourceJson, means("Where the unit was first read.")]

    @classmethod
    def of(cls: type[U], foon: Foon, unit: FunctionalUnit, **more: Any) -> U:
        """Make this, or a shape that says `more` of a unit."""
        source = unit.source
        return cls(
            id=unit.id,
            motion=unit.motion,
            inputs=[object_to_json(foon.objects[number]) for number in unit.inputs],
            outputs=[object_to_json(foon.objects[number]) for number in unit.outputs],
            source=SourceJson(source.file, source.line, source.video),
            **more,
        )


_CONTAINS = State("contains")


def object_to_json(node: ObjectNode) -> ObjectJson:
    """Write a node; states that fit neither `ingredients` nor `container` stay in `states`."""
    states: list[str] = []
    ingredients: list[str] = []
    container: str | None = None
    # Beside a plain `contains`, ingredients would be read as its contents.
    fits = _CONTAINS not in node.states
    for state in node.states:
        if container is None and state.name == "in" and state.relatum is not None and state.contents is None:
            container = state.relatum
        elif fits and not ingredients and state.in_braces and state.contents:
            ingredients = list(state.contents)
        else:
            states.append(str(state))
    return ObjectJson(node.label, states, ingredients, container)
