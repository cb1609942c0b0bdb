"""Explanations against the definitions."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from hypothesis import event, given

from foon_asp.limits import limited
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.unreachable import Lack, circles, essential, unreachable_reason
from foon_asp.retrieval.conflict import conflict
from foon_asp.retrieval.explain import explain
from foon_asp.retrieval.missing import missing_sets, shrunk
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.steps import StepRole, explain_steps, without_unit
from support import brute_force
from support.examples import many
from support.explanations import as_nodes, stocked
from support.small_foons import domains, queries

Cost = tuple[int, int, int, int]


# --- The least that is missing, by trying every set -----------------------------------------------

# Written from docs/explain.md alone; shares nothing with missing.lp or foon_asp.reasons.


def contents(thing: ObjectNode, state: str | None = None) -> set[str]:
    return {c for s in thing.states for c in s.contents or () if state in (None, s.name)}


def holding(thing: ObjectNode) -> bool:
    return bool(contents(thing)) or any(state.name == "contains" for state in thing.states)


def is_guise(where: World, goal: ObjectNode, thing: ObjectNode) -> bool:
    """Say whether an object is the dish of a goal in another state, vessel or place."""
    relata = {state.relatum for state in thing.states if state.relatum}
    inside = contents(goal, "contains")
    if goal.label in where.kitchen.utensils and holding(goal):
        if thing.label == goal.label and holding(thing):
            return True
        names = inside if len(inside) == 1 else set()
    else:
        names = {goal.label}
    named = bool(({thing.label} | contents(thing) | relata) & names)
    return named or (bool(inside) and contents(thing, "contains") == inside)


def made_by_units(where: World) -> set[ObjectNode]:
    return {thing for unit in where.foon.units for thing in brute_force.makes(where, unit)}


def empty_tool(where: World, thing: ObjectNode) -> bool:
    relata = [state.relatum for state in thing.states if state.relatum]
    return thing.label in where.kitchen.utensils and not relata and not holding(thing)


def cost(where: World, goal: ObjectNode, things: tuple[ObjectNode, ...]) -> Cost:
    made = made_by_units(where)
    return (
        sum(is_guise(where, goal, thing) for thing in things),
        sum(thing in made and not empty_tool(where, thing) for thing in things),
        len(things),
        sum(
            len(contents(thing)) + len({s.name for s in thing.states if not s.relatum and not s.contents})
            for thing in things
        ),
    )


def helps(where: World, goal: ObjectNode, things: tuple[ObjectNode, ...]) -> bool:
    at_hand, _ = brute_force.closure(stocked(where, things), brute_force.every_unit(where))
    return goal in at_hand


def all_sets(where: World, goal: ObjectNode) -> Iterator[tuple[ObjectNode, ...]]:
    """Yield every set of objects that could be added and would help."""
    at_hand, _ = brute_force.closure(where, brute_force.every_unit(where))
    made = made_by_units(where)
    wanted = {thing for unit in where.foon.units for thing in brute_force.needs(where, unit)}
    addable = sorted(
        (
            thing
            for thing in wanted - at_hand.keys() - {goal}
            if thing not in made or not is_guise(where, goal, thing)
        ),
        key=lambda thing: thing.sort_key,
    )
    for size in range(len(addable) + 1):
        for things in itertools.combinations(addable, size):
            if helps(where, goal, things):
                yield things


def is_reachable(where: World, goal: ObjectNode) -> bool:
    return goal in brute_force.closure(where, brute_force.every_unit(where))[0]


@many(300)
@given(query=queries())
def test_the_missing_sets_are_exactly_the_least(query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    if is_reachable(where, goal):
        event("reachable")
        return
    possible = list(all_sets(where, goal))
    one = missing_sets(where, where.id_of(goal))
    every = missing_sets(where, where.id_of(goal), most=1000)
    assert one.proven
    assert every.proven
    assert every.complete
    if not possible:
        event("no set helps")
        assert one.sets == every.sets == ()
        return
    least = min(cost(where, goal, things) for things in possible)
    event(f"guises {least[0]}, prepared {least[1]}, things {least[2]}")
    assert [cost(where, goal, as_nodes(where, each)) for each in one.sets] == [least]
    best = {frozenset(things) for things in possible if cost(where, goal, things) == least}
    assert {frozenset(as_nodes(where, each)) for each in every.sets} == best
    assert len(every.sets) == len(best)
    assert set(one.sets) <= set(every.sets)
    guises = {where.node(thing) for thing in every.same_dish}
    assert guises == {thing for things in best for thing in things if is_guise(where, goal, thing)}


@many(100)
@given(query=queries())
def test_without_time_a_set_still_helps_and_has_nothing_superfluous(
    query: tuple[World, ObjectNode],
) -> None:
    where, goal = query
    if is_reachable(where, goal):
        return
    with limited(0):
        found = missing_sets(where, where.id_of(goal))
    assert bool(found.sets) == any(True for _ in all_sets(where, goal))
    problem = Problem(where, (where.id_of(goal),), founded=False)
    lacking = {thing for unit in problem.units for thing in where.units.needs[unit]} - where.stock.keys()
    for each in [*found.sets, *([shrunk(problem, sorted(lacking), ())] if found.sets else ())]:
        things = as_nodes(where, tuple(each))
        assert helps(where, goal, things)
        assert not any(helps(where, goal, fewer) for fewer in itertools.combinations(things, len(things) - 1))


@many(300)
@given(query=queries())
def test_circles_are_circles_of_what_cannot_be_had(query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    if is_reachable(where, goal) or goal not in made_by_units(where):
        return
    made = made_by_units(where)
    raw = tuple(thing for thing in where.foon.objects if thing not in made or empty_tool(where, thing))
    at_hand, _ = brute_force.closure(stocked(where, raw), brute_force.every_unit(where))
    lack = Lack.of(where, where.id_of(goal))
    event(f"circular: {lack.circular}")
    assert lack.circular == (goal not in at_hand)
    if not lack.circular:
        return
    found = circles(where, lack)
    assert found
    event(f"lengths {sorted(len(circle.units) for circle in found)}")
    for circle in found:
        things = as_nodes(where, circle.objects)
        for thing, unit, following in zip(things, circle.units, (*things[1:], things[0]), strict=True):
            assert thing not in at_hand
            assert thing in brute_force.makes(where, where.foon.units[unit])
            assert following in brute_force.needs(where, where.foon.units[unit])
        makers = {u.id for u in where.foon.units if set(things) & brute_force.makes(where, u)}
        assert makers == {*circle.units, *circle.others}
        assert len(circle.units) + len(circle.others) == len(makers)


@many(200)
@given(query=queries())
def test_the_first_sentence_names_what_every_way_needs(query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    made = made_by_units(where)
    if is_reachable(where, goal) or goal not in made:
        return
    lack = Lack.of(where, where.id_of(goal))
    if lack.circular:
        assert unreachable_reason(Problem.of(where, [goal])).startswith("locked in a circle: ")
        return
    raw = [thing for thing in where.foon.objects if thing not in made or empty_tool(where, thing)]
    needed = {thing for thing in raw if not helps(where, goal, tuple(o for o in raw if o != thing))}
    needed -= set(where.kitchen.objects)
    event(f"{len(needed)} needed")
    assert {where.node(thing) for thing in essential(where, lack)} == needed
    sentence = unreachable_reason(Problem.of(where, [goal]))
    assert sentence.startswith("the kitchen lacks " if needed else "whichever way it is made, the kitchen ")


# --- Constraints ----------------------------------------------------------------------------------


@many(20)
@given(where=domains())
def test_depth_and_number_can_be_what_must_give_way(where: World) -> None:
    for goal in where.foon.objects:
        tree = retrieve(where, Query(goal)).tree
        if tree is None or not tree.units:
            continue
        held = Constraints(max_depth=0, max_units=len(where.foon.units))
        found = explain(where, Query(goal, constraints=held))
        assert (found.status, found.give_way) == ("constrained", ("at most 0 rounds",))
        both = Constraints(max_depth=0, max_units=0)
        assert conflict(Problem.of(where, [goal], constraints=both)) == (
            "at most 0 rounds",
            "at most 0 units",
        )


# --- Steps ----------------------------------------------------------------------------------------


@many(200)
@given(query=queries())
def test_every_step_is_for_the_goal(query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    tree = retrieve(where, Query(goal)).tree
    if tree is None or not tree.units:
        return
    steps = explain_steps(tree)
    event(f"{len(steps)} steps")
    assert [step.place for step in steps] == list(range(1, len(steps) + 1))
    at_hand = set(where.kitchen.objects)
    maker: dict[ObjectNode, int] = {}
    for step in steps:
        needed = brute_force.needs(where, step.unit)
        for taken in step.takes:
            assert taken.at_hand == (taken.node in at_hand)
            assert taken.step == maker.get(taken.node)
            assert taken.at_hand or taken.step is not None or taken.node not in needed
        made = brute_force.makes(where, step.unit)
        assert {each.node for each in step.makes} == made
        for thing in made - at_hand:
            maker.setdefault(thing, step.place)
        for each in step.makes:
            users = [
                later.place
                for later in steps
                if each.node in brute_force.needs(where, later.unit) and maker.get(each.node) == step.place
            ]
            assert list(each.steps) == [place for place in users if place > step.place]
            assert each.goal == (each.node == goal and maker.get(goal) == step.place)
    for step in steps:
        assert step.way[0] == step.place
        assert any(made.goal for made in steps[step.way[-1] - 1].makes)
        for place, following in itertools.pairwise(step.way):
            assert any(following in made.steps for made in steps[place - 1].makes)
        assert len(step.way) == shortest(steps, step.place)


def shortest(steps: tuple[StepRole, ...], place: int) -> int:
    """Return how many steps it takes from one to the goal, itself counted."""
    edge, length = {place}, 1
    while not any(made.goal for at in edge for made in steps[at - 1].makes):
        edge = {user for at in edge for made in steps[at - 1].makes for user in made.steps}
        length += 1
    return length


@many(100)
@given(query=queries())
def test_the_tree_without_a_step_is_the_best_there_is(query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    result = retrieve(where, Query(goal))
    if result.tree is None:
        return
    for unit in result.tree.units:
        others = [other.id for other in where.foon.units if other.id != unit]
        possible = [
            size
            for size in range(len(others) + 1)
            for units in itertools.combinations(others, size)
            if brute_force.costs(where, goal, units) is not None
        ]
        found = without_unit(result, unit)
        tree = found.answer.tree
        event("no tree without it" if tree is None else "another tree")
        if tree is None:
            assert possible == []
            assert found.goes == found.comes == ()
            continue
        assert len(tree.units) == min(possible)
        assert unit in found.goes
        assert {*result.tree.units} - {*found.goes} | {*found.comes} == {*tree.units}
