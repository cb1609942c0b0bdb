"""Small FOONs: written in a few words for tables, or drawn at random for properties.

An object is written `label[state,state]{content,content}@container`. A label alone stands for an object
in the state "ready"; `(label)` is bare, it has no state at all. A unit is written `a + b -mix-> c`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from math import prod
from typing import TypeVar

from hypothesis import strategies as st

from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import (
    Annotation,
    FunctionalUnit,
    ObjectNode,
    State,
    UnitId,
    contains,
    inside,
)
from foon_asp.model.world import World
from support import brute_force

T = TypeVar("T")

_OBJECT = re.compile(
    r"(?P<label>[\w ]+)(?:\[(?P<states>[^]]*)\])?(?:\{(?P<contents>[^}]*)\})?(?:@(?P<container>\w+))?"
)
_UNIT = re.compile(r"(?P<inputs>.*)-(?P<motion>\w+)->(?P<outputs>.*)")


def node(text: str) -> ObjectNode:
    """Read one object."""
    text = text.strip()
    if text.startswith("("):
        return ObjectNode.of(text.strip("()"))
    match = _OBJECT.fullmatch(text)
    assert match, text
    states = [State(name) for name in (match["states"] or "").split(",") if name]
    if match["contents"] is not None:
        states.append(contains(*(content for content in match["contents"].split(",") if content)))
    if match["container"]:
        states.append(inside(match["container"]))
    return ObjectNode.of(match["label"].strip(), states or [State("ready")])


def with_units(foon: Foon, units: Iterable[FunctionalUnit]) -> Foon:
    """Return a FOON of the same objects, with other units."""
    builder = FoonBuilder()
    for thing in foon.objects:
        builder.object(thing)
    for unit in units:
        builder.unit(unit.motion, unit.inputs, unit.outputs, unit.annotation)
    return builder.build()


def written(thing: ObjectNode) -> str:
    """Write an object as `node` reads it."""
    if thing.bare:
        return f"({thing.label})"
    if thing.states == (State("ready"),):
        return thing.label
    text = thing.label
    if thing.plain_states:
        text += "[" + ",".join(thing.plain_states) + "]"
    if any(state.contents is not None for state in thing.states):
        text += "{" + ",".join(thing.contents) + "}"
    return text + "".join(f"@{container}" for container in thing.containers)


def nodes(text: str) -> list[ObjectNode]:
    """Read objects with `+` between them; nothing at all is no object."""
    return [node(part) for part in text.split("+") if part.strip()]


def foon(*units: str) -> Foon:
    builder = FoonBuilder()
    for text in units:
        match = _UNIT.fullmatch(text)
        assert match, text
        builder.unit(
            match["motion"],
            [builder.object(thing) for thing in nodes(match["inputs"])],
            [builder.object(thing) for thing in nodes(match["outputs"])],
            Annotation(),
        )
    return builder.build()


def world(
    units: Iterable[str],
    kitchen: str = "",
    *,
    utensils: Iterable[str] = (),
    rates: Mapping[str, float] | None = None,
    strict: bool = False,
) -> World:
    """Make a domain of written units and a written kitchen; motions without a rate never fail."""
    stock = Kitchen(tuple(nodes(kitchen)), frozenset(utensils), dict(rates or {}), 1.0)
    return World.of(foon(*units), stock, strict=strict)


def motions(where: World, units: Iterable[UnitId]) -> set[str]:
    """Name units by their motions."""
    return {where.foon.units[unit].motion for unit in units}


MOTIONS = ("cut", "fry", "mix", "pour", "wash")
RATES = (1.0, 0.97, 0.83, 0.71, 0.5)
"""No product of eight of them comes near another product, so rounding cannot turn an order round."""

_VESSEL_VIEWS = ("bowl{onion}", "onion@bowl", "cup{water}", "water@cup")
_OBJECTS = (
    "onion[whole]",
    "onion[chopped]",
    "soup",
    "salt",
    "water[hot]",
    "(knife)",
    "(bowl)",
    "bowl[empty]",
    *_VESSEL_VIEWS,
    "onion[chopped]@bowl",
    "onion@cup",
    "salt@bowl",
    "bowl{onion,salt}",
    "bowl[dirty]{onion}",
    "cup{onion}",
    "cup{}",
    "jar{onion}",
)


@cache
def _one_of_each(*choices: Sequence[T]) -> st.SearchStrategy[list[T]]:
    """Draw one of each by a single number: to draw many small ones takes Hypothesis many times as long."""
    count = prod(map(len, choices))
    # Of more than that, Hypothesis prefers small numbers.
    assert count <= 2**24, count

    def chosen(number: int) -> list[T]:
        found = []
        for options in choices:
            number, place = divmod(number, len(options))
            found.append(options[place])
        return found

    return st.integers(0, count - 1).map(chosen)


def _places(count: int, size: int) -> list[range]:
    """Return what to draw for so many different things of a number of them: see `_taken`."""
    return [range(left) for left in range(count, max(count - size, 0), -1)]


def _taken(things: Iterable[T], places: Iterable[int]) -> list[T]:
    """Take things one by one, each by its place among those that are left."""
    left = list(things)
    return [left.pop(place) for place in places]


@st.composite
def domains(draw: st.DrawFn, *, strict: bool | None = None, rates: tuple[float, ...] = RATES) -> World:
    """Draw a domain of 2-7 objects and 1-8 units, strict or not unless that is given."""
    more, vessels, most, *first = draw(
        _one_of_each(range(2, 8), (0, 2, 4), (1, 2, 3), *_places(len(_OBJECTS), 4))
    )
    least, *others = draw(_one_of_each((1, 5, 8), *_places(len(_OBJECTS) - 4, 3)))
    drawn = _taken(_OBJECTS, [*first, *others])[:more]
    pool = [node(text) for text in dict.fromkeys((*_VESSEL_VIEWS[:vessels], *drawn))][:7]
    builder = FoonBuilder()
    ids = [builder.object(thing) for thing in pool]
    # Units without any input are rare: they would cut all trees short.
    inputs = _one_of_each(range(len(MOTIONS)), (1, 1, 1, 1, 2, 2, 2, 3, 4, 0, 0), *_places(len(ids), 4))
    outputs = _one_of_each(range(1, most + 1), *_places(len(ids), 3))
    for (motion, needed, *before), (made, *behind) in draw(
        st.lists(st.tuples(inputs, outputs), min_size=least, max_size=8)
    ):
        builder.unit(MOTIONS[motion], _taken(ids, before)[:needed], _taken(ids, behind)[:made], Annotation())
    utensils, stocked, strictly, *stock = draw(
        _one_of_each((2, 1, 0), range(3), (False, True), *_places(len(pool) + 1, 2))
    )
    kitchen = Kitchen(
        tuple(_taken([*pool, node("stranger")], stock)[:stocked]),
        frozenset(("bowl", "cup")[:utensils]),
        dict(zip(MOTIONS, draw(_one_of_each(*[rates] * len(MOTIONS))), strict=True)),
    )
    return World.of(builder.build(), kitchen, strict=bool(strictly) if strict is None else strict)


@st.composite
def queries(
    draw: st.DrawFn, *, strict: bool | None = None, rates: tuple[float, ...] = RATES
) -> tuple[World, ObjectNode]:
    """Draw a domain and a goal: often the thing that takes longest to make, else any object."""
    where = draw(domains(strict=strict, rates=rates))
    things = list(where.foon.objects)
    at_hand, _ = brute_force.closure(where, brute_force.every_unit(where))
    last = max(things, key=lambda thing: at_hand.get(thing, 0))
    return where, draw(st.sampled_from([last] * len(things) + things))
