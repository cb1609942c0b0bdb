"""Explanations of the public goals."""

from __future__ import annotations

import pytest

from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from foon_asp.query.goals import find_goal
from foon_asp.query.query import Query
from foon_asp.retrieval.explain import MOST, explain
from support.explanations import check_every_goal, poorer

# --- Text -----------------------------------------------------------------------------------------


# --- All goals, from poor kitchens and on each level ----------------------------------------------


@pytest.mark.parametrize("kind", ["empty", "half"])
def test_what_is_missing_makes_each_public_goal(universal: Dataset, kind: str) -> None:
    assert check_every_goal(universal, World.of(universal.foon, poorer(universal, kind))) >= 20


def test_the_two_public_goals_that_are_locked(universal: Dataset, universal_world: World) -> None:
    locked = {}
    for goal in universal.goals:
        if universal_world.id_of(goal) in universal_world.closure.available:
            continue
        found = explain(universal_world, Query(goal), most=MOST)
        assert found.missing is not None
        assert found.missing.complete
        assert not found.missing.same_dish
        locked[goal.label] = found
    assert locked.keys() == {"whipped cream", "fried rice"}
    cream, rice = locked["whipped cream"], locked["fried rice"]
    assert [str(thing.node) for thing in cream.missing_objects] == [
        "mixing bowl {pudding} in [mixer]",
        "mixing bowl {pudding}",
    ]
    [deadlock] = cream.deadlocks
    [unit] = deadlock.circle.units
    assert universal.foon.units[unit].source.line == 4827
    assert "mixing bowl {condensed milk, cream cheese} in [mixer]" in [
        str(near.node) for near in deadlock.near
    ]
    assert [str(thing.node) for thing in rice.missing_objects] == [
        "bottle {water}",
        "packet {carrot, corn, green pea}",
    ]
    lines = [
        [universal.foon.units[unit].source.line for unit in each.circle.units] for each in rice.deadlocks
    ]
    assert lines == [[35333], [35226, 35219]]


def test_public_shopping_lists(universal: Dataset) -> None:
    empty = World.of(universal.foon, poorer(universal, "empty"), goals=universal.goals)
    found = explain(empty, Query(find_goal(empty, "sweet potato [chopped]")), most=MOST)
    assert [str(thing.node) for thing in found.missing_objects] == [
        "knife",
        "cutting board [empty]",
        "sweet potato [whole]",
    ]
    beef = explain(empty, Query(find_goal(empty, "beef stroganoff")))
    labels = {thing.node.label for thing in beef.missing_objects}
    assert {"beef", "mushroom", "cognac", "sour cream"} <= labels
    assert "beef stroganoff" not in labels
    assert all(thing.raw for thing in beef.missing_objects)
