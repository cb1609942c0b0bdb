"""Retrieval: from a question to a checked task tree, by any of the methods."""

from __future__ import annotations

import time

from foon_asp.limits import LimitReachedError, limited
from foon_asp.model.world import World
from foon_asp.query.goals import Named
from foon_asp.query.method import Method
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.substitution import Substitution
from foon_asp.query.unreachable import unreachable_reason
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.conflict import conflict_reason
from foon_asp.retrieval.methods import METHODS
from foon_asp.retrieval.methods.found import NOTHING, Found
from foon_asp.retrieval.own_criteria import refuse_criteria
from foon_asp.retrieval.progress import OnBetter, telling
from foon_asp.retrieval.substitute import substituted
from foon_asp.values import said


def retrieve(world: World, query: Query | Named, on_better: OnBetter | None = None) -> Answer:
    """Retrieve a task tree; every tree is replayed from the kitchen before it is returned.

    A goal alone, as a text or an object node, asks for the fewest units. `on_better` is told of each tree
    that is better than those before it, while better ones are looked for; the answer has the best. Raises
    `QueryError` if the question does not fit the data.
    """
    started = time.perf_counter()
    query = Query.of(query)
    world = query.seen_in(world)
    query = query.checked(world)
    if query.method != Method.OPTIMAL:
        refuse_criteria(query.constraints, f"the method {said(query.method.value)} takes none")
    with limited(query.time_limit, query.memory_limit), telling(on_better):
        problem = Problem.posed(world, query)
        found, reason = _found(problem, query)
        if found.status == Status.UNREACHABLE and query.substitute is not None:
            found, reason = _with_replacements(problem, query, query.substitute, reason)
    return Answer(query, *found[:4], reason, time.perf_counter() - started, limit=found.limit)


def _found(problem: Problem, query: Query) -> tuple[Found, str]:
    """Return what the method finds within the limits, and why there is no tree if there is none."""
    try:
        reason = unreachable_reason(problem)
        if reason:
            return NOTHING, reason
        found = METHODS[query.method](problem, query.objective)
    except LimitReachedError as error:
        return Found(Status.LIMIT, limit=error.limit), ""
    return found, conflict_reason(problem) if found.status == Status.UNREACHABLE else ""


def _with_replacements(
    problem: Problem, query: Query, substitution: Substitution, reason: str
) -> tuple[Found, str]:
    """Return the tree with the likest replacements, within the limits; `reason`: why there is no other."""
    try:
        found = substituted(problem, query.objective, substitution)
    except LimitReachedError as error:
        return Found(Status.LIMIT, limit=error.limit), ""
    return found, f"{reason}; no replacement helps" if found.status == Status.UNREACHABLE else ""
