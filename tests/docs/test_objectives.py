"""The page docs/objectives.md: its tables are complete, and plain clingo agrees with foon-asp."""

from __future__ import annotations

import math
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from foon_asp.query.objective import CRITERIA, Costs, Criterion, Objective
from support.cli import run, run_json
from support.paths import ROOT

PAGE = (ROOT / "docs" / "objectives.md").read_text(encoding="utf-8")
FILES = {name: text for text, name in re.findall(r"```prolog\n(% ([\w.]+): .*?)```", PAGE, re.DOTALL)}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with the rule files of the page, and the encodings."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "encodings").symlink_to(ROOT / "encodings")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def clingo(*arguments: str) -> str:
    """Return what plain clingo prints; it must not complain."""
    done = subprocess.run(
        [sys.executable, "-m", "clingo", *arguments], capture_output=True, text=True, timeout=60, check=False
    )
    # The statuses of the program clingo: 10 models, 20 none, 30 an optimum. The module ends with 0.
    assert done.returncode in (0, 10, 20, 30), done.stderr
    assert done.stderr == ""
    return done.stdout


def printed(capsys: pytest.CaptureFixture[str], line: str) -> list[str]:
    """Return the lines that a command of the page prints, messages last."""
    command, *pipes = re.split(r" \| | (?=> )", line)
    program, *arguments = shlex.split(command)
    if program == "foon-asp":
        _, out, err = run(capsys, *arguments)
        lines = (out + err).splitlines()
    else:
        assert [program, *arguments[:2]] == ["python", "-m", "clingo"]
        lines = clingo(*arguments[2:]).splitlines()
    for pipe in pipes:
        word, *rest = shlex.split(pipe)
        if word == "head":
            lines = lines[: -int(rest[0])]
        elif word == "grep":
            assert rest[0] == "-E"
            lines = [each for each in lines if re.search(rest[1], each)]
        else:
            assert word == ">"
            Path(rest[0]).write_text("\n".join(lines) + "\n", encoding="utf-8")
            lines = []
    return [each.rstrip() for each in lines]


def rows(*heads: str) -> list[list[str]]:
    """Return the rows of the table of the page with these heads, without the marks of code."""
    lines = PAGE.splitlines()
    start = lines.index(f"| {' | '.join(heads)} |") + 2
    end = next(place for place in range(start, len(lines)) if not lines[place].startswith("|"))
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines[start:end]]


def test_the_page_names_all_criteria_and_their_files() -> None:
    table = rows("criterion", "what it counts", "file")
    assert sorted(row[0].strip("`") for row in table) == sorted(CRITERIA)
    files = {row[2].strip("`") for row in table}
    # What is foremost is no criterion to ask for.
    foremost = {"likeness.lp"}
    shared = {"objective.lp", "rounds.lp", "takeover.lp", "failures.lp", *foremost}
    assert files | shared == {path.name for path in (ROOT / "encodings" / "criteria").iterdir()}


def test_the_flags_of_the_first_table_work(capsys: pytest.CaptureFixture[str]) -> None:
    table = rows("you want", "command")
    # A link ends the last row.
    commands = [command for _, cell in table for command in re.findall(r"`([^`]+)`", cell)]
    assert len(commands) > len(table)
    for command in commands:
        line = command if command.startswith("foon-asp") else f"foon-asp retrieve GOAL {command}"
        arguments = shlex.split(line.replace("FILE", "weakest.lp"))[1:]
        dishes = iter(["ice", "hummus"])
        arguments = [next(dishes) if word == "GOAL" else word for word in arguments]
        status, out, err = run(capsys, *arguments)
        assert (status, err) == (0, ""), command
        assert out


def test_no_weights_find_the_middle_of_the_front(capsys: pytest.CaptureFixture[str]) -> None:
    front = run_json(capsys, "retrieve", "whipped cream", "--pareto", "units,success")
    assert [tree["size"] for tree in front["trees"]] == [5, 6, 7]
    sizes = []
    for tenths in range(5, 80, 5):
        tree = run_json(capsys, "retrieve", "whipped cream", "--by", f"{tenths / 10}*success+units")
        sizes.append(tree["size"])
    assert set(sizes) == {5, 7}
    assert sizes == sorted(sizes)


