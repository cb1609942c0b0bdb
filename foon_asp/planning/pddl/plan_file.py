"""Plans made elsewhere: the action names of a plan file, as planners and validators write them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from foon_asp.errors import InputError
from foon_asp.io.files import read_string
from foon_asp.model.node import UnitId
from foon_asp.planning.pddl.names import Names
from foon_asp.values import said
from foon_asp.words import closest, shortened

_LINE = re.compile(r"(?:(?P<time>\d+(?:\.\d+)?)\s*:)?\s*\((?P<words>[^()]*)\)\s*(?:\[[^\]]*\])?")


def read_plan(path: Path, names: Names) -> list[UnitId]:
    """Return the units of a plan in the IPC format, in order; helper actions are left out.

    A line is `(action argument …)`, with `time:` before it and `[duration]` behind it in plans with times,
    which are brought into the order of time. `;` begins a comment. Raises `InputError` with the line.
    """
    found: list[tuple[float, int, UnitId]] = []
    known = {**names.units, **names.helpers}
    for number, raw in enumerate(read_string(path).splitlines(), 1):
        text = raw.split(";", 1)[0].strip()
        if not text:
            continue
        match = _LINE.fullmatch(text)
        words = match["words"].lower().split() if match else []
        if match is None or not words:
            raise InputError(path, number, f"{said(text)} is no step of a plan", "write (action argument …)")
        if words[0] not in known:
            hint = closest(words[0][:60], known, 1)
            advice = "name the names.json of its domain"
            raise InputError(path, number, f"unknown action {said(words[0])}{hint}", advice)
        _check_arguments(path, number, words, names)
        unit = names.unit_of(words[0])
        if unit is not None:
            found.append((float(match["time"] or 0), number, unit))
    # Steps without times all have the time 0 and keep the order of their lines.
    return [unit for _, _, unit in sorted(found)]


def _check_arguments(path: Path, line: int, words: list[str], names: Names) -> None:
    """Raise `InputError` if an action is given other objects than those that it is about."""
    action, *given = words
    wanted = names.arguments_of(action)
    if wanted is not None and list(wanted) != given:
        step = " ".join((action, *wanted))
        problem = f"{said(action)} {_taken(wanted)}, not {shortened(given, 5) or 'nothing'}"
        raise InputError(path, line, problem, f"write ({step})")


def _taken(arguments: Sequence[str]) -> str:
    return f"takes {shortened(arguments, 5)}" if arguments else "takes no arguments"
