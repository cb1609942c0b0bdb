"""The built-in data: what a cook and a planner may expect of it."""

from __future__ import annotations

from graphlib import TopologicalSorter

from foon_asp.io.findings import Severity
from foon_asp.io.folder import Dataset
from foon_asp.model.reachability import backward

PAPER_GOALS = {"greek salad", "ice", "macaroni", "sweet potato", "whipped cream"}


def test_size(built_in: Dataset) -> None:
    assert len(built_in.goals) >= 20
    assert len(built_in.foon.units) >= 200
    assert {goal.label for goal in built_in.goals} >= PAPER_GOALS


def test_nothing_worse_than_a_note_is_found_in_it(built_in: Dataset) -> None:
    assert [str(f) for f in built_in.findings if f.severity > Severity.NOTE] == []
    assert built_in.foon.duplicates == 0


def test_every_unit_can_run_and_every_goal_can_be_made(built_in: Dataset) -> None:
    world = built_in.world()
    assert world.strangers == []
    assert len(world.closure.executable) == len(built_in.foon.units)
    for goal in built_in.goals:
        assert world.id_of(goal) in world.closure.available
        assert world.id_of(goal) not in world.stock


def test_no_unit_depends_on_itself(built_in: Dataset) -> None:
    world = built_in.world()
    before = {
        unit: {maker for thing in needs if thing not in world.stock for maker in world.units.makers[thing]}
        for unit, needs in enumerate(world.units.needs)
    }
    assert len(list(TopologicalSorter(before).static_order())) == len(built_in.foon.units)


def test_every_motion_has_a_rate_and_every_rate_a_motion(built_in: Dataset) -> None:
    assert set(built_in.kitchen.rates) == set(built_in.foon.motions)


def test_every_unit_lies_on_a_way_to_a_goal(built_in: Dataset) -> None:
    world = built_in.world()
    goals = [world.id_of(goal) for goal in built_in.goals]
    useful = backward(world.units, goals, world.stock)
    assert useful == list(range(len(built_in.foon.units)))
