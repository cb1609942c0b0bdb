"""Actions as planners and validators print them: one grammar, which takes in the dialects of all of them.

A line is `number action ending`, of which number and ending may be missing:

- the number is a time or a place, with `:`, `.` or `)` behind it, or `step` before it;
- the action is `(name argument …)`, `name(argument, …)` or `name argument …`;
- the ending is `[duration …]`, `(cost)`, ` - start` or a comment.

Lower and upper case are the same, and so are `-` and `_`: no name of an export has both.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

DIALECTS = {
    "IPC": "(pour-45 jar-empty)",
    "IPC, with times": "0.000: (pour-45 jar-empty) [5.000]",
    "numbered": "1. (pour-45 jar-empty)",
    "names alone": "pour-45 jar-empty",
    "FF": "step    0: POUR-45 JAR-EMPTY",
    "LPG": "0.0003:   (POUR-45 JAR-EMPTY) [D:1.0000; C:0.1000]",
    "Fast Downward": "pour-45 jar-empty (1)",
    "POPF, OPTIC": "0.000: (pour-45 jar-empty)  [5.000]",
    "PlanSys2": "0:\t(pour-45 jar-empty)\t[5.000]",
    "VAL": "(pour-45 jar-empty) - start",
    "unified-planning, in order": "    pour_45(jar_empty)",
    "unified-planning, partly ordered": "    0) pour_45(jar_empty)",
    "unified-planning, with times": "    0.0: pour_45(jar_empty) [5.0]",
    "unified-planning, on one line": "SequentialPlan([pour_45(jar_empty)])",
}
"""An example line of each dialect: the same action in all of them."""

_NUMBER = r"(?:step\s+)?(?P<number>\d+(?:\.\d+)?(?:e[+-]?\d+)?)\s*[:.)]\s*"
_NAME = r"[a-z_][\w-]*"
_ACTION = rf"""
    \(\s* (?P<listed> {_NAME} (?:\s+{_NAME})* ) \s*\)
    | (?P<called> {_NAME} \([^()]*\) )
    | (?P<plain> {_NAME} (?:\s+{_NAME})* )
"""
_ENDING = r"\s*(?: \[[^\[\]]*\] | \(\d+\) | -\s+(?P<moment>start|end) )?\s*(?:;.*)?"
_LINE = re.compile(rf"(?:{_NUMBER})?(?:{_ACTION}){_ENDING}", re.VERBOSE | re.IGNORECASE | re.ASCII)

_BEGINNING = re.compile(
    rf"(?:(?:step )?\d[\d.]*(?:e[+-]?\d+)? ?(?P<number>[:)])?)? ?(?P<open>\( ?)?(?P<name>{_NAME})?",
    re.IGNORECASE | re.ASCII,
)
_OF_A_UNIT = re.compile(r".*-\d+")
_ON_ONE_LINE, _ITS_ACTION = "SequentialPlan([", re.compile(r"[^\s,()\[\]]+(?:\([^()]*\))?")

_ANNOUNCED = re.compile(
    r"(?<!no )(?:solution|plan) found|found (?:legal )?plan|plan computed|plan to validate|empty plan"
    r"|^\s*(?:plan:\s*)?[a-z]*plan(?::|\(\[)",
    re.IGNORECASE,
)
"""What planners print before a plan. VAL goes on with how it executes the plan, step by step."""

_ENDED = re.compile(r"plan validation details", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Line:
    """What looks like an action in a line of a text: its number or time, and its name and arguments.

    `place` is the line, from 1, `plan` the number of the plan of the text. A line that says more or less
    than an action does is `broken`. `surely`: it is an action whatever its name is.
    """

    place: int
    plan: int
    number: float
    words: tuple[str, ...]
    text: str
    broken: bool
    surely: bool


@dataclass(frozen=True, slots=True)
class Reading:
    """The lines of a text that look like actions. `announced`: it says that it has a plan, or it is empty."""

    lines: list[Line]
    announced: bool


def read_lines(text: str) -> Reading:
    """Return what looks like an action in a plan, or in the log of a planner, line by line."""
    found: list[Line] = []
    plan, ended, empty, announced = 0, False, True, False
    for place, raw in enumerate(text.splitlines(), 1):
        line = " ".join(raw.split())
        if _ANNOUNCED.search(line):
            plan, ended, announced = plan + 1, False, True
        elif _ENDED.search(line):
            ended = True
        if not line or line.startswith(";"):
            continue
        empty = False
        if not ended:
            found += _actions(line, place, plan)
    return Reading(found, announced or empty)


def _actions(line: str, place: int, plan: int) -> Iterator[Line]:
    _, whole, rest = line.partition(_ON_ONE_LINE)
    for text in _ITS_ACTION.findall(rest) if whole else [line]:
        match = _LINE.fullmatch(text)
        if match is None:
            yield from _broken(text, place, plan)
        elif match["moment"] is None or match["moment"].lower() == "start":
            words = _words(match["listed"] or match["called"] or match["plain"])
            surely = match["plain"] is None or _OF_A_UNIT.fullmatch(words[0]) is not None
            yield Line(place, plan, float(match["number"] or 0), words, text, broken=False, surely=surely)


def _broken(text: str, place: int, plan: int) -> Iterator[Line]:
    """Yield a line that begins as an action does, and does not end so."""
    begins = _BEGINNING.match(text)
    assert begins is not None
    surely = begins["open"] is not None and (begins["number"] is not None or ")" not in text)
    if surely or begins["name"] is not None:
        words = _words(begins["name"] or "")
        yield Line(place, plan, 0, words, text, broken=True, surely=surely)


def _words(text: str) -> tuple[str, ...]:
    """Return the names of an action and its arguments as exports write them."""
    return tuple(re.split(r"[\s(),]+", text.lower().replace("_", "-").strip(" \t(),")))
