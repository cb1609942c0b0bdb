"""Planning engines: those that unified_planning finds, run in a process of their own, their plans checked.

With `pddl.py` the only importer of unified_planning, and like there it is imported where it is used.
"""

from __future__ import annotations

import multiprocessing
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from foon_asp.criteria import Level
from foon_asp.effects import Effects
from foon_asp.errors import InternalError, QueryError, closest
from foon_asp.pddl import from_unified_plan, unified
from foon_asp.pddl_document import document
from foon_asp.pddl_task import planning_task
from foon_asp.pddl_text import domain_text, problem_text
from foon_asp.plan import Plan
from foon_asp.problem import Problem

if TYPE_CHECKING:
    from multiprocessing.connection import Connection


@dataclass(frozen=True, slots=True)
class Engine:
    """A planner: what it promises, its licence, and the package that brings it along.

    `module` is what shows that it is installed, `up_name` is what unified_planning calls it, made with
    `options`. `optimal` says that a plan of it is a cheapest one, though unified_planning may not know that.
    """

    name: str
    package: str
    licence: str
    promises: str
    module: str = ""
    up_name: str = ""
    options: tuple[tuple[str, str | tuple[str, ...]], ...] = ()
    optimal: bool = False

    @property
    def installed(self) -> bool:
        return not self.module or find_spec(self.module) is not None

    @property
    def install(self) -> str:
        """How to get it."""
        return f"pip install {self.package}"


_FD = ("up-fast-downward", "GPL-3.0")
# A unit may take away what it does not need. With the usual invariants, the translator of Fast Downward makes
# a conditional effect of that, and LM-cut knows none.
_LMCUT = (
    ("fast_downward_search_config", "astar(lmcut())"),
    ("fast_downward_translate_options", ("--invariant-generation-max-candidates", "0")),
)

ENGINES = (
    Engine("clingo", "foon-asp", "MIT", "fewest parallel steps, then cheapest, proven"),
    Engine("fast-downward", *_FD, "a plan (LAMA, first iteration)", "up_fast_downward", "fast-downward"),
    Engine(
        "fast-downward-opt",
        *_FD,
        "a cheapest plan, proven (A* with LM-cut)",
        "up_fast_downward",
        "fast-downward",
        _LMCUT,
        optimal=True,
    ),
    Engine("pyperplan", "up-pyperplan", "GPL-3.0", "a plan; knows no costs", "up_pyperplan", "pyperplan"),
    Engine("enhsp", "up-enhsp", "GPL-3.0", "a plan; needs Java", "up_enhsp", "enhsp"),
    Engine(
        "enhsp-opt", "up-enhsp", "GPL-3.0", "a cheapest plan, proven; needs Java", "up_enhsp", "enhsp-opt"
    ),
    Engine("symk", "up-symk", "GPL-3.0", "a plan", "up_symk", "symk"),
    Engine(
        "symk-opt", "up-symk", "GPL-3.0", "a cheapest plan, proven (symbolic search)", "up_symk", "symk-opt"
    ),
)


@dataclass(frozen=True, slots=True)
class EngineAnswer:
    """What an engine said.

    `status`: `optimal` or `solved` (there is a plan, cheapest or not), `unsolvable` (proven), `gave up` (no
    plan was found, and none is ruled out), `timeout`, or `failed` (`message` says how). The plan was replayed
    under the semantics, and accepted by unified_planning's validator. `seconds` is wall time.
    """

    engine: str
    status: str
    plan: Plan | None
    message: str
    seconds: float


def find_engine(name: str) -> Engine:
    """Return an engine that is installed; any that unified_planning knows will do. Raises `QueryError`."""
    for engine in ENGINES:
        if engine.name == name:
            if not engine.installed:
                raise QueryError(f"the engine {name!r} is not installed; {engine.install}")
            return engine
    from unified_planning.environment import get_environment

    factory = get_environment().factory
    if name in factory.engines and factory.engine(name).is_oneshot_planner():
        return Engine(name, "?", "?", "?", up_name=name)
    names = [engine.name for engine in ENGINES]
    raise QueryError(f"unknown engine {name!r}{closest(name, names)}; foon-asp engines lists them")


