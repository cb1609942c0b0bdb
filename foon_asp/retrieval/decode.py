"""From an answer to what it means: the only reader of output predicates."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from foon_asp.asp.model import Model
from foon_asp.errors import InternalError
from foon_asp.model.node import UnitId
from foon_asp.query.problem import Problem
from foon_asp.retrieval.tree import TaskTree, likeliest_to_fail


def decode_tree(problem: Problem, model: Model) -> TaskTree:
    """Return the task tree of a model that there is, replayed."""
    units, human = (list(map(UnitId, model.column(name))) for name in ("use", "human"))
    for most in model.column("split"):
        human = likeliest_to_fail(problem.world, units, most)
    # Rules of the user's own may name a unit that is not in the tree.
    human = [unit for unit in human if unit in units]
    return checked_tree(problem, units, human)


def checked_tree(problem: Problem, units: Collection[UnitId], human: Iterable[UnitId] = ()) -> TaskTree:
    """Return the task tree of some units, replayed.

    Raises `InternalError` if a founded tree cannot be executed: then an encoding, or its twin in Python, is
    wrong.
    """
    tree = TaskTree.of(problem.world, problem.goals, units, human)
    if problem.founded and not tree.executable:
        missing = ", ".join(map(str, tree.replay.missing))
        raise InternalError(f"a founded task tree fails its replay: {missing} is missing")
    return tree
