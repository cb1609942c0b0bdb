"""What units cost on one level of criteria: prices paid each time, and fees paid once for several units."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from foon_asp.criteria import Level
from foon_asp.errors import QueryError
from foon_asp.facts import failure_cost, per_thousand
from foon_asp.graph import FunctionalUnit
from foon_asp.problem import Domain, Problem

PER_UNIT = ("units", "inputs", "success", "time")
"""Criteria that each unit pays for itself, each time that it is done."""

ONCE = ("tools", "dirty", "motions")
"""Criteria that count distinct things: the first use of a thing pays for all uses."""

_INSTEAD = {
    "depth": "a plan's steps already are the rounds; leave the criterion out, or minimise the time of "
    "a durative export",
    "human": "leave the criterion out, or retrieve a task tree, which can share the work with a human",
}


@dataclass(frozen=True, slots=True)
class Prices:
    """What the units of a problem cost on a level, in the integers of `Level.weights`.

    `per_unit`: unit to its price, 0 included. `fees`: a key, as `tools bowl`, to what is paid once for it.
    `once`: unit to the keys that must be paid before it is done; units without any are left out.
    """

    per_unit: dict[int, int]
    fees: dict[str, int]
    once: dict[int, tuple[str, ...]]

    @classmethod
    def of(cls, problem: Problem, level: Level, units: Iterable[int] | None = None) -> Prices:
        """Price the units of a problem, or other units of its domain.

        Raises `QueryError` if the level holds a criterion that is no sum over units or first uses, or asks
        for success and a motion has no rate.
        """
        for name in level.names:
            if name in _INSTEAD:
                raise QueryError(f"the criterion {name!r} has no price per unit; {_INSTEAD[name]}")
        domain, weights = problem.domain, level.weights
        per_unit: dict[int, int] = {}
        fees: dict[str, int] = {}
        once: dict[int, tuple[str, ...]] = {}
        for number in problem.units if units is None else units:
            unit = domain.foon.units[number]
            per_unit[number] = sum(
                weight * _payment(domain, unit, name) for name, weight in weights.items() if name in PER_UNIT
            )
            keys = []
            for name in ONCE:
                if name in weights:
                    for thing in _distinct(domain, unit, name):
                        fees[f"{name} {thing}"] = weights[name]
                        keys.append(f"{name} {thing}")
            if keys:
                once[number] = tuple(keys)
        return cls(per_unit, fees, once)

    def total(self, units: Iterable[int]) -> int:
        """Return what the units of a plan cost, those that come again each time, and all fees once."""
        done = list(units)
        keys = {key for unit in done for key in self.once.get(unit, ())}
        return sum(self.per_unit[unit] for unit in done) + sum(self.fees[key] for key in keys)


def _payment(domain: Domain, unit: FunctionalUnit, criterion: str) -> int:
    if criterion == "inputs":
        return len(unit.inputs)
    if criterion == "success":
        return failure_cost(per_thousand(domain.kitchen.rate(unit)))
    if criterion == "time":
        return unit.duration or 0
    return 1


def _distinct(domain: Domain, unit: FunctionalUnit, criterion: str) -> list[str]:
    """Return, sorted, what a unit uses of that which the criterion counts once."""
    if criterion == "motions":
        return [unit.motion]
    return sorted(domain.handled(unit) if criterion == "tools" else domain.filled(unit))
