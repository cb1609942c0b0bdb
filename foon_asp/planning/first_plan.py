"""Some plan at once, however long: each unit has what it needs made before it, in plain Python."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from foon_asp import limits
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.supply import Supply
from foon_asp.planning.plan import Plan, replay_plan
from foon_asp.planning.problem import PlanProblem

_LONGEST = 3000
"""How many steps are tried; a plan of more is of no use to anybody."""

_AGAIN = 50
"""How often what a unit needs is made again, if making the one uses up the other."""

_PRUNED = 200
"""Plans of more steps are not tried without each of their steps."""


def first_plans(problem: PlanProblem, seconds: Mapping[UnitId, int]) -> list[Plan]:
    """Return plans, replayed, of units that take so long: by the least work, and by the earliest end.

    There may be none though there is a plan: when each way to make something uses up something else.
    """
    tried = (_Search(problem, seconds, together).plan() for together in (sum, max))
    return [found for found in tried if found is not None]


class _LostError(Exception):
    """What is needed cannot be made this way."""


class _Search:
    """Makes what is needed by the unit that costs least, if what costs are together is added, or the most."""

    def __init__(
        self, problem: PlanProblem, seconds: Mapping[UnitId, int], together: Callable[[list[float]], float]
    ) -> None:
        self.problem, self.effects = problem, problem.effects
        self.supply = Supply(self.effects)
        self.done: list[UnitId] = []
        self.costs: dict[ObjectId, float] = dict.fromkeys((*self.effects.endless, *self.effects.counted), 0)
        self.best: dict[ObjectId, UnitId] = {}
        changed = True
        while changed:
            changed = False
            for unit in seconds:
                needs = [self.costs.get(need, math.inf) for need in self.effects.needs(unit)]
                cost = together([*needs, 0]) + seconds[unit]
                for object_id in self.effects.adds(unit):
                    if cost < self.costs.get(object_id, math.inf):
                        self.costs[object_id], self.best[object_id] = cost, unit
                        changed = True

    def plan(self) -> Plan | None:
        goals = self.problem.goals
        try:
            for _ in range(_AGAIN):
                lacking = [goal for goal in goals if not self.supply.has(goal)]
                if not lacking:
                    return Plan.of(self.effects, goals, self.pruned())
                self.make(lacking[0], frozenset())
        except (_LostError, RecursionError):
            pass
        return None

    def make(self, object_id: ObjectId, underway: frozenset[ObjectId]) -> None:
        """Make an object, and before it what its unit needs, the dearest first."""
        limits.check()
        unit = self.best.get(object_id)
        if unit is None or object_id in underway or len(self.done) >= _LONGEST:
            raise _LostError
        needs = sorted(self.effects.needs(unit), key=lambda need: (-self.costs.get(need, 0), need))
        for _ in range(_AGAIN):
            lacking = [need for need in needs if not self.supply.has(need)]
            if not lacking:
                self.supply.execute(unit)
                self.done.append(unit)
                return
            self.make(lacking[0], underway | {object_id})
        raise _LostError

    def pruned(self) -> list[UnitId]:
        """Return what was done without the steps that it can do without, tried from the last one on."""
        units = list(self.done)
        for place in reversed(range(len(units) if len(units) <= _PRUNED else 0)):
            fewer = units[:place] + units[place + 1 :]
            if replay_plan(self.effects, self.problem.goals, fewer).executable:
                units = fewer
        return units
