"""The FOON text format: reading all its dialects, writing the one with labels only.

A file is a sequence of functional units, each ended by a `//` line. A unit is blocks of lines: an
object (an `O` line and the `S` lines of its states), a motion (an `M` line), a comment (`#`). Objects
before the motion are inputs, after it outputs. docs/format.md has the grammar and the dialects.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from foon_asp.findings import Finding, Severity
from foon_asp.graph import Annotation, Foon, FoonBuilder, FunctionalUnit, Mark, ObjectNode, Source, State
from foon_asp.state_syntax import Report, make_state, parse_state

_END_OF_UNIT = re.compile(r"^//.*\n?", re.MULTILINE)
_START = r"(?:[OM]\d*(?:[\t ]|$)|#)"
_BLOCK = re.compile(rf"^{_START}.*\n?(?:(?!{_START}).*\n|(?!{_START}).+\Z)*", re.MULTILINE)
_HEAD = re.compile(r"[OSM]\d*(?:[\t ]+|$)")
_TIME = re.compile(r"(?:(\d+):)?(\d+):(\d\d?)(?:\.\d+)?")
_UNKNOWN_TIME = re.compile(r"assume|unknown|n/?a|-*$", re.IGNORECASE)

_NO_MARK = Mark()
_SEVERITIES = {
    "unreadable-line": Severity.ERROR,
    "object-without-label": Severity.ERROR,
    "unit-without-motion": Severity.ERROR,
    "two-motions": Severity.ERROR,
    "motion-without-label": Severity.ERROR,
    "unit-without-outputs": Severity.WARNING,
    "unit-without-inputs": Severity.WARNING,
    "state-of-motion": Severity.WARNING,
    "state-without-name": Severity.WARNING,
    "contains-without-braces": Severity.WARNING,
    "empty-brackets": Severity.WARNING,
    "empty-braces": Severity.WARNING,
    "comma-in-brackets": Severity.WARNING,
    "unbalanced-brackets": Severity.WARNING,
    "stray-text": Severity.WARNING,
    "broken-time": Severity.WARNING,
    "broken-rate": Severity.WARNING,
}


@dataclass(frozen=True, slots=True)
class _Block:
    """A block once read: which object it is, and what is odd in it (line offset, code, message)."""

    object: int
    mark: Mark
    oddities: tuple[tuple[int, str, str], ...]
    lines: int


@dataclass(slots=True)
class _Unit:
    """The blocks of one unit while it is read."""

    inputs: list[_Block]
    outputs: list[_Block]
    motions: list[tuple[int, str]]
    line: int = 0
    broken: bool = False


_StateLine = tuple[State | None, tuple[tuple[str, str], ...]]
"""An `S` line once read: the state, if it says one, and what is odd in it (code, message)."""


class TextReader:
    """Reads text files into one builder. Blocks and state lines recur, so each is read only once."""

    def __init__(self, builder: FoonBuilder) -> None:
        self.findings: list[Finding] = []
        self.reported_units = 0
        self._builder = builder
        self._blocks: dict[str, _Block] = {}
        self._states: dict[str, _StateLine] = {}
        self._file = ""
        self._video = ""

    def read(self, text: str, file: str) -> None:
        """Read all units of one file; what is odd in it is added to `findings`."""
        self._file = file
        self._video = ""
        if text.startswith("\ufeff"):
            self._report(1, "byte-order-mark", "the file begins with a byte order mark")
            text = text[1:]
        text = text.replace("\r\n", "\n").replace("\r", "\n")
        line = 1
        start = 0
        while start < len(text):
            end = _END_OF_UNIT.search(text, start)
            stop = end.start() if end else len(text)
            chunk = text[start:stop]
            found = bool(chunk) and self._read_unit(chunk, line)
            line += chunk.count("\n")
            if end is None and found:
                last = line - chunk.endswith("\n")
                self._report(last, "unit-not-closed", "the last unit is not closed by '//'")
            elif end is not None and not found:
                self._report(line, "empty-unit", "this '//' ends a unit that is empty")
            line += 1
            start = end.end() if end else len(text)

    def _report(self, line: int, code: str, message: str) -> None:
        severity = _SEVERITIES.get(code, Severity.NOTE)
        self.findings.append(Finding(code, severity, self._file, line, message))

    def _read_unit(self, chunk: str, line: int) -> bool:
        """Read the text between two `//` lines that begins at `line`. Return whether a unit is there."""
        unit = _Unit([], [], [])
        place = 0
        first = _BLOCK.search(chunk)
        if first is None or first.start() > 0:
            place = first.start() if first else len(chunk)
            line = self._read_stray(chunk[:place], line)
        for match in _BLOCK.finditer(chunk, place):
            raw = match[0]
            if raw[0] == "O":
                block = self._blocks.get(raw)
                if block is None:
                    block = self._blocks[raw] = self._read_object(raw)
                for offset, code, message in block.oddities:
                    self._report(line + offset, code, message)
                unit.line = unit.line or line
                unit.broken |= block.object < 0
                (unit.outputs if unit.motions else unit.inputs).append(block)
                line += block.lines
            elif raw[0] == "M":
                head, _, rest = raw.partition("\n")
                unit.motions.append((line, head))
                unit.line = unit.line or line
                line = self._read_stray(rest, line + 1)
            else:
                head, _, rest = raw.partition("\n")
                self._read_comment(head)
                line = self._read_stray(rest, line + 1)
        return self._finish(unit)

    def _read_stray(self, text: str, line: int) -> int:
        """Report lines that belong to no object. Return the line behind them."""
        for row in text.removesuffix("\n").split("\n") if text else ():
            if _HEAD.match(row):
                self._report(line, "state-of-motion", f"the state {row!r} belongs to no object")
            elif row.strip():
                self._report(line, "unreadable-line", f"cannot read {row[:60]!r}")
            else:
                self._report(line, "blank-line", "a blank line")
            line += 1
        return line

    def _read_comment(self, line: str) -> None:
        words = line.lstrip("# \t")
        if words.lower().startswith("source:"):
            self._video = words[len("source:") :].strip()

    def _read_object(self, raw: str) -> _Block:
        lines = raw.split("\n")
        if not lines[-1]:
            lines.pop()
        oddities: list[tuple[int, str, str]] = []
        fields = _fields(lines[0])
        label = fields[0].lower() if fields else ""
        if not label:
            oddities.append((0, "object-without-label", f"no label in {lines[0]!r}"))
        elif "\t" not in lines[0]:
            oddities.append((0, "missing-tab", f"no tab in {lines[0]!r}"))
        mark = _read_mark(fields[1:], oddities)
        states: list[State] = []
        for offset, row in enumerate(lines[1:], 1):
            known = self._states.get(row)
            if known is None:
                known = self._states[row] = _read_state(row)
            state, odd = known
            oddities += [(offset, code, message) for code, message in odd]
            if state is not None:
                if state in states:
                    oddities.append((offset, "duplicate-state", f"{str(state)!r} is said twice"))
                states.append(state)
        number = self._builder.object(ObjectNode.of(label, states)) if label else -1
        return _Block(number, mark, tuple(oddities), len(lines))

    def _finish(self, unit: _Unit) -> bool:
        """Add a unit to the FOON, or report why it cannot be. Return whether there was one."""
        if not (unit.inputs or unit.motions):
            return False
        if not unit.motions:
            self._report(unit.line, "unit-without-motion", "a unit without a motion is left out")
        elif len(unit.motions) > 1:
            place = unit.motions[1][0]
            self._report(place, "two-motions", "two motions: a '//' is missing; units left out")
        elif not unit.broken:
            note = self._read_motion(unit, *unit.motions[0])
            if note is not None:
                motion, annotation = note
                self._add(unit, motion, annotation)
                return True
        self.reported_units += max(1, len(unit.motions))
        return True

    def _add(self, unit: _Unit, motion: str, note: Annotation) -> None:
        inputs = [block.object for block in unit.inputs]
        outputs = [block.object for block in unit.outputs]
        for side, numbers in (("input", inputs), ("output", outputs)):
            if not numbers:
                self._report(unit.line, f"unit-without-{side}s", f"a unit without {side}s")
            elif len(set(numbers)) != len(numbers):
                self._report(unit.line, f"duplicate-{side}", f"an {side} is listed twice")
        if self._builder.unit(motion, inputs, outputs, note) is None:
            self._report(unit.line, "duplicate-unit", "this unit was there before")

    def _read_motion(self, unit: _Unit, line: int, row: str) -> tuple[str, Annotation] | None:
        """Read `M<id?> label [start end | start-end] [agent rate]`; None if it has no label."""
        fields = _fields(row)
        if not fields or not fields[0].strip("* "):
            self._report(line, "motion-without-label", f"no label in {row!r}; the unit is left out")
            return None
        if "\t" not in row:
            self._report(line, "missing-tab", f"no tab in {row!r}")
        label = fields[0].lower()
        start, end, rest = self._read_times(fields[1:], line)
        agent = rest[0] if rest else ""
        rate = None
        if len(rest) > 1:
            rate = _read_rate(rest[1])
            if rate is None:
                self._report(line, "broken-rate", f"{rest[1]!r} is not a chance between 0 and 1")
        marks = tuple(block.mark for block in (*unit.inputs, *unit.outputs))
        if all(mark is _NO_MARK for mark in marks):
            marks = ()
        return label.rstrip("* "), Annotation(
            sources=(Source(self._file, unit.line, self._video),),
            composite=label.endswith("*"),
            start=start,
            end=end,
            agent=agent,
            rate=rate,
            marks=marks,
        )

    def _read_times(self, fields: list[str], line: int) -> tuple[float | None, float | None, list[str]]:
        """Take the times from the front of the fields; return start, end (seconds) and the rest."""
        if not fields:
            return None, None, []
        first = fields[0].strip("<>")
        texts = first.split("-") if "-" in first.strip("-") else [first, *fields[1:2]]
        rest = fields[1:] if "-" in first.strip("-") else fields[2:]
        times = [self._read_time(text.strip("<> "), line) for text in texts[:2]]
        start, end = [*times, None][:2]
        if start is not None and end is not None and end < start:
            self._report(line, "times-backwards", f"the motion ends ({texts[1]}) before it starts")
        return start, end, rest

    def _read_time(self, text: str, line: int) -> float | None:
        if _UNKNOWN_TIME.match(text):
            return None
        match = _TIME.fullmatch(text)
        if match is None:
            self._report(line, "broken-time", f"{text!r} is not a time (m:ss or h:mm:ss)")
            return None
        hours, minutes, seconds = (int(part or 0) for part in match.groups())
        return float(hours * 3600 + minutes * 60 + seconds)


def _fields(row: str) -> list[str]:
    """Split an O, S or M line behind its id; the fields are stripped, empty ones at the end dropped."""
    head = _HEAD.match(row)
    fields = [field.strip() for field in row[head.end() if head else 0 :].split("\t")]
    while fields and not fields[-1]:
        fields.pop()
    return fields


def _read_mark(fields: list[str], oddities: list[tuple[int, str, str]]) -> Mark:
    """Read the flag (0/1: it moves) and the goal mark (`!` or a dish category)."""
    if not fields:
        return _NO_MARK
    moves: bool | None = None
    goal = ""
    for place, text in enumerate(fields):
        if place == 0 and text in ("0", "1"):
            moves = text == "1"
        elif place == 0 and text.strip("0") in ("", "1") and text:
            oddities.append((0, "odd-flag", f"the flag {text!r} is read as {text[-1]!r}"))
            moves = text[-1] == "1"
        elif text == "!" or (place > 0 and text.isdigit()):
            goal = text
        elif text:
            oddities.append((0, "odd-flag", f"{text!r} is neither a flag nor a goal mark"))
    return Mark(moves, goal)


def _read_state(row: str) -> _StateLine:
    """Read an `S` line of an object."""
    odd: list[tuple[str, str]] = []

    def report(code: str, message: str) -> None:
        odd.append((code, message))

    state = _state_of(row, report)
    return state, tuple(odd)


def _state_of(row: str, report: Report) -> State | None:
    if not row.strip():
        report("blank-line", "a blank line")
        return None
    if not _HEAD.match(row):
        report("unreadable-line", f"cannot read {row[:60]!r}")
        return None
    fields = _fields(row)
    if not fields or not fields[0]:
        report("state-without-name", f"no state in {row!r}")
        return None
    if "\t" not in row:
        report("missing-tab", f"no tab in {row!r}")
    if len(fields) == 1 and any(mark in fields[0] for mark in "[]{}"):
        report("missing-tab", f"no tab before the bracket in {fields[0]!r}")
        state = parse_state(fields[0], report)
        if state is None:
            report("state-without-name", f"no state in {row!r}")
        return state
    return make_state(fields[0].lower(), " ".join(fields[1:]), report)


def _read_rate(text: str) -> float | None:
    try:
        rate = float(text)
    except ValueError:
        return None
    return rate if 0 <= rate <= 1 else None


def write_text(foon: Foon, units: Iterable[FunctionalUnit], comments: Iterable[str] = ()) -> str:
    """Write units in the dialect of universal FOONs: labels only, one field a tab."""
    lines = [f"# {comment}" for comment in comments]
    lines.append("//")
    for unit in units:
        for number in unit.inputs:
            lines += object_lines(foon.objects[number])
        lines.append(f"M\t{unit.motion}" + ("*" if unit.annotation.composite else ""))
        for number in unit.outputs:
            lines += object_lines(foon.objects[number])
        lines.append("//")
    return "\n".join(lines) + "\n"


def object_lines(node: ObjectNode) -> list[str]:
    """Write an object and its states, a line each."""
    lines = [f"O\t{node.label}"]
    for state in node.states:
        line = f"S\t{state.name}"
        if state.relatum is not None:
            line += f"\t[{state.relatum}]"
        if state.contents is not None:
            line += "\t{" + ",".join(state.contents) + "}"
        lines.append(line)
    return lines
