"""Small FOONs in which things are used up."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.planner import plan as plan_asked
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query
from support.small_foons import node, world

# --- Effects and replay -----------------------------------------------------------------------------

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
