"""The built-in data: what a cook and a planner may expect of it."""

from __future__ import annotations

from graphlib import TopologicalSorter

from foon_asp.dataset import Dataset
from foon_asp.findings import Severity
from foon_asp.retrieve import retrieve

PAPER_GOALS = {"greek salad", "ice", "macaroni", "sweet potato", "whipped cream"}


def test_size(built_in: Dataset) -> None:
    assert len(built_in.goals) >= 20
    assert len(built_in.foon.units) >= 200
    assert {goal.label for goal in built_in.goals} >= PAPER_GOALS


def test_nothing_worse_than_a_note_is_found_in_it(built_in: Dataset) -> None:
    assert [str(f) for f in built_in.findings if f.severity > Severity.NOTE] == []
    assert built_in.foon.duplicates == 0


def test_every_unit_can_run_and_every_goal_can_be_made(built_in: Dataset) -> None:
    domain = built_in.domain()
    assert domain.strangers == []
    assert len(domain.closure.executable) == len(built_in.foon.units)
    for goal in built_in.goals:
        assert domain.id_of(goal) in domain.closure.available
        assert domain.id_of(goal) not in domain.stock


def test_no_unit_depends_on_itself(built_in: Dataset) -> None:
    domain = built_in.domain()
    before = {
        unit: {
            maker for thing in needs if thing not in domain.stock for maker in domain.reading.makers[thing]
        }
        for unit, needs in enumerate(domain.reading.needs)
    }
    assert len(list(TopologicalSorter(before).static_order())) == len(built_in.foon.units)


def test_every_motion_has_a_rate_and_every_rate_a_motion(built_in: Dataset) -> None:
    assert set(built_in.kitchen.rates) == set(built_in.foon.motions)


def test_every_unit_lies_on_a_way_to_a_goal(built_in: Dataset) -> None:
    domain = built_in.domain()
    goals = [domain.id_of(goal) for goal in built_in.goals]
    useful = domain.reading.backward(goals, domain.stock)
    assert useful == list(range(len(built_in.foon.units)))


def test_methods_disagree_on_eight_dishes_or_more(built_in: Dataset) -> None:
    domain = built_in.domain()
    ways = [("first", ""), ("greedy", "success"), ("optimal", "units"), ("optimal", "success")]
    disagreed = 0
    for goal in built_in.goals:
        trees = [retrieve(domain, goal, method, by or ()).tree for method, by in ways]
        disagreed += len({frozenset(tree.units) for tree in trees if tree}) > 1
    assert disagreed >= 8
