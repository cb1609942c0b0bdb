"""Levels of detail against the definitions."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.asp.facts import facts
from foon_asp.asp.solver import open_solver
from foon_asp.model.foon import Foon
from foon_asp.model.levels import LEVELS, at_level, project
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.reach import reach
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import replay
from support import brute_force
from support.examples import many
from support.level_checks import METHODS, check_lower_levels, images, made, on, read_units, shown
from support.small_foons import domains, queries

WITH_REFERENCE = [each for each in METHODS if each[0] != "ids" and "depth" not in each[1]]


# --- Properties -----------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [1, 2])
@many(150)
@given(full=domains())
def test_readings_are_those_of_the_full_units_projected(level: int, full: World) -> None:
    view = on(level, full)
    assert len(shown(view)) == len(set(shown(view))) == len(view.foon.units)
    assert set(shown(view)) == read_units(full, level)
    assert view.kitchen.objects == tuple(dict.fromkeys(project(o, level) for o in full.kitchen.objects))
    for unit, image in zip(full.foon.units, view.images, strict=True):
        needs, motion, makes = shown(view)[image]
        assert motion == unit.motion
        assert needs == {project(thing, level) for thing in brute_force.needs(full, unit)}
        assert makes == {project(thing, level) for thing in brute_force.makes(full, unit)}


@pytest.mark.parametrize("level", LEVELS)
@many(100)
@given(full=domains())
def test_units_lp_reads_a_level_as_the_plain_reading_does(level: int, full: World) -> None:
    view = on(level, full)
    text = facts(Problem(view, (), whole=True)) + "#show needs/2. #show makes/2."
    answer = open_solver(["units.lp"], text, {"strict": int(view.strict)}).best()
    assert answer.atoms is not None
    for name, table in (("needs", view.units.needs), ("makes", view.units.makes)):
        found = {arguments for predicate, arguments in answer.atoms if predicate == name}
        assert found == {(unit, thing) for unit, things in enumerate(table) for thing in things}


@pytest.mark.parametrize("level", LEVELS)
@many(100)
@given(full=domains())
def test_reach_is_what_the_definitions_make(level: int, full: World) -> None:
    view = on(level, full)
    available, _ = reach(view)
    kitchen = {project(thing, level) for thing in full.kitchen.objects}
    expected = made(kitchen, list(read_units(full, level)))
    assert {view.node(number) for number in available} == expected


@many(300)
@given(domains())
def test_what_is_reachable_is_reachable_on_lower_levels(full: World) -> None:
    check_lower_levels(full)


@pytest.mark.parametrize(("method", "by"), METHODS, ids=str)
@many(60)
@given(query=queries())
def test_the_image_of_a_task_tree_is_a_task_tree(
    method: str, by: tuple[str, ...], query: tuple[World, ObjectNode]
) -> None:
    full, goal = query
    tree = retrieve(full, Query(goal, method=method, by=by)).tree
    event("a tree" if tree else "no tree")
    if tree is not None:
        for level in LEVELS:
            view = on(level, full)
            assert replay(view, [view.id_of(goal)], images(view, tree.units)).executable


@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize(("method", "by"), METHODS, ids=str)
@many(60)
@given(query=queries())
def test_every_method_works_on_a_level(
    method: str, by: tuple[str, ...], level: int, query: tuple[World, ObjectNode]
) -> None:
    full, goal = query
    view = on(level, full)
    result = retrieve(view, Query(goal, method=method, by=by))
    units = shown(view)
    kitchen = view.kitchen.objects
    target = project(goal, level)
    event(result.status)
    if target not in made(kitchen, units):
        assert result.status == "unreachable"
        assert result.tree is None
        assert result.reason
        return
    assert result.tree is not None
    assert result.tree.executable
    assert target in made(kitchen, [units[unit] for unit in result.tree.units])
    if by == ("units",):
        least = min(
            size
            for size in range(len(units) + 1)
            for chosen in combinations(units, size)
            if target in made(kitchen, chosen)
        )
        assert len(result.tree.units) == least


@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize(("method", "by"), WITH_REFERENCE, ids=str)
@many(40)
@given(query=queries())
def test_the_published_reading_works_on_a_level(
    method: str, by: tuple[str, ...], level: int, query: tuple[World, ObjectNode]
) -> None:
    full, goal = query
    view = on(level, full)
    result = retrieve(view, Query(goal, method=method, by=by, founded=False))
    makers = [unit for unit in shown(view) if project(goal, level) in unit[2]]
    in_kitchen = project(goal, level) in view.kitchen.objects
    assert (result.tree is not None) == (in_kitchen or bool(makers))


@many(100)
@given(domains(), st.sampled_from([2, 1]))
def test_the_view_of_a_view_is_a_view(full: World, level: int) -> None:
    def content(view: Foon) -> tuple[list[ObjectNode], list[tuple[str, object, object]]]:
        return list(view.objects), [(unit.motion, unit.inputs, unit.outputs) for unit in view.units]

    view = at_level(full.foon, level)
    assert content(at_level(view, level)) == content(view)
    assert content(at_level(at_level(full.foon, 2), level)) == content(view)
    assert len(view.units) + view.duplicates == len(full.foon.units) + full.foon.duplicates
