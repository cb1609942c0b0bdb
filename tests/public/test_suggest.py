"""Dishes of the public universal FOON."""

from __future__ import annotations

from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import suggest
from support.dish_checks import really_used

# --- Real data ------------------------------------------------------------------------------------


def test_universal_dishes(universal_world: World) -> None:
    where = universal_world
    every = suggest(where, Query())
    best = {each.dish: each.costs.units for each in every.dishes}
    assert every.candidates == len(best) == 231
    for goal in universal_world.goals:
        tree = retrieve(where, Query(goal)).tree
        assert best.get(goal) == (None if tree is None else tree.costs.units)
    for using, count in ((["egg"], 100), (["egg", "milk"], 50)):
        result = suggest(where, Query(), using=using)
        assert len(result.dishes) == count
        assert all(each.tree.executable and best[each.dish] <= each.costs.units for each in result.dishes)
        assert really_used(where, result)


def test_universal_dishes_by_success(universal_world: World) -> None:
    """Core-guided optimisation of some of these takes very long, unless encoding and program help it."""
    for using, count in ((["garlic"], 76), (["butter", "milk"], 43), (["egg"], 100)):
        result = suggest(universal_world, Query(by="success", time_limit=60), using=using)
        assert (len(result.dishes), result.skipped) == (count, 0)
        assert really_used(universal_world, result)
