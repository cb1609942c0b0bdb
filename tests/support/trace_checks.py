"""Traces of iterative deepening against the method `ids`."""

from __future__ import annotations

from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.trace import trace

# --- Real data ------------------------------------------------------------------------------------


def check_all(data: Dataset, where: World) -> int:
    """Compare with the method `ids`, goal by goal; return how many could be made."""
    made = 0
    for goal in data.goals:
        last = trace(where, where.id_of(goal))[-1]
        tree = retrieve(where, Query(goal, method="ids")).tree
        assert last.reached == (tree is not None)
        if tree is not None:
            made += 1
            assert last.limit == tree.depth
            needs = {thing for unit in tree.units for thing in where.units.needs[unit]}
            assert needs <= {thing for thing, _ in last.explored}
    return made
