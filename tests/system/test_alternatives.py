"""Several answers: lists, fronts and menus are exactly those that trying every set of units gives."""

from __future__ import annotations

import pytest

from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import best_trees, diverse_trees, pareto_trees
from foon_asp.retrieval.menu import plan_menu
from support.cli import run, run_json
from support.small_foons import node, world


def test_what_cannot_be_made_may_be_left_out_of_a_menu() -> None:
    where = world(["egg -boil-> egg[boiled]", "milk -heat-> milk[hot]", "stone -melt-> lava"], "egg + milk")
    goals = [node("egg[boiled]"), node("lava"), node("milk[hot]")]
    assert plan_menu(where, Query(*goals)).together.status == "unreachable"
    menu = plan_menu(where, Query(*goals), leave_out=True)
    assert menu.together.tree is not None
    assert len(menu.together.tree.units) == 2
    assert [each.goal for each in menu.left_out] == [node("lava")]


def test_constraints_hold_for_several_trees(built_in: Dataset) -> None:
    where = built_in.world()
    goal = built_in.goals[0]
    quiet = Constraints(avoid_motions=("shake",))
    for result in (
        best_trees(where, Query(goal, constraints=quiet), 3),
        diverse_trees(where, Query(goal, constraints=quiet), 3),
        pareto_trees(where, Query(goal, by="units,success", constraints=quiet)),
    ):
        assert result.trees
        assert all(unit.motion != "shake" for tree in result.trees for unit in tree.functional_units)
    none = best_trees(where, Query(goal, constraints=Constraints(max_units=1)), 2)
    assert none.status == "unreachable"
    assert "at most 1 unit" in none.reason


def test_a_time_limit_is_said(built_in: Dataset) -> None:
    result = best_trees(built_in.world(), Query(built_in.goals[1], time_limit=0), 5)
    assert result.status == "limit"
    assert not result.complete


def test_questions_that_make_no_sense_are_refused(built_in: Dataset) -> None:
    where, goal = built_in.world(), built_in.goals[0]
    with pytest.raises(QueryError, match="two criteria or more"):
        pareto_trees(where, Query(goal, by="units"))
    with pytest.raises(QueryError, match="at least 1"):
        diverse_trees(where, Query(goal), 2, factor=0.5)


@pytest.mark.parametrize(
    "flags",
    [
        ("-n", "2", "--method", "greedy"),
        ("--pareto", "units,depth", "--by", "units"),
        ("-n", "0"),
        ("--diverse", "2", "--all-optimal"),
        ("-n", "2", "--format", "foon"),
        ("--pareto", ""),
    ],
)
def test_flags_that_do_not_go_together_are_exit_2(
    capsys: pytest.CaptureFixture[str], flags: tuple[str, ...]
) -> None:
    try:
        status, _, err = run(capsys, "retrieve", "whipped cream", *flags)
    except SystemExit as error:
        status, err = int(error.code or 0), capsys.readouterr().err
    assert status == 2
    assert err.count("\n") == 1


def test_several_trees_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "whipped cream", "-n", "2")
    assert [tree["size"] for tree in value["trees"]] == sorted(tree["size"] for tree in value["trees"])
    assert value["kind"] == "best"
    _, out, _ = run(capsys, "retrieve", "whipped cream", "--pareto", "units,success")
    assert "nothing beats by units,success" in out
    assert "there are no others" in out
    status, out, _ = run(capsys, "menu", "greek salad", "hummus")
    assert status == 0
    assert "sharing saves 1 step" in out
    menu = run_json(capsys, "menu", "whipped cream", "hummus")
    assert menu["together"]["size"] <= sum(each["costs"]["units"] for each in menu["apart"])
    assert run(capsys, "menu")[0] == 2
