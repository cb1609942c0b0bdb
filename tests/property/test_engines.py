"""The optima of real engines are ours."""

from __future__ import annotations

import pytest
from hypothesis import given

from foon_asp.model.consumption import SEMANTICS
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.examples import many
from support.small_foons import queries


@pytest.mark.parametrize("by", ["units", "success", "2*units+inputs", "units+tools"])
@many(8)
@given(query=queries())
def test_the_optimum_of_fast_downward_is_ours(by: str, query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    if not where.kitchen.utensils:
        by = "units"
    ours = retrieve(where, Query(goal, by=by)).tree
    theirs = plan(where, PlanQuery(Query(goal, by=by), "fast-downward-opt", "add"))
    assert (theirs.status == "unsolvable") == (ours is None)
    if ours is not None:
        mine = plan(where, PlanQuery(Query(goal, by=by), "clingo", "add"))
        assert theirs.status == "optimal"
        costs = {"units": ours.costs.units, "success": ours.costs.success}
        costs["2*units+inputs"] = 2 * ours.costs.units + ours.costs.inputs
        costs["units+tools"] = ours.costs.units + ours.costs.tools
        assert theirs.cost == pytest.approx(costs[by], rel=1e-4)
        # The fewest parallel steps come first for clingo.
        assert mine.plan is not None
        assert theirs.plan is not None
        assert mine.plan.makespan <= theirs.plan.makespan


@pytest.mark.parametrize("semantics", SEMANTICS[1:])
@many(10)
@given(query=queries())
def test_no_plan_is_cheaper_than_the_proven_one(semantics: str, query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    theirs = plan(where, PlanQuery(Query(goal), "fast-downward-opt", semantics))
    ours = plan(where, PlanQuery(Query(goal), "clingo", semantics))
    assert theirs.status in ("optimal", "unsolvable")
    assert (theirs.plan is None) == (ours.plan is None)
    if theirs.plan is not None and ours.plan is not None:
        # One is cheapest, the other takes the fewest parallel steps.
        assert len(theirs.plan.units) <= len(ours.plan.units)
        assert ours.plan.makespan <= theirs.plan.makespan
