"""The command line: what it prints, how it ends, what it says of bad input."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import clingo
import pytest
from conftest import ROOT

from foon_asp.cli import main
from foon_asp.dataset import Dataset, load
from foon_asp.retrieve import retrieve
from foon_asp.tree import replay

UNIT = "O\tonion\nS\twhole\nO\tknife\nM\tchop\nO\tonion\nS\tchopped\n//\n"
ONION = [{"label": "onion", "states": ["whole"], "ingredients": [], "container": None}]
KNIFE: list[dict[str, object]] = [{"label": "knife", "states": [], "ingredients": [], "container": None}]
Write = Callable[..., Path]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A data folder with one unit that the kitchen can execute."""
    (tmp_path / "FOON.txt").write_text(UNIT)
    (tmp_path / "kitchen.json").write_text(json.dumps(ONION + KNIFE))
    (tmp_path / "motion.txt").write_text("chop\t0.5\n")
    return tmp_path


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, str, str]:
    try:
        status = main([str(argument) for argument in arguments])
    except SystemExit as stop:
        status = int(stop.code or 0)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def run_json(capsys: pytest.CaptureFixture[str], *arguments: object) -> Any:
    status, out, _ = run(capsys, *arguments, "--format", "json")
    assert status == 0
    return json.loads(out)


