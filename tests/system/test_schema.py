"""What `--format json` writes is what docs/schema/ says."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from support.paths import ROOT
from support.schemas import ALL, output, schema

GOALS = ROOT / "data" / "goal_nodes.json"
GOAL = "whipped cream"
NAMES = ["retrieve", "menu", "reach", "compare", "stats", "audit", "goals"]
"""The schemas that are tested here."""
METHODS = [
    [],
    ["--method", "optimal", "--by", "success"],
    ["--method", "optimal", "--by", "inputs,units"],
    ["--method", "optimal", "--by", "depth,success"],
    ["--method", "optimal", "--by", "success,depth"],
    ["--by", "tools,dirty,motions"],
    ["--by", "2*units+inputs"],
    ["--by", "0.5*success + units, depth"],
    ["--human-steps", "2"],
    ["--by", "human,units", "--min-success", "0.8"],
    ["--method", "greedy"],
    ["--method", "greedy", "--by", "inputs"],
    ["--method", "ids"],
    ["--method", "first"],
    ["--reference"],
    ["--method", "greedy", "--reference"],
    ["--method", "first", "--reference"],
    ["--method", "ids", "--trace"],
]


@pytest.fixture
def empty_kitchen(tmp_path: Path) -> str:
    path = tmp_path / "kitchen.json"
    path.write_text("[]", encoding="utf-8")
    return str(path)


def test_every_schema_is_tested() -> None:
    others = [path for path in (ROOT / "tests").rglob("*.py") if path != Path(__file__)]
    texts = [path.read_text(encoding="utf-8") for path in others]
    for name in ALL:
        assert name in NAMES or any(f'"{name}.schema.json"' in text for text in texts), name


@pytest.mark.parametrize("options", METHODS, ids=" ".join)
def test_retrieve_by_each_method(options: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", GOAL, *options)
    assert value["status"] in ("optimal", "found")
    assert value["executable"]
    assert value["size"] == len(value["units"]) == value["costs"]["units"] > 0
    assert value["founded"] == ("--reference" not in options)


def test_retrieve_what_the_kitchen_has(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", "tomato [whole]")
    assert (value["status"], value["executable"], value["size"]) == ("optimal", True, 0)


def test_retrieve_without_rates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rates = tmp_path / "motion.txt"
    rates.write_text("", encoding="utf-8")
    value = output(capsys, "retrieve", GOAL, "--rates", str(rates))
    assert value["costs"]["success"] is None


def test_retrieve_unreachable(empty_kitchen: str, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", GOAL, "--kitchen", empty_kitchen, status=1)
    assert value["status"] == "unreachable"
    assert value["reason"]
    assert value["costs"] is value["bound"] is value["size"] is None


def test_retrieve_a_reference_tree_that_cannot_be_executed(
    empty_kitchen: str, capsys: pytest.CaptureFixture[str]
) -> None:
    value = output(capsys, "retrieve", GOAL, "--reference", "--kitchen", empty_kitchen)
    assert not value["executable"]
    assert value["depth"] is value["costs"]["depth"] is None


def test_retrieve_with_no_time(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", "pesto pasta", "--time-limit", "0", status=3)
    assert value["status"] == "limit"
    assert value["executable"]
    assert value["bound"]["units"] <= value["costs"]["units"]


def test_retrieve_with_no_time_and_no_tree(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--method", "ids", "--time-limit", "0"]
    value = output(capsys, "retrieve", "pesto pasta", *options, status=3)
    assert value["status"] == "limit"


def test_retrieve_a_list_of_goals(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    goals = json.loads(GOALS.read_text(encoding="utf-8"))[:4]
    path = tmp_path / "goals.json"
    path.write_text(json.dumps(goals), encoding="utf-8")
    value = output(capsys, "retrieve", "--goals", str(path))
    assert [answer["goal"]["label"] for answer in value] == [goal["label"] for goal in goals]


def test_retrieve_under_constraints(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", GOAL, "--avoid-motion", "shake", "--max-units", "9")
    assert value["constraints"] == ["avoid motion shake", "at most 9 units"]
    value = output(capsys, "retrieve", GOAL, "--max-units", "1", status=1)
    assert value["status"] == "unreachable"


def test_retrieve_says_who_does_what(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", GOAL, "--human-steps", "2")
    assert [unit["agent"] for unit in value["units"]].count("human") == value["costs"]["human"] == 2


def test_bounds_go_by_the_texts_of_what_is_minimised(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--by", "2*units+inputs,success", "--time-limit", "0"]
    value = output(capsys, "retrieve", "pesto pasta", *options, status=3)
    assert list(value["bound"]) == value["by"] == ["2*units+inputs", "success"]
    menu = output(capsys, "menu", "pesto pasta", GOAL, *options, status=3)
    assert list(menu["bound"]) == menu["by"] == ["2*units+inputs", "success"]
    assert menu["together"]["size"] > 0


SEVERAL = {
    "best": ["-n", "3"],
    "all optimal": ["--all-optimal"],
    "diverse": ["--diverse", "2", "--by", "2*units+depth"],
    "pareto": ["--pareto", "units,success"],
}


@pytest.mark.parametrize("kind", SEVERAL)
def test_retrieve_several_trees(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "retrieve", GOAL, *SEVERAL[kind], "--avoid-motion", "shake")
    assert (value["kind"], value["status"]) == (kind, "optimal")
    assert value["constraints"] == ["avoid motion shake"]
    sets = {frozenset(unit["id"] for unit in tree["units"]) for tree in value["trees"]}
    assert len(sets) == len(value["trees"]) > 0


@pytest.mark.parametrize("kind", SEVERAL)
def test_several_trees_of_which_there_are_none(
    kind: str, empty_kitchen: str, capsys: pytest.CaptureFixture[str]
) -> None:
    value = output(capsys, "retrieve", GOAL, *SEVERAL[kind], "--kitchen", empty_kitchen, status=1)
    assert (value["status"], value["trees"]) == ("unreachable", [])
    assert value["reason"]
    value = output(capsys, "retrieve", GOAL, *SEVERAL[kind], "--time-limit", "0", status=3)
    assert (value["status"], value["reason"]) == ("limit", "")


def test_retrieve_several_trees_for_a_list_of_goals(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    goals = json.loads(GOALS.read_text(encoding="utf-8"))[:2]
    path = tmp_path / "goals.json"
    path.write_text(json.dumps(goals), encoding="utf-8")
    value = output(capsys, "retrieve", "--goals", str(path), "-n", "2")
    assert [len(answer["trees"]) for answer in value] == [2, 2]


def test_menu(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "menu", "greek salad", "hummus", "--human-steps", "1", "--by", "units,success")
    assert value["together"]["size"] < sum(dish["costs"]["units"] for dish in value["apart"])
    assert value["together"]["costs"]["human"] == 1
    assert {len(unit["dishes"]) for unit in value["together"]["units"]} == {1, 2}


def test_menu_with_a_dish_that_cannot_be_made(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kitchen = json.loads((ROOT / "data" / "kitchen.json").read_text(encoding="utf-8"))
    path = tmp_path / "kitchen.json"
    path.write_text(
        json.dumps([each for each in kitchen if each["label"] != "heavy cream"]), encoding="utf-8"
    )
    dishes = [GOAL, "hummus", "--kitchen", str(path)]
    value = output(capsys, "menu", *dishes, status=1)
    assert value["together"]["costs"] is value["together"]["size"] is None
    assert [dish["status"] for dish in value["apart"]] == ["unreachable", "optimal"]
    value = output(capsys, "menu", *dishes, "--leave-out")
    assert [dish["goal"]["label"] for dish in value["left_out"]] == ["whipped cream"]
    assert value["together"]["size"] == value["apart"][0]["costs"]["units"]


def test_compare_with_a_human(empty_kitchen: str, capsys: pytest.CaptureFixture[str]) -> None:
    (table,) = output(capsys, "compare", GOAL, "--human")
    assert [step["human_steps"] for step in table["steps"]] == list(range(len(table["steps"])))
    assert [len(step["human"]) for step in table["steps"]] == list(range(len(table["steps"])))
    assert table["steps"][-1]["success"] == 1
    (table,) = output(capsys, "compare", GOAL, "--human", "--kitchen", empty_kitchen)
    assert table["steps"] == []
    assert table["reason"]


ANSWERS = {
    "one tree": ["retrieve", "pesto pasta", "--by", "2*units+inputs", "--time-limit", "0"],
    "several trees": ["retrieve", GOAL, "--pareto", "units,success"],
    "menu": ["menu", GOAL, "hummus", "--time-limit", "0"],
    "human": ["compare", GOAL, "--human"],
}
WRONG: dict[str, list[tuple[list[str | int], Any]]] = {
    "one tree": [
        (["method"], "best"),
        (["by", 0], "units*2"),
        (["by"], ["units", "units"]),
        (["constraints"], [1]),
        (["status"], "proven"),
        (["costs", "tools"], -1),
        (["costs", "time"], 1.5),
        (["costs", "success"], 1.01),
        (["bound"], {}),
        (["bound"], {"unit": 3}),
        (["bound"], {"units": -1}),
        (["bound"], {"success": 2}),
        (["bound"], {"2*units+inputs": "3"}),
        (["units", 0, "agent"], "cook"),
        (["units", 0, "id"], -1),
        (["units", 0, "inputs", 0, "label"], ""),
        (["units", 0, "dishes"], []),
    ],
    "several trees": [
        (["kind"], "all-optimal"),
        (["by"], []),
        (["status"], "found"),
        (["complete"], None),
        (["trees", 0, "size"], None),
        (["trees", 0, "costs"], None),
        (["trees", 0, "units", 0, "agent"], None),
        (["bound"], None),
    ],
    "menu": [
        (["by"], []),
        (["status"], "found"),
        (["together", "units", 0, "dishes"], None),
        (["together", "units", 0, "dishes"], ["hummus"]),
        (["apart", 0, "costs", "human"], None),
        (["left_out"], [{"goal": None, "reason": "none"}]),
        (["goal"], None),
    ],
    "human": [
        ([0, "steps", 0, "human_steps"], None),
        ([0, "steps", 0, "success"], 1.5),
        ([0, "steps", 1, "human"], [3, 3]),
        ([0, "steps", 0, "proven"], "yes"),
        ([0, "optimal"], {"units": 3, "executable": True, "proven": True}),
        ([], []),
    ],
}


def places(value: object, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Yield the path of each object in a value, of lists only their first and last item."""
    if isinstance(value, dict):
        yield path
        for name, member in value.items():
            yield from places(member, (*path, name))
    elif isinstance(value, list):
        for number in sorted({0, len(value) - 1} if value else ()):
            yield from places(value[number], (*path, number))


