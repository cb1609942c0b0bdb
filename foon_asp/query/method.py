"""The ways to choose a task tree."""

from __future__ import annotations

from enum import StrEnum

from foon_asp.errors import QueryError
from foon_asp.query.objective import SUCCESS, UNITS, Objective
from foon_asp.values import said


class Method(StrEnum):
    """How the units of a task tree are chosen."""

    OPTIMAL = "optimal"
    """A best tree by the objective, proven."""
    GREEDY = "greedy"
    """From the goal downwards, the best unit for each object (the seed paper's heuristics)."""
    IDS = "ids"
    """Iterative deepening: the least depth, then the first unit that fits it."""
    FIRST = "first"
    """The first unit that makes each object, in file order."""

    @classmethod
    def named(cls, name: str) -> Method:
        """Return the method of a name; raise `QueryError` if there is none."""
        try:
            return cls(name)
        except ValueError:
            raise QueryError(f"unknown method {said(name)}; methods: {', '.join(cls)}") from None


HEURISTICS = ("success", "inputs")
"""What the method `greedy` can go by."""

DEFAULTS = {
    Method.OPTIMAL: UNITS,
    Method.GREEDY: SUCCESS,
    Method.IDS: Objective(),
    Method.FIRST: Objective(),
}
"""What each method goes by where nothing is said."""
