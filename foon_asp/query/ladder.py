"""Bounds before search: which units can be in a tree that costs no more than so much.

Theorem. Let a tree have no superfluous unit, and u be a unit of it. Then the tree costs at least what a chain
of units costs that u cannot be done without, u included, and what a chain costs by which u leads to a goal, u
left out: `chain(u) + onward(u) - price(u)`.

Proof. Execute the tree in rounds, each unit as soon as it can be. Each object that is not at hand at first
has a first maker. From u go back to that first maker of a need whose own least chain is dearest, and so on:
these units are done in earlier rounds than u, each once, and by induction over the rounds cost at least what
`chain(u)` says, u included. If no chain of first makers led from u to a goal (or to a unit that is demanded),
the first makers that the goals do lead to would be a tree without u. So one does, all its units are done in
later rounds than u, and it costs at least `onward(u)`. The two chains have only u in common.

So it holds for sums over units (units, inputs, time, failures), and for the depth: units of one chain are
done in different rounds. What several units pay together (utensils, motions) adds nothing to a price, and no
unit pays for what a human might do. Constraints forbid trees and so make no tree cheaper; all of them but
rules of the user's own are kept when a superfluous unit is left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foon_asp.model.relaxation import Amounts, Part
from foon_asp.query.objective import Criterion
from foon_asp.query.prices import least_prices
from foon_asp.query.problem import Problem

_NEAR = 1e-9
"""What sums of floating-point numbers may lose."""


@dataclass(frozen=True, eq=False)
class Ladder:
    """The units of a problem, ordered by what a tree with each of them costs at least by one criterion.

    `reach` says that of each unit, `rungs` are the same numbers, sorted. `least` is what every tree costs.
    """

    problem: Problem
    reach: Amounts
    rungs: Amounts
    least: float

    @classmethod
    def of(cls, problem: Problem, part: Part, criterion: Criterion) -> Ladder | None:
        """Work out what each unit takes; None if that says nothing, or would take too long."""
        prices = least_prices(problem, criterion, part.units)
        if not prices.any():
            return None
        chain, onward = part.least_chain(prices), part.least_onward(prices)
        if chain is None or onward is None:
            return None
        with np.errstate(invalid="ignore"):
            reach = np.nan_to_num(chain + onward - prices, nan=np.inf, posinf=np.inf)
        first = [
            chain[part.makers.values[slice(*part.makers.offsets[goal : goal + 2])]] for goal in part.goals
        ]
        least = max([0.0, *(float(makers.min()) for makers in first), *chain[part.demanded].tolist()])
        return cls(problem, reach, np.sort(reach), least)

    def upto(self, most: float) -> Problem:
        """Return the problem with only the units of trees that cost so much, or less."""
        kept = np.flatnonzero(self.reach <= _above(most))
        ids = self.problem.units
        return replace(self.problem, among=tuple(ids[place] for place in kept.tolist()))

    def below(self, cost: float) -> float:
        """Return the highest rung that is below a cost; all cheaper trees are within it."""
        near = cost - _NEAR * (1 + cost) if cost < np.inf else cost
        place = int(np.searchsorted(self.rungs, near))
        return float(self.rungs[place - 1]) if place else -np.inf

    def above(self, most: float) -> float:
        """Return the lowest rung above a cost: what a tree costs at least that is not `upto` it."""
        place = int(np.searchsorted(self.rungs, _above(most), side="right"))
        return float(self.rungs[place]) if place < len(self.rungs) else np.inf

    def rung(self, count: int) -> float:
        """Return the rung up to which there are so many units, or all."""
        return max(self.least, float(self.rungs[min(count, len(self.rungs)) - 1]))


def _above(most: float) -> float:
    return most + _NEAR * (1 + most)


def part_of(problem: Problem) -> Part:
    """Return the units and goals of a problem as arrays."""
    world = problem.world
    return Part.of(world.units, world.at_hand, problem.units, problem.goals, problem.constraints.use_units)
