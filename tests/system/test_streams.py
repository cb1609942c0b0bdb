"""Standard output and standard error that cannot be written: one line, exit 2, and nothing else is harmed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from support.paths import BUILT_IN

COMMANDS = [
    ["stats"],
    ["reach", "--format", "json"],
    ["retrieve", "whipped cream"],
    ["facts"],
    ["engines"],
    ["convert", str(BUILT_IN), "--to", "json", "-o", "-"],
    ["--help"],
    ["retrieve", "--help"],
    ["--version"],
]


def shell(command: list[str], redirection: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run the program with streams as a shell sets them."""
    return subprocess.run(
        ["sh", "-c", f'exec "$@" {redirection}', "sh", sys.executable, "-m", "foon_asp", *command],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        cwd=folder,
    )


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
@pytest.mark.parametrize(
    ("redirection", "told"),
    [
        (">/dev/full", "standard output: cannot be written (No space left on device)"),
        (">&-", "standard output: this is closed; name a file with -o"),
    ],
)
def test_an_answer_that_cannot_be_written(
    command: list[str], redirection: str, told: str, tmp_path: Path
) -> None:
    done = shell(command, redirection, tmp_path)
    assert (done.returncode, done.stderr) == (2, f"foon-asp: error: {told}\n")


@pytest.mark.parametrize("redirection", ["2>/dev/full", "2>&-"])
def test_messages_that_nobody_reads_change_nothing(redirection: str, tmp_path: Path) -> None:
    for command in (
        ["stats"],
        ["retrieve", "ice", "--kitchen", "k.json"],
        ["stats", "none.txt"],
        ["nothing"],
    ):
        (tmp_path / "k.json").write_text('[{"label": "no such object"}]')
        usual = shell(command, "", tmp_path)
        done = shell(command, redirection, tmp_path)
        assert (done.returncode, done.stdout, done.stderr) == (usual.returncode, usual.stdout, "")


def test_closed_streams_are_no_place_for_files(tmp_path: Path) -> None:
    """The first file to be opened would get the number of a closed stream, and what is said there."""
    (tmp_path / "rule.lp").write_text("one(X) :- X = 1..3, unit(X), not two(X).\ntwo(X) :- one(X), X < 0.\n")
    usual = shell(["query", "rule.lp", "-o", "usual"], "", tmp_path)
    assert usual.returncode == 0
    done = shell(["query", "rule.lp", "-o", "closed"], "<&- >&- 2>&-", tmp_path)
    assert done.returncode == 0
    assert (tmp_path / "closed").read_bytes() == (tmp_path / "usual").read_bytes()


def test_a_reader_that_has_seen_enough_is_no_error(tmp_path: Path) -> None:
    done = shell(["facts"], "| head -n 1", tmp_path)
    assert (done.stderr, done.stdout.count("\n")) == ("", 1)
