"""Fast Downward on the exported delete-free PDDL: the program that the package up-fast-downward brings along.

Its parts are run one by one, as its own driver runs them, so that each can be timed: writing the PDDL,
`translate`, and the search. (This file is not named for the whole name: a package of that is installed.)
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from proof import Proof, Stopwatch, posed

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.planning.pddl.styles import Document, document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.write import domain_text, problem_text
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from foon_asp.retrieval.tree import TaskTree

LMCUT = "astar(lmcut())"

OPERATOR_COUNTING = (
    "astar(operatorcounting([delete_relaxation_rr_constraints(acyclicity_type=vertex_elimination,"
    "use_integer_vars=true)],use_integer_operator_counts=true,lpsolver={solver}))"
)
"""The configuration that Fast Downward itself names for h+, solved by one of `LP_SOLVERS`."""

LP_SOLVERS = ("cplex", "soplex")

_UNSOLVABLE = (10, 11, 12)
"""Exit statuses of translate and search for a task that has no plan; neither heuristic is ever infinite
where there is one."""


def installed() -> bool:
    """Say whether the package up-fast-downward is there, with its programs."""
    return find_spec("up_fast_downward") is not None and _search_program().exists()


def solve(
    world: World, goal: ObjectNode, limit: float, search: str = LMCUT, *, reduced: bool = False
) -> Proof:
    """Find a cheapest plan, and so a least task tree, or prove within `limit` seconds that there is none."""
    watch = Stopwatch()
    deadline = time.monotonic() + limit
    problem = posed(watch, world, goal, reduced=True) if reduced else Problem.of(world, [goal])
    if isinstance(problem, Proof):
        return problem
    with TemporaryDirectory(prefix="foon-asp-") as name:
        folder = Path(name)
        written = write(problem, folder)
        watch.lap("export")
        for phase, command in (("translate", translate()), ("search", search_command(search))):
            status, said = _run(command, folder, deadline)
            watch.lap(phase)
            if status is None:
                return watch.proof("limit")
            if status in _UNSOLVABLE:
                return watch.proof("unreachable")
            if status != 0:
                return watch.proof("failed", message=f"{phase} ended with {status}: {said}")
        plan = (folder / "plan").read_text(encoding="utf-8")
    names = written.task.names
    units = [names.unit_of(line.strip("() ")) for line in plan.splitlines() if not line.startswith(";")]
    tree = TaskTree.of(world, problem.goals, [unit for unit in units if unit is not None])
    watch.lap("replay")
    return watch.proof("optimal", tree)


def write(problem: Problem, folder: Path) -> Document:
    """Write domain.pddl and problem.pddl, in which nothing is ever deleted, and each unit costs 1."""
    task = planning_task(problem, Effects(problem.world, "add"), Criterion.parse("units"))
    written = document(task, "objects")
    (folder / "domain.pddl").write_text(domain_text(written), encoding="utf-8")
    (folder / "problem.pddl").write_text(problem_text(written), encoding="utf-8")
    return written


def unsupported(solver: str) -> str:
    """Return what Fast Downward says if it lacks an LP solver, or nothing if it can do with this one."""
    with TemporaryDirectory(prefix="foon-asp-") as name:
        folder = Path(name)
        (folder / "output.sas").write_text(_TINY_TASK, encoding="utf-8")
        command = search_command(OPERATOR_COUNTING.format(solver=solver))
        status, said = _run(command, folder, time.monotonic() + 60)
    return "" if status == 0 else said


def translate() -> list[str]:
    """Return the command that turns PDDL into output.sas, both in the current folder."""
    return [sys.executable, "-m", "fast_downward.translate", "domain.pddl", "problem.pddl"]


def search_command(search: str) -> list[str]:
    """Return the command that reads output.sas from its standard input and writes the file plan."""
    return [str(_search_program()), "--search", search, "--internal-plan-file", "plan"]


def _bin() -> Path:
    # The package itself is not imported: that takes longer than most searches.
    package = find_spec("up_fast_downward")
    if package is None or package.origin is None:
        raise ModuleNotFoundError("no Fast Downward; pip install up-fast-downward")
    return Path(package.origin).parent / "downward" / "builds" / "release" / "bin"


def _search_program() -> Path:
    return _bin() / "downward"


def _run(command: Sequence[str], folder: Path, deadline: float) -> tuple[int | None, str]:
    """Run a part of Fast Downward; return its exit status, None if the time ran out, and its complaints."""
    task = folder / "output.sas"
    with (
        Path(task if task.exists() else os.devnull).open("rb") as source,
        subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(_bin())},
            stdin=source,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as process,
    ):
        try:
            out, errors = process.communicate(timeout=max(0.0, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            process.kill()
            return None, ""
    lines = [line for line in (errors + out).splitlines() if line.strip() and not line.startswith("[")]
    return process.returncode, " ".join(lines[:2])


_TINY_TASK = """\
begin_version
3
end_version
begin_metric
0
end_metric
1
begin_variable
var0
-1
2
Atom a()
NegatedAtom a()
end_variable
0
begin_state
1
end_state
begin_goal
1
0 0
end_goal
1
begin_operator
make
0
1
0 0 -1 0
1
end_operator
0
"""
