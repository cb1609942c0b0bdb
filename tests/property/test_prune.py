"""What is printed at the limit has no superfluous unit, against trying to leave out each."""

from __future__ import annotations

from collections.abc import Collection

import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.asp.program import optimisers
from foon_asp.io.folder import Dataset
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import FREE, Constraints
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.tariff import tariffs
from foon_asp.retrieval.decode import decode_tree
from foon_asp.retrieval.prune import pruned
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree
from support import brute_force
from support.examples import many
from support.small_foons import node, queries, world

BY = ["units", "success", "inputs", "depth", "depth,inputs", "2*depth+units", "human,success"]


def paid(by: str, tree: TaskTree) -> list[float]:
    return Objective.parse(by).complete.costs(tree.costs)


def holds(where: World, goal: ObjectNode, units: Collection[UnitId], c: Constraints) -> bool:
    """Say whether units are a task tree under the constraints."""
    costs = brute_force.costs(where, goal, units)
    return (
        costs is not None
        and set(c.use_units) <= set(units)
        and (c.max_depth is None or costs["depth"] <= c.max_depth)
    )


@pytest.mark.parametrize("by", BY)
@many(150)
@given(query=queries(), data=st.data())
def test_a_tree_is_pruned_to_one_that_needs_all_its_units(
    by: str, query: tuple[World, ObjectNode], data: st.DataObject
) -> None:
    where, goal = query
    at_hand, done = brute_force.closure(where, brute_force.every_unit(where))
    assume(goal in at_hand)
    units = sorted(done)
    demanded = tuple(data.draw(st.lists(st.sampled_from(units), max_size=1))) if units else ()
    depth = max(done.values(), default=0)
    constraints = Constraints(
        use_units=demanded,
        max_depth=data.draw(st.none() | st.just(depth)),
        human_steps=data.draw(st.sampled_from([None, None, 0, 1, 2])),
    )
    problem = Problem.of(where, [goal], constraints=constraints)
    human = data.draw(st.lists(st.sampled_from(units), unique=True)) if units and by[0] == "h" else ()
    before = TaskTree.of(where, problem.goals, units, human)
    after = pruned(problem, before, Objective.parse(by).complete)
    event(f"{len(before) - len(after)} units less")
    assert after.executable
    assert set(after.units) <= set(units)
    assert brute_force.replays(where, goal, after.units)
    assert holds(where, goal, after.units, constraints)
    assert paid(by, after) <= paid(by, before)
    assert after == pruned(problem, before, Objective.parse(by).complete)
    for unit in after.units:
        fewer = [other for other in after.units if other != unit]
        without = TaskTree.of(where, problem.goals, fewer, after.human & set(fewer))
        assert not holds(where, goal, fewer, constraints) or paid(by, without) > paid(by, after)


@pytest.mark.parametrize("by", BY)
@many(60)
@given(query=queries())
def test_the_first_tree_of_a_search_is_pruned_as_well(by: str, query: tuple[World, ObjectNode]) -> None:
    """It is what there is at the limit if there is no time left to look for better ones."""
    where, goal = query
    problem, every = Problem.of(where, [goal]), Objective.parse(by).complete
    model = next(optimisers(problem, tariffs(problem, every))).first()
    event("a tree" if model.atoms is not None else "no tree")
    if model.atoms is None:
        return
    tree = pruned(problem, decode_tree(problem, model), every)
    assert holds(where, goal, tree.units, FREE)
    for unit in tree.units:
        fewer = [other for other in tree.units if other != unit]
        without = TaskTree.of(where, tree.goals, fewer, tree.human & set(fewer))
        assert not holds(where, goal, fewer, FREE) or paid(by, without) > paid(by, tree)


@pytest.mark.parametrize("by", ["units", "success", "inputs"])
def test_whenever_the_time_runs_out_no_unit_is_superfluous(built_in: Dataset, by: str) -> None:
    where = built_in.world()
    trees = 0
    for place, goal in enumerate(built_in.goals[::4]):
        answer = retrieve(where, Query(goal, by=by, time_limit=0.03 + 0.02 * place))
        for tree in answer.trees:
            trees += 1
            for unit in tree.units:
                fewer = TaskTree.of(where, tree.goals, [other for other in tree.units if other != unit])
                assert not fewer.executable
    assert trees


def test_a_circle_is_pruned_to_what_leads_to_the_goal() -> None:
    where = world(["a + dish -mix-> b", "b -bake-> dish", "a -wash-> c"], "a")
    problem = Problem.of(where, [node("dish")], founded=False)
    every = TaskTree.of(where, problem.goals, where.foon.units.ids)
    assert set(pruned(problem, every, Objective.parse("units")).units) == {0, 1}


def test_rules_of_the_users_own_may_need_any_unit() -> None:
    where = world(["a -mix-> dish", "a -wash-> c"], "a")
    rules = ('violated("no washing",0) :- not use(1), unit(1).',)
    problem = Problem.of(where, [node("dish")], constraints=Constraints(rules=rules))
    every = TaskTree.of(where, problem.goals, where.foon.units.ids)
    assert pruned(problem, every, Objective.parse("units")) == every
