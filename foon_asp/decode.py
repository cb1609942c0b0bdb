"""From an answer to what it means: the only reader of output predicates."""

from __future__ import annotations

from foon_asp.errors import InternalError
from foon_asp.problem import Problem
from foon_asp.solve import Answer, Value
from foon_asp.tree import TaskTree, likeliest_to_fail


def decode_tree(problem: Problem, answer: Answer) -> TaskTree:
    """Return the task tree of a model that there is, replayed.

    Raises `InternalError` if a founded tree cannot be executed: then an encoding is wrong.
    """
    units, human = column(answer, "use"), column(answer, "human")
    for most in column(answer, "split"):
        human = likeliest_to_fail(problem.domain, units, most)
    tree = TaskTree.of(problem.domain, problem.goals, units, human)
    if problem.founded and not tree.executable:
        missing = ", ".join(map(str, tree.replay.missing))
        raise InternalError(f"a founded task tree fails its replay: {missing} is missing")
    return tree


def column(answer: Answer, predicate: str) -> list[int]:
    """Return the first arguments of a predicate in the model, sorted, each once."""
    return sorted({ids[0] for ids in rows(answer, predicate) if isinstance(ids[0], int)})


def rows(answer: Answer, predicate: str) -> list[tuple[Value, ...]]:
    """Return the arguments of each atom of a predicate in the model, in clingo's order of terms."""
    return [arguments for name, arguments in answer.atoms or () if name == predicate]
