"""A small drill: of each part a few rounds; `make drill` does many. And each part can fail."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pytest

from drill.inputs import mutated_inputs, try_input
from drill.kills import disturbed, kills, left_behind
from drill.memory import growth, warm_questions
from drill.part import Part, Span
from drill.readers import Reader
from foon_asp.errors import FoonError
from support.paths import ROOT

SEED = 4711


@pytest.mark.parametrize(("part", "rounds"), [(mutated_inputs, 1), (kills, 2), (warm_questions, 15)])
def test_a_small_drill(part: Part, rounds: int) -> None:
    outcome = part(Span.of(SEED, 60, rounds))
    assert outcome.failures == []
    assert outcome.lines


def reading(read: object) -> Reader:
    assert callable(read)
    return Reader(lambda random: random.randbytes(10), lambda data, _: read(data), 1)


def test_an_input_can_fail(tmp_path: Path) -> None:
    def refuses(_: bytes) -> None:
        raise FoonError("no")

    def fails(data: bytes) -> None:
        raise ZeroDivisionError(data)

    def hangs(_: bytes) -> None:
        end = time.process_time() + 0.7
        while time.process_time() < end:
            pass

    path = tmp_path / "input"
    assert try_input(reading(refuses), "1/x/0", path) is None
    assert path.read_bytes() == Random("1/x/0").randbytes(10)
    assert "ZeroDivisionError" in (try_input(reading(fails), "1/x/0", path) or "")
    assert "0.7 s for 10 bytes" in (try_input(reading(hangs), "1/x/0", path) or "")


def test_a_kill_can_fail(tmp_path: Path) -> None:
    """What ends in a traceback, ends otherwise or leaves a process behind is found."""
    ended = disturbed(("plan", "no such goal"), tmp_path, signal.SIGINT, 30)
    assert ended.problem(signal.SIGINT) is not None
    # A new process shows its environment a moment after it has started, so it says when it runs.
    sleeper = subprocess.Popen(
        ["sh", "-c", "echo; read _"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "FOON_ASP_DRILL": "mine"},
    )
    try:
        assert sleeper.stdout is not None
        sleeper.stdout.readline()
        assert [str(sleeper.pid) in each for each in left_behind("mine", 0.1)] == [True]
    finally:
        sleeper.kill()
        sleeper.communicate()


def test_growth_is_told_from_going_up_and_down() -> None:
    assert growth([10, 80, 85, 81, 88, 82, 86, 83, 85]) <= 0
    assert growth([10, *range(80, 160, 5)]) >= 30


def test_the_command_runs_the_parts_that_are_named() -> None:
    command = [sys.executable, "-m", "drill", "stores", "--times", "0.001", "--seed", "1"]
    done = subprocess.run(
        command,
        env={**os.environ, "PYTHONPATH": str(ROOT / "tests")},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("seed 1\nstores: ")
    command[3] = "nothing"
    refused = subprocess.run(
        command, env={**os.environ, "PYTHONPATH": str(ROOT / "tests")}, capture_output=True, check=False
    )
    assert refused.returncode == 2
