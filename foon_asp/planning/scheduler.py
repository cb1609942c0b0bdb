"""Scheduling: the least makespan from both sides, a schedule above and what must be done below."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

from foon_asp import limits
from foon_asp.asp.model import Model
from foon_asp.errors import InternalError
from foon_asp.limits import Limit, LimitReachedError
from foon_asp.model.consumption import Effects
from foon_asp.model.node import FunctionalUnit, UnitId
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.clingo import plan_by_clingo
from foon_asp.planning.durations import durations
from foon_asp.planning.first_plan import first_plans
from foon_asp.planning.list_schedule import list_schedule
from foon_asp.planning.plan import Plan
from foon_asp.planning.prices import Prices, plan_cost
from foon_asp.planning.problem import posed
from foon_asp.planning.query import PlanQuery
from foon_asp.planning.schedule import Schedule, faults
from foon_asp.planning.schedule_answer import ScheduleAnswer
from foon_asp.planning.schedule_clingo import AGAIN, Task, counts_of
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.query.status import Status
from foon_asp.query.unreachable import unreachable_reason

_MANY = 250
"""Of how many possible steps clingo is asked for a schedule; of more only for one with few of each unit."""

_FEW = 5
"""With fewer hands than that a list schedule is made, too."""

_REST = 0.6
"""Seconds that are left for what comes after the last question."""

_PART = 0.4
"""Which part of the time that is left one question may take, where there are others to try."""


def schedule(world: World, asked: ScheduleQuery, known: Schedule | None = None) -> ScheduleAnswer:
    """Schedule some goals; every schedule is judged in plain Python before it is returned.

    `known` is a schedule for the same goals and semantics, with fewer resources: what is answered is no
    longer than that. Raises `QueryError` if the question does not fit the data.
    """
    started = time.perf_counter()
    asked, problem = posed(world, asked)
    with limits.limited(asked.query.time_limit, asked.query.memory_limit):
        task = Task.of(problem, asked.resources, durations(problem.world, problem.units, asked.durations))
        if asked.criterion is not None:
            # Whether its weights can be paid at all is told before anything is looked for.
            Prices.of(problem, asked.criterion)
        search = _Search(task, asked)
        search.run(known)
    best = search.best
    return ScheduleAnswer(
        asked,
        problem.effects,
        task.durations,
        search.status,
        best,
        search.lower,
        None if best is None else search.cost(best),
        search.reason,
        time.perf_counter() - started,
        search.limit,
        tuple((each, search.cost(each)) for each in search.front),
    )


@dataclass
class _Search:
    """`lower`: no schedule is shorter. `best`: a schedule that was judged, the shortest so far."""

    task: Task
    asked: ScheduleQuery
    lower: int = 0
    best: Schedule | None = None
    status: Status = Status.LIMIT
    reason: str = ""
    limit: Limit | None = None
    front: list[Schedule] = field(default_factory=list)
    usual: Counter[UnitId] = field(default_factory=Counter)
    """How often units are done in some plan, the first or that of the best schedule."""

    def run(self, known: Schedule | None) -> None:
        """Look for the shortest schedule, and then for the cheapest of these, until a limit."""
        try:
            if self.unsolvable(self.begin(known)):
                return
            self.bound_by_work()
            cheapest = self.shorten()
            if cheapest and self.asked.criterion is not None:
                cheapest = self.cheapen()
            if cheapest:
                self.status, self.limit = Status.OPTIMAL, None
        except LimitReachedError as error:
            self.limit = error.limit
        if self.status is Status.LIMIT and not self.reason:
            what = "there was a schedule" if self.best is None else "the best was proven"
            ended = "too much can be done too often" if self.limit is None else limits.ended(self.limit)
            self.reason = f"{ended} before {what}"

    def begin(self, known: Schedule | None) -> str:
        """Find schedules at once, or return why there can be none."""
        task = self.task
        problem = task.problem
        if reason := unreachable_reason(problem):
            return reason
        if not task.reachable:
            return "nobody can do what leads to the goal"
        self.lower = task.critical.least
        if known is not None:
            self.offer(replace(known, world=problem.effects.world))
        seconds = {unit: task.durations.seconds[unit] for unit in problem.units}
        plans = first_plans(problem, seconds)
        for plan in plans:
            self.listed(plan)
        if plans or self.best is not None:
            return ""
        found = plan_by_clingo(
            problem, PlanQuery(self.asked.query.replace(by=()), semantics=self.asked.semantics)
        )
        if found.plan is None:
            self.limit = found.limit
            self.reason = found.reason
            return found.reason if found.status is Status.UNSOLVABLE else ""
        self.listed(found.plan)
        return ""

    def unsolvable(self, reason: str) -> bool:
        """Take down that there is no schedule, if there is a reason for it."""
        if reason:
            self.status, self.reason = Status.UNSOLVABLE, reason
        return bool(reason)

    @property
    def effects(self) -> Effects:
        return self.task.problem.effects

    @property
    def upper(self) -> int:
        """A makespan that there is a schedule of, or one that is enough for each that there may be."""
        if self.best is not None:
            return self.best.makespan
        return self.task.longest({unit: self.usual[unit] + 1 for unit in self.task.units})

    def listed(self, plan: Plan) -> None:
        """Offer what list scheduling makes of a plan, with all hands or fewer: more can make it longer."""
        task, resources = self.task, self.task.resources
        self.usual = self.usual or Counter(plan.units)
        self.offer(list_schedule(plan, self.effects, task.durations, resources))
        if len(resources.workers) == 1:
            least = max((resources.needed(unit) for unit in self.foon_units(plan)), default=1)
            for fewer in range(max(1, least), min(resources.workers[0].hands, _FEW)):
                some = resources.with_hands(fewer)
                self.offer(list_schedule(plan, self.effects, task.durations, some))

    def foon_units(self, plan: Plan) -> list[FunctionalUnit]:
        """Return the functional units of a plan."""
        return [plan.world.foon.units[unit] for unit in plan.units]

    def offer(self, found: Schedule) -> bool:
        """Keep a schedule if it is shorter than the best so far, and nothing is wrong with it."""
        if self.best is not None and found.makespan >= self.best.makespan:
            return False
        if faults(found, self.effects, self.task.durations, self.task.resources):
            return False
        self.best, self.usual = found, Counter(found.units)
        return True

    def decoded(self, model: Model) -> Schedule:
        """Return the schedule of a model; raise `InternalError` if something is wrong with it."""
        found = self.task.schedule(model)
        wrong = faults(found, self.effects, self.task.durations, self.task.resources)
        if wrong:
            raise InternalError(f"a schedule cannot be carried out: {wrong[0]}")
        return found

    def tried(self, ask: Callable[[], Model], part: float = 1.0) -> Model:
        """Ask something, for a part of the time that is left; raise `LimitReachedError` if none is."""
        seconds = limits.seconds_left()
        # What is found last is still to be judged and written.
        most = min(seconds * part, max(seconds * _PART, seconds - _REST))
        try:
            with limits.limited(None if seconds == math.inf else most):
                model = ask()
        except LimitReachedError as error:
            model = Model(None, False, limit=error.limit)
        limit = limits.reached()
        if limit is not None and not model.proven:
            raise LimitReachedError(limit)
        self.limit = model.limit or self.limit
        return model

    def bound_by_work(self) -> None:
        """Raise the lower bound to the least makespan in which all that must be done can be."""
        task, upper = self.task, self.upper
        target = self.lower
        while self.lower < upper:
            model = self.tried(partial(task.less, target), _PART)
            if model.atoms is not None:
                upper = target
                self.work_listed(model)
                upper = min(upper, self.upper)
            elif model.proven:
                self.lower = target + 1
            else:
                return
            target = (self.lower + upper) // 2

    def work_listed(self, model: Model) -> None:
        """Offer a schedule of what a model does, if that can be put into an order."""
        left = Counter(counts_of(model))
        supply, order = Supply(self.effects), []
        while ready := next((unit for unit in left if left[unit] and not supply.lacks(unit)), None):
            supply.execute(ready)
            order.append(ready)
            left[ready] -= 1
        plan = Plan.of(self.effects, self.task.problem.goals, order)
        if plan.executable:
            self.listed(plan)

    def counts(self, bound: int) -> tuple[dict[UnitId, int], bool]:
        """Return how often each unit is done at most in schedules within a bound, and whether that is proven.

        Where that would be too much to look through, it is once more than in the best schedule so far, or
        just as often; or nothing is, if that is too much.
        """
        task = self.task
        most, proven = task.often(bound), task.exact
        if max(most.values(), default=0) > 1:
            model = self.tried(partial(task.possible, bound), _PART)
            if model.proven:
                most = counts_of(model)
            proven = proven and model.proven and max(most.values(), default=0) < AGAIN
        if sum(most.values()) <= _MANY:
            return most, proven
        for more in (1, 0):
            few = {unit: min(most.get(unit, 0), max(1, self.usual[unit] + more)) for unit in task.units}
            if sum(few.values()) <= _MANY:
                return few, False
        return {}, False

    def some(self) -> bool:
        """Find any schedule, where a first one takes too many utensils; say whether there is one."""
        often = {unit: self.usual[unit] + 1 for unit in self.task.units}
        if self.effects.semantics == "add":
            often = self.task.often(0)
        bound = self.task.longest(often)
        model = self.tried(partial(self.task.within, bound, often))
        if model.atoms is not None:
            return self.offer(self.decoded(model))
        if model.proven:
            self.reason = (
                "the utensils are too few, where each step is done no more often than without a limit"
            )
            if self.effects.semantics == "add" and self.task.exact:
                self.status, self.reason = Status.UNSOLVABLE, "the utensils are too few"
        return False

    def shorten(self) -> bool:
        """Look for shorter schedules, from the lower bound on; say whether the shortest is proven."""
        if self.best is None and not self.some():
            return False
        if self.lower >= self.upper:
            return True
        most, proven = self.counts(self.upper - 1)
        if not most:
            # Nothing can be done in less time, or too much can.
            self.lower = self.upper if proven else self.lower
            return proven
        low = target = self.lower
        missed: set[int] = set()
        while low < self.upper:
            # What is left to be tried last has all the time that is left.
            part = 1.0 if low >= self.upper - 1 else _PART
            model = self.tried(partial(self.task.within, target, most), part)
            if model.atoms is not None:
                self.offer(self.decoded(model))
            elif model.proven:
                low = target + 1
                self.lower = max(self.lower, low) if proven else self.lower
            else:
                missed.add(target)
            target = (low + self.upper - 1) // 2
            if target in missed:
                target = self.upper - 1
            if target in missed:
                return False
        return self.lower >= self.upper

    def cheapen(self) -> bool:
        """Look for the cheapest of the shortest schedules; say whether it is proven. Then for the front."""
        most, proven = self.counts(self.upper)
        if not most:
            return False
        prices = self.prices(most)
        model = self.tried(partial(self.task.within, self.upper, most, prices))
        if model.atoms is None:
            return False
        self.best = self.decoded(model)
        proven = proven and model.proven
        return proven and (not self.asked.front or self.trade())

    def prices(self, most: Mapping[UnitId, int]) -> Prices:
        assert self.asked.criterion is not None
        return Prices.of(self.task.problem, self.asked.criterion, times=max(most.values()))

    def trade(self) -> bool:
        """Add longer schedules that are cheaper, the shortest first; say whether all are there."""
        assert self.best is not None
        last = self.best
        most, proven = self.counts(
            self.task.longest({unit: self.usual[unit] + 1 for unit in self.task.units})
        )
        longest, prices = self.task.longest(most), self.prices(most)
        while True:
            budget = prices.total(last.units) - 1
            low, high, found = last.makespan + 1, longest, None
            target = high
            while budget >= 0 and low <= high:
                model = self.tried(partial(self.task.within, target, most, prices, budget))
                if model.atoms is not None:
                    found = self.decoded(model)
                    high = found.makespan - 1
                else:
                    low = target + 1
                target = (low + high) // 2
            if found is None:
                return proven
            model = self.tried(partial(self.task.within, found.makespan, most, prices))
            last = self.decoded(model)
            self.front.append(last)

    def cost(self, found: Schedule) -> float | None:
        """Return what a schedule costs by the criterion; None without one, and if it is infinite."""
        if self.asked.criterion is None:
            return None
        cost = plan_cost(self.effects.world, self.asked.criterion, found.units)
        return None if cost == math.inf else cost
