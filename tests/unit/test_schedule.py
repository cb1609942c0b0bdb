"""Schedules without a solver: what is refused, how long things take, and what the judge finds."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from foon_asp.errors import InputError, QueryError
from foon_asp.io.motions import read_durations
from foon_asp.model.consumption import Effects
from foon_asp.model.node import Annotation, Interval, ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.planning.durations import Durations, durations
from foon_asp.planning.first_plan import first_plans
from foon_asp.planning.list_schedule import list_schedule
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.resource_file import read_resources
from foon_asp.planning.resources import Resources, Station, Worker
from foon_asp.planning.schedule import Schedule, ScheduledStep, faults
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.query.query import Query
from support.plan_worlds import bread
from support.schemas import schema
from support.small_foons import node, with_units, world


def video(start: int, end: int) -> Annotation:
    return Annotation(times=(Interval(start, end),))


def timed(where: World, **seconds: int) -> World:
    """Return the world where some motions have videos."""
    units = [
        replace(unit, annotation=video(1, 1 + seconds[unit.motion])) if unit.motion in seconds else unit
        for unit in where.foon.units
    ]
    return World.of(with_units(where.foon, units), where.kitchen)


class TestDurations:
    def test_where_nothing_is_known_each_step_counts_one(self) -> None:
        where = bread()
        found = durations(where, where.foon.units.ids, {})
        assert set(found.seconds.values()) == {1}
        assert (found.unit, found.guessed) == ("steps", frozenset())

    def test_videos_come_first_then_the_table_then_medians(self) -> None:
        where = timed(bread(), mix=7, bake=100)
        found = durations(where, where.foon.units.ids, {"mix": 1, "stir": 30.2})
        by_motion = {unit.motion: found.seconds[unit.id] for unit in where.foon.units}
        # The median of 7, 100 and 31.
        assert by_motion == {"mix": 7, "bake": 100, "stir": 31, "knead": 31, "spread": 31}
        assert {where.foon.units[unit].motion for unit in found.guessed} == {"knead", "spread"}
        assert found.unit == "s"

    def test_a_motion_is_guessed_from_others_like_it(self) -> None:
        where = world(("a -cut-> b", "b -cut-> c", "c -fry-> d", "d -cut-> e"), "a")
        units = list(where.foon.units)
        for place, end in ((0, 4), (2, 90), (3, 8)):
            units[place] = replace(units[place], annotation=video(0, end))
        where = World.of(with_units(where.foon, units), where.kitchen)
        found = durations(where, where.foon.units.ids, {})
        assert found.seconds[UnitId(1)] == 6
        assert found.guessed == {UnitId(1)}

    @pytest.mark.parametrize("text", ['{"bake": 0}', '{"bake": "long"}', "bake\t-3", "bake"])
    def test_a_table_that_is_none_is_refused(self, text: str, tmp_path: Path) -> None:
        path = tmp_path / "table"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match="seconds"):
            read_durations(path)


GIVEN: dict[str, Any] = {
    "workers": [{"name": "cook", "hands": 2}, {"name": "robot", "rate": 0.5, "motions": ["stir"]}],
    "stations": [{"name": "oven", "count": 1, "motions": ["bake"]}],
    "utensils": {"bowl": 2},
    "hands": {"bake": 0},
}


class TestResources:
    def test_a_file_is_what_the_schema_says(self, tmp_path: Path) -> None:
        path = tmp_path / "kitchen.json"
        path.write_text(json.dumps(GIVEN), encoding="utf-8")
        Draft202012Validator(schema("resources")).validate(GIVEN)
        found = read_resources(path)
        assert found.workers == (Worker("cook", 2), Worker("robot", 1, 0.5, frozenset({"stir"})))
        assert found.stations == (Station("oven", 1, frozenset({"bake"})),)
        assert (found.utensils, found.hands) == ({"bowl": 2}, {"bake": 0})

    @pytest.mark.parametrize(
        ("change", "words"),
        [
            ({"workers": [{"name": "cook", "hands": 0}]}, ">= 1"),
            ({"workers": [{"name": "cook"}, {"name": "cook"}]}, "the same name"),
            ({"workers": [{"name": "cook", "rate": 0}]}, "the rate of cook"),
            ({"stations": [{"name": ""}]}, "length >= 1"),
            ({"utensils": {"bowl": "many"}}, "Expected `int`"),
            ({"cooks": 3}, "unknown field `cooks`"),
            ({"hands": {"bake": -1}}, ">= 0"),
        ],
    )
    def test_what_says_nothing_is_refused(self, change: dict[str, Any], words: str, tmp_path: Path) -> None:
        path = tmp_path / "kitchen.json"
        path.write_text(json.dumps({**GIVEN, **change}), encoding="utf-8")
        with pytest.raises(InputError, match=words):
            read_resources(path)

    def test_counts_are_of_utensils_and_of_stations(self) -> None:
        where = bread()
        found = Resources().with_counts(where, [("bowl", 2), ("oven", 1)])
        assert found.utensils == {"bowl": 2}
        assert found.stations == (Station("oven", 1, labels=frozenset({"oven"})),)
        with pytest.raises(QueryError, match="'spoon' is no utensil, no station and no label"):
            found.with_counts(where, [("spoon", 1)])
        with pytest.raises(QueryError, match=r"no unit has the motion 'bakes'.*bake"):
            found.with_passive(where, ["bakes"])
        with pytest.raises(QueryError, match="for one worker"):
            Resources((Worker("a"), Worker("b"))).with_hands(2)

    def test_a_front_needs_a_criterion(self) -> None:
        with pytest.raises(QueryError, match="name one"):
            ScheduleQuery(Query("soup"), front=True)
        with pytest.raises(QueryError, match="number of seconds"):
            ScheduleQuery(Query("soup"), durations={"bake": 0})


TIMES = {"mix": 2, "knead": 3, "stir": 4, "bake": 10, "spread": 1}
RESOURCES = Resources(
    (Worker("cook", 2),), (Station("oven", 1, frozenset({"bake"})),), {"bowl": 2}, {"bake": 0}
)


def judged(steps: tuple[ScheduledStep, ...] | None = None) -> tuple[Schedule, list[str]]:
    """Return a schedule for toast, with steps of its own or those of the list, and what is wrong with it."""
    where = bread()
    goal = where.id_of(node("toast"))
    effects = Effects(where, "consume")
    times = {unit.id: TIMES[unit.motion] for unit in where.foon.units}
    known = Durations(times, frozenset(), "s")
    problem = PlanProblem(effects, (goal,))
    plan = first_plans(problem, times)[0]
    found = list_schedule(plan, effects, known, RESOURCES)
    if steps is not None:
        found = replace(found, steps=steps)
    return found, faults(found, effects, known, RESOURCES)


def test_a_list_schedule_is_as_good_as_it_can_be_here() -> None:
    found, wrong = judged()
    assert wrong == []
    assert found.makespan == 2 + 3 + 10 + 1


CHANGES: dict[str, tuple[dict[str, Any], str]] = {
    "somebody else does it": ({"worker": "robot"}, "cannot do it"),
    "nobody does it": ({"worker": "", "hands": ()}, "nobody cannot do it"),
    "it takes too long": ({"end": 99}, "takes"),
    "it takes both hands": ({"hands": (1, 2)}, "takes 1 hands"),
    "there is no such hand": ({"hands": (3,)}, "takes 1 hands"),
    "it stands at the oven": ({"stations": (("oven", 1),)}, "takes the stations"),
    "there is no such bowl": ({"vessels": (("bowl", 3),)}, "is done with bowl 3"),
    "it takes no bowl": ({"vessels": ()}, "is done with bowl 0"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_the_judge_finds_what_one_step_does_wrong(change: str) -> None:
    steps = list(judged()[0].steps)
    changes, words = CHANGES[change]
    place = next(place for place, step in enumerate(steps) if step.vessels)
    steps[place] = replace(steps[place], **changes)
    wrong = judged(tuple(steps))[1]
    assert any(words in each for each in wrong), wrong


def moved(steps: tuple[ScheduledStep, ...], place: int, by: int) -> tuple[ScheduledStep, ...]:
    step = steps[place]
    later = replace(step, start=step.start + by, end=step.end + by)
    return (*steps[:place], later, *steps[place + 1 :])


def test_the_judge_finds_what_is_not_there_or_taken_twice() -> None:
    steps = judged()[0].steps
    motions = [bread().foon.units[step.unit].motion for step in steps]
    knead, bake, stir = (motions.index(motion) for motion in ("knead", "bake", "stir"))
    assert any("lacks" in each for each in judged(moved(steps, bake, -1))[1])
    assert any("toast [ready] is not there in the end" in each for each in judged(steps[:-1])[1])
    same = tuple(replace(step, hands=(1,)) if step.hands else step for step in steps)
    assert any("hand cook 1 at the same time" in each for each in judged(same)[1])
    one_bowl = tuple(replace(step, vessels=(("bowl", 1),)) if step.vessels else step for step in steps)
    assert any("bowl 1 at the same time" in each for each in judged(one_bowl)[1])
    assert knead != stir
    strange = replace(steps[knead], origins=((ObjectId(0), stir),))
    wrong = judged((*steps[:knead], strange, *steps[knead + 1 :]))[1]
    assert any("has not made yet" in each or "does not make" in each for each in wrong)
