"""The built-in data: methods that disagree."""

from __future__ import annotations

from foon_asp.io.folder import Dataset
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve


def test_methods_disagree_on_eight_dishes_or_more(built_in: Dataset) -> None:
    world = built_in.world()
    ways = [("first", ""), ("greedy", "success"), ("optimal", "units"), ("optimal", "success")]
    disagreed = 0
    for goal in built_in.goals:
        trees = [retrieve(world, Query(goal, method=method, by=by or ())).tree for method, by in ways]
        disagreed += len({frozenset(tree.units) for tree in trees if tree}) > 1
    assert disagreed >= 8
