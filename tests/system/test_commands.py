"""The commands: found by name, one meaning a flag, nothing replaced unasked, answers apart from messages."""

from __future__ import annotations

import argparse
import contextlib
import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from foon_asp.cli import main as main_module
from foon_asp.cli.commands import COMMANDS
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.io.folder import load
from foon_asp.query.constraints import KINDS, ConstraintKeys, Constraints
from foon_asp.query.query import Query
from foon_asp.render.menu import menu_text
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import suggest
from support.cli import run, run_json
from support.paths import ROOT

SELDOM = {
    *("clingo.ast", "foon_asp.asp.rules", "foon_asp.io.json", "foon_asp.io.store", "foon_asp.retrieval.wire"),
    *("hashlib", "importlib.metadata", "msgspec", "multiprocessing", "networkx", "numpy.ma", "pandas"),
    *("psutil", "pyarrow", "pygraphviz", "rapidfuzz", "tqdm", "unified_planning"),
}
"""What is nothing to a question without options, and takes a while to be imported."""

CIRCLE = "O\ta\nS\t1\nM\tx\nO\tb\nS\t1\n//\nO\tb\nS\t1\nM\ty\nO\ta\nS\t1\n//\n"


@pytest.fixture
def circle(tmp_path: Path) -> Path:
    """A data folder with two units that each need what the other one makes."""
    (tmp_path / "FOON.txt").write_text(CIRCLE)
    return tmp_path


@pytest.mark.parametrize(
    "flags", [[], ["-n", 2], ["--all-optimal"], ["--diverse", 2], ["--pareto", "units,inputs"]]
)
def test_every_tree_says_whether_it_can_be_executed(
    capsys: pytest.CaptureFixture[str], circle: Path, flags: list[object]
) -> None:
    command = ["retrieve", "a [1]", "--data", circle, "--reference", *flags]
    status, out, _ = run(capsys, *command)
    assert status == 0
    assert out.count("NOT EXECUTABLE in any order: at step 1 it lacks") == 1
    value = run_json(capsys, *command)
    schema = json.loads((ROOT / "docs" / "schema" / "retrieve.schema.json").read_text())
    Draft202012Validator(schema).validate(value)
    trees = value["trees"] if flags else [value]
    assert [tree["executable"] for tree in trees] == [False]
    value = run_json(capsys, "retrieve", "whipped cream", *flags)
    assert all(tree["executable"] for tree in (value["trees"] if flags else [value]))


def test_a_menu_says_whether_it_can_be_executed(circle: Path) -> None:
    world = load(circle).world()
    menu = plan_menu(world, Query("a [1]", "b [1]", founded=False))
    assert "NOT EXECUTABLE in any order" in menu_text(menu)


def test_a_goal_is_a_question() -> None:
    data = load()
    world = data.world()
    [ice] = [goal for goal in data.goals if goal.label == "ice"]
    trees = [retrieve(world, question).tree for question in ("ice", ice, Query("ice"))]
    assert trees[0] == trees[1] == trees[2]
    with pytest.raises(QueryError, match="a question is a Query, a text or an ObjectNode, not 3"):
        retrieve(world, 3)  # type: ignore[arg-type]
    with pytest.raises(QueryError, match="a Query without goals, not 'ice'"):
        suggest(world, "ice")  # type: ignore[arg-type]


def test_the_table_of_constraints_is_complete() -> None:
    assert {kind.name for kind in KINDS} | {"rules"} == ConstraintKeys.__annotations__.keys()
    encoding = (ROOT / "encodings" / "constraints" / "constraints.lp").read_text()
    for kind in KINDS:
        assert f":- {kind.atom}(Name," in encoding, kind
        assert kind.wording(3) != kind.wording(4) or kind.name == "only_motions"
    assert Constraints.of({"without": [" Egg"], "max_units": 3, "human_steps": 1}).names == [
        "without egg",
        "at most 3 units",
        "at most 1 human step",
    ]


UNIT = "O\tonion\nS\twhole\nO\tknife\nM\tchop\nO\tonion\nS\tchopped\n//\n"
ODD = UNIT.replace("S\twhole", "S\tin [bowl]")


def everything(parser: Parser, name: str = "") -> Iterator[tuple[str, argparse.Action]]:
    """Yield each command and option of a parser, its commands' too."""
    for action in parser._actions:
        if isinstance(action.choices, dict):
            for command, chosen in action.choices.items():
                with contextlib.suppress(SystemExit):
                    chosen.parse_known_args(["--no-such-option"])
                yield from everything(chosen, f"{name} {command}")
        yield name, action


