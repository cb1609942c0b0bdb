"""Nothing hangs and nothing is left behind: rules that never end, crash or fill the memory, and signals."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

import psutil
import pytest
from hypothesis import given

import foon_asp as fa
from foon_asp.asp.control import Control, Program
from foon_asp.asp.encodings import encoding_files, encoding_text
from foon_asp.asp.facts import facts
from foon_asp.asp.process import ProcessControl
from foon_asp.limits import Limit
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.problem import Problem
from support.batch_runs import gone, program, until
from support.cli import run
from support.examples import many
from support.small_foons import queries

FOREVER = "p(0). p(X+1) :- p(X)."
HUGE = "p(1..1000000000)."
MANY = "p(X,Y,Z,W) :- X = 1..300, Y = 1..300, Z = 1..300, W = 1..300."
CRASHES = "p(-2147483647-1). q(X/(-1)) :- p(X)."
PATIENCE = 30.0
"""Seconds after which a limit of one or two was none, be the machine as busy as it may."""


def with_rules(rules: str, **keys: float) -> fa.Query:
    return fa.Query("greek salad", constraints=Constraints(rules=(rules,)), time_limit=keys.get("time"))


# In Python


@pytest.mark.parametrize("rules", [FOREVER, HUGE, MANY])
def test_grounding_is_limited_in_python_too(rules: str) -> None:
    world = fa.load()
    query = with_rules(rules, time=1)
    begun = time.monotonic()
    answer = world.retrieve(query)
    assert (answer.status, answer.limit, answer.tree) == ("limit", Limit.TIME, None)
    assert time.monotonic() - begun < PATIENCE
    explained = world.explain(query)
    assert (explained.status, explained.limit) == ("limit", Limit.TIME)
    several = world.best(query, 2)
    assert (several.status, several.limit, several.trees) == ("limit", Limit.TIME, ())
    assert time.monotonic() - begun < 3 * PATIENCE
    # The next question has nothing of it.
    assert world.retrieve("greek salad").status == "optimal"


def test_memory_is_limited() -> None:
    world = fa.load()
    query = with_rules(MANY).replace(memory_limit=300, time_limit=120)
    answer = world.retrieve(query)
    assert (answer.status, answer.limit) == ("limit", Limit.MEMORY)
    assert '"limit": "memory"' in answer.to_json()
    assert "memory limit" in str(answer)
    assert world.retrieve(fa.Query("greek salad", memory_limit=2000)).status == "optimal"


def test_a_command_that_gets_no_more_memory_says_so(tmp_path: Path) -> None:
    """It has room for a file of 8 MB as bytes and as text, and not for what that means."""
    foon = tmp_path / "big.txt"
    units = (f"O\tegg\nS\traw {n}\nM\tcrack {n}\nO\tegg\nS\tcracked {n}\n//\n" for n in range(150_000))
    foon.write_text("".join(units))
    code = (
        # Libraries are there before, for how a system says that it cannot map one is its own.
        "import resource, sys, psutil, pyarrow\n"
        "from foon_asp.cli.commands import reach\n"
        "from foon_asp.cli.main import main\n"
        "most = psutil.Process().memory_info().vms + 40_000_000\n"
        "resource.setrlimit(resource.RLIMIT_AS, (most, most))\n"
        f"sys.exit(main(['reach', '--foon', {str(foon)!r}]))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (3, "")
    assert done.stderr == "foon-asp: the memory ran out before there was an answer\n"


def test_what_kills_clingo_kills_a_process_alone() -> None:
    world = fa.load()
    for _ in range(2):
        with pytest.raises(fa.QueryError, match="clingo died"):
            world.retrieve(with_rules(CRASHES))
    assert world.retrieve(with_rules(':- use(U), motion(U,"shake").')).status == "optimal"


def test_what_asks_several_questions_ends_in_time() -> None:
    world = fa.load()
    assert world.menu(fa.Query("greek salad", "hummus", time_limit=0)).status == "limit"
    found = world.suggest(query=fa.Query(time_limit=0))
    assert (found.status, found.limit) == ("limit", Limit.TIME)


# The same, here and in a process of its own


def programs(where: World, goal: ObjectNode, *more: str) -> Program:
    problem = Problem(where, (where.id_of(goal),))
    encodings = ["retrieval/task_tree.lp", "criteria/units.lp"]
    texts = [*map(encoding_text, encoding_files(encodings)), facts(problem), *more]
    return Program(tuple(texts), {"founded": 1, "strict": int(where.strict)})


@many(60)
@given(query=queries())
def test_a_process_answers_as_one_does_here(query: tuple[World, ObjectNode]) -> None:
    asked = programs(
        *query, 'criterion("units",1).', 'shown(f(U),"a\\"b",(U,)) :- use(U). #show done : use(_).'
    )
    here, there = Control(asked), ProcessControl(asked)
    assert here.best() == there.best()
    assert here.first().atoms is None or there.first().atoms is not None
    assert here.all_best("use") == there.all_best("use")
    assert here.look([("shown", 3), ("use", 1)]) == there.look([("shown", 3), ("use", 1)])


def test_a_process_is_used_again_and_ends_with_the_one_that_asks() -> None:
    code = (
        "import sys, time, psutil\n"
        "from foon_asp.asp.control import Program\n"
        "from foon_asp.asp.process import ProcessControl\n"
        "for _ in range(3):\n"
        "    ProcessControl(Program(('a.',), {})).best()\n"
        "control = ProcessControl(Program(('a.',), {}))\n"
        "print(*(each.pid for each in psutil.Process().children()), flush=True)\n"
        f"ProcessControl(Program(({FOREVER!r},), {{}}))\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        [first] = map(int, process.stdout.readline().split())
        until(lambda: len(psutil.Process(process.pid).children()) == 2)
        children = psutil.Process(process.pid).children()
        assert first in [child.pid for child in children]
        time.sleep(0.3)
        process.kill()
        process.wait()
        until(lambda: gone(children))


# Commands


@contextmanager
def at_work(*arguments: object) -> Iterator[subprocess.Popen[str]]:
    """Run a command in a group of its own."""
    with subprocess.Popen(
        program(*arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                process.kill()


def children_of(process: subprocess.Popen[str], name: str) -> Sequence[psutil.Process]:
    """Wait until a command has started something, and return all that it has started."""

    def started() -> list[psutil.Process]:
        found = psutil.Process(process.pid).children(recursive=True)
        # Planners start others that are soon done.
        with suppress(psutil.NoSuchProcess):
            return found if any(name in " ".join(each.cmdline()) for each in found) else []
        return []

    until(started)
    return started()


@pytest.mark.parametrize("command", ["retrieve", "explain", "query"])
def test_the_limit_of_a_command_holds_for_grounding(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "rules.lp").write_text(FOREVER)
    asked = (
        [tmp_path / "rules.lp"]
        if command == "query"
        else ["greek salad", "--constraint", tmp_path / "rules.lp"]
    )
    begun = time.monotonic()
    status, out, err = run(capsys, command, *asked, "--time-limit", 1)
    assert (status, err) == (3, "")
    assert "time limit" in out
    assert time.monotonic() - begun < PATIENCE


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_a_command_that_grounds_with_its_children(
    number: signal.Signals, status: int, tmp_path: Path
) -> None:
    (tmp_path / "rules.lp").write_text(FOREVER)
    with at_work("query", tmp_path / "rules.lp") as process:
        children = children_of(process, "worker")
        # By then it grounds, and the command waits for it.
        until(lambda: any(each.cpu_times().user > 1 for each in children))
        os.killpg(process.pid, number)
        out, err = process.communicate(timeout=PATIENCE)
        assert (process.returncode, err) == (status, "")
        assert out == ("no stable model was found before the interruption\n" if status == 130 else "")
        until(lambda: gone(children))


@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)]
)
def test_a_planner_ends_with_the_command(number: signal.Signals, status: int) -> None:
    with at_work("plan", "greek salad", "--engine", "fast-downward-opt", "--by", "success") as process:
        children = children_of(process, "downward")
        process.send_signal(number)
        process.communicate(timeout=PATIENCE)
        assert process.returncode == status
        until(lambda: gone(children))
