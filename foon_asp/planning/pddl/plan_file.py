"""Plans made elsewhere: the actions of a plan file, or of the log of a planner, as units."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from foon_asp.errors import InputError
from foon_asp.io.files import read_string
from foon_asp.model.node import UnitId
from foon_asp.planning.pddl.names import Names
from foon_asp.planning.pddl.plan_lines import Line, read_lines
from foon_asp.values import said
from foon_asp.words import closest, shortened


def read_plan(path: Path, names: Names) -> list[UnitId]:
    """Return the units of the plan in a file, in order; of several plans the last one, which is the best.

    As `read_plans`; empty if the file says that nothing is to be done.
    """
    return (read_plans(path, names) or [[]])[-1]


def read_plans(path: Path, names: Names) -> list[list[UnitId]]:
    """Return the units of each plan in a file, in order; helper actions are left out.

    The file is a plan or the log of a planner, in any dialect of `plan_lines`. What has times or numbers is
    brought into their order; lines without come first. What is no action is skipped. Raises `InputError` with
    the line of an action that is unknown, incomplete, or given other objects than its own, and for a file
    in which there is no plan.
    """
    reading = read_lines(read_string(path))
    plans: dict[int, list[tuple[float, int, UnitId | None]]] = {}
    known = {**names.units, **names.helpers}
    for order, line in enumerate(reading.lines):
        if _checked(path, line, known, names):
            step = (line.number, order, names.unit_of(line.words[0]))
            plans.setdefault(line.plan, []).append(step)
    if not plans and not reading.announced:
        advice = "name a plan, or what a planner printed that found one"
        raise InputError(path, None, "there is no plan in it", advice)
    return [[unit for *_, unit in sorted(steps, key=_place) if unit is not None] for steps in plans.values()]


def _place(step: tuple[float, int, UnitId | None]) -> tuple[float, int]:
    # Steps without times all have the time 0 and keep the order of their lines.
    return step[:2]


def _checked(path: Path, line: Line, known: Collection[str], names: Names) -> bool:
    """Return whether a line is an action; raise `InputError` if it is none of the export's, or incomplete."""
    action = line.words[0]
    if action not in known and not line.surely:
        return False
    if line.broken:
        raise InputError(
            path, line.place, f"{said(line.text)} is no step of a plan", "write (action argument …)"
        )
    if action not in known:
        hint = closest(action[:60], known, 1)
        advice = "name the names.json of its domain"
        raise InputError(path, line.place, f"unknown action {said(action)}{hint}", advice)
    _check_arguments(path, line, names)
    return True


def _check_arguments(path: Path, line: Line, names: Names) -> None:
    """Raise `InputError` if an action is given other objects than those that it is about."""
    action, *given = line.words
    wanted = names.arguments_of(action)
    if wanted is not None and list(wanted) != given:
        step = " ".join((action, *wanted))
        problem = f"{said(action)} {_taken(wanted)}, not {shortened(given, 5) or 'nothing'}"
        raise InputError(path, line.place, problem, f"write ({step})")


def _taken(arguments: Sequence[str]) -> str:
    return f"takes {shortened(arguments, 5)}" if arguments else "takes no arguments"
