"""Suggestions against trying every set of units."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import isclose

import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import suggest
from support import brute_force
from support.dish_checks import takes
from support.examples import many
from support.small_foons import domains

# --- Made with certain things ---------------------------------------------------------------------


def tree_costs(where: World, goal: ObjectId, using: Sequence[str]) -> tuple[list[brute_force.Costs], ...]:
    """Return what trees cost that really use the labels, and those of them with no superfluous unit."""
    dish = where.node(goal)
    numbers = brute_force.every_unit(where)
    found: dict[frozenset[UnitId], brute_force.Costs] = {}
    for size in range(len(numbers) + 1):
        for units in combinations(numbers, size):
            costs = brute_force.costs(where, dish, units)
            if costs is not None:
                found[frozenset(units)] = costs
    takers = {label: {u.id for u in where.foon.units if takes(where, u, label)} for label in using}

    def makes(units: Iterable[UnitId]) -> bool:
        return dish in brute_force.closure(where, units)[0]

    real = [
        costs for units, costs in found.items() if not any(makes(units - takers[label]) for label in takers)
    ]
    small = [
        costs
        for units, costs in found.items()
        if all(units & takers[label] for label in takers) and not any(makes(units - {unit}) for unit in units)
    ]
    return real, small


QUESTIONS = [("units",), ("success",), ("inputs", "units"), ("depth", "units"), ("units", "depth")]


@pytest.mark.parametrize("by", QUESTIONS, ids=",".join)
@many(60)
@given(where=domains(), data=st.data())
def test_best_by_brute_force(by: tuple[str, ...], where: World, data: st.DataObject) -> None:
    """The best tree that really uses something is the best small one that uses it."""
    at_hand, done = brute_force.closure(where, brute_force.every_unit(where))
    made = [thing for thing in where.foon.objects if at_hand.get(thing, 0) > 0]
    inputs = [where.foon.units[unit].inputs for unit in sorted(done)]
    labels = sorted(
        {label for things in inputs for thing in things for label in where.node(thing).named_labels}
    )
    assume(made and labels)
    using = data.draw(st.lists(st.sampled_from(labels), min_size=1, max_size=2, unique=True))
    result = suggest(where, Query(by=by), using=using, everything=True)
    assert result.skipped == 0
    assert result.candidates == len(made)
    found = {where.id_of(each.dish): each for each in result.dishes}
    goal = data.draw(st.sampled_from([where.id_of(thing) for thing in made]))
    real, small = tree_costs(where, goal, using)
    event(f"{len(using)} labels, {'no ' * (not real)}tree")
    assert (goal in found) == bool(real) == bool(small)
    if not real:
        return
    expected = brute_force.best(real, by)
    if "depth" not in by:
        # Superfluous units can only help to be done in fewer rounds.
        assert {name: brute_force.best(small, by)[name] for name in by} == {
            name: expected[name] for name in by
        }
    tree = found[goal].tree
    assert brute_force.replays(where, where.node(goal), tree.units)
    paid = brute_force.costs(where, where.node(goal), tree.units)
    assert paid is not None
    for name in by:
        assert paid[name] == expected[name] or (
            name == "success" and isclose(float(paid[name]), float(expected[name]), rel_tol=1e-4)
        )
    for label in using:
        rest = [unit.id for unit in tree.functional_units if not takes(where, unit, label)]
        assert where.node(goal) not in brute_force.closure(where, rest)[0]


@many(60)
@given(where=domains())
def test_without_ingredients_it_is_the_method_optimal(where: World) -> None:
    result = suggest(where, Query(), everything=True)
    for each in result.dishes:
        alone = retrieve(where, Query(each.dish)).tree
        assert alone is not None
        assert each.costs.units == alone.costs.units
    keys = [(each.costs.units, str(each.dish)) for each in result.dishes]
    assert keys == sorted(keys)
