"""What a level cannot reach, no higher one can, also where objects are used up."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.levels import project
from foon_asp.model.node import ObjectNode
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.engines import ENGINES
from foon_asp.planning.plan import replay_plan
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query
from support import brute_force
from support.examples import many
from support.level_checks import on
from support.small_foons import node, world

PROVEN = [e.name for e in ENGINES if e.name in ("clingo", "fast-downward-opt", "pyperplan")]
LABELS = "abc"
STATES = ["[s]", "[t]", "{x}", "{y}", "@a", "()"]


def counted(seed: int) -> tuple[World, Random]:
    """Make a FOON of few labels in many forms, tools among them, whose kitchen is counted."""
    random = Random(seed)
    forms = [f"({label})" if state == "()" else label + state for label in LABELS for state in STATES]
    names = random.sample(forms, 7)

    def unit() -> str:
        takes = random.sample(names, random.choice([1, 2, 2]))
        gives = random.sample(names, random.choice([1, 2]))
        if random.random() < 0.4:
            gives = list(dict.fromkeys([*gives, random.choice(takes)]))
        return f"{' + '.join(takes)} -{random.choice(['cut', 'mix'])}-> {' + '.join(gives)}"

    kitchen = " + ".join(random.sample(names, 3)) + random.choice(["", " + a[strange]"])
    where = world([unit() for _ in range(7)], kitchen, utensils=random.choice([["a"], []]))
    quantities = {thing: random.choice([1, 2]) for thing in where.kitchen.objects if random.random() < 0.8}
    return World.of(where.foon, replace(where.kitchen, quantities=quantities)), random


foons = st.integers(0, 10**6).map(counted)


@pytest.mark.parametrize("semantics", SEMANTICS)
@many(300)
@given(foons)
def test_the_image_of_a_plan_is_a_plan(semantics: str, drawn: tuple[World, Random]) -> None:
    full, random = drawn
    effects = Effects(full, semantics)
    supply, order = Supply(effects), []
    for _ in range(10):
        unit = random.choice(brute_force.every_unit(full))
        if not supply.execute(unit):
            order.append(unit)
    there = [full.node(number) for number in full.ids if supply.has(number)]
    event(f"{len(order)} units")
    for level in (2, 1):
        view = on(level, full)
        goals = [view.id_of(thing) for thing in there]
        images = [view.images[unit] for unit in order]
        assert replay_plan(Effects(view, semantics), goals, images).executable


@pytest.mark.parametrize("semantics", SEMANTICS)
@many(80)
@given(foons)
def test_a_plan_on_a_level_is_one_on_the_levels_below(semantics: str, drawn: tuple[World, Random]) -> None:
    full, random = drawn
    goals: list[ObjectNode] = random.sample(list(full.foon.objects), random.choice([1, 1, 2]))
    answers = {}
    for level in (3, 2, 1):
        query = Query(*(project(goal, level) for goal in goals))
        answers[level] = plan(on(level, full), PlanQuery(query, semantics=semantics, max_steps=12))
    event(" ".join(answer.status for answer in answers.values()))
    for upper, lower in ((3, 2), (2, 1), (3, 1)):
        above, below = answers[upper], answers[lower]
        if above.plan is not None:
            assert below.plan is not None
            assert below.plan.makespan <= above.plan.makespan


MERGED = ("z[raw] -split-> bowl{a} + bowl{b}", "bowl{a} -stir-> x[x]", "bowl{b} -beat-> y[x]")


@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("engine", PROVEN)
def test_one_of_two_bowls_that_look_alike_is_left(engine: str, level: int) -> None:
    where = world(MERGED, "z[raw]")
    where = World.of(where.foon, replace(where.kitchen, quantities={node("z[raw]"): 1}), level=level)
    goals = [project(node(text), level) for text in ("x[x]", "y[x]")]
    answer = plan(where, PlanQuery(Query(*goals), engine))
    assert answer.plan is not None
    assert len(answer.plan.units) == 3


@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("engine", PROVEN)
def test_a_counted_tool_that_is_given_back_is_there_again(engine: str, level: int) -> None:
    where = world(["a[raw] + (knife) -cut-> b[cut] + (knife)", "b[cut] + (knife) -dice-> c[cut]"], "a[raw]")
    counts = {node("(knife)"): 1, node("a[raw]"): 1}
    kitchen = replace(where.kitchen, objects=tuple(counts), quantities=counts)
    answer = plan(
        World.of(where.foon, kitchen, level=level), PlanQuery(Query(project(node("c[cut]"), level)), engine)
    )
    assert answer.plan is not None


@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("engine", PROVEN)
def test_what_stands_for_one_object_is_still_used_up(engine: str, level: int) -> None:
    where = world(["egg[raw] -fry-> omelette[hot]", "egg[raw] -boil-> snack[hot]"], "egg[raw]")
    where = World.of(where.foon, replace(where.kitchen, quantities={node("egg[raw]"): 1}), level=level)
    goals = [project(node(text), level) for text in ("omelette[hot]", "snack[hot]")]
    assert plan(where, PlanQuery(Query(*goals), engine)).plan is None
    assert plan(where, PlanQuery(Query(goals[0]), engine)).plan is not None
