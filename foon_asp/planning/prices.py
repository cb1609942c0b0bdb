"""What units cost by one criterion: prices paid each time, and fees paid once for several units."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from foon_asp import limits
from foon_asp.errors import QueryError
from foon_asp.model.kitchen import chance_of
from foon_asp.model.node import FunctionalUnit, UnitId
from foon_asp.model.world import World
from foon_asp.query.objective import Costs, Criterion
from foon_asp.query.problem import Problem
from foon_asp.query.tariff import Tariff, Totals

PER_UNIT = ("units", "inputs", "success", "time", "cost")
"""Criteria that each unit pays for itself, each time that it is done."""

ONCE = ("tools", "dirty", "motions")
"""Criteria that count distinct labels: the first use of a label pays for all uses."""

_INSTEAD = {
    "depth": "a plan's steps already are the rounds; leave the criterion out, or minimise the time of "
    "a durative export",
    "human": "leave the criterion out, or retrieve a task tree, which can share the work with a human",
}


RUIN = "success failure"
"""The key of the fee that is paid once for units that never succeed; it is more than all else can be."""


@dataclass(frozen=True, slots=True)
class Prices:
    """What the units of a problem cost by a criterion, in the integers of a tariff.

    `per_unit`: unit to its price, 0 included. `fees`: a key, as `tools bowl`, to what is paid once for it.
    `once`: unit to the keys that must be paid before it is done; units without any are left out.
    """

    tariff: Tariff
    per_unit: Mapping[UnitId, int]
    fees: Mapping[str, int]
    once: Mapping[UnitId, tuple[str, ...]]

    @classmethod
    def of(
        cls, problem: Problem, criterion: Criterion, units: Iterable[UnitId] | None = None, times: int = 1
    ) -> Prices:
        """Price the units of a problem, or other units of its domain, each done so many times at most.

        Raises `QueryError` if the criterion holds one that is no sum over units or first uses, or asks
        for success and a motion has no rate, or if its weights do not fit.
        """
        for name in criterion.names:
            if name in _INSTEAD:
                raise QueryError(f"the criterion {name!r} has no price per unit; {_INSTEAD[name]}")
        world, numbers = problem.world, list(problem.units if units is None else units)
        tariff = Tariff.of(criterion, Totals.of(world, numbers, criterion, times))
        weights = tariff.weights
        per_unit: dict[UnitId, int] = {}
        fees: dict[str, int] = {}
        once: dict[UnitId, tuple[str, ...]] = {}
        for number in numbers:
            limits.check()
            unit = world.foon.units[number]
            per_unit[number] = sum(
                weight * _payment(world, unit, name, tariff)
                for name, weight in weights.items()
                if name in PER_UNIT
            )
            keys = []
            for name in ONCE:
                if name in weights:
                    for label in _distinct(world, unit, name):
                        fees[f"{name} {label}"] = weights[name]
                        keys.append(f"{name} {label}")
            if "success" in weights and world.kitchen.rate(unit) == 0:
                fees[RUIN] = tariff.ruin
                keys.append(RUIN)
            if keys:
                once[number] = tuple(keys)
        return cls(tariff, per_unit, fees, once)

    def total(self, units: Iterable[UnitId]) -> int:
        """Return what the units of a plan cost, those that come again each time, and all fees once."""
        done = list(units)
        keys = {key for unit in done for key in self.once.get(unit, ())}
        if RUIN in keys:
            return self.fees[RUIN]
        return sum(self.per_unit[unit] for unit in done) + sum(self.fees[key] for key in keys)


def plan_cost(world: World, criterion: Criterion, units: Iterable[UnitId]) -> float:
    """Return what a plan costs, not rounded: a chance for success alone; a sum may be infinite."""
    done = [world.foon.units[unit] for unit in units]
    rates = [world.kitchen.known_rate(unit) for unit in done]
    known = [rate for rate in rates if rate is not None]
    labels = {name: len({each for unit in done for each in _distinct(world, unit, name)}) for name in ONCE}
    costs = Costs(
        units=len(done),
        inputs=sum(len(unit.inputs) for unit in done),
        success=float(chance_of(known)) if len(known) == len(rates) else None,
        depth=None,
        **labels,
        time=sum(unit.duration or 0 for unit in done),
        human=0,
        cost=world.cost_of(done),
    )
    if criterion.names == ("success",):
        return costs.success or 0.0
    return criterion.cost(costs)


def _payment(world: World, unit: FunctionalUnit, criterion: str, tariff: Tariff) -> int:
    if criterion == "inputs":
        return len(unit.inputs)
    if criterion == "success":
        rate = world.kitchen.rate(unit)
        return tariff.failure(rate) if rate else 0
    if criterion == "time":
        return unit.duration or 0
    if criterion == "cost":
        return tariff.price(world.kitchen.cost(unit))
    return 1


def _distinct(world: World, unit: FunctionalUnit, criterion: str) -> list[str]:
    """Return, sorted, what a unit uses of that which the criterion counts once."""
    if criterion == "motions":
        return [unit.motion]
    return sorted(world.handled(unit) if criterion == "tools" else world.filled(unit))
