"""Several trees and menus are those of trying every set of units."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import all_optimal_trees, best_trees, diverse_trees, pareto_trees
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.tree import TaskTree
from support import brute_force
from support.examples import many
from support.small_foons import queries

Drawn = tuple[World, ObjectNode]
Key = tuple[int | Fraction, ...]


def key(costs: brute_force.Costs, by: Sequence[str]) -> Key:
    return tuple(-costs[name] if name == "success" else costs[name] for name in by)


def ranked(where: World, goal: ObjectNode, by: Sequence[str]) -> list[tuple[Key, frozenset[UnitId]]]:
    """Return all trees by cost, without those that only add units to one before them."""
    found = brute_force.tree_sets(where, [goal])
    kept: list[tuple[Key, frozenset[UnitId]]] = []
    order = sorted(found, key=lambda units: (key(found[units], (*by, "units")), sorted(units)))
    for units in order:
        if not any(known <= units for _, known in kept):
            kept.append((key(found[units], (*by, "units")), units))
    return kept


def sets(trees: Sequence[TaskTree]) -> list[frozenset[UnitId]]:
    return [frozenset(tree.units) for tree in trees]


@pytest.mark.parametrize("by", [("units",), ("success",), ("depth",), ("inputs", "depth")])
@many(100)
@given(query=queries(), count=st.sampled_from([1, 2, 3, 5, 50]))
def test_the_best_few_are_those_of_trying_every_set(by: tuple[str, ...], query: Drawn, count: int) -> None:
    where, goal = query
    wanted = ranked(where, goal, by)
    result = best_trees(where, Query(goal, by=",".join(by)), count)
    event(f"{min(len(wanted), 4)} trees")
    costs = {units: cost for cost, units in wanted}
    found = sets(result.trees)
    assert len(set(found)) == len(found) == min(count, len(wanted))
    # Where equal ones are cut off, any of them will do.
    assert [costs[units] for units in found] == [cost for cost, _ in wanted[:count]]
    if len(wanted) != count:
        assert result.complete == (len(wanted) < count)
    assert (result.status == "unreachable") == (not wanted)


@pytest.mark.parametrize("by", ["units", "success", "depth", "inputs"])
@many(100)
@given(query=queries())
def test_all_optimal_trees_are_found(by: str, query: Drawn) -> None:
    where, goal = query
    wanted = ranked(where, goal, [by])
    result = all_optimal_trees(where, Query(goal, by=by))
    assert sets(result.trees) == sorted((units for cost, units in wanted if cost == wanted[0][0]), key=sorted)
    assert result.complete


def front(where: World, goal: ObjectNode, by: Sequence[str]) -> set[Key]:
    points = {key(costs, by) for costs in brute_force.trees(where, goal)}
    return {
        point
        for point in points
        if not any(
            other != point and all(map(Fraction.__le__, map(Fraction, other), map(Fraction, point)))
            for other in points
        )
    }


@pytest.mark.parametrize(
    "by",
    [
        ("units", "success"),
        ("inputs", "depth"),
        ("depth", "success"),
        ("units", "inputs", "success"),
        ("motions", "depth", "inputs"),
    ],
)
@many(100)
@given(query=queries())
def test_the_pareto_front_is_that_of_trying_every_set(by: tuple[str, ...], query: Drawn) -> None:
    where, goal = query
    wanted = front(where, goal, by)
    result = pareto_trees(where, Query(goal, by=by))
    ours = []
    for tree in result.trees:
        costs = brute_force.costs(where, goal, tree.units)
        assert costs is not None
        ours.append(key(costs, by))
    event(f"{min(len(wanted), 3)} points")
    assert len(ours) == len(set(ours))
    assert set(ours) == wanted
    assert ours == sorted(ours)
    assert result.complete or not wanted


@many(100)
@given(query=queries(), count=st.integers(2, 4), factor=st.sampled_from([1.0, 1.5, 3.0]))
def test_each_diverse_tree_shares_the_fewest_units(query: Drawn, count: int, factor: float) -> None:
    where, goal = query
    result = diverse_trees(where, Query(goal), count, factor=factor)
    found = sets(result.trees)
    all_sets = list(brute_force.tree_sets(where, [goal]))
    if not all_sets:
        assert result.status == "unreachable"
        return
    least = min(map(len, all_sets))
    assert len(found[0]) == least
    for place in range(1, count):
        left = [
            units
            for units in all_sets
            if len(units) <= int(least * factor) and not any(known <= units for known in found[:place])
        ]
        if not left or not found[0]:
            assert len(found) == place
            return
        keys = {units: (max(len(units & known) for known in found[:place]), len(units)) for units in left}
        assert keys[found[place]] == min(keys.values())


@many(100)
@given(query=queries(), other=st.integers(0, 100), third=st.integers(0, 100))
def test_a_menu_is_the_best_tree_for_all_its_dishes(query: Drawn, other: int, third: int) -> None:
    where, goal = query
    things = list(where.foon.objects)
    goals = list(dict.fromkeys([goal, things[other % len(things)], things[third % len(things)]]))
    found = brute_force.tree_sets(where, goals)
    menu = plan_menu(where, Query(*goals, by="inputs"))
    if not found:
        assert menu.together.status == "unreachable"
        assert menu.together.reason
        return
    tree = menu.together.tree
    assert tree is not None
    best = min(key(costs, ("inputs", "units")) for costs in found.values())
    assert key(found[frozenset(tree.units)], ("inputs", "units")) == best
    for each in menu.apart:
        assert each.tree is not None
    assert sum(each.tree.costs.units for each in menu.apart if each.tree) >= len(tree.units)
    for dishes in menu.dishes.values():
        assert dishes
