"""A first task tree, without any search: relaxed plans, less what is superfluous in them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from foon_asp.model.kitchen import chance_of, exact
from foon_asp.model.node import UnitId
from foon_asp.model.relaxation import Part
from foon_asp.query.objective import Objective
from foon_asp.query.prices import least_prices
from foon_asp.query.problem import Problem
from foon_asp.retrieval.prune import leading, pruned, tree_of
from foon_asp.retrieval.tree import TaskTree

_AGAIN = 3
"""How often a plan is made anew, with what those before have for nothing."""


def first_tree(problem: Problem, part: Part, objective: Objective, again: int = _AGAIN) -> TaskTree | None:
    """Return a task tree that may not be the best one; None if none is found that keeps the constraints.

    Plans are made `again` so many times, as long as others come of it.
    Who does which step is not decided here: there is none where human steps have a price.
    """
    if "human" in objective.names:
        return None
    trees = (
        pruned(problem, tree_of(problem, units, objective), objective)
        for units in _plans(problem, part, objective, again)
    )
    return min(
        (tree for tree in trees if tree.executable and keeps(problem, tree)),
        key=lambda tree: [*objective.costs(tree.costs), tree.costs.units],
        default=None,
    )


def _plans(problem: Problem, part: Part, objective: Objective, again: int) -> Iterator[list[UnitId]]:
    """Yield relaxed plans, by the first criterion that units pay for, and by their number."""
    if "depth" in objective.names or problem.constraints.max_depth is not None:
        # What is made as early as can be makes no tree deeper than it must be.
        yield sorted(leading(problem, problem.units) or ())
    known = [least_prices(problem, criterion, part.units) for criterion in objective]
    paid = [prices for prices in known if prices.any() and np.isfinite(prices).any()]
    ones = np.ones(len(part.units))
    if not paid or not np.array_equal(paid[0], ones):
        paid[1:] = [ones]
    seen: set[tuple[UnitId, ...]] = set()
    for prices in paid[:2]:
        prices = prices.copy()
        for _ in range(1 + again):
            plan = part.plan(prices)
            if plan is None or tuple(plan) in seen:
                break
            yield plan
            seen.add(tuple(plan))
            prices[np.searchsorted(part.units, plan)] = 0


def keeps(problem: Problem, tree: TaskTree) -> bool:
    """Whether a tree keeps the constraints that speak of whole trees; no unit of it breaks one by itself."""
    constraints, units = problem.constraints, tree.functional_units
    if constraints.max_units is not None and len(units) > constraints.max_units:
        return False
    if constraints.max_depth is not None and (tree.depth or 0) > constraints.max_depth:
        return False
    if constraints.min_success is not None:
        rates = (problem.world.kitchen.rate(unit) for unit in units if unit.id not in tree.human)
        return chance_of(rates) >= exact(constraints.min_success)
    return True
