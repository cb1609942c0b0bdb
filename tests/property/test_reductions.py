"""What reductions leave of a problem, and the bounds before search, against trying every set of units."""

from __future__ import annotations

import math
from collections.abc import Collection

import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.model.kitchen import exact
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.ladder import Ladder, part_of
from foon_asp.query.objective import Criterion, Objective
from foon_asp.query.prices import least_prices
from foon_asp.query.problem import Problem
from foon_asp.query.reduction import narrowed, permitted, reducible, without_superfluous
from foon_asp.query.status import Status
from foon_asp.retrieval.methods.climb import Climb
from foon_asp.retrieval.relaxed import first_tree, keeps
from foon_asp.retrieval.tree import TaskTree
from support import brute_force
from support.examples import many
from support.small_foons import node, queries, world

Trees = dict[frozenset[UnitId], list[float]]

BY = [
    "units",
    "success",
    "inputs,success",
    "depth",
    "2*depth+units,inputs",
    "tools",
    "dirty,motions",
    "success+0.3*units",
    "motions,2*inputs+tools",
]


@st.composite
def problems(draw: st.DrawFn) -> Problem:
    """Draw a problem for which there is a tree but for its constraints."""
    where, goal = draw(queries())
    return Problem.of(where, [goal], constraints=_constraints(draw, where, goal))


def _constraints(draw: st.DrawFn, where: World, goal: ObjectNode) -> Constraints:
    at_hand, done = brute_force.closure(where, brute_force.every_unit(where))
    assume(goal in at_hand)
    some = st.lists(st.sampled_from(sorted(done)), max_size=1).map(tuple) if done else st.just(())
    labels = sorted({label for thing in where.foon.objects for label in thing.named_labels})
    few = st.lists(st.sampled_from(labels), max_size=1).map(tuple)
    motions = st.lists(st.sampled_from(where.foon.motions), max_size=1).map(tuple)
    kind = draw(st.sampled_from(["free", "free", "forbidden", "whole", "human"]))
    if kind == "forbidden":
        return Constraints(
            avoid_units=draw(some),
            avoid_motions=draw(motions),
            without=draw(few),
            without_tools=draw(few),
            only_motions=draw(st.none() | st.just(tuple(where.foon.motions[:3]))),
        )
    if kind == "whole":
        return Constraints(
            use_units=draw(some),
            max_units=draw(st.none() | st.integers(1, 4)),
            max_depth=draw(st.none() | st.integers(1, 3)),
            min_success=draw(st.sampled_from([None, None, 0.5, 0.8])),
        )
    return Constraints(human_steps=draw(st.integers(0, 2))) if kind == "human" else Constraints()


def trees_of(problem: Problem, by: str) -> Trees:
    """Return all trees that keep the constraints, with what they cost by each criterion."""
    every = Objective.parse(by).complete
    where, constraints = problem.world, problem.constraints
    human = constraints.human_steps or 0
    found: Trees = {}
    for units, costs in brute_force.tree_sets(where, [where.node(goal) for goal in problem.goals]).items():
        rates = sorted(where.kitchen.rates[where.foon.units[unit].motion] for unit in units)
        chance = math.prod(map(exact, rates[human:]))
        if not set(constraints.use_units) <= units or not _allowed(where, units, constraints):
            continue
        if len(units) > (constraints.max_units or 99) or costs["depth"] > (constraints.max_depth or 99):
            continue
        if constraints.min_success is not None and chance < exact(constraints.min_success):
            continue
        values = {name: float(value) for name, value in costs.items()} | {"success": -math.log(chance)}
        found[units] = [
            round(sum(float(weight) * values[name] for name, weight in criterion.terms), 9)
            for criterion in every
        ]
    return found


def _allowed(where: World, units: Collection[UnitId], constraints: Constraints) -> bool:
    """Say whether no unit breaks a constraint by itself."""
    for number in units:
        unit = where.foon.units[number]
        things = [where.foon.objects[each] for each in (*unit.inputs, *unit.outputs)]
        handled = {thing.label for thing in things} | {s.relatum for thing in things for s in thing.states}
        touched = handled | {c for thing in things for s in thing.states for c in s.contents or ()}
        if number in constraints.avoid_units or unit.motion in constraints.avoid_motions:
            return False
        if constraints.only_motions is not None and unit.motion not in constraints.only_motions:
            return False
        if not touched.isdisjoint(constraints.without) or not handled.isdisjoint(constraints.without_tools):
            return False
    return True


