"""What is known of a world from question to question, against what a question works out by itself."""

from __future__ import annotations

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp import limits
from foon_asp.limits import Limit, LimitReachedError
from foon_asp.model import landmarks
from foon_asp.model.and_or import AndOrGraph
from foon_asp.model.node import ObjectId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World
from support.examples import many
from support.small_foons import domains


def _alone(where: World, goals: list[ObjectId]) -> AndOrGraph:
    units = backward(where.units, goals, where.stock, where.closure.executable)
    return AndOrGraph(where.units, where.stock, units, goals, (), where.closure.executable)


@pytest.mark.parametrize("bits", [4, 1 << 13])
@many(150)
@given(where=domains(), data=st.data())
def test_what_is_known_of_a_world_is_what_each_question_finds(
    bits: int, where: World, data: st.DataObject
) -> None:
    there = sorted(goal for goal in where.closure.available if goal not in where.stock)
    questions = data.draw(st.lists(st.lists(st.sampled_from(there), max_size=2), max_size=4)) if there else []
    ended = data.draw(st.sets(st.integers(0, 4)))

    def check() -> None:
        if looks.pop() in ended:
            raise LimitReachedError(Limit.TIME)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(landmarks, "_MOST_BITS", bits)
        for goals in questions:
            alone = _alone(where, goals)
            looks = list(range(100))[::-1]
            with pytest.MonkeyPatch.context() as limit:
                # A limit may end a question while it learns; the next one must not be misled by that.
                limit.setattr(limits, "check", check)
                try:
                    known = AndOrGraph.known(where.ways, goals, where.closure.executable)
                except LimitReachedError:
                    event("ended by a limit")
                    ended.clear()
                    known = AndOrGraph.known(where.ways, goals, where.closure.executable)
            assert known.units == alone.units
            assert known.makes == alone.makes
            assert known.makers == alone.makers
            assert known.forced == alone.forced
            event(f"{len(known.units)} units")
