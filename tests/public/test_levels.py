"""Levels of detail of the public data."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from foon_asp.io.folder import Dataset, load
from foon_asp.model.foon import Foon
from foon_asp.model.levels import LEVELS, at_level, project
from foon_asp.model.node import ObjectId
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.reach import reach
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree, replay
from support.level_checks import METHODS, check_lower_levels, images, made, on, read_units
from support.small_foons import motions

# --- The public data ------------------------------------------------------------------------------


def independent_count(full: Foon, level: int) -> tuple[int, int]:
    """Count units and objects on a level as sets of what is shown."""

    def seen(number: ObjectId) -> object:
        thing = full.objects[number]
        if level == 1:
            return thing.label
        if level == 2:
            return thing.label, frozenset((state.name, state.relatum) for state in thing.states)
        return thing.label, frozenset(thing.states)

    units = {
        (unit.motion, frozenset(map(seen, unit.inputs)), frozenset(map(seen, unit.outputs)))
        for unit in full.units
    }
    return len(units), len({seen(number) for number in full.objects.ids})


@pytest.mark.parametrize(
    ("folder", "expected"),
    [
        ("universal", {3: (2376, 4305), 2: (2287, 2610), 1: (2079, 502)}),
        ("subgraphs", {3: (1099, 2152), 2: (1064, 1377), 1: (991, 337)}),
    ],
)
def test_units_and_objects_of_the_public_data(
    public_data: Path, folder: str, expected: dict[int, tuple[int, int]]
) -> None:
    full = load(public_data / folder).foon
    views = {level: at_level(full, level) for level in LEVELS}
    found = {level: (len(view.units), len(view.objects)) for level, view in views.items()}
    assert found == {level: independent_count(full, level) for level in LEVELS}
    assert found == expected


def with_starting_objects(dataset: Dataset) -> World:
    """Give a FOON that has no kitchen all objects that no unit makes."""
    reading = Units(dataset.foon, ())
    starts = tuple(thing for number, thing in enumerate(dataset.foon.objects) if number not in reading.makers)
    return World.of(dataset.foon, replace(dataset.kitchen, objects=starts, default_rate=1.0))


def test_what_is_reachable_in_the_public_data_is_reachable_on_lower_levels(
    public_data: Path, universal_world: World
) -> None:
    check_lower_levels(universal_world)
    check_lower_levels(with_starting_objects(load(public_data / "subgraphs")))


@pytest.mark.parametrize(
    ("level", "units", "executable", "available"),
    [(3, 2376, 2306, 4192), (2, 2275, 2255, 2588), (1, 2015, 2003, 498)],
)
def test_reach_on_the_levels_of_the_universal_foon(
    universal_world: World, level: int, units: int, executable: int, available: int
) -> None:
    view = on(level, universal_world)
    found = reach(view)
    read = read_units(universal_world, level)
    kitchen = {project(thing, level) for thing in universal_world.kitchen.objects}
    at_hand = made(kitchen, list(read))
    assert {view.node(number) for number in found[0]} == at_hand
    assert len(found[0]) == available
    if level < 3:
        assert len(view.foon.units) == len(read)
        assert len(found[1]) == sum(needs <= at_hand for needs, _, _ in read)
    assert (len(view.foon.units), len(found[1])) == (units, executable)


@pytest.mark.parametrize(("method", "by"), METHODS, ids=str)
def test_public_goals_on_lower_levels(
    universal: Dataset, universal_world: World, method: str, by: tuple[str, ...]
) -> None:
    views = [on(level, universal_world) for level in (2, 1)]
    for goal in universal.goals:
        tree: TaskTree | None = retrieve(universal_world, Query(goal, method=method, by=by)).tree
        for view in views:
            result = retrieve(view, Query(goal, method=method, by=by))
            if tree is None:
                continue
            assert replay(view, [view.id_of(goal)], images(view, tree.units)).executable
            assert result.tree is not None
            assert result.tree.executable
            if method == "optimal" and by == ("units",):
                assert len(result.tree.units) <= len(tree.units)


def test_each_level_has_its_own_units(universal_world: World) -> None:
    """A unit of a view stands for all units that become equal to it."""
    for level in (2, 1):
        view = on(level, universal_world)
        assert sorted(set(view.images)) == list(range(len(view.foon.units)))
        sources = sum(len(unit.annotation.sources) for unit in view.foon.units)
        assert sources == sum(len(unit.annotation.sources) for unit in universal_world.foon.units)
        assert motions(view, view.images) == motions(universal_world, universal_world.foon.units.ids)
