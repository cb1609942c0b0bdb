"""Small FOONs in which things are used up."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from random import Random
from typing import Any

from hypothesis import strategies as st

from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.planner import plan as plan_asked
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query
from support.small_foons import MOTIONS, RATES, node, world


def recipe(seed: int) -> World:
    """Make a FOON in which things are shared and made again: most units need what others make."""
    random = Random(seed)
    things = [node(f"{random.choice('abc')}[s{number}]") for number in range(7)]
    builder = FoonBuilder()
    for thing in things:
        builder.object(thing)
    for place in range(2, 7):
        for _ in range(random.choice([1, 1, 2])):
            inputs = random.sample([ObjectId(number) for number in range(place)], random.choice([1, 2, 2]))
            outputs = [ObjectId(place), *([random.choice(inputs)] if random.random() < 0.25 else [])]
            builder.unit(random.choice(MOTIONS), inputs, outputs, Annotation())
    rates = {motion: random.choice(RATES) for motion in MOTIONS}
    return World.of(builder.build(), Kitchen(tuple(things[:2]), frozenset(), rates))


recipes = st.integers(0, 10**6).map(recipe)


BREAD = (
    "flour + bowl[empty] -mix-> flour@bowl + bowl{flour}",
    "flour@bowl + bowl{flour} -knead-> dough + bowl[dirty]",
    "milk + bowl[empty] -stir-> cream@bowl + bowl{cream}",
    "dough + (oven) -bake-> bread[baked]",
    "bread[baked] + cream@bowl -spread-> toast + bowl[dirty]",
)


def bread() -> World:
    return world(BREAD, "flour + milk + bowl[empty] + (oven)", utensils=["bowl"])


KITCHEN_UNITS = (
    "onion[whole] + (knife) -chop-> onion[chopped] + (knife)",
    "onion[chopped] + bowl[empty] + lid -pour-> bowl{onion} + onion[chopped]@bowl",
    "bowl{onion} + onion[chopped]@bowl + salt -salt-> bowl{onion,salt}",
)


def with_quantities(units: Iterable[str], kitchen: str, **counts: int) -> World:
    where = world(units, kitchen)
    quantities = {node(text): count for text, count in counts.items()}
    return World.of(where.foon, replace(where.kitchen, quantities=quantities))


def plan(
    where: World,
    goals: ObjectNode | Iterable[ObjectNode],
    semantics: str = "consume",
    by: str = "units",
    **limits: Any,
) -> PlanAnswer:
    """Plan by clingo; limits are `max_steps` and `time_limit`."""
    wanted = (goals,) if isinstance(goals, ObjectNode) else tuple(goals)
    max_steps = limits.pop("max_steps", None)
    query = Query(*wanted, by=by, **limits)
    return plan_asked(where, PlanQuery(query, semantics=semantics, max_steps=max_steps))
