"""What the formats share of a functional unit: motion labels, times, rates, sides, ids of labels."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from foon_asp.graph import Foon, FunctionalUnit
from foon_asp.state_syntax import Report

_TIME = re.compile(r"(?:([0-9]{1,6}):)?([0-9]{1,6}):([0-9]{1,2})(?:\.([0-9]+))?")
_UNKNOWN_TIME = re.compile(r"assume|unknown|n/?a|-*$", re.IGNORECASE)


def split_motion(label: str) -> tuple[str, bool]:
    """Return a motion's label without trailing `*`, and whether one was there: a composite motion."""
    end = len(label)
    while end and (label[end - 1] == "*" or label[end - 1].isspace()):
        end -= 1
    return label[:end], "*" in label[end:]


def parse_time(text: str) -> float | None:
    """Read `m:ss` or `h:mm:ss`, milliseconds at most, as seconds; None if the time is not known.

    Raises `ValueError` if the text is neither a time nor a word for an unknown one.
    """
    if _UNKNOWN_TIME.match(text):
        return None
    match = _TIME.fullmatch(text)
    if match is None:
        raise ValueError(f"{text!r} is not a time (m:ss or h:mm:ss)")
    hours, minutes, seconds = (int(part or 0) for part in match.groups()[:3])
    thousandths = int((match[4] or "")[:3].ljust(3, "0"))
    return ((hours * 60 + minutes) * 60000 + seconds * 1000 + thousandths) / 1000


def time_text(seconds: float | None) -> str:
    """Write `m:ss`, with milliseconds where there are some; `Assumed` if the time is not known."""
    if seconds is None:
        return "Assumed"
    minutes, rest = divmod(round(seconds * 1000), 60000)
    whole, thousandths = divmod(rest, 1000)
    return f"{minutes}:{whole:02d}" + (f".{thousandths:03d}".rstrip("0") if thousandths else "")


def parse_rate(value: object) -> float | None:
    """Read a chance between 0 and 1, a number or its text; None if it is neither."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        return None
    try:
        rate = float(value)
    except (ValueError, OverflowError):
        return None
    return rate if 0 <= rate <= 1 else None


def check_times(start: float | None, end: float | None, report: Report) -> None:
    """Report times that run backwards."""
    if start is not None and end is not None and end < start:
        report("times-backwards", f"the motion ends ({time_text(end)}) before it starts")


def check_sides(inputs: list[int], outputs: list[int]) -> list[tuple[str, str]]:
    """Return code and message of each side of a unit that is empty or lists an object twice."""
    if inputs and outputs and len(set(inputs)) == len(inputs) and len(set(outputs)) == len(outputs):
        return []
    found = []
    for side, numbers in (("input", inputs), ("output", outputs)):
        if not numbers:
            found.append((f"unit-without-{side}s", f"a unit without {side}s"))
        elif len(set(numbers)) != len(numbers):
            found.append((f"duplicate-{side}", f"an {side} is listed twice"))
    return found


@dataclass(frozen=True, slots=True)
class LabelIds:
    """The numbers that the labels of some units get when ids are to be written: their sorted places."""

    objects: dict[str, int]
    states: dict[str, int]
    motions: dict[str, int]

    @classmethod
    def of(cls, foon: Foon, units: Sequence[FunctionalUnit]) -> LabelIds:
        nodes = [foon.objects[o] for o in {o for unit in units for o in unit.inputs + unit.outputs}]
        return cls(
            _numbered({node.label for node in nodes}),
            _numbered({state.name for node in nodes for state in node.states}),
            _numbered({unit.motion for unit in units}),
        )


def _numbered(labels: set[str]) -> dict[str, int]:
    return {label: number for number, label in enumerate(sorted(labels))}
