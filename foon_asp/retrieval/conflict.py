"""Which constraints leave no task tree, the fewest."""

from __future__ import annotations

from foon_asp.asp.program import solver
from foon_asp.limits import LimitReachedError, moment
from foon_asp.query.problem import Problem


def conflict_reason(problem: Problem) -> str:
    """Say which constraints must give way for a task tree to exist."""
    try:
        with moment():
            names = conflict(problem)
    except LimitReachedError:
        return "the constraints leave no task tree; there was no time to find out which of them"
    if not names:
        return "the rules leave no task tree"
    return "the constraints leave no task tree; one exists without: " + "; ".join(names)


def conflict(problem: Problem) -> tuple[str, ...]:
    """Return the names of the constraints that must give way, the fewest that will do, sorted.

    Raises `LimitReachedError`.
    """
    encodings = ["retrieval/task_tree.lp", "constraints/conflict.lp"]
    founded: dict[str, str | int] = {"founded": int(problem.founded)}
    if problem.constraints.human_steps is not None:
        # To know whether more human steps would help, it must be open how many there are.
        encodings.append("criteria/takeover.lp")
    answer = solver(problem, encodings, founded).best()
    if answer.limit is not None:
        raise LimitReachedError(answer.limit)
    return tuple(sorted(str(name) for (name,) in answer.rows("waived")))
