"""The methods of retrieval: one file each, all with the same signature."""

from __future__ import annotations

from collections.abc import Callable

from foon_asp.query.method import Method
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.retrieval.methods.found import Found
from foon_asp.retrieval.methods.greedy import greedy
from foon_asp.retrieval.methods.ids import ids
from foon_asp.retrieval.methods.optimal import optimal

METHODS: dict[Method, Callable[[Problem, Objective], Found]] = {
    Method.OPTIMAL: optimal,
    Method.GREEDY: greedy,
    Method.IDS: ids,
    Method.FIRST: greedy,
}
"""A method: a problem for which a tree may exist, and what it goes by, to what it finds within the limits."""