def run_engine(
    problem: Problem,
    effects: Effects,
    level: Level | None,
    engine: Engine,
    *,
    time_limit: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> EngineAnswer:
    """Let an engine solve a problem, and check its plan.

    The engine runs in a process of its own, which is ended with all that it started when the time (seconds)
    is up. `progress` is told the seconds so far, about every second. Raises `InternalError` if a plan fails
    its replay or unified_planning's validator.
    """
    started = time.perf_counter()
    written = document(planning_task(problem, effects, level))
    target = unified(written)
    kind, found, message = _in_process(target.problem, engine, time_limit, progress)
    plan = None
    if found is not None:
        from unified_planning.plans import ActionInstance, SequentialPlan

        actions = [ActionInstance(target.problem.action(name)) for name in found]
        sequence = SequentialPlan(actions, target.problem.environment)
        plan = from_unified_plan(sequence, target.document.task.names, effects, problem.goals)
        if not plan.executable:
            lacking = ", ".join(map(str, plan.replay.missing))
            raise InternalError(f"the plan of {engine.name} fails its replay: {lacking} is missing")
        _validate(target.problem, sequence)
        if (val := find_val()) is not None:
            check_by_val(val, domain_text(written), problem_text(written), found)
    return EngineAnswer(engine.name, kind, plan, message, time.perf_counter() - started)


def _validate(problem: Any, plan: Any) -> None:
    from unified_planning.engines import SequentialPlanValidator, ValidationResultStatus

    with _quiet():
        result = SequentialPlanValidator().validate(problem, plan)
    if result.status is not ValidationResultStatus.VALID:
        raise InternalError("unified_planning's validator does not accept a plan that replays")


def find_val() -> str | None:
    """Return the program of VAL, the validator of the planning competitions, if it is installed."""
    return next(filter(None, map(shutil.which, ("Validate", "VAL"))), None)


def check_by_val(val: str, domain: str, problem: str, actions: Iterable[str]) -> None:
    """Let VAL check a plan; raise `InternalError` if it does not accept it."""
    with TemporaryDirectory(prefix="foon-asp-") as name:
        folder = Path(name)
        (folder / "domain.pddl").write_text(domain, encoding="utf-8")
        (folder / "problem.pddl").write_text(problem, encoding="utf-8")
        (folder / "plan").write_text("".join(f"({action})\n" for action in actions), encoding="utf-8")
        done = subprocess.run(
            [val, "domain.pddl", "problem.pddl", "plan"],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
    if "Plan valid" not in done.stdout:
        words = " ".join(done.stdout.split()) or f"exit status {done.returncode}"
        raise InternalError(f"VAL does not accept a plan that replays: {words}")


Said = tuple[str, "list[str] | None", str]
"""Status, the names of the actions, and a message."""


def _in_process(
    problem: Any, engine: Engine, time_limit: float | None, progress: Callable[[float], None] | None
) -> Said:
    """Run an engine in a process of its own."""
    # A fork has the problem and the imports already; where there is none they are passed on.
    method = "fork" if "fork" in multiprocessing.get_all_start_methods() else "spawn"
    context: Any = multiprocessing.get_context(method)
    here, there = context.Pipe(duplex=False)
    # Engines leave files where they run, all under the same names: each gets a folder of its own.
    with TemporaryDirectory(prefix="foon-asp-") as folder:
        process = context.Process(target=_solve, args=(there, problem, engine, folder), daemon=True)
        return _await(process, here, there, engine, time_limit, progress)


def _await(
    process: Any,
    here: Connection,
    there: Connection,
    engine: Engine,
    time_limit: float | None,
    progress: Callable[[float], None] | None,
) -> Said:
    begun = time.monotonic()
    process.start()
    there.close()
    try:
        while not here.poll(
            1.0 if time_limit is None else max(0.0, min(1.0, begun + time_limit - time.monotonic()))
        ):
            passed = time.monotonic() - begun
            if time_limit is not None and passed >= time_limit:
                return "timeout", None, f"no plan within {time_limit:g} s"
            if progress is not None:
                progress(passed)
        said: Said = here.recv()
        return said
    except EOFError:
        process.join(5)
        return "failed", None, f"{engine.name} ended without an answer (exit status {process.exitcode})"
    finally:
        _end(process.pid)
        process.join(5)
        here.close()


def _end(pid: int) -> None:
    """End a process and all that it started: planners run in sessions of their own, which signals miss."""
    import psutil

    with suppress(psutil.NoSuchProcess):
        engine = psutil.Process(pid)
        for each in [*engine.children(recursive=True), engine]:
            with suppress(psutil.NoSuchProcess):
                each.kill()


def _solve(there: Connection, problem: Any, engine: Engine, folder: str) -> None:
    """Solve, in the process of the engine, and send what came of it."""
    os.chdir(folder)
    from unified_planning.engines import PlanGenerationResultStatus as Status

    words = {
        Status.SOLVED_OPTIMALLY: "optimal",
        Status.SOLVED_SATISFICING: "solved",
        Status.INTERMEDIATE: "solved",
        Status.UNSOLVABLE_PROVEN: "unsolvable",
        Status.UNSOLVABLE_INCOMPLETELY: "gave up",
        Status.TIMEOUT: "timeout",
        Status.MEMOUT: "failed",
    }
    try:
        with _quiet():
            factory = problem.environment.factory
            params = {name: list(v) if isinstance(v, tuple) else v for name, v in engine.options}
            with factory.OneshotPlanner(name=engine.up_name, params=params) as planner:
                result = planner.solve(problem)
    except Exception as error:
        there.send(("failed", None, f"{type(error).__name__}: {' '.join(str(error).split())}"))
        return
    names = None if result.plan is None else [each.action.name for each in result.plan.actions]
    kind = words.get(result.status, "failed")
    if kind == "solved" and engine.optimal:
        kind = "optimal"
    message = "" if kind not in ("failed", "gave up") else _last_words(result)
    there.send((kind, names, message))


def _last_words(result: Any) -> str:
    """Return the end of what an engine logged."""
    lines = [line for log in result.log_messages or () for line in log.message.splitlines() if line.strip()]
    return f"{result.status.name}: {' / '.join(lines[-2:])}" if lines else str(result.status.name)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep the credits, logs and warnings of engines out of standard output, which is for the answer."""
    import warnings

    with redirect_stdout(sys.stderr), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from unified_planning.environment import get_environment

        get_environment().credits_stream = None
        yield
