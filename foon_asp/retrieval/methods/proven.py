"""What clingo proves of a problem: a best tree, or the best until a limit."""

from __future__ import annotations

from collections.abc import Sequence

from foon_asp import limits
from foon_asp.asp.model import Model
from foon_asp.asp.program import optimisers, too_deep
from foon_asp.asp.solver import Solver
from foon_asp.limits import LimitReachedError
from foon_asp.query.objective import CRITERIA, Objective, Payments
from foon_asp.query.problem import Problem
from foon_asp.query.reduction import MOST, narrowed
from foon_asp.query.status import Status
from foon_asp.query.tariff import Tariff, tariffs
from foon_asp.retrieval.decode import decode_tree
from foon_asp.retrieval.methods.found import NOTHING, Found
from foon_asp.retrieval.prune import pruned, tree_of
from foon_asp.retrieval.relaxed import keeps
from foon_asp.retrieval.tree import TaskTree


def proven(problem: Problem, objective: Objective, known: TaskTree | None = None) -> Found:
    """Return a best tree of a problem that can be reduced, or the best until a limit.

    Where a tree is known clingo need not find any first.
    """
    every = objective.complete
    if len(problem.units) <= MOST:
        problem = narrowed(problem, every)
        if problem.forced and "human" not in every.names:
            tree = tree_of(problem, problem.units, every)
            if tree.executable and keeps(problem, tree):
                # There is nothing to choose.
                return Found(Status.OPTIMAL, tree)
    return solved(problem, objective, known)


def solved(problem: Problem, objective: Objective, known: TaskTree | None = None) -> Found:
    """Let clingo find a best tree, or the best until a limit, whatever the problem."""
    every = objective.complete
    priced = tariffs(problem, every)
    models: list[Model] = []
    try:
        for control in optimisers(problem, priced):
            if limits.limited_now() and known is None:
                # Proving bounds may take all the time there is.
                models.append(control.first())
                if models[-1].proven:
                    return NOTHING
            answer = control.best()
            if not answer.proven:
                models.append(answer)
                break
            if answer.atoms is None:
                return NOTHING
            if not too_deep(answer):
                tree = decode_tree(problem, answer)
                unsure = gaps(problem, priced[: len(objective)], tree, answer)
                own = own_payments(answer, control) if problem.constraints.rules else {}
                return Found(Status.OPTIMAL, tree, unsure, own)
            models.append(answer)
    except LimitReachedError as error:
        models.append(Model(None, False, limit=error.limit))
    return _best_so_far(problem, models, objective, priced)


def _best_so_far(
    problem: Problem, models: list[Model], objective: Objective, priced: Sequence[Tariff]
) -> Found:
    """Return the best tree of some models, the last of which ended at a limit, and what that has proven."""
    every = objective.complete
    trees = [pruned(problem, decode_tree(problem, each), every) for each in models if each.atoms is not None]
    best = min(trees, key=lambda tree: every.costs(tree.costs), default=None)
    last = models[-1]
    # Rules of the user's own may pay by any criterion, and at any priority.
    known = len(last.bounds) == len(every) and not problem.constraints.rules
    lower = last.bounds if known else [0] * len(every)
    rows = zip(priced, lower, strict=True)
    bound = {str(tariff.criterion): tariff.bound(paid) for tariff, paid in rows}
    return Found(Status.LIMIT, best, {name: bound[name] for name in objective.texts}, {}, last.limit)


def gaps(problem: Problem, priced: Sequence[Tariff], tree: TaskTree, answer: Model) -> dict[str, float]:
    """Return what is proven by each criterion by which a tree is not exactly best, for costs are rounded."""
    rounded = [(place, tariff) for place, tariff in enumerate(priced) if tariff.rounds]
    if not rounded or problem.constraints.rules:
        return {}
    paid = dict(zip(answer.priorities, answer.costs, strict=True))
    top = len(Objective(tuple(tariff.criterion for tariff in priced)).complete)
    found = {str(tariff.criterion): tariff.gap(tree.costs, paid[top - place]) for place, tariff in rounded}
    return {name: bound for name, bound in found.items() if bound is not None}


def own_payments(answer: Model, control: Solver) -> Payments:
    """Return what a model pays by criteria of the user's own, at each of their priorities.

    clingo leaves out a priority at which nothing can ever be paid.
    """
    paid = dict(zip(answer.priorities, answer.costs, strict=True))
    standing, foremost = control.derived([("standing", 2), ("foremost", 1)])
    # What comes before all else is ours, too.
    ours = {*CRITERIA, *(name for (name,) in foremost)}
    own = {int(str(priority)) for name, priority in standing if name not in ours}
    return {priority: paid.get(priority, 0) for priority in sorted(own, reverse=True)}
