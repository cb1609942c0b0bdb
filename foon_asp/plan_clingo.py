"""Planning by clingo: the fewest parallel steps first, then the cheapest, decoded and replayed."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from foon_asp.criteria import Level, parse_by
from foon_asp.decode import rows
from foon_asp.effects import Effects, PlanProblem
from foon_asp.errors import InternalError, QueryError
from foon_asp.facts import facts, price_facts
from foon_asp.graph import ObjectNode
from foon_asp.plan import Plan, hopeless
from foon_asp.prices import Prices
from foon_asp.problem import Domain
from foon_asp.reasons import unreachable_reason
from foon_asp.retrieve import check_levels
from foon_asp.solve import Answer, Solver

MAX_STEPS = 100
"""How many parallel steps are tried if nothing else is said."""

_OPTIONS = ("--opt-strategy=usc", "--opt-usc-shrink=bin")
"""Units compete in many steps at once: core-guided search, with cores made small, proves that best."""

_PATIENCE = 5
"""After so many steps tried in vain it is worth looking whether there can be a plan at all."""

_STATES = 10_000
"""How many states that may take; it is about a second."""


@dataclass(frozen=True, slots=True)
class PlanResult:
    """The answer to a planning question.

    `status` is `optimal` (proven), `unreachable` (no plan exists; `reason` says why) or `limit` (the time
    or the steps ran out; `plan` is the best so far, if there is one). `steps` is proven: no plan takes
    fewer parallel steps, and a plan that there is takes no more. `cost` is what the plan costs on the level
    `by`, a chance if that is success alone. `bound` is proven, too: no plan of so many steps is cheaper, or
    likelier to succeed. `seconds` is wall time.
    """

    goals: tuple[ObjectNode, ...]
    semantics: str
    by: str
    status: str
    plan: Plan | None
    steps: int
    cost: float | None
    bound: float | None
    reason: str
    seconds: float


def plan(
    domain: Domain,
    goals: ObjectNode | Iterable[ObjectNode],
    semantics: str = "consume",
    by: str | Sequence[str] = "units",
    *,
    max_steps: int = MAX_STEPS,
    time_limit: float | None = None,
) -> PlanResult:
    """Plan with things being used up; every plan is replayed from the kitchen before it is returned.

    `by` is one level of criteria that have a price per unit, as `units` or `2*units+tools`. `time_limit` is
    in seconds. Raises `QueryError`.
    """
    started = time.perf_counter()
    deadline = math.inf if time_limit is None else time.monotonic() + time_limit
    wanted = (goals,) if isinstance(goals, ObjectNode) else tuple(goals)
    effects = Effects(domain, semantics)
    problem = PlanProblem(effects, tuple(domain.id_of(goal) for goal in wanted))
    levels = parse_by(by) or parse_by("units")
    if len(levels) > 1:
        raise QueryError("a plan is minimised on one level, after its steps; weigh the criteria, as in a+b")
    check_levels(problem, by)
    question = _Question(effects, problem, levels[0], Prices.of(problem, levels[0]))
    found = _Found("unreachable", None, 0, None, unreachable_reason(problem))
    if not found.reason:
        found = question.answer(max_steps, deadline)
    return PlanResult(
        goals=wanted,
        semantics=semantics,
        by=str(levels[0]),
        status=found.status,
        plan=found.plan,
        steps=found.steps,
        cost=None if found.plan is None else question.cost(question.paid(found.plan.units)),
        bound=None if found.bound is None else question.cost(found.bound),
        reason=found.reason,
        seconds=time.perf_counter() - started,
    )


@dataclass(frozen=True, slots=True)
class _Found:
    """Status, plan, steps and reason as in `PlanResult`, and the bound as clingo counts."""

    status: str
    plan: Plan | None
    steps: int
    bound: int | None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class _Question:
    effects: Effects
    problem: PlanProblem
    level: Level
    prices: Prices

    def answer(self, max_steps: int, deadline: float) -> _Found:
        """Try one number of steps after the other, then look for the cheapest plan of so many.

        The first number is the round in which the forward closure reaches the last goal. By induction, what
        is there after t steps, under any semantics, is there after t rounds of the closure: each unit of a
        step had its needs before the step, so the closure has them a round before, and it uses nothing up.
        """
        rounds = self.effects.domain.closure.available
        least = max((rounds[goal] for goal in self.problem.goals), default=0)
        control = self.solver()
        for step in range(1, least):
            control.ground("step", step)
        for steps in range(least, max_steps + 1):
            if time.monotonic() >= deadline:
                return self.gave_up(steps)
            if steps > 0:
                control.ground("step", steps)
            control.ground("check", steps)
            control.switch("last", steps, True)
            # Nothing has a price as yet: any plan will do, and this is quick.
            first = control.best(_deadline(deadline))
            if first.atoms is not None:
                return self.cheapest(control, first, steps, deadline)
            if not first.proven:
                return self.gave_up(steps)
            control.switch("last", steps, False)
            if steps == least + _PATIENCE and self.hopeless(deadline):
                return self.used_up(steps)
        if self.hopeless(deadline):
            return self.used_up(max_steps)
        return self.gave_up(max(least, max_steps + 1))

    def solver(self) -> Solver:
        """Return a solver with the plan's first part."""
        prices = self.prices
        constants: dict[str, str | int] = {
            "semantics": self.effects.semantics,
            "strict": int(self.effects.domain.strict),
            "tie": int(self.tie),
        }
        text = facts(self.problem) + price_facts(prices.per_unit, prices.fees, prices.once)
        return Solver(["plan.lp"], text, constants, _OPTIONS)

    def cheapest(self, control: Solver, first: Answer, steps: int, deadline: float) -> _Found:
        """Return the cheapest plan of so many steps, or the best until the deadline."""
        control.ground("cheapest", steps)
        answer = control.best(_deadline(deadline))
        if answer.proven:
            if answer.atoms is None:
                raise InternalError("there is a plan, but no cheapest one")
            best = self.decode(answer)
            return _Found("optimal", best, steps, self.paid(best.units))
        plans = [self.pruned(self.decode(each)) for each in (answer, first) if each.atoms is not None]
        best = min(plans, key=lambda each: (self.paid(each.units), len(each.units)))
        # clingo has no place for prices if nothing costs anything, and then the bound is another one's.
        bound = answer.bounds[0] if len(answer.bounds) == 1 + self.tie else 0
        return _Found("limit", best, steps, bound, "the time ran out before the cheapest plan was proven")

    def decode(self, answer: Answer) -> Plan:
        """Return the plan of a model, replayed; raise `InternalError` if it cannot be executed."""
        done = sorted((step, unit) for unit, step in rows(answer, "do"))
        units, steps = [int(str(unit)) for _, unit in done], [int(str(step)) for step, _ in done]
        return self.replayed(units, steps)

    def replayed(self, units: Sequence[int], steps: Sequence[int]) -> Plan:
        found = Plan.of(self.effects, self.problem.goals, units, steps)
        if not found.executable:
            missing = ", ".join(map(str, found.replay.missing))
            raise InternalError(f"a plan fails its replay: {missing} is missing")
        return found

    def pruned(self, found: Plan) -> Plan:
        """Return a plan without the units that it can do without, tried from the last one on."""
        units, steps = list(found.units), list(found.steps)
        for place in reversed(range(len(units))):
            fewer = units[:place] + units[place + 1 :], steps[:place] + steps[place + 1 :]
            if Plan.of(self.effects, self.problem.goals, *fewer).executable:
                units, steps = fewer
        return self.replayed(units, steps)

    def hopeless(self, deadline: float) -> bool:
        return hopeless(self.effects, self.problem.goals, self.problem.units, _STATES, deadline)

    def gave_up(self, steps: int) -> _Found:
        """Say that nothing is known but that fewer steps are not enough."""
        return _Found(
            "limit", None, steps, None, f"no plan has fewer than {steps} steps; more were not tried"
        )

    def used_up(self, steps: int) -> _Found:
        return _Found(
            "unreachable",
            None,
            steps + 1,
            None,
            f"too much is used up ({self.effects.semantics!r}): no order of the units reaches the goal",
        )

    def paid(self, units: Iterable[int]) -> int:
        """Return what units cost, in clingo's integers."""
        return self.prices.total(units)

    def cost(self, paid: int) -> float:
        """Return what a sum of clingo's integers means on the level."""
        return self.level.bound(paid + self.level.base)

    @property
    def tie(self) -> bool:
        """Whether the cheapest plan may have superfluous units, because some cost nothing."""
        return self.level.names != ("units",)


def _deadline(deadline: float) -> float | None:
    return None if deadline == math.inf else deadline
