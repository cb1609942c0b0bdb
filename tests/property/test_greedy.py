"""Greedy selections: the worklist, the encoding, and brute force over every selection there is."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from itertools import islice
from random import Random

import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.errors import QueryError
from foon_asp.limits import LimitReachedError, limited
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, FunctionalUnit, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.methods.greedy import settled, solved
from foon_asp.retrieval.retrieve import retrieve
from support import brute_force
from support.examples import many
from support.small_foons import MOTIONS, foon, motions, node, with_units, world

HEURISTICS = ["first", "success", "inputs"]
RATES = (1.0, 0.9, 0.9, 0.9003, 0.9001, 0.5)
"""Some are alike, and some differ by less than a thousandth."""

Asked = tuple[World, list[ObjectNode]]
Picks = dict[ObjectNode, FunctionalUnit]


@st.composite
def tangles(draw: st.DrawFn, most: int, rates: Sequence[float]) -> Asked:
    """Draw a world in which most objects have several makers and many circles, and one to three goals."""
    dice = Random(draw(st.integers(0, 1 << 32)))
    while True:
        where = tangle(dice, dice.randint(4, most), rates)
        rounds = where.closure.available
        last = sorted(rounds, key=rounds.__getitem__)[-3:]
        if rounds[last[-1]] > 1:
            return where, [where.node(goal) for goal in dice.sample(last, dice.randint(1, len(last)))]


def tangle(dice: Random, objects: int, rates: Sequence[float]) -> World:
    things = [node(f"o{number}") for number in range(objects)]
    builder = FoonBuilder()
    ids = [builder.object(thing) for thing in things]
    for _ in range(dice.randint(objects, 2 * objects + 2)):
        inputs, outputs = (dice.sample(ids, dice.choice([1, 1, 1, 2, 2, 3])) for _ in range(2))
        builder.unit(dice.choice(MOTIONS), inputs, outputs, Annotation())
    kitchen = Kitchen(tuple(things[:1]), frozenset(), {motion: dice.choice(rates) for motion in MOTIONS})
    return World.of(builder.build(), kitchen)


@pytest.mark.parametrize("founded", [True, False])
@pytest.mark.parametrize("heuristic", HEURISTICS)
@many(100)
@given(asked=tangles(12, RATES))
def test_the_worklist_finds_what_the_encoding_says(heuristic: str, founded: bool, asked: Asked) -> None:
    problem = Problem.of(*asked, founded=founded)
    here, there = settled(problem, heuristic), solved(problem, heuristic)
    assert there.tree is not None
    event("takes a search" if here is None else f"{len(there.tree.units)} units")
    if here is None:
        assert founded
        return
    assert here.tree is not None
    assert here.tree.units == there.tree.units
    assert here.status == there.status == "found"


@pytest.mark.parametrize("heuristic", HEURISTICS)
@many(60)
@given(asked=tangles(7, [1.0, 0.9, 0.8, 0.5]))
def test_both_find_a_best_one_of_all_founded_selections(heuristic: str, asked: Asked) -> None:
    where, goals = asked
    selections = list(islice(all_selections(where, goals, {}), 5000))
    assume(len(selections) < 5000)
    event(f"{len(selections)} selections" if len(selections) < 10 else "more")
    costs = [distance_costs(where, goals, picks, heuristic) for picks in selections]
    best = [
        {unit.id for unit in picks.values()}
        for picks, cost in zip(selections, costs, strict=True)
        if cost == min(costs)
    ]
    problem = Problem.of(where, goals)
    for found in (settled(problem, heuristic), solved(problem, heuristic)):
        assert found is None or (found.tree is not None and set(found.tree.units) in best)


def all_selections(where: World, goals: Sequence[ObjectNode], picks: Picks) -> Iterator[Picks]:
    """Yield every founded selection that has some picks already."""
    open_ = [*goals, *(need for unit in picks.values() for need in brute_force.needs(where, unit))]
    known = {*picks, *where.kitchen.objects}
    wanted = next((thing for thing in open_ if thing not in known), None)
    if wanted is None:
        if is_founded(where, picks):
            yield picks
        return
    for unit in where.foon.units:
        if wanted in brute_force.makes(where, unit):
            yield from all_selections(where, goals, {**picks, wanted: unit})


def is_founded(where: World, picks: Picks) -> bool:
    traced = set(where.kitchen.objects)
    for _ in picks:
        traced |= {thing for thing, unit in picks.items() if brute_force.needs(where, unit) <= traced}
    return picks.keys() <= traced


def distance_costs(
    where: World, goals: Sequence[ObjectNode], picks: Picks, heuristic: str
) -> list[tuple[int, int]]:
    """Return what the picks at each distance from the goals fall short by, and their places in the file."""
    costs: list[tuple[int, int]] = []
    seen = {thing for thing in goals if thing in picks}
    level = set(seen)
    while level:
        demerits = [demerit(where, picks[thing], heuristic) for thing in level]
        costs.append((sum(demerits), sum(place(where, thing, picks[thing].id) for thing in level)))
        needs = {need for thing in level for need in brute_force.needs(where, picks[thing])}
        level = {need for need in needs if need in picks} - seen
        seen |= level
    return costs


def demerit(where: World, unit: FunctionalUnit, heuristic: str) -> int:
    if heuristic == "success":
        return 1000 - round(1000 * where.kitchen.rates[unit.motion])
    return len(unit.inputs) if heuristic == "inputs" else 0


def place(where: World, thing: ObjectNode, number: UnitId) -> int:
    return sum(thing in brute_force.makes(where, unit) for unit in where.foon.units[:number])


# --- Cases ----------------------------------------------------------------------------------------

EACH_FROM_THE_OTHER = (
    "x + y -serve-> goal",
    "y -turn-> x",
    "x -return-> y",
    "a -squeeze-> x",
    "a -press-> y",
)


@pytest.mark.parametrize(
    ("rates", "expected"),
    [
        ({"squeeze": 0.5, "press": 0.4}, {"serve", "squeeze", "return"}),
        ({"squeeze": 0.4, "press": 0.5}, {"serve", "press", "turn"}),
    ],
)
def test_of_two_objects_that_cannot_both_have_their_best_unit_the_better_sum_has_it(
    rates: dict[str, float], expected: set[str]
) -> None:
    """x and y are each best made of the other: which of them has to do with less takes a search."""
    where = world(EACH_FROM_THE_OTHER, "a", rates=rates)
    goal = node("goal")
    assert settled(Problem.of(where, [goal]), "success") is None
    tree = retrieve(where, Query(goal, method="greedy", by="success")).tree
    assert tree is not None
    assert motions(where, tree.units) == expected


def test_what_was_settled_nearer_to_the_goal_is_no_matter_of_a_search() -> None:
    """x is nearer, so it has its best unit, and y, which that needs, cannot be made of it."""
    units = ("x -serve-> goal", *EACH_FROM_THE_OTHER[1:])
    where = world(units, "a", rates={"squeeze": 0.5, "press": 0.4})
    found = settled(Problem.of(where, [node("goal")]), "success")
    assert found is not None
    assert found.tree is not None
    assert motions(where, found.tree.units) == {"serve", "turn", "press"}


def test_objects_that_are_not_settled_are_made_another_way_where_they_must() -> None:
    """b would be made of goal in the earliest round; now that goal is made of c it comes from d."""
    units = (
        "a -quick-> goal",
        "goal -split-> b",
        "a -slow-> d",
        "d -slower-> e",
        "e -slowest-> b",
        "b -best-> c",
        "c -finish-> goal",
    )
    where = world(units, "a", rates={"quick": 0.5, "slowest": 0.1})
    found = settled(Problem.of(where, [node("goal")]), "success")
    assert found is not None
    assert found.tree is not None
    assert motions(where, found.tree.units) == {"finish", "best", "slowest", "slower", "slow"}


@pytest.mark.parametrize("founded", [True, False])
def test_a_unit_that_can_matter_must_have_a_rate(founded: bool) -> None:
    units = foon("a -fry-> goal", "b -guess-> goal", "goal -guess-> other")
    kitchen = Kitchen((node("a"), node("b")), rates={"fry": 0.5})
    query = Query(node("goal"), method="greedy", by="success", founded=founded)
    with pytest.raises(QueryError, match="the motion 'guess' has no success rate"):
        retrieve(World.of(units, kitchen), query)
    rated = with_units(units, units.units[::2])
    assert retrieve(World.of(rated, kitchen), query).status == "found"


def test_at_a_limit_there_is_a_tree_already_if_it_is_founded() -> None:
    """It is that of the earliest round, as long as nothing is settled."""
    where = world(("a -quick-> goal", "a -sure-> b", "b -surely-> goal"), "a", rates={"quick": 0.5})
    founded, free = (Problem.of(where, [node("goal")], founded=founded) for founded in (True, False))
    with limited(seconds=0):
        # What takes a moment is done even where no time is left.
        time.sleep(0.6)
        found = settled(founded, "success")
        with pytest.raises(LimitReachedError):
            settled(free, "success")
    assert found is not None
    assert found.tree is not None
    assert (found.status, found.limit) == ("limit", "time")
    assert motions(where, found.tree.units) == {"quick"}
    in_time = settled(founded, "success")
    assert in_time is not None
    assert in_time.tree is not None
    assert motions(where, in_time.tree.units) == {"sure", "surely"}