def least(trees: Trees) -> set[frozenset[UnitId]]:
    """Return the trees that have no superfluous unit."""
    return {units for units in trees if not any(other < units for other in trees)}


@pytest.mark.parametrize("by", BY)
@many(100)
@given(problem=problems())
def test_a_best_tree_is_among_what_is_left(by: str, problem: Problem) -> None:
    every = Objective.parse(by).complete
    assert reducible(problem, every)
    trees = trees_of(problem, by)
    smaller = permitted(problem)
    if smaller is None:
        assert not trees
        return
    left = narrowed(smaller, every)
    event(f"{len(smaller.units) - len(left.units)} units less")
    among = {units: costs for units, costs in trees.items() if units <= set(left.units)}
    assert min(among.values(), default=None) == min(trees.values(), default=None)
    if left.forced and trees:
        assert frozenset(left.units) in among


@pytest.mark.parametrize("by", ["units", "depth"])
@many(150)
@given(problem=problems())
def test_no_tree_is_lost_that_has_no_superfluous_unit(by: str, problem: Problem) -> None:
    trees = trees_of(problem, by)
    left = without_superfluous(problem, Objective.parse(by).complete)
    among = {units: costs for units, costs in trees.items() if units <= set(left.units)}
    event(f"{len(problem.units) - len(left.units)} units less")
    assert least(trees) == least(among)
    # A tree may be worth its superfluous units: they make something earlier.
    points = {tuple(costs) for costs in trees.values()}
    kept = {tuple(costs) for costs in among.values()}
    assert all(any(all(map(float.__le__, one, other)) for one in kept) for other in points)


@pytest.mark.parametrize("by", ["units", "success", "inputs", "depth", "2*units+inputs", "success+0.3*depth"])
@many(100)
@given(problem=problems())
def test_no_tree_is_cheaper_than_what_one_of_its_units_takes(by: str, problem: Problem) -> None:
    part, criterion = part_of(problem), Criterion.parse(by)
    ladder = Ladder.of(problem, part, criterion)
    if ladder is None:
        assert not least_prices(problem, criterion, part.units).any()
        return
    trees = trees_of(problem, by)
    reach = dict(zip(problem.units, ladder.reach.tolist(), strict=True))
    for units in least(trees):
        cost = trees[units][0] + 1e-8
        assert ladder.least <= cost
        assert all(reach[unit] <= cost for unit in units)
        assert units <= set(ladder.upto(trees[units][0]).units)


@pytest.mark.parametrize("by", BY)
@many(40)
@given(problem=problems())
def test_climbing_ends_at_the_best_tree(by: str, problem: Problem) -> None:
    """From one unit on, so that small FOONs have stages, too."""
    objective = Objective.parse(by)
    smaller = permitted(problem)
    trees = trees_of(problem, by)
    if smaller is None or not smaller.units:
        return
    found = Climb(smaller, objective, first_stage=1).found()
    event(found.status)
    assert found.status == (Status.OPTIMAL if trees else Status.UNREACHABLE)
    if found.tree is not None:
        assert trees[frozenset(found.tree.units)] == pytest.approx(min(trees.values()), abs=1e-4)


@pytest.mark.parametrize("by", ["units", "success", "depth,inputs"])
@many(150)
@given(problem=problems())
def test_a_first_tree_is_one_that_keeps_the_constraints(by: str, problem: Problem) -> None:
    every = Objective.parse(by).complete
    smaller = permitted(problem)
    if smaller is None:
        return
    trees = trees_of(problem, by)
    tree = first_tree(smaller, part_of(smaller), every)
    event("a tree" if tree else "none")
    if tree is None:
        assert (
            any(
                value is not None
                for value in (problem.constraints.max_units, problem.constraints.min_success)
            )
            or not trees
        )
    else:
        assert every.costs(tree.costs) == trees[frozenset(tree.units)]


def test_a_tree_keeps_a_least_chance_exactly() -> None:
    where = world(["a -mix-> b", "b -mix-> dish"], "a", rates={"mix": 0.7})
    for chance, kept in ((0.49, True), (0.4900000001, False)):
        problem = Problem.of(where, [node("dish")], constraints=Constraints(min_success=chance))
        assert keeps(problem, TaskTree.of(where, problem.goals, problem.units)) is kept