def test_every_command_is_listed_without_being_imported() -> None:
    code = (
        "import sys; from foon_asp.cli.main import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "print([name for name in sys.modules if name.startswith('foon_asp.cli.commands.')])"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    *page, imported = done.stdout.splitlines()
    assert imported == "[]"
    for name, command in COMMANDS.items():
        assert any(line.split()[:1] == [name] for line in page), name
        assert command.summary.split()[0] in done.stdout


def test_a_plain_question_imports_no_more_than_it_takes() -> None:
    code = (
        "import sys; from foon_asp.cli.main import main\n"
        "main(['retrieve', 'ice'])\n"
        f"print(sorted(set(sys.modules).intersection({SELDOM})))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_a_flag_means_the_same_in_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    meanings: dict[str, dict[object, list[str]]] = {}
    for command, action in everything(main_module._parser()):
        for flag in action.option_strings:
            if action.help == argparse.SUPPRESS:
                continue
            # What a limit is for, what a file has in it and what is usual may differ.
            text = re.split(r"[,;] | \(default", action.help or "")[0]
            meaning = (text, action.type, type(action), action.nargs)
            meanings.setdefault(flag, {}).setdefault(meaning, []).append(command)
    capsys.readouterr()
    assert {flag: found for flag, found in meanings.items() if len(found) > 1} == {}
    assert len(meanings["--quiet"].popitem()[1]) == len(meanings["--overwrite"].popitem()[1]) == 25


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.txt").write_text(UNIT)
    (tmp_path / "odd.txt").write_text(ODD)
    (tmp_path / "q.jsonl").write_text('{"goal": "ice"}\n')
    return tmp_path


WRITERS = {
    "ice.txt": ["retrieve", "ice", "-o", "ice.txt"],
    "ice.json": ["retrieve", "ice", "--format", "json", "--output", "ice.json"],
    "ice.svg": ["draw", "ice", "-o", "ice.svg"],
    "f.lp": ["facts", "ice", "-o", "f.lp"],
    "engines.txt": ["engines", "-o", "engines.txt"],
    "out.json": ["convert", "a.txt", "-o", "out.json"],
    "many/a.json": ["convert", "a.txt", "odd.txt", "-o", "many/", "--to", "json"],
    "m.txt": ["merge", "a.txt", "odd.txt", "-o", "m.txt"],
    "kb.foon": ["compile", "a.txt", "-o", "kb.foon"],
    "pddl/domain.pddl": ["pddl", "export", "ice", "-o", "pddl"],
    "odd.fixed.txt": ["audit", "odd.txt", "--fix"],
    "mended/odd.txt": ["audit", "odd.txt", "--fix-dir", "mended"],
    "audit.sarif": ["audit", "odd.txt", "--format", "sarif", "-o", "audit.sarif"],
    "r.jsonl": ["batch", "--queries", "q.jsonl", "-o", "r.jsonl", "--jobs", "1"],
}


@pytest.mark.parametrize("name", WRITERS)
def test_nothing_is_replaced_unasked(capsys: pytest.CaptureFixture[str], files: Path, name: str) -> None:
    def content() -> bytes:
        path = files / name
        return (path / "manifest.json" if path.is_dir() else path).read_bytes()

    status, out, _ = run(capsys, *WRITERS[name])
    assert status == 0
    assert out == "" or "--fix" in WRITERS[name] or "--fix-dir" in WRITERS[name]
    before = content()
    mark = files / name / "manifest.json" if (files / name).is_dir() else files / name
    times = mark.stat().st_mtime_ns
    status, out, err = run(capsys, *WRITERS[name])
    assert (status, out) == (2, "")
    assert "is there already; name another one, or add --overwrite" in err.splitlines()[-1]
    assert mark.stat().st_mtime_ns == times
    assert run(capsys, *WRITERS[name], "--overwrite")[0] == 0
    assert content() == before or name == "ice.json"


def test_an_answer_in_a_file_is_that_of_standard_output(
    capsys: pytest.CaptureFixture[str], files: Path
) -> None:
    for command in (["retrieve", "ice"], ["facts", "ice"], ["merge", "a.txt"], ["suggest", "-n", 2]):
        plain = run(capsys, *command)[1]
        assert run(capsys, *command, "-o", "-")[1] == plain
        assert run(capsys, *command, "-o", "out.txt", "--overwrite")[1] == ""
        assert (files / "out.txt").read_text() == plain
        assert run(capsys, *command, "-o", "new/deep.txt", "--overwrite")[0] == 0
    assert run(capsys, "convert", "a.txt", "-o", "-", "--to", "text")[1] == (
        "//\n" + UNIT.replace("//\n", "") + "//\n"
    )


def test_descriptors_and_pipes_are_no_files_that_are_there(files: Path) -> None:
    program = [sys.executable, "-m", "foon_asp", "convert", "a.txt", "-o", "/dev/stdout", "--to", "text"]
    with (files / "there.txt").open("w") as there:
        subprocess.run(program, check=True, stdout=there, stderr=subprocess.DEVNULL)
    piped = subprocess.run(program, check=True, capture_output=True)
    assert (files / "there.txt").read_bytes() == piped.stdout != b""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["retrieve", "ice", "-o", "."], "this is a folder; name a file"),
        (["merge", "a.txt", "-o", "a.txt", "--overwrite"], "this would replace an input"),
        (["facts", "--foon", "a.txt", "-o", "a.txt", "--overwrite"], "this would replace an input"),
        (["compile", "a.txt", "-o", "-"], "a folder is written, which standard output cannot be"),
        (["pddl", "export", "ice", "-o", "-"], "a folder is written, which standard output cannot be"),
        (["batch", "--queries", "q.jsonl", "-o", "-"], "name a file for them"),
        (["batch", "--queries", "q.jsonl", "-o", "r", "--quiet", "--progress"], "leave out --progress"),
        (["batch", "--queries", "q.jsonl"], "-o/--output"),
        (["retrieve", "ice", "-n", "2", "-k", "2"], "not allowed with"),
        (["retrieve", "ice", "--quiet", "--verbose"], "not allowed with"),
        (["retrieve", "ice", "-n", "0"], "-n: expected a whole number from 1, not '0'"),
    ],
)
def test_what_cannot_be_written_is_one_line(
    capsys: pytest.CaptureFixture[str],
    files: Path,  # noqa: ARG001 - the current folder
    arguments: list[str],
    message: str,
) -> None:
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert message in err.splitlines()[-1]


