"""Goals as they are printed."""

from __future__ import annotations

from foon_asp.io.folder import Dataset
from foon_asp.query.goals import find_goal, written_object


def check_whatever_is_printed_can_be_typed(dataset: Dataset) -> None:
    """Check that the printed name of each object node means it, in its world and without one."""
    world = dataset.world()
    nodes = list(dataset.foon.objects) + world.strangers
    assert len(nodes) > 500
    assert [node for node in nodes if find_goal(world, str(node)) != node] == []
    assert [node for node in nodes if written_object(str(node)) != node] == []
