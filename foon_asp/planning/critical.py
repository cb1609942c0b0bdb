"""How long a schedule takes at least, whoever does what: the longest way that cannot be shortened."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.planning.problem import PlanProblem


@dataclass(frozen=True, slots=True)
class Critical:
    """Bounds of time for the units of a problem, if nothing were used up and hands were free at once.

    `there`: when each object can be there at the earliest. `quickest`: how long each unit takes at least.
    `heads`: when it begins at the earliest. `tails`: how long it takes from its end until some goal is there
    that it is of use for. Units that no goal needs are left out. `least`: no schedule is shorter.
    """

    there: Mapping[ObjectId, int]
    quickest: Mapping[UnitId, int]
    heads: Mapping[UnitId, int]
    tails: Mapping[UnitId, int]
    least: int

    @classmethod
    def of(cls, problem: PlanProblem, quickest: Mapping[UnitId, int]) -> Critical:
        """Work the bounds out for units that take so long at least; all others cannot be done by anybody."""
        there = _there(problem, quickest)
        effects = problem.effects
        heads = {
            unit: max((there[need] for need in effects.needs(unit)), default=0)
            for unit in quickest
            if all(need in there for need in effects.needs(unit))
        }
        tails = _tails(problem, {unit: quickest[unit] for unit in heads})
        heads = {unit: heads[unit] for unit in tails}
        least = max((there.get(goal, 0) for goal in problem.goals), default=0)
        return cls(there, {unit: quickest[unit] for unit in tails}, heads, tails, least)

    def shortest(self, unit: UnitId) -> int:
        """Return the least makespan of a schedule in which a unit is of use."""
        return self.heads[unit] + self.quickest[unit] + self.tails[unit]

    def windows(self) -> list[tuple[int, int]]:
        """Return where it is worth counting the work: from when on, and until how long before the end."""
        starts, rests = _some({*self.heads.values()}), _some({*self.tails.values()})
        return [(start, rest) for start in starts for rest in rests]


_WINDOWS = 20
"""How many starts, and how many ends, of spans are looked at."""


def _some(values: set[int]) -> list[int]:
    """Return some of many values, spread evenly, the first and the last among them."""
    found = sorted(values)
    if len(found) <= _WINDOWS:
        return found
    return [found[place * (len(found) - 1) // (_WINDOWS - 1)] for place in range(_WINDOWS)]


def _there(problem: PlanProblem, quickest: Mapping[UnitId, int]) -> dict[ObjectId, int]:
    """Return when each object can be there at the earliest."""
    effects = problem.effects
    there: dict[ObjectId, int] = dict.fromkeys((*effects.endless, *effects.counted), 0)
    changed = True
    while changed:
        changed = False
        for unit, seconds in quickest.items():
            needs = effects.needs(unit)
            if not all(need in there for need in needs):
                continue
            end = max((there[need] for need in needs), default=0) + seconds
            for object_id in (*effects.adds(unit), *effects.restores(unit)):
                if end < there.get(object_id, end + 1):
                    there[object_id] = end
                    changed = True
    return there


def _tails(problem: PlanProblem, quickest: Mapping[UnitId, int]) -> dict[UnitId, int]:
    """Return for each unit that is of use how long it takes from its end until a goal is there."""
    effects = problem.effects
    after: dict[ObjectId, int] = dict.fromkeys(problem.goals, 0)
    tails: dict[UnitId, int] = {}
    changed = True
    while changed:
        changed = False
        for unit, seconds in quickest.items():
            makes = (*effects.adds(unit), *effects.restores(unit))
            rest = min((after[each] for each in makes if each in after), default=None)
            if rest is None or rest >= tails.get(unit, rest + 1):
                continue
            tails[unit] = rest
            changed = True
            for need in effects.needs(unit):
                after[need] = min(after.get(need, rest + seconds), rest + seconds)
    return tails
