"""Prices: what each unit of a chain adds at least to what a tree costs by a criterion, as whole columns."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from foon_asp.model.arrays import Numbers, numbers
from foon_asp.model.node import UnitId
from foon_asp.model.relaxation import Amounts
from foon_asp.model.world import World
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem


def _rates(world: World, units: Numbers) -> Amounts:
    """Return the chance that each of some units succeeds, as `Kitchen.known_rate` has it; NaN if unknown."""
    table, kitchen = world.foon.units, world.kitchen
    motions = (
        kitchen.rates.get(motion.rstrip("*").rstrip(), kitchen.default_rate) for motion in table.motions
    )
    known = np.array([np.nan if rate is None else rate for rate in motions], dtype=np.float64)
    own = table.notes.rate[units]
    return np.where(np.isnan(own), known[table.motion[units]], own)


def rates_known(problem: Problem) -> bool:
    """Whether it is known of each unit of a problem how likely it succeeds."""
    return not np.isnan(_rates(problem.world, numbers(problem.units))).any()


def least_prices(problem: Problem, criterion: Criterion, units: Numbers) -> Amounts:
    """Return what each unit adds at least to a criterion, beside those that are done before or behind it.

    Utensils and motions add nothing, for another unit may have them, too, and neither does the chance of a
    unit that a human may take over.
    """
    total = np.zeros(len(units))
    for name, weight in criterion.terms:
        human = problem.constraints.human_steps is not None or "human" in criterion.names
        if name in _PRICES and not (name == "success" and human):
            total += float(weight) * _PRICES[name](problem.world, units)
    return total


def _one(_: World, units: Numbers) -> Amounts:
    return np.ones(len(units))


def _inputs(world: World, units: Numbers) -> Amounts:
    offsets = world.foon.units.inputs.offsets
    return (offsets[units + 1] - offsets[units]).astype(np.float64)


def _time(world: World, units: Numbers) -> Amounts:
    return world.foon.units.notes.durations[units]


def _cost(world: World, units: Numbers) -> Amounts:
    table, kitchen = world.foon.units, world.kitchen
    return np.array([kitchen.known_cost(table[UnitId(number)]) or 0 for number in units.tolist()], np.float64)


def _failure(world: World, units: Numbers) -> Amounts:
    with np.errstate(divide="ignore"):
        return np.nan_to_num(-np.log(_rates(world, units)), nan=0.0, posinf=np.inf)


_PRICES: dict[str, Callable[[World, Numbers], Amounts]] = {
    "units": _one,
    # Units of a chain need each other, so each is done a round later.
    "depth": _one,
    "inputs": _inputs,
    "time": _time,
    "cost": _cost,
    "success": _failure,
}
