"""Planning by any engine: clingo with our own encoding, or those that unified_planning finds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from foon_asp.criteria import Level
from foon_asp.effects import Effects
from foon_asp.engines import find_engine, run_engine
from foon_asp.errors import QueryError
from foon_asp.graph import ObjectNode
from foon_asp.plan import Plan
from foon_asp.plan_clingo import MAX_STEPS
from foon_asp.plan_clingo import plan as plan_by_clingo
from foon_asp.prices import Prices
from foon_asp.problem import Domain


@dataclass(frozen=True, slots=True)
class PlanAnswer:
    """What an engine found.

    `status`: `optimal` (proven by the engine: the cheapest plan, or for clingo the cheapest of those with the
    fewest parallel steps), `solved`, `unsolvable`, `limit` (the time or the steps ran out; `plan` is the best
    so far, if there is one), `gave up` or `failed`; `reason` says why. `cost` is what the plan costs by `by`,
    a chance if that is success alone. `seconds` is wall time.
    """

    goals: tuple[ObjectNode, ...]
    engine: str
    semantics: str
    by: str
    status: str
    plan: Plan | None
    cost: float | None
    reason: str
    seconds: float


def plan(
    domain: Domain,
    goals: Iterable[ObjectNode],
    engine: str = "clingo",
    semantics: str = "consume",
    by: str = "units",
    *,
    max_steps: int | None = None,
    time_limit: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> PlanAnswer:
    """Plan for some goals; every plan is replayed under its semantics before it is returned.

    `by` is one level of criteria; `time_limit` is in seconds. `max_steps` is for clingo alone. Raises
    `QueryError`.
    """
    wanted = tuple(goals)
    if engine == "clingo":
        steps = MAX_STEPS if max_steps is None else max_steps
        own = plan_by_clingo(domain, wanted, semantics, by, max_steps=steps, time_limit=time_limit)
        status = {"unreachable": "unsolvable"}.get(own.status, own.status)
        return PlanAnswer(
            wanted, engine, semantics, own.by, status, own.plan, own.cost, own.reason, own.seconds
        )
    if max_steps is not None:
        raise QueryError("--max-steps is for the engine clingo; the others do not count parallel steps")
    chosen = find_engine(engine)
    level = Level.parse(by)
    effects = Effects(domain, semantics)
    problem = domain.problem(wanted)
    found = run_engine(problem, effects, level, chosen, time_limit=time_limit, progress=progress)
    cost = None
    if found.plan is not None:
        prices = Prices.of(problem, level, found.plan.units)
        cost = level.bound(prices.total(found.plan.units) + level.base)
    status = {"timeout": "limit"}.get(found.status, found.status)
    reason = found.message
    if status == "unsolvable":
        reason = f"{engine} has proven that no plan exists"
    return PlanAnswer(wanted, engine, semantics, str(level), status, found.plan, cost, reason, found.seconds)
