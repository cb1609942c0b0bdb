"""Small FOONs: written in a few words for tables, or drawn at random for properties.

An object is written `label[state,state]{content,content}@container`. A label alone stands for an object
in the state "ready"; `(label)` is bare, it has no state at all. A unit is written `a + b -mix-> c`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import brute_force
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from foon_asp.builder import FoonBuilder
from foon_asp.graph import Annotation, Foon, FunctionalUnit, ObjectNode, State, contains, inside
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain

_OBJECT = re.compile(
    r"(?P<label>[\w ]+)(?:\[(?P<states>[^]]*)\])?(?:\{(?P<contents>[^}]*)\})?(?:@(?P<container>\w+))?"
)
_UNIT = re.compile(r"(?P<inputs>.*)-(?P<motion>\w+)->(?P<outputs>.*)")


def many(examples: int) -> settings:
    """Try a property on many examples, the same ones in each run."""
    return settings(
        deadline=None,
        max_examples=examples,
        derandomize=True,
        suppress_health_check=[HealthCheck.too_slow],
    )


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


def domain(
    units: Iterable[str],
    kitchen: str = "",
    *,
    utensils: Iterable[str] = (),
    rates: Mapping[str, float] | None = None,
    strict: bool = False,
) -> Domain:
    """Make a domain of written units and a written kitchen; motions without a rate never fail."""
    stock = Kitchen(tuple(nodes(kitchen)), frozenset(utensils), dict(rates or {}), 1.0)
    return Domain(foon(*units), stock, strict=strict)


def motions(where: Domain, units: Iterable[int]) -> set[str]:
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


@st.composite
def domains(draw: st.DrawFn, *, strict: bool | None = None, rates: tuple[float, ...] = RATES) -> Domain:
    """Draw a domain of 2-7 objects and 1-8 units, strict or not unless that is given."""
    seeds = draw(st.sampled_from([(), _VESSEL_VIEWS[:2], _VESSEL_VIEWS]))
    more = draw(st.lists(st.sampled_from(_OBJECTS), min_size=2, max_size=7, unique=True))
    pool = [node(text) for text in dict.fromkeys((*seeds, *more))][:7]
    builder = FoonBuilder()
    for thing in pool:
        builder.object(thing)
    ids = st.sampled_from(range(len(pool)))
    # Units without any input are rare: they would cut all trees short.
    inputs = st.sampled_from([0, 1, 1, 1, 1, 2, 2]).flatmap(
        lambda least: st.lists(ids, min_size=least, max_size=min(2 * least, len(pool)), unique=True)
    )
    outputs = st.lists(ids, min_size=1, max_size=draw(st.sampled_from([1, 2, 3])), unique=True)
    drawn = st.tuples(st.sampled_from(MOTIONS), inputs, outputs)
    least = draw(st.sampled_from([1, 5, 8]))
    for motion, before, behind in draw(st.lists(drawn, min_size=least, max_size=8)):
        builder.unit(motion, before, behind, Annotation())
    stock = draw(st.lists(st.sampled_from([*pool, node("stranger")]), max_size=2, unique=True))
    kitchen = Kitchen(
        tuple(stock),
        frozenset(draw(st.sampled_from([("bowl", "cup"), ("bowl",), ()]))),
        {motion: draw(st.sampled_from(rates)) for motion in MOTIONS},
    )
    return Domain(builder.build(), kitchen, strict=draw(st.booleans()) if strict is None else strict)


@st.composite
def queries(
    draw: st.DrawFn, *, strict: bool | None = None, rates: tuple[float, ...] = RATES
) -> tuple[Domain, ObjectNode]:
    """Draw a domain and a goal: often the thing that takes longest to make, else any object."""
    where = draw(domains(strict=strict, rates=rates))
    things = list(where.foon.objects)
    at_hand, _ = brute_force.closure(where, range(len(where.foon.units)))
    last = max(things, key=lambda thing: at_hand.get(thing, 0))
    return where, draw(st.sampled_from([last] * len(things) + things))
