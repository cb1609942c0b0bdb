"""Tariffs: what a criterion costs in clingo's integers, as finely as 32 bits allow for a problem."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from foon_asp.errors import QueryError
from foon_asp.model.node import UnitId
from foon_asp.model.world import World
from foon_asp.numbers import MOST
from foon_asp.query.objective import SUCCESS, Costs, Criterion, Objective
from foon_asp.query.problem import Problem

FINEST = 10**8
"""How many payments make one unit of natural logarithm, at most."""

PLAIN = 10**5
"""The same in facts that people read, and to which they fit factors of their own."""

EXACT = 1e-5
"""A proven optimum is exact within this factor, or the answer says what is proven."""

_LOST = 1e-5
"""More than what a product of floating-point numbers up to 2^31 loses."""


_ROUNDING = 1e-9
"""By how much sums of floating-point numbers may differ."""


@dataclass(frozen=True, slots=True)
class Totals:
    """What all units of a problem together pay by some criteria, and whether one has a chance of 0.

    `grain` is how much a single payment is worth by the criterion `cost`: costs are whole multiples of it.
    """

    sums: Mapping[str, Fraction]
    zero: bool
    grain: Fraction = Fraction(1)

    @classmethod
    def of(cls, world: World, numbers: Iterable[UnitId], criterion: Criterion, times: int = 1) -> Totals:
        """Add up, for each criterion of a sum, what is paid if each unit is done so many times."""
        numbers = list(numbers)
        looked_at = not {"success", "inputs", "time", "cost"}.isdisjoint(criterion.names)
        units = [world.foon.units[number] for number in numbers] if looked_at else []
        sums: dict[str, Fraction] = {}
        zero, grain = False, Fraction(1)
        for name in criterion.names:
            if name == "success":
                rates = [world.kitchen.known_rate(unit) for unit in units]
                zero = 0 in rates
                total: float = math.fsum(-math.log(rate) for rate in rates if rate)
            elif name == "inputs":
                total = sum(len(unit.inputs) for unit in units)
            elif name == "time":
                total = sum(unit.duration or 0 for unit in units)
            elif name == "cost":
                costs = [world.kitchen.cost(unit) for unit in units]
                grain = grain_of(costs)
                total = int(sum(costs) / grain)
            elif name in ("tools", "dirty"):
                total = len(world.kitchen.utensils)
            else:
                # There is one round more than units that a depth may count, so that it is told from them.
                total = len(numbers) + (name == "depth")
            sums[name] = Fraction(total) * times
        return cls(sums, zero, grain)

    def weights(self, criterion: Criterion) -> dict[str, Fraction]:
        """Return how much a single payment counts by each criterion of a sum."""
        return {name: weight * (self.grain if name == "cost" else 1) for name, weight in criterion.terms}


def grain_of(costs: Iterable[Fraction]) -> Fraction:
    """Return the largest part of which costs are whole multiples, if that is one of a whole."""
    return Fraction(1, math.lcm(*(cost.denominator for cost in costs)))


@dataclass(frozen=True, slots=True)
class Tariff:
    """What is paid by a criterion.

    Each payment by one of the `weights` counts so many times. `scale` is how many payments make one unit of
    the criterion; weights and chances are rounded down, so that no bound is too high. `ruin` is what is paid
    instead of all else where the chance is 0: more than anything else can be; it is 0 if that cannot happen.
    `grain` is what a single payment by the criterion `cost` is worth.
    """

    criterion: Criterion
    weights: Mapping[str, int]
    scale: Fraction
    ruin: int
    grain: Fraction = Fraction(1)

    @classmethod
    def of(cls, criterion: Criterion, totals: Totals, finest: int = FINEST) -> Tariff:
        """Choose the finest scale with which all payments together fit into clingo's integers.

        Raises `QueryError` if that makes nothing of a weight.
        """
        # A ruin is as much again, and each criterion pays a base.
        room = MOST // (2 if totals.zero else 1) - 3
        weights = totals.weights(criterion)
        [name, *others] = weights
        if not others and name != "success" and totals.sums[name] < room:
            # What is counted one by one is paid as it is, whatever its weight.
            return cls(criterion, {name: 1}, 1 / weights[name], 0, totals.grain)
        total = sum((weight * totals.sums[name] for name, weight in weights.items()), start=Fraction(0))
        if "success" in weights:
            scale = min(finest / weights["success"], room / total if total else Fraction(room))
        else:
            whole = math.lcm(*(weight.denominator for weight in weights.values()))
            divisor = math.gcd(*(int(weight * whole) for weight in weights.values()))
            scale = Fraction(whole, divisor)
            if scale * (total + min(weights.values())) > room:
                scale = room / (total + max(weights.values()))
        scale = _rounder(scale, [weight for name, weight in weights.items() if name != "success"])
        whole_weights = {
            name: 1 if name == "success" else math.floor(weight * scale) for name, weight in weights.items()
        }
        if lost := [name for name, weight in whole_weights.items() if weight < 1]:
            raise QueryError(_too_much(criterion, totals, lost[0], room))
        ruin = room + 2 if totals.zero else 0
        return cls(criterion, whole_weights, scale, ruin, totals.grain)

    @property
    def base(self) -> int:
        """What every tree pays by this criterion, so that clingo has a place for its costs and bounds."""
        return min(self.weights.values())

    @property
    def rounds(self) -> bool:
        """Whether what is paid is not exactly in the ratio of the costs."""
        return any(
            name == "success" or weight * (self.grain if name == "cost" else 1) * self.scale != paid
            for (name, weight), paid in zip(self.criterion.terms, self.weights.values(), strict=True)
        )

    def price(self, cost: Fraction) -> int:
        """Return how many payments a cost by the criterion `cost` is."""
        return int(cost / self.grain)

    @property
    def nat(self) -> Fraction:
        """How many payments make one unit of the natural logarithm of a chance."""
        return self.scale * dict(self.criterion.terms).get("success", Fraction(0))

    def failure(self, rate: float) -> int:
        """Return what a chance above 0 costs: the negative logarithm, rounded down."""
        return max(0, math.floor(-math.log(rate) * self.nat - _LOST))

    def most_failure(self, chance: float) -> int:
        """Return the largest sum of failures that may be as likely to succeed as a chance."""
        return min(MOST - 1, math.floor(-math.log(chance) * self.nat + _LOST))

    def bound(self, paid: int) -> float:
        """Return what a sum of payments proves: a chance for success alone, else a cost."""
        paid = max(0, paid - self.base)
        if self.criterion.names != ("success",):
            return float(paid / self.scale)
        return 0.0 if self._ruined(paid + self.base) else math.exp(-paid / self.nat)

    def gap(self, costs: Costs, paid: int) -> float | None:
        """Return the bound of a best tree that pays so much, unless that is its cost exactly enough."""
        if self._ruined(paid):
            return None
        bound = self.bound(paid)
        if self.criterion.names == ("success",):
            return None if (costs.success or 0) * (1 + EXACT) >= bound else bound
        return None if self.criterion.cost(costs) <= bound * (1 + EXACT) + _ROUNDING else bound

    def times(self, paid: int, factor: float) -> int:
        """Return the sum of payments that is a factor dearer; a chance is divided by the factor.

        What is possible does not become impossible.
        """
        if self._ruined(paid):
            return MOST
        if self.criterion.names == ("success",):
            most = paid + min(MOST, math.floor(math.log(factor) * self.nat))
        else:
            most = self.base + math.floor((paid - self.base) * Fraction(factor))
        return min(most, self.ruin - 1 if self.ruin else MOST)

    def _ruined(self, paid: int) -> bool:
        return 0 < self.ruin <= paid


def plain_tariff(problem: Problem) -> Tariff:
    """Return the tariff of success with a scale that people can remember, if that fits."""
    [criterion] = SUCCESS
    return Tariff.of(criterion, Totals.of(problem.world, problem.units, criterion), PLAIN)


def success_tariff(problem: Problem) -> Tariff:
    """Return the tariff of success alone."""
    [tariff] = tariffs(problem, SUCCESS)
    return tariff


def tariffs(problem: Problem, objective: Objective) -> list[Tariff]:
    """Return the tariff of each criterion of an objective; raise `QueryError` if its weights do not fit."""
    world, units = problem.world, problem.units
    return [Tariff.of(criterion, Totals.of(world, units, criterion)) for criterion in objective]


def _rounder(scale: Fraction, weights: Iterable[Fraction]) -> Fraction:
    """Return a scale that is not larger and, if it can be, makes whole numbers of all weights."""
    whole = math.lcm(*(weight.denominator for weight in weights))
    steps = math.floor(scale / whole)
    return Fraction(steps * whole) if steps else scale


def _too_much(criterion: Criterion, totals: Totals, lost: str, room: int) -> str:
    """Say what does not fit, and what would."""
    weights = totals.weights(criterion)
    name = max(weights, key=lambda each: weights[each] * totals.sums[each])
    if name == lost:
        return (
            f"what all units pay by {lost!r} adds up to more than {room:,}, which is all that clingo can add"
        )
    most = room * weights[lost] / (totals.sums[name] or 1)
    return (
        f"the weights of {criterion} are too far apart: all units together pay {int(totals.sums[name]):,} by"
        f" {name!r}, so beside {lost!r} it can weigh at most {float(most):.6g}"
    )
