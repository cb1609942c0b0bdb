"""Plans for the public goals."""

from __future__ import annotations

import pytest

from foon_asp.io.folder import Dataset
from foon_asp.model.consumption import SEMANTICS
from foon_asp.model.world import World
from support.plan_worlds import plan

# --- Plans ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("semantics", SEMANTICS)
def test_public_goals(universal: Dataset, universal_world: World, semantics: str) -> None:
    """All goals that can be made are planned for with proof, but for one that takes over 50 steps."""
    statuses = dict[str, list[str]]()
    for goal in universal.goals:
        if semantics != "add" and goal.label == "cheese pizza":
            continue
        result = plan(universal_world, goal, semantics, time_limit=60)
        statuses.setdefault(result.status, []).append(goal.label)
        if result.plan is not None:
            assert result.plan.makespan >= universal_world.closure.available[universal_world.id_of(goal)]
    assert sorted(statuses) == ["optimal", "unsolvable"]
    assert sorted(statuses["unsolvable"]) == ["fried rice", "whipped cream"]
    assert len(statuses["optimal"]) == (23 if semantics == "add" else 22)