def at(value: Any, path: tuple[str | int, ...]) -> Any:
    for part in path:
        value = value[part]
    return value


@pytest.mark.parametrize("name", ANSWERS)
def test_no_member_may_be_missing_or_added(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    command = ANSWERS[name]
    value = output(capsys, *command, status=3 if "--time-limit" in command else 0)
    validator = Draft202012Validator(schema(command[0]))
    count = 0
    for path in places(value):
        for member in (*at(value, path), None):
            spoilt = copy.deepcopy(value)
            if member is None:
                at(spoilt, path)["other"] = None
            else:
                del at(spoilt, path)[member]
            assert not validator.is_valid(spoilt), (path, member)
            count += 1
    assert count > 20


@pytest.mark.parametrize("name", ANSWERS)
def test_wrong_values_are_refused(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    command = ANSWERS[name]
    value = output(capsys, *command, status=3 if "--time-limit" in command else 0)
    validator = Draft202012Validator(schema(command[0]))
    for path, wrong in WRONG[name]:
        spoilt = copy.deepcopy(value)
        if path:
            at(spoilt, tuple(path[:-1]))[path[-1]] = wrong
        else:
            spoilt = wrong
        assert not validator.is_valid(spoilt), path


def test_reach(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "reach")
    assert 0 < len(value["makeable"]) < value["available"]


def test_reach_of_an_empty_kitchen(empty_kitchen: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert output(capsys, "reach", "--kitchen", empty_kitchen)["available"] == 0


def test_compare(capsys: pytest.CaptureFixture[str]) -> None:
    (row,) = output(capsys, "compare", GOAL)
    assert row["optimal"]["proven"]
    assert "greedy_success" in row


def test_compare_without_a_tree_or_rates(
    empty_kitchen: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rates = tmp_path / "motion.txt"
    rates.write_text("", encoding="utf-8")
    (row,) = output(capsys, "compare", GOAL, "--kitchen", empty_kitchen, "--rates", str(rates))
    assert row["optimal"] == {"units": None, "executable": False, "proven": True}
    assert "greedy_success" not in row


@pytest.mark.parametrize("level", ["1", "2", "3"])
def test_goals(level: str, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "goals", "--level", level)
    listed = json.loads(GOALS.read_text(encoding="utf-8"))
    assert [goal["label"] for goal in value] == [goal["label"] for goal in listed]


def test_goals_of_a_folder_without_any(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "FOON.txt").write_text(ODD, encoding="utf-8")
    assert output(capsys, "goals", "--data", str(tmp_path)) == []


@pytest.mark.parametrize("level", ["1", "2", "3"])
@pytest.mark.parametrize("options", [[], ["--centrality"]], ids=" ".join)
def test_stats(level: str, options: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "stats", "--level", level, *options)
    assert value["units"] == value["units_read"] - value["duplicates"] == value["levels"][level]["units"]
    assert value["objects"] == value["levels"][level]["objects"]
    assert ("centrality" in value) == bool(options)


ODD = "O\tonion\nS\tin\tcup\nM\tlook at\n//\n"
"""One unit without outputs, so that objects have no edges and units no results."""


def test_stats_of_a_foon_without_edges(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "odd.txt"
    path.write_text(ODD, encoding="utf-8")
    value = output(capsys, "stats", str(path), "--centrality")
    assert value["findings"] == {"state-without-brackets": 1, "unit-without-outputs": 1}
    assert value["centrality"]["edges"] == value["centrality"]["alpha"] == 0


def test_audit(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "audit")
    assert value["locks"] == value["locked_goals"] == []


def test_audit_from_an_empty_kitchen(empty_kitchen: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert output(capsys, "audit", "--kitchen", empty_kitchen)["findings"]


def test_audit_of_a_locked_goal_that_nothing_frees(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "FOON.txt"
    path.write_text("O\tsoup\nS\traw\nM\tboil\nO\tsoup\nS\traw\nO\tsoup\nS\thot\n//\n", encoding="utf-8")
    (tmp_path / "goal_nodes.json").write_text('[{"label": "soup", "states": ["hot"]}]', encoding="utf-8")
    (tmp_path / "kitchen.json").write_text('[{"label": "knife"}]', encoding="utf-8")
    value = output(capsys, "audit", "--data", str(tmp_path))
    (locked,) = value["locked_goals"]
    assert locked["missing"] is None
    (lock,) = value["locks"]
    assert lock["circle"] == lock["opens"] == [0]
