"""The published heuristics, and the first unit of each object.

`encodings/retrieval/greedy.lp` says which selection that is. Nearly always a worklist finds the same one (the
tests hold both equal); else the encoding is solved.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from foon_asp import limits
from foon_asp.asp.facts import finer_facts
from foon_asp.asp.program import solver
from foon_asp.limits import LimitReachedError
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.query.constraints import FREE
from foon_asp.query.objective import UNITS, Objective
from foon_asp.query.problem import Problem
from foon_asp.query.status import Status
from foon_asp.query.tariff import success_tariff
from foon_asp.retrieval.decode import checked_tree, decode_tree
from foon_asp.retrieval.methods.found import NOTHING, Found
from foon_asp.retrieval.prune import pruned
from foon_asp.retrieval.selection import Selection

Demerit = Callable[[UnitId], tuple[float, int]]
"""By how much a unit falls short by a heuristic, then its place in the file."""


def greedy(problem: Problem, objective: Objective) -> Found:
    """Return the tree that gives each object its best unit, from the goal downwards; by nothing, its first.

    The seed paper's heuristics. A tree at a limit is not proven to be that one.
    """
    heuristic = str(objective) or "first"
    found = settled(problem, heuristic) if problem.constraints == FREE else None
    return found or solved(problem, heuristic)


def settled(problem: Problem, heuristic: str) -> Found | None:
    """Settle objects one distance from the goals after the other; None if that takes a search.

    Whatever the encoding minimises is a sum over the objects at one distance. Say that nearer objects have
    the same units in all its best models. Then the objects at this distance are the same in all of them, too.
    Each can only be made by a unit with which the rest of the selection can be completed. If each has the
    best of these units, no sum can be less, and no other choice has the same sums: no two units that make an
    object have the same place. So if these choices go together, all best models make them. Only if they do
    not, as they stand in each other's way, it takes a search which of the objects has to do with less.
    """
    demerit = _demerit(problem, heuristic)
    selection = Selection(problem.world, founded=problem.founded)
    goals = [goal for goal in problem.goals if goal not in problem.world.stock]
    try:
        units = _settle(selection, goals, demerit)
    except LimitReachedError as error:
        if not problem.founded:
            raise
        units = selection.traced(goals)
        return Found(Status.LIMIT, checked_tree(problem, units), limit=error.limit)
    return None if units is None else Found(Status.FOUND, checked_tree(problem, units))


def _settle(selection: Selection, goals: Sequence[ObjectId], demerit: Demerit) -> set[UnitId] | None:
    """Give all objects that are wanted their best units; None if some stand in each other's way."""
    units: set[UnitId] = set()
    level = list(dict.fromkeys(goals))
    wanted = set(level)
    while level:
        below: dict[ObjectId, None] = {}
        for place, object_id in enumerate(level):
            limits.check()
            for unit in sorted(selection.candidates(object_id), key=demerit):
                if selection.settle(object_id, unit):
                    units.add(unit)
                    below.update(dict.fromkeys(selection.needs(unit)))
                    break
                if selection.possible(object_id, unit, free=level[:place]):
                    return None
        level = [object_id for object_id in below if object_id not in wanted]
        wanted.update(level)
    return units


def _demerit(problem: Problem, heuristic: str) -> Demerit:
    """Return what the units of a problem fall short by; raise `QueryError` if one has no rate for that."""
    world = problem.world
    inputs, rates = world.foon.units.inputs, world.rates
    if heuristic == "success":
        for unit in problem.units if np.isnan(rates).any() else ():
            world.kitchen.rate(world.foon.units[unit])
        return lambda unit: (-rates[unit], unit)
    if heuristic == "inputs":
        return lambda unit: (len(inputs[unit]), unit)
    return lambda unit: (0, unit)


def solved(problem: Problem, heuristic: str) -> Found:
    """Solve the encoding."""
    # A selection is about as deep as the closure has rounds.
    rounds = problem.world.closure.available
    horizon = 4 + max(rounds.get(goal, 8) for goal in problem.goals)
    while True:
        control = solver(
            problem,
            ["retrieval/greedy.lp"],
            {"founded": int(problem.founded), "by": heuristic, "horizon": horizon},
            extra_facts=finer_facts(problem) if heuristic == "success" else "",
            tariff=success_tariff(problem) if heuristic == "success" else None,
        )
        first = control.first() if limits.limited_now() else None
        if first is not None and first.proven:
            return NOTHING
        answer = control.best()
        if not answer.proven:
            best = answer if answer.atoms is not None or first is None else first
            if best.atoms is None:
                return Found(Status.LIMIT, limit=answer.limit)
            tree = pruned(problem, decode_tree(problem, best), UNITS)
            return Found(Status.LIMIT, tree, limit=answer.limit)
        if answer.atoms is None:
            return NOTHING
        if not answer.column("beyond"):
            return Found(Status.FOUND, decode_tree(problem, answer))
        horizon *= 2
