"""Rates near 0 and 1, chances of 0, long times and large weights, against trying every set of units."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterable
from fractions import Fraction

import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.io.wire import dumps
from foon_asp.model.node import Annotation, Interval, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.planning.wire import plan_answer_json
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import best_trees, diverse_trees, pareto_trees
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import suggest
from support import brute_force
from support.examples import many
from support.small_foons import queries, with_units

RATES = (0.0, 0.0, 1e-12, 0.0001, 0.0004, 0.0005, 0.5, 0.7, 0.9996, 0.9997, 0.9999999, 1.0)
SECONDS = (None, 1, 120, 7200, 100_000, 30_000_000)

Drawn = tuple[World, ObjectNode]


@st.composite
def extremes(draw: st.DrawFn) -> Drawn:
    """Draw a question with such rates, and times for some units."""
    where, goal = draw(queries(rates=RATES))
    units = []
    for unit in where.foon.units:
        seconds = draw(st.sampled_from(SECONDS))
        times = Annotation() if seconds is None else Annotation(times=(Interval(0.0, float(seconds)),))
        units.append(unit.__class__(unit.id, unit.motion, unit.inputs, unit.outputs, times))
    return World.of(with_units(where.foon, units), where.kitchen, strict=where.strict), goal


def timed(where: World, goal: ObjectNode) -> bool:
    """Whether anything is known of the time that a goal takes: else it is no question."""
    return any(where.foon.units[unit].duration for unit in Problem.of(where, [goal]).units)


def chance(where: World, units: Iterable[UnitId], human: int = 0) -> Fraction:
    """Return the exact chance of some units, of which a human does the likeliest to fail."""
    rates = sorted(Fraction(repr(where.kitchen.rates[where.foon.units[unit].motion])) for unit in units)
    return math.prod(rates[human:], start=Fraction(1))


def nats(exact: Fraction) -> float:
    return math.log(exact.denominator) - math.log(exact.numerator) if exact else math.inf


def paid(where: World, units: frozenset[UnitId], criterion: Criterion) -> float:
    """Return what a set of units costs by a sum, in which success counts as -ln of the chance."""
    seconds = sum(where.foon.units[unit].duration or 0 for unit in units)
    costs = {
        "units": len(units),
        "inputs": sum(len(where.foon.units[unit].inputs) for unit in units),
        "time": seconds,
        "success": nats(chance(where, units)),
    }
    return math.fsum(float(weight) * costs[name] for name, weight in criterion.terms)


SUMS = (
    "success",
    "success+units",
    "3*time+success",
    "999999*time+success",
    "time+0.001*success",
    "inputs+100000*success",
    "3000000*success+units",
)


@pytest.mark.parametrize("by", SUMS)
@many(60)
@given(query=extremes())
def test_the_optimum_is_exact_and_the_fewest_units_among_chances_of_0(by: str, query: Drawn) -> None:
    where, goal = query
    sets = brute_force.tree_sets(where, [goal])
    criterion = Criterion.parse(by)
    assume(sets and ("time" not in by or timed(where, goal)))
    answer = retrieve(where, Query(goal, by=by))
    assert answer.tree is not None
    best = min(paid(where, units, criterion) for units in sets)
    ours = paid(where, frozenset(answer.tree.units), criterion)
    event("a chance of 0" if best == math.inf else "a chance")
    if best == math.inf:
        assert ours == math.inf
        fewest = min(len(units) for units in sets)
        assert len(answer.tree.units) == fewest
    elif by == "success":
        assert ours - best <= 1e-5
    else:
        assert ours == pytest.approx(best, rel=1e-5, abs=1e-5)
    assert answer.tree.costs.success == float(chance(where, answer.tree.units))
    assert "Infinity" not in answer.to_json()
    assert all(math.isfinite(bound) for bound in answer.bound.values())


@many(150)
@given(extremes(), st.sampled_from([0, 0, 1, 2]), st.data())
def test_a_least_chance_is_exact(query: Drawn, human: int, data: st.DataObject) -> None:
    where, goal = query
    sets = brute_force.tree_sets(where, [goal])
    assume(sets)
    chances = {units: chance(where, units, human) for units in sets}
    near = float(data.draw(st.sampled_from(sorted(chances.values()))))
    least = data.draw(st.sampled_from([near, near, math.nextafter(near, 2), math.nextafter(near, 0), 0.0005]))
    assume(0 < least <= 1)
    answer = retrieve(where, Query(goal, by="units", min_success=least, human_steps=human or None))
    good = [units for units, exact in chances.items() if exact >= Fraction(repr(least))]
    event("likely enough" if good else "never likely enough")
    if not good:
        assert answer.status == "unreachable"
        # Each constraint alone can be met by giving it up, and one of them has to be.
        assert "success at least" in answer.reason or "human step" in answer.reason
        return
    assert answer.tree is not None
    assert len(answer.tree.units) == min(map(len, good))
    assert frozenset(answer.tree.units) in good


def front(points: Iterable[tuple[int, Fraction]]) -> set[tuple[int, Fraction]]:
    """Return the points that no other beats: less of the first, more of the second."""
    every = set(points)
    return {
        (few, high)
        for few, high in every
        if not any(other != (few, high) and other[0] <= few and other[1] >= high for other in every)
    }


@pytest.mark.parametrize("by", ["units,success", "human,success", "success,units"])
@many(60)
@given(query=extremes())
def test_a_front_has_each_trade_off_once(by: str, query: Drawn) -> None:
    where, goal = query
    sets = brute_force.tree_sets(where, [goal])
    assume(sets)
    if by == "human,success":
        expected = front(
            (human, chance(where, units, human)) for units in sets for human in range(len(units) + 1)
        )
    else:
        expected = front((len(units), chance(where, units)) for units in sets)
    answer = pareto_trees(where, Query(goal, by=by))
    assert answer.complete
    few = "human" if by == "human,success" else "units"
    found = sorted((getattr(tree.costs, few), tree.costs.success or 0) for tree in answer.trees)
    # What differs by less than one in 100,000 may be left out, or be there though something beats it.
    for count, exact in expected:
        assert any(n <= count and p >= float(exact) * (1 - 1e-5) for n, p in found)
    for count, high in found:
        assert all(n > count or (n == count and p == high) or p < high * (1 + 1e-5) for n, p in expected)
    assert sum(high == 0 for _, high in found) <= 1


@many(60)
@given(extremes(), st.sampled_from(["success", "success+units", "3*time+success"]))
def test_several_trees_and_suggestions_end_in_their_order(query: Drawn, by: str) -> None:
    where, goal = query
    sets = brute_force.tree_sets(where, [goal])
    assume(sets and timed(where, goal))
    criterion = Criterion.parse(by)
    for answer in (best_trees(where, Query(goal, by=by), 3), diverse_trees(where, Query(goal, by=by), 3)):
        costs = [paid(where, frozenset(tree.units), criterion) for tree in answer.trees]
        assert costs[0] == pytest.approx(min(paid(where, units, criterion) for units in sets), 1e-5, 1e-5)
        assert "Infinity" not in answer.to_json()
        if answer.kind == "best":
            assert all(a <= b * (1 + 1e-5) + 1e-5 for a, b in itertools.pairwise(costs))
        elif by == "success":
            assert all(cost <= costs[0] + math.log(1.5) + 1e-5 for cost in costs)
        else:
            assert all(cost <= costs[0] * 1.5 * (1 + 1e-5) + 1e-5 for cost in costs)
    dishes = suggest(where, Query(by=by), everything=True)
    assert "Infinity" not in dishes.to_json()
    assert "inf" not in str(dishes)
    menu = plan_menu(where, Query(goal, by=by))
    assert menu.together.tree is not None


@many(80)
@given(extremes(), st.sampled_from(["success", "success+units", "3*time+success"]))
def test_a_plan_says_the_chance_of_its_steps(query: Drawn, by: str) -> None:
    where, goal = query
    sets = brute_force.tree_sets(where, [goal])
    assume(sets and timed(where, goal))
    answer = plan(where, PlanQuery(Query(goal, by=by), semantics="add"))
    assert answer.plan is not None
    units = answer.plan.units
    expected = paid(where, frozenset(units), Criterion.parse(by))
    assert len(set(units)) == len(units)
    if by == "success":
        assert answer.cost == float(chance(where, units))
    else:
        assert answer.cost == (None if expected == math.inf else pytest.approx(expected))
    assert "Infinity" not in dumps(json.loads(dumps(plan_answer_json(answer))))
