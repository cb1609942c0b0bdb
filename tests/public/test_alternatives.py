"""A menu of all public goals."""

from __future__ import annotations

import itertools

from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.menu import plan_menu


def test_the_universal_menu_is_proven(universal: Dataset, universal_world: World) -> None:
    menu = plan_menu(universal_world, Query(*universal.goals), leave_out=True)
    assert menu.together.status == "optimal"
    assert len(menu.left_out) == 2
    assert menu.together.tree is not None
    assert len(menu.together.tree.units) < sum(len(each.tree.units) for each in menu.apart if each.tree)
    assert all(map(bool, menu.dishes.values()))
    assert list(itertools.chain.from_iterable(menu.dishes.values()))
