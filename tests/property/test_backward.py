"""Which units can matter for goals, on whole arrays and one by one, against the plain definition."""

from __future__ import annotations

from collections.abc import Collection

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.model import reachability
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World
from support.examples import many
from support.small_foons import queries


def plain(where: World, goals: Collection[ObjectId], among: Collection[UnitId]) -> list[UnitId]:
    """Go over all units until no other one makes what is wanted."""
    wanted = set(goals) - where.stock.keys()
    found: set[UnitId] = set()
    while True:
        more = {unit for unit in among if wanted.intersection(where.units.makes[unit])} - found
        if not more:
            return sorted(found)
        found |= more
        wanted.update(need for unit in more for need in where.units.needs[unit] if need not in where.stock)


@pytest.mark.parametrize("wide", [1, 2, 1000])
@many(100)
@given(question=queries(), data=st.data())
def test_what_leads_to_goals_is_found_however_it_is_searched(
    wide: int, question: tuple[World, ObjectNode], data: st.DataObject
) -> None:
    where, goal = question
    goals = [where.id_of(goal), *data.draw(st.lists(st.sampled_from(where.ids), max_size=3))]
    units = list(where.foon.units.ids)
    some = data.draw(st.sets(st.sampled_from(units))) if units else set()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reachability, "_WIDE", wide)
        for among in (None, where.closure.executable, some, sorted(some)):
            found = backward(where.units, goals, where.stock, among)
            assert found == plain(where, goals, units if among is None else among)
    event(f"{len(found)} units")
