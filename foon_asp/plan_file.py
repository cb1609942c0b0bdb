"""Plans made elsewhere: the action names of a plan file, as planners and validators write them."""

from __future__ import annotations

import re
from pathlib import Path

from foon_asp.errors import InputError, closest
from foon_asp.files import read_string
from foon_asp.pddl_names import Names

_LINE = re.compile(r"(?:(?P<time>\d+(?:\.\d+)?)\s*:)?\s*\((?P<words>[^()]*)\)\s*(?:\[[^\]]*\])?")


def read_plan(path: Path, names: Names) -> list[int]:
    """Return the units of a plan in the IPC format, in order; helper actions are left out.

    A line is `(action argument …)`, with `time:` before it and `[duration]` behind it in plans with times,
    which are brought into the order of time. `;` begins a comment. Raises `InputError` with the line.
    """
    found: list[tuple[float, int, int]] = []
    for number, raw in enumerate(read_string(path).splitlines(), 1):
        text = raw.split(";", 1)[0].strip()
        if not text:
            continue
        match = _LINE.fullmatch(text)
        words = match["words"].lower().split() if match else []
        if match is None or not words:
            raise InputError(path, number, f"{text!r} is no step of a plan", "write (action argument …)")
        known = {**names.units, **names.helpers}
        if words[0] not in known:
            hint = closest(words[0], known, 1)
            advice = "name the names.json of its domain"
            raise InputError(path, number, f"unknown action {words[0]!r}{hint}", advice)
        unit = names.unit_of(words[0])
        if unit is not None:
            found.append((float(match["time"] or 0), number, unit))
    # Steps without times all have the time 0 and keep the order of their lines.
    return [unit for _, _, unit in sorted(found)]
