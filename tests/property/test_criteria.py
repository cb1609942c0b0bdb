"""Every criterion against trying every set of units."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support import brute_force
from support.examples import many
from support.small_foons import queries

Drawn = tuple[World, ObjectNode]


def paid(costs: brute_force.Costs, terms: dict[str, float]) -> float:
    """Return a weighted sum, in which success counts as -ln of the chance."""
    return sum(
        weight * (-math.log(costs[name]) if name == "success" else float(costs[name]))
        for name, weight in terms.items()
    )


LISTS: dict[str, list[dict[str, float]]] = {
    "tools": [{"tools": 1}],
    "dirty": [{"dirty": 1}],
    "motions,tools": [{"motions": 1}, {"tools": 1}],
    "2*units+inputs": [{"units": 2, "inputs": 1}],
    "0.5*dirty+3*motions,inputs": [{"dirty": 0.5, "motions": 3}, {"inputs": 1}],
    "success+0.3*units": [{"success": 1, "units": 0.3}],
    "2*success+inputs": [{"success": 2, "inputs": 1}],
    "motions,2*depth+units": [{"motions": 1}, {"depth": 2, "units": 1}],
    "tools+depth": [{"tools": 1, "depth": 1}],
    "inputs,depth": [{"inputs": 1}, {"depth": 1}],
}


@pytest.mark.parametrize("by", LISTS)
@many(100)
@given(query=queries())
def test_the_optimum_is_that_of_trying_every_set_of_units(by: str, query: Drawn) -> None:
    where, goal = query
    if not where.kitchen.utensils:
        where = World.of(
            where.foon,
            where.kitchen.__class__(where.kitchen.objects, frozenset({"jar"}), where.kitchen.rates),
            strict=where.strict,
        )
    found = brute_force.trees(where, goal)
    result = retrieve(where, Query(goal, by=by))
    event(f"{len(found)} trees" if len(found) < 3 else "many trees")
    if not found:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    best = min([paid(each, terms) for terms in LISTS[by]] for each in found)
    ours = brute_force.costs(where, goal, result.tree.units)
    assert ours is not None
    # Costs of success are rounded to five digits each.
    assert [paid(ours, terms) for terms in LISTS[by]] == pytest.approx(best, abs=1e-3)
    shown = result.tree.costs
    assert {name: getattr(shown, name) for name in ours if name != "success"} == {
        name: value for name, value in ours.items() if name != "success"
    }
    assert shown.success == pytest.approx(float(ours["success"]))


COSTS: dict[str, list[dict[str, float]]] = {
    "cost": [{"cost": 1}],
    "2*cost+0.5*units": [{"cost": 2, "units": 0.5}],
    "inputs,cost": [{"inputs": 1}, {"cost": 1}],
}


@pytest.mark.parametrize("by", COSTS)
@many(100)
@given(query=queries(), data=st.data())
def test_the_least_cost_is_that_of_trying_every_set_of_units(
    by: str, query: Drawn, data: st.DataObject
) -> None:
    """Costs are decimals, and no digit of them is lost."""
    where, goal = query
    decimals = st.decimals(0, 3, places=3).map(float)
    costs = {motion: data.draw(decimals) for motion in where.foon.motions}
    where = World.of(where.foon, replace(where.kitchen, costs=costs), strict=where.strict)
    found = brute_force.trees(where, goal)
    result = retrieve(where, Query(goal, by=by))
    if not found:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    best = min([paid(each, terms) for terms in COSTS[by]] for each in found)
    ours = brute_force.costs(where, goal, result.tree.units)
    assert ours is not None
    assert result.status == "optimal"
    assert result.bound == {}
    assert [paid(ours, terms) for terms in COSTS[by]] == pytest.approx(best, abs=1e-9)
    assert result.tree.costs.cost == float(ours["cost"])


def best_with_human(where: World, goal: ObjectNode, most: int) -> Fraction | None:
    """Return the highest chance if a human may do so many steps, by trying every tree and every split."""
    chances = []
    for units in brute_force.tree_sets(where, [goal]):
        rates = sorted(
            Fraction(round(where.kitchen.rates[where.foon.units[u].motion] * 1000), 1000) for u in units
        )
        chances.append(math.prod(rates[most:], start=Fraction(1)))
    return max(chances, default=None)


@pytest.mark.parametrize("most", [0, 1, 2, 3])
@many(100)
@given(query=queries())
def test_the_split_between_robot_and_human_is_the_best_one(most: int, query: Drawn) -> None:
    where, goal = query
    best = best_with_human(where, goal, most)
    result = retrieve(where, Query(goal, constraints=Constraints(human_steps=most)))
    assert result.by == ("success",)
    if best is None:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    assert result.tree.costs.success == pytest.approx(float(best), rel=1e-4)
    assert len(result.tree.human) <= most
    assert result.tree.human <= set(result.tree.units)


@many(80)
@given(query=queries())
def test_the_fewest_human_steps_for_a_chance_are_found(query: Drawn) -> None:
    where, goal = query
    counts = [most for most in range(9) if (best_with_human(where, goal, most) or 0) >= Fraction(4, 5)]
    result = retrieve(where, Query(goal, by="human", constraints=Constraints(min_success=0.8)))
    if not counts:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    assert result.tree.costs.human == counts[0]
    assert (result.tree.costs.success or 0) >= 0.8 - 1e-4


@many(60)
@given(query=queries())
def test_a_chance_and_a_number_of_human_steps_hold_together(query: Drawn) -> None:
    where, goal = query
    both = Constraints(human_steps=1, min_success=0.7)
    best = best_with_human(where, goal, 1)
    result = retrieve(where, Query(goal, constraints=both))
    assert (result.tree is not None) == (best is not None and best >= Fraction(7, 10))
    if result.tree is None and best is not None:
        assert "at most 1 human step" in result.reason or "success at least 0.7" in result.reason