def test_retrieve_prints_steps(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    status, out, err = run(capsys, "retrieve", "onion [chopped]", "--data", folder)
    assert (status, err) == (0, "")
    assert out == (
        "onion [chopped]\n"
        "1 step, 1 round, 2 inputs, success 0.5 (optimal by units, proven optimal)\n"
        "\n"
        "  1. chop  [FOON.txt:1, unit 0]\n"
        "     take onion [whole]\n"
        "     with knife\n"
        "     get  onion [chopped]\n"
    )


def test_retrieve_json_has_what_the_replay_needs(
    capsys: pytest.CaptureFixture[str], built_in: Dataset
) -> None:
    value = run_json(capsys, "retrieve", "greek salad", "--by", "success")
    assert (value["status"], value["executable"], value["founded"]) == ("optimal", True, True)
    domain = built_in.domain()
    ids = [unit["id"] for unit in value["units"]]
    assert len(ids) == value["size"] == value["costs"]["units"]
    assert replay(domain, [domain.id_of(built_in.goals[1])], ids).executable


def test_foon_output_is_a_foon_that_makes_the_goal(
    capsys: pytest.CaptureFixture[str], built_in: Dataset, tmp_path: Path
) -> None:
    status, out, _ = run(capsys, "retrieve", "hummus", "--format", "foon")
    assert status == 0
    path = tmp_path / "tree.txt"
    path.write_text(out)
    tree = load(foon=[path])
    goal = next(goal for goal in built_in.goals if goal.label == "hummus")
    result = retrieve(tree.domain(), goal)
    assert result.tree is not None
    assert len(result.tree.units) == len(tree.foon.units)


def test_no_tree_is_exit_1_with_the_reason(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "kitchen.json").write_text(json.dumps(KNIFE))
    status, out, _ = run(capsys, "retrieve", "onion [chopped]", "--data", folder)
    assert status == 1
    assert "no task tree: the kitchen lacks onion [whole], and no unit makes it" in out


def test_a_circle_is_named_with_its_lines(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "FOON.txt").write_text("O\ta\nS\t1\nM\tx\nO\tb\nS\t1\n//\nO\tb\nS\t1\nM\ty\nO\ta\nS\t1\n//\n")
    status, out, _ = run(capsys, "retrieve", "a [1]", "--data", folder)
    assert status == 1
    assert "locked in a circle: a [1] is needed to make itself" in out
    assert "FOON.txt:1" in out
    assert "FOON.txt:7" in out
    status, out, _ = run(capsys, "retrieve", "a [1]", "--data", folder, "--reference")
    assert status == 0
    assert "NOT EXECUTABLE in any order" in out


def test_what_the_kitchen_has_needs_no_step(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    value = run_json(capsys, "retrieve", "onion [whole]", "--data", folder)
    assert (value["status"], value["size"], value["executable"]) == ("optimal", 0, True)


def test_time_limit_prints_the_best_so_far(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(
        capsys, "retrieve", "chicken curry", "--by", "success", "--time-limit", 0, "--format", "json"
    )
    value = json.loads(out)
    assert status == 3
    assert (value["status"], value["executable"]) == ("limit", True)
    assert value["costs"]["success"] <= value["bound"]["success"] <= 1


def test_goals_from_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    values = run_json(capsys, "retrieve", "--goals", ROOT / "data" / "goal_nodes.json")
    assert len(values) == 35
    assert all(value["executable"] for value in values)


def test_facts_feed_clingo_without_python(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "facts")
    assert status == 0
    control = clingo.Control(message_limit=0)
    control.load(str(ROOT / "encodings" / "reachability.lp"))
    control.add(out)
    control.ground()
    shown: list[clingo.Symbol] = []
    control.solve(on_model=lambda model: shown.extend(model.symbols(shown=True)))
    value = run_json(capsys, "reach")
    assert sum(symbol.name == "available" for symbol in shown) == value["available"]
    assert sum(symbol.name == "executable" for symbol in shown) == value["executable"]


def test_facts_of_a_goal_are_its_slice(capsys: pytest.CaptureFixture[str]) -> None:
    _, sliced, _ = run(capsys, "facts", "whipped cream")
    _, whole, _ = run(capsys, "facts", "whipped cream", "--whole")
    assert 0 < sliced.count("unit(") < whole.count("unit(")
    assert "goal(" in sliced


def test_compare_marks_what_cannot_be_executed(capsys: pytest.CaptureFixture[str], public_data: Path) -> None:
    universal = public_data / "universal"
    status, out, _ = run(capsys, "compare", "whipped cream", "macaroni in pot", "--data", universal)
    assert status == 0
    cream, macaroni = out.splitlines()[2:4]
    assert cream.split("|")[1].split() == ["10", "10", "15"]
    assert cream.split("|")[2].split() == ["10!", "10!", "15!"]
    assert set(cream.split("|")[3].split()) == {"-"}
    assert macaroni.split()[-1] == "5*"


@pytest.mark.parametrize(
    ("files", "arguments", "message"),
    [
        ({}, ["retrieve", "onoin"], "unknown goal 'onoin': no object has this label; closest: onion"),
        ({}, ["retrieve", "onion"], "ambiguous goal 'onion': onion [whole]; onion [chopped]"),
        ({}, ["retrieve"], "name one GOAL"),
        ({}, ["retrieve", "onion [chopped]", "--method", "magic"], "invalid choice: 'magic'"),
        ({}, ["retrieve", "onion [chopped]", "--by", "speed"], "no criterion 'speed'"),
        ({}, ["retrieve", "onion [chopped]", "--time-limit", "-1"], "number of seconds"),
        ({}, ["retrieve", "--goals", "{}/none.json"], "none.json: no such file"),
        ({}, ["retrieve", "onion [chopped]", "--kitchen", "{}"], "this is a folder"),
        ({"FOON.txt": ""}, ["retrieve", "onion"], "an empty FOON"),
        ({"FOON.txt": "soup\n"}, ["retrieve", "onion"], "FOON.txt:1: not a FOON file"),
        ({"kitchen.json": b"\xff"}, ["retrieve", "onion"], "kitchen.json:1: byte 0xff is not UTF-8"),
        ({"kitchen.json": "[\n{,"}, ["retrieve", "onion"], "kitchen.json:2: not JSON"),
        ({"kitchen.json": "{}"}, ["retrieve", "onion"], "kitchen.json:1: expected a JSON list"),
        (
            {"kitchen.json": '[{"label": "a"},\n {"states": []}]'},
            ["retrieve", "onion"],
            "kitchen.json:2: object 2: 'label' is missing",
        ),
        (
            {"kitchen.json": '[{"label": "a", "states": "hot"}]'},
            ["reach"],
            "kitchen.json:1: object 1: 'states' is not a list",
        ),
        ({"motion.txt": "chop\t2\n"}, ["reach"], "motion.txt:1: cannot read 'chop\\t2'"),
        (
            {"motion.txt": "cut\t0.5\n"},
            ["retrieve", "onion [chopped]", "--by", "success"],
            "FOON.txt:1: the motion 'chop' has no success rate",
        ),
        (
            {"goals.json": '[{"label": "onoin"}]'},
            ["retrieve", "--goals", "{}/goals.json"],
            "unknown goal 'onoin'; closest: onion",
        ),
    ],
)
def test_bad_input_is_one_line_and_exit_2(
    capsys: pytest.CaptureFixture[str],
    folder: Path,
    files: dict[str, str | bytes],
    arguments: list[str],
    message: str,
) -> None:
    for name, content in files.items():
        (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    arguments = [argument.replace("{}", str(folder)) for argument in arguments]
    status, out, err = run(capsys, *arguments, "--data", folder)
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1


def test_a_star_does_not_matter_to_the_rate(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "FOON.txt").write_text(UNIT.replace("chop\n", "chop*\n", 1))
    value = run_json(capsys, "retrieve", "onion [chopped]", "--by", "success", "--data", folder)
    assert value["costs"]["success"] == 0.5


def test_a_default_rate_fills_the_gaps(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "motion.txt").unlink()
    value = run_json(
        capsys,
        *("retrieve", "onion [chopped]", "--by", "success", "--default-rate", "0.25"),
        *("--data", folder),
    )
    assert value["costs"]["success"] == 0.25


def test_an_unknown_kitchen_object_is_a_warning(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "kitchen.json").write_text(json.dumps(ONION + KNIFE + [{"label": "onoin"}]))
    status, _, err = run(capsys, "retrieve", "onion [chopped]", "--data", folder)
    assert status == 0
    assert err == ("foon-asp: warning: the kitchen has onoin, which the FOON does not know; closest: onion\n")


def test_same_bytes_whatever_the_hash_seed(public_data: Path, tmp_path: Path) -> None:
    commands: list[list[object]] = [
        ["retrieve", "cheese pizza", "--data", public_data / "universal"],
        ["retrieve", "greek salad", "--method", "greedy", "--format", "foon"],
        ["compare", "whipped cream", "hummus", "--format", "json"],
        ["reach", "--format", "json"],
        ["facts"],
    ]
    for command in commands:
        outputs = {
            subprocess.run(
                [sys.executable, "-m", "foon_asp", *map(str, command)],
                env={**os.environ, "PYTHONHASHSEED": seed},
                capture_output=True,
                check=True,
                cwd=tmp_path,
            ).stdout
            for seed in ("0", "1", "4711")
        }
        assert len(outputs) == 1, command


def test_explain_says_what_is_missing_and_what_steps_are_for(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "explain", "whipped cream", "--step", "48")
    assert status == 0
    assert "step 4 of 5: shake" in out
    assert run_json(capsys, "explain", "whipped cream")["status"] == "reachable"
    assert run(capsys, "explain", "whipped cream", "--step", "3")[0] == 2
    assert run(capsys, "explain", "whipped cream", "--instead")[0] == 2
    status, out, _ = run(capsys, "explain", "omelette", "--diet", "vegan")
    assert status == 1
    assert "diet vegan" in out


def test_explain_tells_its_first_sentence_once(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text('[{"label": "ice crusher"}]')
    status, out, _ = run(capsys, "explain", "ice", "--kitchen", kitchen)
    assert status == 1
    assert out.count("no task tree") == 1
    assert "drinking glass [empty]" in out


def test_suggest_ranks_dishes(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "suggest", "--using", "egg", "-n", "3")
    assert status == 0
    assert "made with egg" in out
    assert run(capsys, "suggest", "--using", "eggg")[0] == 2


def test_query_prints_what_rules_show(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    rules = tmp_path / "shakes.lp"
    rules.write_text('shakes(U) :- motion(U,"shake").')
    status, out, _ = run(capsys, "query", rules)
    assert status == 0
    assert "shakes" in out
    assert "48" in out.split()
    rules.write_text("shakes(U) :- use(U).")
    assert run(capsys, "query", rules)[0] == 2


def test_the_trace_is_printed_before_the_tree(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "retrieve", "ice", "--method", "ids", "--trace")
    assert status == 0
    assert out.startswith("limit 0: ice [crushed, frozen] in [drinking glass]\nlimit 1: ")
    value = run_json(capsys, "retrieve", "ice", "--method", "ids", "--trace")
    assert [bound["reached"] for bound in value["trace"]] == [False, True]
    assert run(capsys, "retrieve", "ice", "--trace")[0] == 2
