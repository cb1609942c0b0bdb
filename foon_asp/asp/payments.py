"""Payments of rules of the user's own, all together: clingo counts with 32 bits and wraps what is more."""

from __future__ import annotations

from collections import defaultdict

from foon_asp.asp.solver import Solver
from foon_asp.asp.terms import Term
from foon_asp.errors import QueryError
from foon_asp.numbers import MOST


def check_payments(solver: Solver) -> None:
    """Raise `QueryError` if all that can be paid at a priority is more than clingo can add."""
    *tables, payments = solver.derived([("weight", 2), ("standing", 2), ("penalty", 3)])
    weights, priorities = ({row[0]: _number(row[1]) for row in table} for table in tables)
    sums: defaultdict[int, int] = defaultdict(int)
    for criterion, _, value in payments:
        if criterion in priorities:
            sums[priorities[criterion]] += _number(value) * weights.get(criterion, 1)
    for priority, total in sums.items():
        if total > MOST:
            raise QueryError(
                f"what can be paid at priority {priority} adds up to {total:,}, and clingo counts up to"
                f" {MOST:,}: let the rules pay less"
            )


def _number(term: Term) -> int:
    return term if isinstance(term, int) else 0
