"""Schedules for the public goals."""

from __future__ import annotations

import pytest
from schedules import HANDS, by_cp_sat, cooks, ours, task_of

from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from foon_asp.planning.first_plan import first_plans
from foon_asp.planning.list_schedule import list_schedule
from foon_asp.planning.schedule import faults

LIMIT = 20.0
"""Seconds; each takes less than two, but for CP-SAT where there is more of a choice."""

GOALS = [("macaroni",), ("vinaigrette",), ("rib",), ("cocktail",), ("macaroni", "vinaigrette")]


@pytest.mark.parametrize("names", GOALS)
def test_the_least_makespans_are_those_of_cp_sat(
    universal: Dataset, universal_world: World, names: tuple[str, ...]
) -> None:
    goals = [goal for goal in universal.goals if goal.label in names]
    known = None
    for hands in HANDS:
        answer = ours(universal_world, goals, hands, "add", LIMIT, known)
        other = by_cp_sat(task_of(universal_world, goals, hands), LIMIT)
        assert answer.makespan is not None
        assert other.makespan is not None
        # A limit that is reached on a busy machine leaves bounds, which must agree, too.
        assert answer.bound <= other.makespan
        assert other.bound <= answer.makespan
        if answer.proven and other.proven:
            assert answer.makespan == other.makespan
        assert known is None or answer.makespan <= known.makespan
        known = answer.schedule


@pytest.mark.parametrize("semantics", ["add", "transform", "consume"])
def test_every_goal_has_a_schedule_at_once(
    universal: Dataset, universal_world: World, semantics: str
) -> None:
    """The first ones, of which a search begins; but for a dish of hundreds of steps."""
    found = 0
    for goal in universal.goals:
        task = task_of(universal_world, [goal], 1, semantics)
        if not task.reachable or (goal.label == "cheese pizza" and semantics == "consume"):
            continue
        effects = task.problem.effects
        plans = first_plans(task.problem, task.durations.seconds)
        assert plans
        for hands in HANDS:
            schedules = [list_schedule(plan, effects, task.durations, cooks(hands)) for plan in plans]
            assert any(not faults(each, effects, task.durations, cooks(hands)) for each in schedules)
        found += 1
    assert found == (22 if semantics == "consume" else 23)
