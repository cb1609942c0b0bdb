"""Criteria: each is what it says, sums are sums, and a human takes over what is likeliest to fail."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.node import Annotation, Interval
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.objective import CRITERIA
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.compare import compare_human
from foon_asp.retrieval.retrieve import retrieve
from support.cli import run, run_json
from support.small_foons import node, world


def timed(*seconds: tuple[str, str, str, float | None, float | None]) -> World:
    builder = FoonBuilder()
    for motion, before, behind, start, end in seconds:
        builder.unit(
            motion,
            [builder.object(node(before))],
            [builder.object(node(behind))],
            Annotation(times=(Interval(start, end),)),
        )
    where = world([], "egg")
    return World.of(builder.build(), where.kitchen)


def test_time_is_the_sum_of_what_the_videos_show() -> None:
    where = timed(
        ("boil", "egg", "egg[hot]", 0.0, 300.0),
        ("fry", "egg", "egg[hot]", 10.0, 70.4),
        ("peel", "egg[hot]", "dish", 300.0, 305.0),
        ("serve", "dish", "meal", None, 400.0),
    )
    fast = retrieve(where, Query(node("meal"), by="time")).tree
    assert fast is not None
    assert [unit.motion for unit in fast.functional_units] == ["fry", "peel", "serve"]
    assert fast.costs.time == 65
    assert retrieve(
        where, Query(node("meal"), by="time", constraints=Constraints(avoid_motions=("fry",)))
    ).tree


def test_several_goes_take_the_sum_of_their_times(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """For the search, for the replay and for plans; what passed in between does not count."""
    foon, kitchen = tmp_path / "foon.txt", tmp_path / "kitchen.json"
    foon.write_text(
        "O\tegg\nM\tpoach\t<0:00-0:40,1:40-2:10>\nO\tegg\nS\thot\n//\n"
        "O\tegg\nM\tfry\t0:00\t1:11\nO\tegg\nS\thot\n//\n"
    )
    kitchen.write_text('[{"label": "egg"}]')
    for command in ("retrieve", "plan"):
        found = run_json(capsys, command, "egg [hot]", "--foon", foon, "--kitchen", kitchen, "--by", "time")
        assert "poach" in str(found)
        assert "fry" not in str(found)
    _, out, _ = run(capsys, "facts", "--foon", foon, "--kitchen", kitchen)
    assert "start(0,0). end(0,130). duration(0,70)." in out


def test_criteria_that_the_data_know_nothing_of_are_refused() -> None:
    where = world(["egg -cut-> dish"], "egg")
    with pytest.raises(QueryError, match="no unit that can matter for this goal has a time"):
        retrieve(where, Query(node("dish"), by="time"))
    with pytest.raises(QueryError, match="do not say what is a utensil"):
        retrieve(where, Query(node("dish"), by="units,tools"))


@pytest.mark.parametrize("criterion", [*CRITERIA, "time+units", "tools,success"])
def test_a_goal_that_is_at_hand_costs_nothing_by_any_criterion(criterion: str) -> None:
    where = world(["egg -cut-> dish", "dish -serve-> egg"], "egg")
    answer = retrieve(where, Query(node("egg"), by=criterion))
    assert answer.status == Status.OPTIMAL
    assert answer.tree is not None
    assert answer.tree.units == ()


@pytest.mark.parametrize("command", ["retrieve", "menu"])
def test_a_goal_that_is_at_hand_does_not_end_a_list(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, command: str
) -> None:
    foon, goals = tmp_path / "foon.txt", tmp_path / "goals.json"
    kitchen = tmp_path / "kitchen.json"
    foon.write_text("O\tegg\nS\traw\nM\tcook\t0:01\t0:09\nO\tegg\nS\tcooked\n//\n")
    kitchen.write_text('[{"label": "egg", "states": ["raw"]}]')
    goals.write_text('[{"label": "egg", "states": ["raw"]}, {"label": "egg", "states": ["cooked"]}]')
    status, out, _ = run(
        capsys, command, "--foon", foon, "--kitchen", kitchen, "--goals", goals, "--by", "time"
    )
    assert status == 0
    assert out.count("nothing to do") == (command == "retrieve")
    assert "1. cook" in out


def test_the_table_of_human_steps_ends_when_nothing_can_fail(built_in: Dataset) -> None:
    where = built_in.world()
    [table] = compare_human(where, [built_in.goals[0]])
    chances = [tree.costs.success if tree else None for tree, _ in table.trees]
    assert chances == sorted(chances, key=lambda chance: chance or 0)
    assert chances[-1] == 1
    assert all(proven for _, proven in table.trees)
    [short] = compare_human(where, [built_in.goals[0]], most=1)
    assert short.trees == table.trees[:2]


def test_human_steps_are_marked(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "whipped cream", "--human-steps", "2")
    assert [unit["agent"] for unit in value["units"]].count("human") == 2
    assert value["constraints"] == ["at most 2 human steps"]
    assert value["costs"]["human"] == 2
    _, out, _ = run(capsys, "retrieve", "whipped cream", "--human-steps", "2")
    assert out.count("(human)") == 2
    assert run(capsys, "retrieve", "whipped cream", "--method", "greedy", "--human-steps", "2")[0] == 2
    status, out, _ = run(capsys, "compare", "--human", "--human-steps", "3", "whipped cream", "ice")
    assert status == 0
    assert len(out.splitlines()[0].split()) == 5


def test_the_command_line_knows_all_criteria(capsys: pytest.CaptureFixture[str]) -> None:
    for name in CRITERIA:
        known = ["--default-cost", "0.5"] if name == "cost" else []
        status, out, err = run(capsys, "retrieve", "whipped cream", "--by", name, *known)
        assert status == 0 or (name == "time" and "has a time" in err), name
        assert name == "time" or f"optimal by {name}, proven optimal" in out
    status, _, err = run(capsys, "retrieve", "whipped cream", "--by", "unit")
    assert status == 2
    assert "closest: units" in err
