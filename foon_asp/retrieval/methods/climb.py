"""A best tree among the cheapest units first, and then among more of them.

A relaxed plan says what a tree costs at most, and a `Ladder` which units cheaper trees may have. clingo
proves the best tree among the cheapest units, then among more of them, until all that matter were there. Each
proof is a bound for the whole.
"""

from __future__ import annotations

import math
from contextlib import nullcontext

from foon_asp import limits
from foon_asp.limits import LimitReachedError
from foon_asp.model.relaxation import Part
from foon_asp.query.ladder import Ladder, part_of
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.status import Status
from foon_asp.retrieval.methods.found import Found
from foon_asp.retrieval.methods.proven import proven
from foon_asp.retrieval.progress import better
from foon_asp.retrieval.relaxed import first_tree
from foon_asp.retrieval.tree import TaskTree

_FIRST_STAGE = 500
"""How many units clingo is given at first."""

_GROWTH = 4
"""How many times as many it is given next."""

_NEAR = 1e-9
"""By how much sums of floating-point numbers may differ, in proportion."""


class Climb:
    """A search among the cheapest units first: the best tree so far, and what every tree costs at least."""

    def __init__(self, problem: Problem, objective: Objective, first_stage: int = _FIRST_STAGE) -> None:
        self._problem = problem
        self._objective = objective
        self._first_stage = first_stage
        self._every = objective.complete
        self._criterion = self._every.criteria[0]
        self._best: TaskTree | None = None
        self._least = 0.0

    def found(self) -> Found:
        """Return a best tree, proven, or the best until a limit."""
        try:
            part = part_of(self._problem)
            self._offer(first_tree(self._problem, part, self._every, again=0))
            # Who has a tree needs no moment more.
            with nullcontext() if self._best is None else limits.strictly():
                return self._improved(part)
        except LimitReachedError as error:
            return self._ended(Found(Status.LIMIT, limit=error.limit))

    def _improved(self, part: Part) -> Found:
        """Look for better trees, and for the proof."""
        ladder = Ladder.of(self._problem, part, self._criterion)
        if ladder is not None:
            self._least = ladder.least
            self._plan_again(ladder.upto(self._top(ladder)))
            return self._climb(ladder)
        self._plan_again(self._problem)
        found = proven(self._problem, self._objective, self._best)
        return self._ended(found) if found.status == Status.LIMIT else found

    def _plan_again(self, problem: Problem) -> None:
        """Look for a better plan, among the units of trees that may be better."""
        if self._best is not None and not self._proven():
            self._offer(first_tree(problem, part_of(problem), self._every))

    def _climb(self, ladder: Ladder) -> Found:
        """Prove the best tree among more and more units."""
        count, done = self._first_stage, -math.inf
        while True:
            most = min(ladder.rung(count), self._top(ladder))
            if most <= done:
                # No tree is better than one whose cost every tree has.
                return Found(Status.OPTIMAL, self._best)
            stage = ladder.upto(most)
            found = proven(stage, self._objective, self._best)
            self._offer(found.tree)
            if found.status == Status.LIMIT:
                return self._ended(found, ladder.above(most))
            if most >= self._top(ladder):
                return found if self._best is found.tree else Found(Status.OPTIMAL, self._best)
            self._least = max(self._least, min(ladder.above(most), self._cost(found.tree)))
            count, done = _GROWTH * len(stage.units), most

    def _top(self, ladder: Ladder) -> float:
        """Return the rung up to which all trees are that may be better than the best so far."""
        if self._best is None:
            return float(ladder.rungs[-1])
        cost = self._cost(self._best)
        if len(self._every) > 1 or cost == math.inf:
            return cost
        return -math.inf if self._proven() else ladder.below(cost)

    def _proven(self) -> bool:
        """Whether the best tree so far costs no more than every tree must."""
        return len(self._every) == 1 and self._cost(self._best) <= self._least * (1 + _NEAR)

    def _cost(self, tree: TaskTree | None) -> float:
        return math.inf if tree is None else self._criterion.cost(tree.costs)

    def _offer(self, tree: TaskTree | None) -> None:
        """Take a tree if it is better than the best so far, and say so."""
        if tree is None:
            return
        if self._best is None or self._rank(tree) < self._rank(self._best):
            self._best = tree
            better(tree)

    def _rank(self, tree: TaskTree) -> list[float]:
        """Return what trees are compared by; of those that can never succeed the smallest is the best."""
        return [*self._every.costs(tree.costs), tree.costs.units]

    def _ended(self, found: Found, above: float = math.inf) -> Found:
        """Return the best so far where a limit has ended the search.

        `found` is of a stage. What it proves holds for all trees that cost less than those `above` it.
        """
        self._offer(found.tree)
        if self._best is None:
            return found
        bound = dict(found.bound) if above == math.inf else {}
        for criterion in self._objective:
            bound.setdefault(str(criterion), criterion.bound(0.0))
        first = str(self._criterion)
        self._least = max(self._least, min(self._criterion.cost_of(bound[first]), above))
        if self._proven():
            return Found(Status.OPTIMAL, self._best)
        bound[first] = self._criterion.bound(self._least)
        return Found(Status.LIMIT, self._best, bound, {}, found.limit)
