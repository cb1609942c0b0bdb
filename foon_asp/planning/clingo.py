"""Planning by clingo: the fewest parallel steps first, then the cheapest, decoded and replayed."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from foon_asp import limits
from foon_asp.asp.facts import facts, price_facts
from foon_asp.asp.model import Model
from foon_asp.asp.solver import Solver, open_solver
from foon_asp.errors import InternalError
from foon_asp.limits import Limit, LimitReachedError
from foon_asp.model.consumption import Effects
from foon_asp.model.node import UnitId
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.plan import Plan, unreachable_by_search
from foon_asp.planning.prices import RUIN, Prices, plan_cost
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.query import MAX_STEPS, PlanQuery
from foon_asp.query.objective import Criterion
from foon_asp.query.status import Status
from foon_asp.query.tariff import EXACT
from foon_asp.query.unreachable import unreachable_reason

_OPTIONS = ("--opt-strategy=usc", "--opt-usc-shrink=bin")
"""Units compete in many steps at once: core-guided search, with cores made small, proves that best."""

_PATIENCE = 5
"""After so many steps tried in vain it is worth looking whether there can be a plan at all."""

_STATES = 10_000
"""How many states that may take; it is about a second."""


def plan_by_clingo(problem: PlanProblem, asked: PlanQuery) -> PlanAnswer:
    """Plan for a question that was checked against the world of the problem."""
    started = time.perf_counter()
    criterion = asked.criterion
    # Whether its weights can be paid at all is told before anything is looked for.
    Prices.of(problem, criterion)
    question = _Question(problem, criterion)
    found = question.answer(MAX_STEPS if asked.max_steps is None else asked.max_steps)
    return PlanAnswer(
        asked,
        problem.effects,
        found.status,
        found.plan,
        None if found.plan is None else question.cost(found.plan.units),
        found.reason,
        time.perf_counter() - started,
        found.steps,
        found.bound,
        found.limit,
    )


@dataclass(frozen=True, slots=True)
class _Found:
    """Status, plan, steps, bound, reason and limit as in `PlanAnswer`."""

    status: Status
    plan: Plan | None
    steps: int
    bound: float | None = None
    reason: str = ""
    limit: Limit | None = None


@dataclass(frozen=True, slots=True)
class _Question:
    problem: PlanProblem
    criterion: Criterion

    @property
    def effects(self) -> Effects:
        return self.problem.effects

    def answer(self, max_steps: int) -> _Found:
        """Look for a plan within the limits."""
        steps = 0
        try:
            reason = unreachable_reason(self.problem)
            if reason:
                return _Found(Status.UNSOLVABLE, None, 0, None, reason)
            control = self.solver()
            for steps, first in self.tried(control, max_steps):
                if first.atoms is not None:
                    return self.cheapest(control, first, steps)
                if not first.proven:
                    return self.gave_up(steps, first.limit)
                if steps == self.least + _PATIENCE and self.unreachable_by_search():
                    return self.used_up(steps)
            if self.unreachable_by_search():
                return self.used_up(max_steps)
        except LimitReachedError as error:
            return self.gave_up(steps, error.limit)
        return self.gave_up(max(self.least, max_steps + 1))

    @property
    def least(self) -> int:
        """The round in which the forward closure reaches the last goal: no plan has fewer steps.

        By induction, what is there after t steps, under any semantics, is there after t rounds of the
        closure: each unit of a step had its needs before the step, so the closure has them a round before,
        and it uses nothing up.
        """
        rounds = self.effects.world.closure.available
        return max((rounds[goal] for goal in self.problem.goals), default=0)

    def tried(self, control: Solver, max_steps: int) -> Iterator[tuple[int, Model]]:
        """Yield numbers of steps, the fewest first, each with some plan of so many: none has a price yet."""
        for step in range(1, self.least):
            control.ground("step", step)
        for steps in range(self.least, max_steps + 1):
            if steps > 0:
                control.ground("step", steps)
            control.ground("check", steps)
            control.switch("last", steps, True)
            yield steps, control.best()
            control.switch("last", steps, False)

    def solver(self) -> Solver:
        """Return a solver with the plan's first part."""
        constants: dict[str, str | int] = {
            "semantics": self.effects.semantics,
            "strict": int(self.effects.world.strict),
            "tie": int(self.tie),
        }
        return open_solver(["planning/plan_pruning.lp"], facts(self.problem), constants, _OPTIONS)

    def cheapest(self, control: Solver, first: Model, steps: int) -> _Found:
        """Return the cheapest plan of so many steps, or the best until a limit."""
        # Only now is it known how often a unit can be done, and so how finely it can be paid for.
        prices = Prices.of(self.problem, self.criterion, times=max(1, steps))
        try:
            control.extend("prices", price_facts(prices.per_unit, prices.fees, prices.once, RUIN))
            control.ground("cheapest", steps)
            answer = control.best()
        except LimitReachedError as error:
            answer = Model(None, False, limit=error.limit)
        if answer.proven:
            if answer.atoms is None:
                raise InternalError("there is a plan, but no cheapest one")
            best = self.decode(answer)
            return _Found(Status.OPTIMAL, best, steps, self.proven(prices, best))
        plans = [self.pruned(self.decode(each)) for each in (answer, first) if each.atoms is not None]
        best = min(plans, key=lambda each: (prices.total(each.units), len(each.units)))
        # clingo has no place for prices if nothing costs anything, and then the bound is another one's.
        tariff = prices.tariff
        lower = answer.bounds[0] if len(answer.bounds) == 1 + self.tie else 0
        bound = tariff.bound(lower + tariff.base)
        reason = f"{limits.ended(answer.limit)} before the cheapest plan was proven"
        return _Found(Status.LIMIT, best, steps, bound, reason, answer.limit)

    def decode(self, answer: Model) -> Plan:
        """Return the plan of a model, replayed; raise `InternalError` if it cannot be executed."""
        done = sorted((step, unit) for unit, step in answer.rows("do"))
        units, steps = [UnitId(int(str(unit))) for _, unit in done], [int(str(step)) for step, _ in done]
        return self.replayed(units, steps)

    def replayed(self, units: Sequence[UnitId], steps: Sequence[int]) -> Plan:
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

    def unreachable_by_search(self) -> bool:
        return unreachable_by_search(self.problem, _STATES)

    def gave_up(self, steps: int, limit: Limit | None = None) -> _Found:
        """Say that nothing is known but that fewer steps are not enough."""
        reason = f"no plan has fewer than {steps} steps; more were not tried"
        return _Found(Status.LIMIT, None, steps, None, reason, limit)

    def used_up(self, steps: int) -> _Found:
        return _Found(
            Status.UNSOLVABLE,
            None,
            steps + 1,
            None,
            f"too much is used up ({self.effects.semantics!r}): no order of the units reaches the goal",
        )

    def proven(self, prices: Prices, best: Plan) -> float | None:
        """Return what is proven of the cheapest plan: its own cost, or less if that is not exact enough."""
        cost = self.cost(best.units)
        if cost is None:
            return None
        tariff = prices.tariff
        bound = tariff.bound(prices.total(best.units) + tariff.base)
        return cost if math.isclose(cost, bound, rel_tol=EXACT) else bound

    def cost(self, units: Iterable[UnitId]) -> float | None:
        """Return what units cost by the criterion; None if that is infinite, for the chance is 0."""
        cost = plan_cost(self.effects.world, self.criterion, units)
        return None if cost == math.inf else cost

    @property
    def tie(self) -> bool:
        """Whether the cheapest plan may have superfluous units, because some cost nothing."""
        return self.criterion.names != ("units",)
