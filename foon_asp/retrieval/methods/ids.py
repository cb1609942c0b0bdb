"""Iterative deepening: clingo multi-shot, a bound of depth at a time."""

from __future__ import annotations

from foon_asp import limits
from foon_asp.asp.program import solver
from foon_asp.errors import InternalError
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.status import Status
from foon_asp.retrieval.decode import decode_tree
from foon_asp.retrieval.methods.found import Found


def ids(problem: Problem, objective: Objective) -> Found:  # noqa: ARG001
    """Return the tree of iterative deepening: one bound after the other, until one reaches the goals."""
    control = solver(problem, ["retrieval/ids.lp"], {})
    # Within less depth than the closure has rounds no search reaches the goals.
    shallowest = max(problem.world.closure.available[goal] for goal in problem.goals)
    for bound in range(len(problem.units) + 1):
        limit = limits.reached()
        if limit is not None:
            return Found(Status.LIMIT, limit=limit)
        if bound > 0:
            control.ground("step", bound)
        if bound < shallowest:
            continue
        control.ground("check", bound)
        control.switch("bound", bound, True)
        answer = control.best()
        if answer.atoms is not None:
            control.ground("choose", bound)
            answer = control.best()
            if answer.proven:
                return Found(Status.FOUND, decode_tree(problem, answer))
        if not answer.proven:
            return Found(Status.LIMIT, limit=answer.limit)
        control.switch("bound", bound, False)
    raise InternalError("depth-bounded search passed every depth without reaching a reachable goal")
