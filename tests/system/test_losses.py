"""Whatever reads a FOON says what of it is lost, once; and what is marked as the goal need not be named."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import foon_asp as fa
from foon_asp.cli.commands import COMMANDS, PDDL_COMMANDS
from support.cli import run, run_json

FOON = (
    "O\ta\nS\tx\nM\tcut\nO\ta\t0\t!\nS\ty\n//\n"
    "O\ta\nS\ty\nM\tmix\nO\tb\nS\tz\nM\tcook\nO\tb\nS\tw\n//\n"
    "M\tserve\nO\tcake\n//\n"
)
LOST = ("two motions: a '//' is missing; units left out", "a unit without inputs is left out")
READ = "--foon FOON --kitchen kitchen.json"
CALLS = {
    "retrieve": f"retrieve {READ}",
    "adapt": f"adapt a {READ}",
    "explain": f"explain {READ}",
    "suggest": f"suggest {READ}",
    "menu": f"menu {READ}",
    "reach": f"reach {READ}",
    "compare": f"compare {READ}",
    "check": "check FOON",
    "check, as what is known": f"check good.txt {READ}",
    "draw": f"draw {READ}",
    "draw, of trees": "draw tree.txt --kitchen kitchen.json",
    "draw, as what is known": f"draw good.txt {READ}",
    "consolidate": "consolidate FOON",
    "query": f"query rules.lp {READ}",
    "batch": f"batch --queries queries.jsonl {READ} --jobs 1 -o answers.jsonl",
    "plan": f"plan {READ}",
    "schedule": f"schedule {READ}",
    "explore": f"explore {READ} -o page.html",
    "pddl export": f"pddl export {READ} -o again",
    "pddl decode": f"pddl decode plan --names pddl/names.json {READ}",
    "facts": f"facts {READ}",
    "stats": "stats FOON",
    "convert": "convert FOON --to text -o -",
    "merge": "merge FOON",
    "compile": "compile FOON -o other.foon",
    "goals": f"goals {READ}",
}
NO_FILES = {"engines", "pddl"}
"""They read none; `audit` lists every loss in its answer."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Path:
    monkeypatch.chdir(tmp_path)
    for name in ("FOON", "tree.txt"):
        Path(name).write_text(FOON)
    Path("good.txt").write_text("O\ta\nS\tx\nM\tcut\nO\ta\nS\ty\n//\n")
    Path("kitchen.json").write_text('[{"label": "a", "states": ["x"]}]')
    Path("queries.jsonl").write_text('{"goal": "a [y]"}\n')
    Path("rules.lp").write_text("#show unit/1.\n")
    assert run(capsys, *f"pddl export {READ} -o pddl".split())[0] == 0
    action = next(iter(json.loads(Path("pddl/names.json").read_text())["actions"]))
    Path("plan").write_text(f"({action})\n")
    return tmp_path


def test_every_command_is_tried() -> None:
    nested = {f"pddl {name}" for name in PDDL_COMMANDS}
    assert COMMANDS.keys() - NO_FILES - {"audit"} | nested <= CALLS.keys()


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_each_command_says_what_is_lost(capsys: pytest.CaptureFixture[str], call: str) -> None:
    status, _, err = run(capsys, *call.split())
    assert status == 0, err
    assert [err.count(each) for each in LOST] == [1, 1]


@pytest.mark.usefixtures("folder")
def test_a_store_tells_what_was_lost_when_it_was_compiled(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "compile", "FOON", "-o", "FOON.foon")[0] == 0
    status, out, err = run(capsys, "stats", "FOON.foon")
    assert (status, [err.count(each) for each in LOST]) == (0, [1, 1])
    assert run(capsys, "stats", "FOON.foon", "--quiet")[1:] == (out, "")


@pytest.mark.usefixtures("folder")
def test_what_is_marked_is_the_goal_where_none_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_json(capsys, *f"goals {READ}".split()) == [
        {"label": "a", "states": ["y"], "ingredients": [], "container": None}
    ]
    for command in ("retrieve", "menu", "plan", "explain"):
        _, out, err = run(capsys, *f"{command} {READ}".split())
        assert "a [y]" in out
        assert "asked for what the FOON marks: a [y]\n" in err
    named = run_json(capsys, "retrieve", "a [y]", *READ.split())
    assert run_json(capsys, *f"retrieve {READ}".split()) | {"seconds": named["seconds"]} == named
    with pytest.warns(fa.FoonWarning, match="two motions"):
        assert list(map(str, fa.load(foon=["FOON"]).goals)) == ["a [y]"]


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("command", ["retrieve", "menu", "plan", "explain", "pddl export -o new"])
def test_without_any_goal_one_is_asked_for(capsys: pytest.CaptureFixture[str], command: str) -> None:
    status, _, err = run(capsys, *command.split(), "--foon", "good.txt", "--kitchen", "kitchen.json")
    assert status == 2
    assert "no object of the FOON is marked as its goal" in err


@pytest.mark.usefixtures("folder")
def test_goals_of_the_built_in_data_are_no_goals_of_another_foon(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_json(capsys, "goals", "--foon", "good.txt") == []
    assert run_json(capsys, "goals")


def test_one_file_is_converted_with_what_it_repeats(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fill = "O\tcup\nS\tempty\nM\tfill\nO\tcup\nS\tfull\n//\n"
    drink = "O\tcup\nS\tfull\nM\tdrink\nO\tcup\nS\tempty\n//\n"
    tree, other = tmp_path / "tree.txt", tmp_path / "tree.json"
    tree.write_text("//\n" + fill + drink + fill)
    assert run(capsys, "convert", tree, "-o", other, "--to", "json")[0] == 0
    assert run(capsys, "convert", other, "-o", "-", "--to", "text")[:2] == (0, tree.read_text())
    _, out, err = run(capsys, "convert", tree, other, "-o", "-", "--to", "text")
    assert out == "//\n" + fill + drink
    assert "2 units (text), 4 duplicates removed" in err


def test_nothing_is_made_from_nothing() -> None:
    with pytest.raises(fa.QueryError, match="nothing is made from nothing: a unit of 'serve' has no input"):
        fa.read([([], "serve", ["cake"])])
    with pytest.raises(fa.QueryError, match="nothing is made from nothing"):
        fa.check([([], "serve", ["cake"])])
    with pytest.warns(fa.FoonWarning, match="a unit without inputs is left out"):
        foon = fa.read('[{"motion_node": "serve", "output_nodes": [{"label": "cake"}]}]')
    assert not foon.units


def test_older_words_stay_where_they_are_to(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    old = "O\tbowl\nS\tingredients inside\t{x}\nM\tpick + place\nO\tx\nS\tno state\n//\n"
    now = "O\tbowl\nS\tcontains\t{x}\nM\tpick-and-place\nO\tx\n//\n"
    (tmp_path / "old.txt").write_text("//\n" + old)
    convert = ("convert", tmp_path / "old.txt", "-o", "-", "--to", "text")
    assert run(capsys, *convert)[1] == "//\n" + now
    assert run(capsys, *convert, "--vocabulary", "as-written")[1] == "//\n" + old
    world = fa.load(foon=[tmp_path / "old.txt"], vocabulary="as-written")
    assert world.foon.motions == ["pick + place"]