def test_human_and_success_are_a_row_of_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    (table,) = run_json(capsys, "compare", "--human", "whipped cream")
    front = run_json(capsys, "retrieve", "whipped cream", "--pareto", "human,success")
    # The table goes on until nothing can fail, and more human steps never harm.
    assert [tree["costs"]["success"] for tree in front["trees"]] == pytest.approx(
        [step["success"] for step in table["steps"]]
    )


def optimum(text: str) -> list[int]:
    """Return what the last model of plain clingo pays, for each priority; the optimum must be proven."""
    assert "OPTIMUM FOUND" in text
    return [int(paid) for paid in re.findall(r"^Optimization: (.*)$", text, re.MULTILINE)[-1].split()]


def statistic(text: str, name: str) -> int:
    (value,) = re.findall(rf"^{name} +: (\d+)", text, re.MULTILINE)
    return int(value)


def test_the_weakest_step_is_the_one_that_is_paid_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert printed(capsys, "foon-asp facts hummus > facts.lp") == []
    files = (
        "facts.lp",
        "by.lp",
        "encodings/retrieval/task_tree.lp",
        "encodings/criteria/units.lp",
        "--stats",
    )
    whole, parts = (clingo(*files, name) for name in ("weakest.lp", "weakest_parts.lp"))
    tree = run_json(capsys, "retrieve", "hummus", "--objective", "weakest.lp")
    facts = Path("facts.lp").read_text(encoding="utf-8")
    rates = {int(unit): int(rate) for unit, rate in re.findall(r"success_rate\((\d+),(\d+)\)", facts)}
    weakest = min(rates[unit["id"]] for unit in tree["units"])
    assert optimum(whole) == optimum(parts) == [1000 - weakest, tree["size"]]
    for name, least, most in (("Rules", 3, 5), ("Variables", 5, 7), ("Constraints", 11, 14)):
        assert least < statistic(whole, name) / statistic(parts, name) < most


def paid(level: Criterion, costs: Costs) -> float:
    """Return what a tree pays on a level in clingo's units, with success in units of a hundred thousandth."""
    scale = 100_000 / dict(level.terms)["success"] if "success" in level.names else 1
    return sum(
        100_000 * -math.log(costs.success or 0)
        if name == "success"
        else int(scale * weight) * getattr(costs, name)
        for name, weight in level.terms
    )


PLAIN = rows("asked of foon-asp", "facts", "files beside `encodings/retrieval/task_tree.lp`")


@pytest.mark.parametrize("goal", ["macaroni", "hummus"])
@pytest.mark.parametrize(("asked", "facts", "files"), PLAIN, ids=[row[0] for row in PLAIN])
def test_plain_clingo_finds_the_same_optimum(
    asked: str, facts: str, files: str, goal: str, capsys: pytest.CaptureFixture[str]
) -> None:
    options = shlex.split(asked.strip("`"))
    value = run_json(capsys, "retrieve", goal, *options)
    assert value["status"] == "optimal"
    assert printed(capsys, f"foon-asp facts {goal} > facts.lp") == []
    Path("question.lp").write_text(facts.strip("`"), encoding="utf-8")
    marked = re.findall(r"`([^`]+)`", files)
    encodings = [f"encodings/{name}" for name in marked if name.endswith(".lp")]
    constants = [word for name in marked if not name.endswith(".lp") for word in name.split()]
    out = clingo(
        "facts.lp",
        "question.lp",
        "encodings/retrieval/task_tree.lp",
        *encodings,
        *constants,
        "--warn=no-file-included",
    )
    assert "too_deep" not in out
    costs = Costs(**value["costs"])
    expected = [paid(level, costs) for level in Objective.parse(options[1])]
    # Success is rounded for each unit, and so are the weights beside it.
    assert optimum(out) == pytest.approx(expected, abs=value["size"] if "success" in asked else 0)


def test_plain_clingo_says_if_the_horizon_is_too_small(capsys: pytest.CaptureFixture[str]) -> None:
    assert printed(capsys, "foon-asp facts macaroni > facts.lp") == []
    Path("question.lp").write_text('criterion("depth",2). criterion("units",1).', encoding="utf-8")
    files = ["facts.lp", "question.lp", "encodings/retrieval/task_tree.lp"]
    files += ["encodings/criteria/depth.lp", "encodings/criteria/units.lp", "--warn=no-file-included"]
    assert "too_deep(2)" in clingo(*files, "-c", "horizon=2")
    assert "too_deep" not in clingo(*files, "-c", "horizon=20").rpartition("Answer")[2]
