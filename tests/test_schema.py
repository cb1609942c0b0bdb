"""What `--format json` writes is what docs/schema/ says."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from foon_asp.cli import main
from foon_asp.oddities import ODDITIES

ROOT = Path(__file__).parent.parent
SCHEMAS = ROOT / "docs" / "schema"
GOALS = ROOT / "data" / "goal_nodes.json"
GOAL = "whipped cream"
NAMES = ["retrieve", "reach", "compare", "stats", "audit", "goals"]

METHODS = [
    [],
    ["--method", "optimal", "--by", "success"],
    ["--method", "optimal", "--by", "inputs,units"],
    ["--method", "optimal", "--by", "depth,success"],
    ["--method", "optimal", "--by", "success,depth"],
    ["--method", "greedy"],
    ["--method", "greedy", "--by", "inputs"],
    ["--method", "ids"],
    ["--method", "first"],
    ["--reference"],
    ["--method", "greedy", "--reference"],
    ["--method", "first", "--reference"],
]


def schema(name: str) -> dict[str, Any]:
    value: dict[str, Any] = json.loads((SCHEMAS / f"{name}.schema.json").read_text(encoding="utf-8"))
    return value


def output(capsys: pytest.CaptureFixture[str], *arguments: str, status: int = 0) -> Any:
    """Run a command, check its output against the schema of that name and return it."""
    assert main([*arguments, "--format", "json"]) == status
    value = json.loads(capsys.readouterr().out)
    Draft202012Validator(schema(arguments[0])).validate(value)
    return value


@pytest.fixture
def empty_kitchen(tmp_path: Path) -> str:
    path = tmp_path / "kitchen.json"
    path.write_text("[]", encoding="utf-8")
    return str(path)


def object_schemas(value: object) -> list[dict[str, Any]]:
    """Return all parts of a schema that describe the members of an object."""
    if isinstance(value, list):
        return [found for item in value for found in object_schemas(item)]
    if not isinstance(value, dict):
        return []
    own = [value] if value.get("type") == "object" else []
    return own + [found for item in value.values() for found in object_schemas(item)]


@pytest.mark.parametrize("name", NAMES)
def test_schemas_are_strict_and_say_what_each_member_means(name: str) -> None:
    value = schema(name)
    Draft202012Validator.check_schema(value)
    for part in object_schemas(value):
        if "propertyNames" in part:
            # Counts by name: any of the names may be there.
            assert part["propertyNames"]["enum"]
            assert part["additionalProperties"]["type"] == "integer"
            continue
        assert part["additionalProperties"] is False
        assert set(part.get("required", ())) <= part["properties"].keys()
        assert all(member.get("description") for member in part["properties"].values())


def test_schemas_share_the_shape_of_an_object() -> None:
    shapes = [schema(name)["$defs"]["object"] for name in NAMES]
    assert all(shape == shapes[0] for shape in shapes)
    assert set(shapes[0]["required"]) == set(shapes[0]["properties"])


def test_every_schema_is_tested() -> None:
    assert sorted(path.name for path in SCHEMAS.iterdir()) == sorted(f"{name}.schema.json" for name in NAMES)


def test_schemas_name_the_codes_of_all_findings() -> None:
    page = (ROOT / "docs" / "audit.md").read_text(encoding="utf-8")
    codes = re.findall(r"^\| `([a-z-]+)` \| (?:note|warning|error)\b", page, re.MULTILINE)
    assert schema("stats")["properties"]["findings"]["propertyNames"]["enum"] == list(ODDITIES)
    assert schema("audit")["$defs"]["finding"]["properties"]["code"]["enum"] == [*ODDITIES, *codes]


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
    options = ["--method", "greedy", "--time-limit", "0"]
    value = output(capsys, "retrieve", "pesto pasta", *options, status=3)
    assert value["status"] == "limit"


def test_retrieve_a_list_of_goals(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    goals = json.loads(GOALS.read_text(encoding="utf-8"))[:4]
    path = tmp_path / "goals.json"
    path.write_text(json.dumps(goals), encoding="utf-8")
    value = output(capsys, "retrieve", "--goals", str(path))
    assert [answer["goal"]["label"] for answer in value] == [goal["label"] for goal in goals]


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


def test_compare_with_the_papers_figures(public_data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (row,) = output(capsys, "compare", "ice", "--data", str(public_data / "universal"))
    assert row["paper_ids"] == {"units": 1, "executable": None, "proven": False}


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


def test_stats_of_public_files(public_data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "stats", "--data", str(public_data / "subgraphs"), "--centrality")
    assert value["findings"]["duplicate-unit"] == value["duplicates"]


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


def test_audit_of_public_data(public_data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "audit", "--data", str(public_data / "universal"))
    assert len(value["locks"]) == 8
    assert [locked["goal"]["label"] for locked in value["locked_goals"]] == ["whipped cream", "fried rice"]
    codes = {finding["code"] for finding in value["findings"]}
    assert {"empty-unit", "locked", "goal-locked"} <= codes
