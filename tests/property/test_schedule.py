"""Schedules against everything that could be done, on small FOONs."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.world import World
from foon_asp.planning.durations import Durations
from foon_asp.planning.resources import Resources, Worker, plain_motion
from foon_asp.planning.schedule import faults
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.planning.scheduler import schedule
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from support.brute_schedule import Kitchen
from support.examples import many
from support.plan_worlds import recipes
from support.small_foons import MOTIONS, domains

MOST = 30_000
"""How many states are tried; there are never so many."""


def counted(where: World, random: Random) -> World:
    """Return a domain with some of its kitchen counted."""
    counts = {thing: random.choice([0, 0, 1, 2]) for thing in where.kitchen.objects}
    quantities = {thing: count for thing, count in counts.items() if count}
    return World.of(where.foon, replace(where.kitchen, quantities=quantities), strict=where.strict)


@many(100)
@given(
    st.one_of(domains(), recipes, recipes, recipes),
    st.sampled_from([*SEMANTICS, "consume"]),
    st.integers(0, 10**6),
)
def test_the_shortest_schedule_is_that_of_trying_everything(where: World, semantics: str, seed: int) -> None:
    random = Random(seed)
    where = counted(where, random)
    seconds = {motion: random.choice([1, 1, 2, 3]) for motion in MOTIONS}
    hands = random.choice([1, 2])
    passive = {motion: 0 for motion in MOTIONS if random.random() < 0.2}
    rounds = where.closure.available
    goal = max(where.foon.objects.ids, key=lambda thing: rounds.get(thing, 0))
    resources = Resources((Worker("cook", hands),), hands=passive)
    asked = ScheduleQuery(Query(where.node(goal)), resources, semantics, seconds)
    answer = schedule(where, asked)
    effects = Effects(where, semantics)
    times = {unit.id: seconds[plain_motion(unit.motion)] for unit in where.foon.units}
    alone = frozenset(unit.id for unit in where.foon.units if plain_motion(unit.motion) in passive)
    least = Kitchen(effects, times, hands, alone).least([goal], MOST)
    if answer.schedule is None:
        assert answer.status == "unsolvable"
        assert least is None
        return
    assert faults(answer.schedule, effects, Durations(times, frozenset(), "s"), resources) == []
    assert least is not None
    assert answer.bound <= least <= answer.schedule.makespan
    # What is taken without a need, and counted, is all that is left open.
    if answer.status is Status.OPTIMAL:
        assert answer.schedule.makespan == least
