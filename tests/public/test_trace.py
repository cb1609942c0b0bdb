"""The trace of the public goals."""

from __future__ import annotations

from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from foon_asp.retrieval.trace import trace
from support.trace_checks import check_all

# --- Real data ------------------------------------------------------------------------------------


def test_universal_goals(universal: Dataset, universal_world: World) -> None:
    assert check_all(universal, universal_world) == 23
    # Fewer than two thousand visits for each goal: this can be read.
    goals = map(universal_world.id_of, universal.goals)
    sizes = [sum(len(bound.explored) for bound in trace(universal_world, goal)) for goal in goals]
    assert max(sizes) == 1742
