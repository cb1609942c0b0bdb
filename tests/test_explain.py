"""Explanations: what is missing is exactly the least, circles are circles, steps are there for a reason."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import brute_force
import pytest
from conftest import ROOT
from hypothesis import event, given
from jsonschema import Draft202012Validator
from small_foons import domain, domains, many, node, nodes, queries, written

from foon_asp.constraints import Constraints
from foon_asp.dataset import Dataset
from foon_asp.errors import QueryError
from foon_asp.explain import (
    MOST,
    Explanation,
    Near,
    Step,
    explain,
    explain_steps,
    first_sentence,
    missing_sets,
    shrunk,
    without_unit,
)
from foon_asp.goals import find_goal
from foon_asp.graph import ObjectNode
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain, Problem
from foon_asp.reasons import Lack, circles, essential
from foon_asp.render.explain import explanation_text, explanation_value, reason_text
from foon_asp.retrieve import conflict, retrieve

Cost = tuple[int, int, int, int]


# --- The least that is missing, by trying every set -----------------------------------------------
# Written from docs/explain.md alone; shares nothing with missing.lp or foon_asp.reasons.


def contents(thing: ObjectNode, state: str | None = None) -> set[str]:
    return {c for s in thing.states for c in s.contents or () if state in (None, s.name)}


def holding(thing: ObjectNode) -> bool:
    return bool(contents(thing)) or any(state.name == "contains" for state in thing.states)


def is_guise(where: Domain, goal: ObjectNode, thing: ObjectNode) -> bool:
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


def made_by_units(where: Domain) -> set[ObjectNode]:
    return {thing for unit in where.foon.units for thing in brute_force.makes(where, unit)}


def empty_tool(where: Domain, thing: ObjectNode) -> bool:
    relata = [state.relatum for state in thing.states if state.relatum]
    return thing.label in where.kitchen.utensils and not relata and not holding(thing)


def cost(where: Domain, goal: ObjectNode, things: tuple[ObjectNode, ...]) -> Cost:
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


def stocked(where: Domain, things: tuple[ObjectNode, ...]) -> Domain:
    kitchen = replace(where.kitchen, objects=(*where.kitchen.objects, *things))
    return Domain(where.foon, kitchen, strict=where.strict, level=where.level)


def helps(where: Domain, goal: ObjectNode, things: tuple[ObjectNode, ...]) -> bool:
    at_hand, _ = brute_force.closure(stocked(where, things), range(len(where.foon.units)))
    return goal in at_hand


def all_sets(where: Domain, goal: ObjectNode) -> Iterator[tuple[ObjectNode, ...]]:
    """Yield every set of objects that could be added and would help."""
    at_hand, _ = brute_force.closure(where, range(len(where.foon.units)))
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


def as_nodes(where: Domain, numbers: tuple[int, ...]) -> tuple[ObjectNode, ...]:
    return tuple(where.node(number) for number in numbers)


def is_reachable(where: Domain, goal: ObjectNode) -> bool:
    return goal in brute_force.closure(where, range(len(where.foon.units)))[0]


@many(300)
@given(query=queries())
def test_the_missing_sets_are_exactly_the_least(query: tuple[Domain, ObjectNode]) -> None:
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
    query: tuple[Domain, ObjectNode],
) -> None:
    where, goal = query
    if is_reachable(where, goal):
        return
    found = missing_sets(where, where.id_of(goal), time_limit=0)
    assert bool(found.sets) == any(True for _ in all_sets(where, goal))
    problem = Problem(where, (where.id_of(goal),), founded=False)
    lacking = {thing for unit in problem.units for thing in where.reading.needs[unit]} - where.stock.keys()
    for each in [*found.sets, *([shrunk(problem, sorted(lacking), ())] if found.sets else ())]:
        things = as_nodes(where, tuple(each))
        assert helps(where, goal, things)
        assert not any(helps(where, goal, fewer) for fewer in itertools.combinations(things, len(things) - 1))


@many(300)
@given(query=queries())
def test_circles_are_circles_of_what_cannot_be_had(query: tuple[Domain, ObjectNode]) -> None:
    where, goal = query
    if is_reachable(where, goal) or goal not in made_by_units(where):
        return
    made = made_by_units(where)
    raw = tuple(thing for thing in where.foon.objects if thing not in made or empty_tool(where, thing))
    at_hand, _ = brute_force.closure(stocked(where, raw), range(len(where.foon.units)))
    lack = Lack.of(where, where.id_of(goal))
    event(f"circular: {lack.circular}")
    assert lack.circular == (goal not in at_hand)
    if not lack.circular:
        return
    found = circles(where, lack)
    assert found
    event(f"lengths {sorted(len(circle.units) for circle in found)}")
    for circle in found:
        things = as_nodes(where, circle.things)
        for thing, unit, following in zip(things, circle.units, (*things[1:], things[0]), strict=True):
            assert thing not in at_hand
            assert thing in brute_force.makes(where, where.foon.units[unit])
            assert following in brute_force.needs(where, where.foon.units[unit])
        makers = {u.id for u in where.foon.units if set(things) & brute_force.makes(where, u)}
        assert makers == {*circle.units, *circle.others}
        assert len(circle.units) + len(circle.others) == len(makers)


@many(200)
@given(query=queries())
def test_the_first_sentence_names_what_every_way_needs(query: tuple[Domain, ObjectNode]) -> None:
    where, goal = query
    made = made_by_units(where)
    if is_reachable(where, goal) or goal not in made:
        return
    lack = Lack.of(where, where.id_of(goal))
    if lack.circular:
        assert first_sentence(where.problem([goal])).startswith("locked in a circle: ")
        return
    raw = [thing for thing in where.foon.objects if thing not in made or empty_tool(where, thing)]
    needed = {thing for thing in raw if not helps(where, goal, tuple(o for o in raw if o != thing))}
    needed -= set(where.kitchen.objects)
    event(f"{len(needed)} needed")
    assert {where.node(thing) for thing in essential(where, lack)} == needed
    sentence = first_sentence(where.problem([goal]))
    assert sentence.startswith("the kitchen lacks " if needed else "whichever way it is made, the kitchen ")


# --- Guises of the dish ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("units", "goal", "missing"),
    [
        # Only what units make of other things is a guise of the dish; the rest is bought.
        (("flour -bake-> pie", "pie[cold] -heat-> pie"), "pie", "flour"),
        (("flour + salt -bake-> pie", "plate{pie} -take-> pie"), "pie", "flour + salt"),
        (("flour + salt -bake-> pie", "pan[warm]@pie -lift-> pie"), "pie", "flour + salt"),
        (("flour + x -bake-> pie{a,b}", "dish{a,b} -lift-> pie{a,b}"), "pie{a,b}", "flour + x"),
        (("flour + x -bake-> pie{a,b}", "dish{a,b,c} -sort-> pie{a,b}"), "pie{a,b}", "dish{a,b,c}"),
        # The dish in another guise is better than nothing, but only if no unit makes it.
        (("pie[cold] + (oven) -heat-> pie",), "pie", "pie[cold] + (oven)"),
        (("plate{pie} -take-> pie",), "pie", "plate{pie}"),
        (("pie[cold] -heat-> pie", "pie -cool-> pie[cold]"), "pie", None),
        # An empty vessel is no dish, and what it holds is.
        (("bowl[empty] + egg -crack-> bowl{egg,salt}",), "bowl{egg,salt}", "bowl[empty] + egg"),
        (
            ("bowl{a} -m-> bowl{a,b}", "bowl[empty] + x + y -n-> bowl{a,b}"),
            "bowl{a,b}",
            "bowl[empty] + x + y",
        ),
        (("soup@pan -pour-> bowl{soup}", "x + y -cook-> bowl{soup}"), "bowl{soup}", "x + y"),
        (("water@jug -pour-> bowl{water}",), "bowl{water}", "water@jug"),
        # Raw comes before prepared, however much it is; an empty vessel is raw though units empty it.
        (("a -m-> p", "p -n-> goal", "p -back-> a", "b + c + d -o-> goal"), "goal", "b + c + d"),
        (("bowl[empty] + a -m-> goal", "bowl{goal} -n-> bowl[empty]"), "goal", "bowl[empty] + a"),
        (("p + q -m-> goal", "p -n-> q", "q -o-> p"), "goal", "p"),
        # Of as many things the plainest are best.
        (("cup{a,b} -m-> goal", "cup{a} -n-> goal"), "goal", "cup{a}"),
        (("cup[wet,cold] -m-> goal", "cup[wet] -n-> goal"), "goal", "cup[wet]"),
        # No unit makes it.
        (("goal -m-> b",), "goal", None),
    ],
)
def test_the_dish_in_another_guise_comes_last(units: tuple[str, ...], goal: str, missing: str | None) -> None:
    where = domain(units, utensils=("bowl",))
    found = explain(where, node(goal), everything=True)
    sets = {frozenset(as_nodes(where, each)) for each in found.missing.sets} if found.missing else set()
    expected = set() if missing is None else {frozenset(nodes(missing))}
    if units[0].startswith("p + q"):
        expected.add(frozenset([node("q")]))
    assert sets == expected


def test_the_goal_is_never_missing_nor_what_is_there() -> None:
    where = domain(["a + b -m-> goal", "goal -n-> b"], "a")
    found = explain(where, node("goal"))
    assert [str(thing.node) for thing in found.things] == ["b [ready]"]


def test_no_more_sets_are_sought_than_asked_for() -> None:
    units = ["a + b + c + d + e + f -mix-> goal"]
    units += [f"{thing}{k} -make-> {thing}" for thing in "abcdef" for k in range(2)]
    units += [f"{thing} -unmake-> {thing}{k}" for thing in "abcdef" for k in range(2)]
    where = domain(units)
    found = explain(where, node("goal"), everything=True)
    assert found.missing is not None
    assert (len(found.missing.sets), found.missing.complete) == (MOST, False)
    assert f"There are more: no more than {MOST} were looked for." in explanation_text(found)
    every = explain(where, node("goal"), everything=True, most=1000)
    assert every.missing is not None
    assert (len(every.missing.sets), every.missing.complete) == (3**6, True)


# --- What there is instead ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kitchen", "lacks", "nearest"),
    [
        ("egg[boiled]", "egg[raw]", ["egg[boiled]"]),
        ("egg[raw]@box + egg[boiled]", "egg[raw]", ["egg[raw]@box", "egg[boiled]"]),
        ("cake{egg,flour}", "egg[raw]", []),
        ("bowl{egg} + bowl{egg,flour,salt}", "egg[raw]", ["bowl{egg}"]),
        ("bowl{oil} + oil@can", "bowl{milk}", []),
        ("bowl{milk,sugar} + milk@can + cup{milk}", "bowl{milk}", ["cup{milk}", "milk@can"]),
        ("cup{a} + bowl{a} + cup{b}", "bowl{a,b}", ["bowl{a}", "cup{b}", "cup{a}"]),
        ("(drinking glass) + (pan)", "drinking glas[empty]", ["(drinking glass)"]),
        ("(bowl) + (rice bowl) + onion", "salad bowl[empty]", ["(bowl)"]),
        ("bowl{soy sauce}", "cup{sauce}", ["bowl{soy sauce}"]),
        ("(cutter) + (cutting board)", "(pizza cutter)", ["(cutter)"]),
        ("leaf green", "(green)", []),
    ],
)
def test_what_the_kitchen_has_instead(kitchen: str, lacks: str, nearest: list[str]) -> None:
    where = domain([f"{lacks} -m-> goal"], kitchen, utensils=("bowl", "cup", "salad bowl"))
    [thing] = explain(where, node("goal")).things
    assert [written(near.node) for near in thing.near] == nearest
    assert all(near.at_hand for near in thing.near)


def test_what_the_kitchen_can_make_instead() -> None:
    where = domain(["egg[whole] -crack-> egg[raw]", "egg[boiled] -m-> goal"], "egg[whole]")
    [thing] = explain(where, node("goal")).things
    assert thing.near == (Near(node("egg[whole]"), True), Near(node("egg[raw]"), False))


def test_what_resembles_a_goal_that_no_unit_makes() -> None:
    where = domain(["egg[raw] -boil-> egg[boiled]"], "egg[raw]")
    found = explain(where, node("egg[raw]"))
    assert (found.status, found.steps) == ("reachable", ())
    assert explanation_text(found) == "egg [raw]\nnothing to do: the kitchen has it\n"
    empty = explain(domain(["egg[raw] -boil-> egg[boiled]"], "egg[old]"), node("egg[raw]"))
    assert (
        explanation_text(empty)
        == "egg [raw]\nno task tree: no unit makes egg [raw]\n  the kitchen has egg [old]\n"
    )


# --- Constraints ----------------------------------------------------------------------------------


def test_the_constraints_that_must_give_way_are_named(built_in: Dataset) -> None:
    where = built_in.domain()
    held = Constraints(avoid_motions=("shake",), max_units=5, without_tools=("oven",))
    found = explain(where, built_in.goals[0], constraints=held)
    assert (found.status, found.give_way, found.missing) == ("constrained", ("avoid motion shake",), None)
    assert found.reason in explanation_text(found)
    assert retrieve(where, built_in.goals[0], constraints=replace(held, avoid_motions=())).tree is not None


def test_constraints_that_the_missing_things_do_not_help_against() -> None:
    units = ["a + b -fry-> goal", "a -boil-> b[done]"]
    held = Constraints(avoid_motions=("fry",), max_units=7)
    found = explain(domain(units, "a"), node("goal"), constraints=held)
    assert (found.status, found.give_way) == ("unreachable", ("avoid motion fry",))
    assert explanation_text(found).endswith(
        "\nEven then there is no task tree, unless these constraints give way:\n  avoid motion fry\n"
    )
    boiling = explain(domain(units, "a"), node("goal"), constraints=Constraints(avoid_motions=("boil",)))
    assert boiling.give_way == ()


@many(20)
@given(where=domains())
def test_depth_and_number_can_be_what_must_give_way(where: Domain) -> None:
    for goal in where.foon.objects:
        tree = retrieve(where, goal).tree
        if tree is None or not tree.units:
            continue
        held = Constraints(max_depth=0, max_units=len(where.foon.units))
        found = explain(where, goal, constraints=held)
        assert (found.status, found.give_way) == ("constrained", ("at most 0 rounds",))
        both = Constraints(max_depth=0, max_units=0)
        assert conflict(where.problem([goal], constraints=both)) == (
            "at most 0 rounds",
            "at most 0 units",
        )


# --- Steps ----------------------------------------------------------------------------------------


@many(200)
@given(query=queries())
def test_every_step_is_for_the_goal(query: tuple[Domain, ObjectNode]) -> None:
    where, goal = query
    tree = retrieve(where, goal).tree
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


def shortest(steps: tuple[Step, ...], place: int) -> int:
    """Return how many steps it takes from one to the goal, itself counted."""
    edge, length = {place}, 1
    while not any(made.goal for at in edge for made in steps[at - 1].makes):
        edge = {user for at in edge for made in steps[at - 1].makes for user in made.steps}
        length += 1
    return length


@many(100)
@given(query=queries())
def test_the_tree_without_a_step_is_the_best_there_is(query: tuple[Domain, ObjectNode]) -> None:
    where, goal = query
    result = retrieve(where, goal)
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
        tree = found.retrieval.tree
        event("no tree without it" if tree is None else "another tree")
        if tree is None:
            assert possible == []
            assert found.goes == found.comes == ()
            continue
        assert len(tree.units) == min(possible)
        assert unit in found.goes
        assert {*result.tree.units} - {*found.goes} | {*found.comes} == {*tree.units}


def test_a_forced_step_that_nothing_needs() -> None:
    where = domain(["a -m-> goal", "a -n-> b"], "a")
    found = explain(where, node("goal"), constraints=Constraints(use_units=(1,)))
    idle = next(step for step in found.steps if step.unit.id == 1)
    assert idle.way == ()
    assert "nothing that a later step needs" in explanation_text(found)


def test_a_step_that_is_not_in_the_tree_names_those_that_are(built_in: Dataset) -> None:
    with pytest.raises(QueryError, match=r"unit 0 is not in the task tree of whipped cream .* 48 shake, 49"):
        explain(built_in.domain(), built_in.goals[0], step=0)
    with pytest.raises(QueryError, match="name the step to do without: --step ID"):
        explain(built_in.domain(), built_in.goals[0], instead=True)


# --- Text -----------------------------------------------------------------------------------------


CIRCLE = (
    "flour + yeast -knead-> dough",
    "dough -save-> starter",
    "starter -feed-> yeast",
    "dough -bake-> bread",
)


def test_text_of_a_circle() -> None:
    where = domain(CIRCLE, "flour + yeast[dry]")
    assert explanation_text(explain(where, node("bread"), everything=True)) == (
        "bread [ready]\n"
        "no task tree: locked in a circle: dough [ready] is needed to make itself (unit 0, unit 2, unit 1)\n"
        "\n"
        "It could be made if the kitchen had one of these 3 choices:\n"
        "  a) yeast [ready] (prepared)\n"
        "  b) dough [ready] (prepared)\n"
        "  c) starter [ready] (prepared)\n"
        "\n"
        "This goes round in a circle:\n"
        "  knead makes dough [ready]\n"
        "      and needs yeast [ready]\n"
        "  feed makes yeast [ready]\n"
        "      and needs starter [ready]\n"
        "  save makes starter [ready]\n"
        "      and needs dough [ready] again\n"
    )


def kitchen_without(dataset: Dataset, *labels: str) -> Domain:
    objects = tuple(thing for thing in dataset.kitchen.objects if thing.label not in labels)
    return Domain(dataset.foon, replace(dataset.kitchen, objects=objects))


def test_text_of_what_is_missing(built_in: Dataset) -> None:
    where = kitchen_without(built_in, "jar", "heavy cream", "mixing bowl")
    found = explain(where, built_in.goals[0], everything=True)
    assert explanation_text(found) == (
        "whipped cream [creamy, whipped] in [mixing bowl]\n"
        "no task tree: the kitchen lacks heavy cream [cold] in [cup], and no unit makes it\n"
        "\n"
        "It could be made if the kitchen had these 2 things:\n"
        "  heavy cream [cold] in [cup]\n"
        "  mixing bowl [empty]\n"
        "      the kitchen has bowl [empty]\n"
        "Nothing else as small would do.\n"
    )


def test_text_of_choices() -> None:
    units = ["(oven) + dough -bake-> bread", "flour + oil@can -mix-> dough", "flour + milk@jug -mix-> dough"]
    assert explanation_text(explain(domain(units, "flour + oil@bowl"), node("bread"), everything=True)) == (
        "bread [ready]\n"
        "no task tree: the kitchen lacks oven, and no unit makes it\n"
        "\n"
        "It could be made if the kitchen had 2 more things. In any case:\n"
        "  oven\n"
        "and one of these 2 choices:\n"
        "  a) oil in [can]\n"
        "  b) milk in [jug]\n"
    )


def test_text_of_the_dish_in_another_state() -> None:
    text = explanation_text(explain(domain(["egg[raw] + (pot) -boil-> egg[boiled]"]), node("egg[boiled]")))
    assert text == (
        "egg [boiled]\n"
        "no task tree: the kitchen lacks egg [raw] and pot, and no unit makes them\n"
        "\n"
        "It could be made if the kitchen had these 2 things:\n"
        "  egg [raw] (the same thing in another state or place)\n"
        "  pot\n"
    )


def test_text_where_nothing_helps() -> None:
    where = domain(["soup[raw] -boil-> soup[raw] + soup[hot]"], "soup[cold]")
    assert explanation_text(explain(where, node("soup[hot]"))) == (
        "soup [hot]\n"
        "no task tree: locked in a circle: soup [raw] is needed to make itself (unit 0)\n"
        "\n"
        "Nothing that could be added to the kitchen would help, but the dish itself.\n"
        "  the kitchen has soup [cold]\n"
        "\n"
        "This goes round in a circle:\n"
        "  boil makes soup [raw]\n"
        "      and needs it itself\n"
        "  the kitchen has soup [cold]\n"
    )


def test_the_first_sentence_can_be_told_before_the_rest(built_in: Dataset) -> None:
    where = kitchen_without(built_in, "lemon")
    goal = find_goal(where, "lemonade", built_in.goals)
    problem = where.problem([goal])
    head = reason_text(goal, first_sentence(problem))
    found = explain(where, goal)
    assert head.endswith("no task tree: the kitchen lacks lemon [whole], and no unit makes it\n")
    assert head + explanation_text(found, told=True) == explanation_text(found)
    assert first_sentence(built_in.domain().problem([goal])) == ""


def test_text_of_a_tree_and_its_steps(built_in: Dataset) -> None:
    where = built_in.domain()
    assert explanation_text(explain(where, built_in.goals[0])) == (
        "whipped cream [creamy, whipped] in [mixing bowl]\n"
        "5 steps\n"
        "\n"
        "  1. pour [FOON.txt:489], unit 45\n"
        "     jar {heavy cream}: for step 2\n"
        "  2. add [FOON.txt:498], unit 46\n"
        "     jar {heavy cream, powdered sugar}: for step 3\n"
        "  3. close [FOON.txt:506], unit 47\n"
        "     jar [closed] {heavy cream, powdered sugar}: for step 4\n"
        "  4. shake [FOON.txt:513], unit 48\n"
        "     jar {whipped cream}: for step 5\n"
        "  5. scrape out [FOON.txt:520], unit 49\n"
        "     whipped cream [creamy, whipped] in [mixing bowl]: the goal\n"
    )
    assert explanation_text(explain(where, built_in.goals[0], step=48, instead=True)) == (
        "whipped cream [creamy, whipped] in [mixing bowl]\n"
        "step 4 of 5: shake [FOON.txt:513], unit 48\n"
        "\n"
        "  takes  jar [closed] {heavy cream, powdered sugar} from step 3 (close)\n"
        "  makes  jar {whipped cream}: for step 5 (scrape out)\n"
        "  so     4 shake → 5 scrape out → whipped cream [creamy, whipped] in [mixing bowl]\n"
        "\n"
        "               with it  without it\n"
        "  units              5           6\n"
        "  inputs             9          12\n"
        "  success         0.32       0.403\n"
        "  depth              5           6\n"
        "  tools              4           4\n"
        "  dirty              3           2\n"
        "  motions            5           4\n"
        "\n"
        "without it these steps go (5) and come (6):\n"
        "  -   1. pour [FOON.txt:489], unit 45\n"
        "  -   2. add [FOON.txt:498], unit 46\n"
        "  -   3. close [FOON.txt:506], unit 47\n"
        "  -   4. shake [FOON.txt:513], unit 48\n"
        "  -   5. scrape out [FOON.txt:520], unit 49\n"
        "  +   1. chill [FOON.txt:538], unit 50\n"
        "  +   2. pour [FOON.txt:547], unit 51\n"
        "  +   3. add [FOON.txt:558], unit 52\n"
        "  +   4. add [FOON.txt:568], unit 53\n"
        "  +   5. whisk [FOON.txt:578], unit 54\n"
        "  +   6. whisk [FOON.txt:588], unit 55\n"
    )


def test_text_of_a_step_that_cannot_be_spared() -> None:
    where = domain(
        ["(knife) + a -cut-> b + peel", "b + peel -fry-> c", "peel + c + a -mix-> goal"], "a + (knife)"
    )
    assert explanation_text(explain(where, node("goal"), step=0, instead=True)) == (
        "goal [ready]\n"
        "step 1 of 3: cut, unit 0\n"
        "\n"
        "  takes  knife from the kitchen\n"
        "         a [ready] from the kitchen\n"
        "  makes  b [ready]: for step 2 (fry)\n"
        "         peel [ready]: for step 2 (fry), step 3 (mix)\n"
        "  so     1 cut → 3 mix → goal [ready]\n"
        "\n"
        "There is no task tree without it.\n"
    )


def test_the_examples_of_the_docs_are_real(built_in: Dataset, universal: Dataset) -> None:
    poor = kitchen_without(built_in, "feta cheese", "mixing bowl")
    salad = find_goal(poor, "greek salad", built_in.goals)
    cream = built_in.goals[0]
    rice = next(goal for goal in universal.goals if goal.label == "fried rice")
    texts = [
        explanation_text(explain(poor, salad)),
        explanation_text(explain(built_in.domain(), cream, step=48, instead=True)),
        explanation_text(explain(universal.domain(), rice)),
    ]
    real = {line for text in texts for line in text.splitlines()}
    page = (ROOT / "docs" / "explain.md").read_text(encoding="utf-8")
    shown = [line[4:] for line in page.split("## In Python")[0].splitlines() if line.startswith("    ")]
    assert len(shown) > 20
    assert {line for line in shown if line != "…" and not line.startswith("$")} <= real


# --- JSON -----------------------------------------------------------------------------------------

SCHEMA = json.loads((ROOT / "docs" / "schema" / "explain.schema.json").read_text(encoding="utf-8"))


def value(explanation: Explanation) -> dict[str, Any]:
    """Return an explanation as JSON, checked against its schema."""
    found = explanation_value(explanation)
    Draft202012Validator(SCHEMA).validate(found)
    assert json.loads(json.dumps(found)) == found
    return found


def test_json_of_what_is_missing(built_in: Dataset) -> None:
    where = domain(CIRCLE, "flour + yeast[dry]")
    found = value(explain(where, node("bread"), everything=True))
    assert (found["status"], found["missing"]["sets"]) == ("unreachable", [[0], [1], [2]])
    assert [thing["object"]["label"] for thing in found["missing"]["things"]] == ["yeast", "dough", "starter"]
    assert found["missing"]["things"][0]["nearest"][0]["at_hand"]
    [circle] = found["circles"]
    assert [link["unit"]["motion"] for link in circle["links"]] == ["knead", "feed", "save"]
    assert [link["needs"]["label"] for link in circle["links"]] == ["yeast", "starter", "dough"]
    assert found["steps"] == []
    assert found["costs"] is found["instead"] is None
    nothing = value(explain(domain(["soup[raw] -boil-> soup[raw] + soup[hot]"], "soup"), node("soup[hot]")))
    assert nothing["missing"]["sets"] == []
    assert nothing["nearest"][0]["object"]["states"] == ["ready"]
    held = Constraints(avoid_motions=("shake",), max_units=5)
    assert value(explain(built_in.domain(), built_in.goals[0], constraints=held))["give_way"] == [
        "avoid motion shake"
    ]


def test_json_of_steps(built_in: Dataset) -> None:
    where = built_in.domain()
    for goal in built_in.goals[:6]:
        found = value(explain(where, goal))
        assert found["costs"]["units"] == len(found["steps"])
        assert all(step["way"] for step in found["steps"])
    found = value(explain(where, built_in.goals[0], step=48, instead=True))
    assert [step["way"] for step in found["steps"]] == [[4, 5]]
    assert (found["instead"]["status"], found["instead"]["costs"]["units"]) == ("optimal", 6)
    assert [unit["motion"] for unit in found["instead"]["comes"]][-1] == "whisk"
    alone = domain(["a -m-> goal"], "a")
    assert value(explain(alone, node("goal"), step=0, instead=True))["instead"]["status"] == "unreachable"
    assert value(explain(where, built_in.goals[2], time_limit=0))["status"] == "limit"


def test_the_schema_is_strict() -> None:
    open_ = [SCHEMA]
    while open_:
        part = open_.pop()
        open_ += [item for item in part.values() if isinstance(item, dict)]
        open_ += [
            item
            for items in part.values()
            if isinstance(items, list)
            for item in items
            if isinstance(item, dict)
        ]
        if part.get("type") == "object":
            assert part["additionalProperties"] is False
            assert set(part["required"]) == set(part["properties"])
            assert all(member["description"] for member in part["properties"].values())


# --- All goals, from poor kitchens and on each level ----------------------------------------------


def poorer(dataset: Dataset, kind: str) -> Kitchen:
    objects = dataset.kitchen.objects
    kept = {"empty": (), "half": objects[::2], "tools": tuple(thing for thing in objects if thing.bare)}
    return replace(dataset.kitchen, objects=kept[kind])


def check_every_goal(dataset: Dataset, where: Domain) -> int:
    """Explain every goal and buy what is missing; return how many cannot be made."""
    lacking = 0
    for goal in dict.fromkeys(map(where.project, dataset.goals)):
        found = explain(where, goal)
        value(found)
        assert explanation_text(found)
        if found.status != "unreachable":
            assert found.steps or where.id_of(goal) in where.stock
            continue
        lacking += 1
        assert found.reason
        assert found.missing is not None
        assert found.missing.proven
        [things] = found.missing.sets or [()]
        bought = as_nodes(where, things)
        assert goal not in bought
        if bought:
            result = retrieve(stocked(where, bought), goal)
            assert result.tree is not None
            assert result.tree.executable
        else:
            assert found.deadlocks
    return lacking


@pytest.mark.parametrize(("kind", "level"), [("empty", 3), ("half", 3), ("half", 2), ("tools", 1)])
def test_what_is_missing_makes_each_goal(built_in: Dataset, kind: str, level: int) -> None:
    where = Domain(built_in.foon, poorer(built_in, kind), level=level)
    lacking = check_every_goal(built_in, where)
    assert lacking == len(built_in.goals) or kind != "empty"
    assert lacking or level == 1


@pytest.mark.parametrize("kind", ["empty", "half"])
def test_what_is_missing_makes_each_public_goal(universal: Dataset, kind: str) -> None:
    assert check_every_goal(universal, Domain(universal.foon, poorer(universal, kind))) >= 20


def test_the_two_public_goals_that_are_locked(universal: Dataset, universal_domain: Domain) -> None:
    locked = {}
    for goal in universal.goals:
        if universal_domain.id_of(goal) in universal_domain.closure.available:
            continue
        found = explain(universal_domain, goal, everything=True)
        assert found.missing is not None
        assert found.missing.complete
        assert not found.missing.same_dish
        locked[goal.label] = found
    assert locked.keys() == {"whipped cream", "fried rice"}
    cream, rice = locked["whipped cream"], locked["fried rice"]
    assert [str(thing.node) for thing in cream.things] == [
        "mixing bowl {pudding} in [mixer]",
        "mixing bowl {pudding}",
    ]
    [deadlock] = cream.deadlocks
    [unit] = deadlock.circle.units
    assert universal.foon.units[unit].source.line == 4827
    assert "mixing bowl {condensed milk, cream cheese} in [mixer]" in [
        str(near.node) for near in deadlock.near
    ]
    assert [str(thing.node) for thing in rice.things] == [
        "bottle {water}",
        "packet {carrot, corn, green pea}",
    ]
    lines = [
        [universal.foon.units[unit].source.line for unit in each.circle.units] for each in rice.deadlocks
    ]
    assert lines == [[35333], [35226, 35219]]


def test_public_shopping_lists(universal: Dataset) -> None:
    empty = Domain(universal.foon, poorer(universal, "empty"))
    found = explain(empty, find_goal(empty, "sweet potato [chopped]", universal.goals), everything=True)
    assert [str(thing.node) for thing in found.things] == [
        "knife",
        "cutting board [empty]",
        "sweet potato [whole]",
    ]
    beef = explain(empty, find_goal(empty, "beef stroganoff", universal.goals))
    labels = {thing.node.label for thing in beef.things}
    assert {"beef", "mushroom", "cognac", "sour cream"} <= labels
    assert "beef stroganoff" not in labels
    assert all(thing.raw for thing in beef.things)
