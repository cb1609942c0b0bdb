"""Planning by any engine: clingo with our own encoding, or those that unified_planning finds."""

from __future__ import annotations

import time
from collections.abc import Callable

from foon_asp import limits
from foon_asp.limits import Limit, LimitReachedError
from foon_asp.model.world import World
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.clingo import plan_by_clingo
from foon_asp.planning.engines import find_engine, plan_by_engine
from foon_asp.planning.problem import posed
from foon_asp.planning.query import OWN_ENGINE, PlanQuery
from foon_asp.query.query import Query
from foon_asp.query.status import Status


def plan(world: World, asked: PlanQuery, progress: Callable[[float], None] | None = None) -> PlanAnswer:
    """Plan for some goals; every plan is replayed under its semantics before it is returned.

    `progress` is told the seconds so far while another engine than clingo is at work. Raises `QueryError` if
    the question does not fit the data.
    """
    started = time.perf_counter()
    engine = None if asked.engine == OWN_ENGINE else find_engine(asked.engine)
    asked, problem = posed(world, asked)
    with limits.limited(asked.query.time_limit, asked.query.memory_limit):
        try:
            if engine is None:
                return plan_by_clingo(problem, asked)
            return plan_by_engine(problem, asked, engine, progress)
        except LimitReachedError as error:
            reason, seconds = _no_plan(asked.query, error.limit), time.perf_counter() - started
            return PlanAnswer(
                asked, problem.effects, Status.LIMIT, None, None, reason, seconds, limit=error.limit
            )


def _no_plan(query: Query, limit: Limit) -> str:
    """Say which limit there was no plan within."""
    if limit is Limit.TIME:
        return f"no plan within {query.time_limit:g} s"
    if limit is Limit.MEMORY:
        with limits.limited(megabytes=query.memory_limit):
            megabytes = limits.careful_memory() / limits.MEGABYTE
        return f"no plan within {megabytes:.0f} MB of memory"
    return "interrupted"
