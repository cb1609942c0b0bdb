"""A best tree, proven."""

from __future__ import annotations

from foon_asp import limits
from foon_asp.query.checks import check_objective
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.reduction import permitted, reducible
from foon_asp.retrieval.methods.climb import Climb
from foon_asp.retrieval.methods.found import Found
from foon_asp.retrieval.methods.proven import proven, solved

_WIDE = 300
"""From how many units on a problem is looked at before clingo is asked of all of it."""


def optimal(problem: Problem, objective: Objective) -> Found:
    """Return a best tree by an objective, proven, or the best until a limit with what was proven."""
    every = check_objective(problem, objective).complete
    smaller = permitted(problem) if reducible(problem, every) else None
    if smaller is None:
        return solved(problem, objective)
    if len(smaller.units) < _WIDE and not limits.limited_now():
        return proven(smaller, objective)
    return Climb(smaller, objective).found()