def test_old_spellings_do_the_same_and_say_the_new_one(
    capsys: pytest.CaptureFixture[str], files: Path
) -> None:
    for old, new, note in (
        (["retrieve", "ice", "-k", 2], ["retrieve", "ice", "-n", 2], "-k is now -n"),
        (["suggest", "--all"], ["suggest", "--everything"], "--all is now --everything"),
    ):
        status, out, err = run(capsys, *old)
        assert run(capsys, *new) == (status, out, "")
        assert note in err
        assert run(capsys, *old, "--quiet") == (status, out, "")
    assert (
        "--out is now -o/--output"
        in run(capsys, "batch", "--queries", "q.jsonl", "--out", "r.jsonl", "--jobs", 1)[2]
    )
    assert (files / "r.jsonl").exists()


def test_quiet_and_verbose(capsys: pytest.CaptureFixture[str], files: Path) -> None:
    strange = json.dumps([{"label": f"thing {number}"} for number in range(6)])
    (files / "kitchen.json").write_text(strange)
    command = ["reach", "--foon", "a.txt", "--kitchen", "kitchen.json"]
    err = run(capsys, *command)[2].splitlines()
    assert len(err) == 4
    assert err[-1] == "foon-asp: warning: and 3 more objects that the FOON does not know"
    err = run(capsys, *command, "--verbose")[2].splitlines()
    assert sum("the kitchen has thing" in line for line in err) == 6
    assert re.fullmatch(r"foon-asp: reach took \d+\.\d\d s", err[-1])
    for quiet in (
        command,
        ["merge", "a.txt"],
        ["compile", "a.txt", "-o", "kb.foon"],
        ["audit", "odd.txt", "--fix"],
        ["batch", "--queries", "q.jsonl", "-o", "r.jsonl", "--jobs", 1],
    ):
        status, _, said = run(capsys, *quiet, "--quiet")
        assert (status, said) == (0, "")
    assert run(capsys, "reach", "--foon", "none.txt", "--quiet")[2].startswith("foon-asp: error: ")


def test_how_many_holds_for_text_and_json(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "suggest", "-n", 2)
    assert (len(value["dishes"]), value["found"]) == (2, 44)
    assert len(run_json(capsys, "suggest")["dishes"]) == 44
    assert len(run_json(capsys, "retrieve", "whipped cream", "-n", 2)["trees"]) == 2
