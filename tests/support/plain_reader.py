"""A reader of FOON text that goes from line to line and adds unit by unit: slow, and easy to believe.

What a line says by itself is read by `foon_asp.io.lines`; how lines make units is said here once more.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

from foon_asp.characters import one_line, without_control_characters
from foon_asp.io.findings import Finding, oddity
from foon_asp.io.lines import only_ends, read_end, read_motion, read_object, read_origin, read_state, stray
from foon_asp.io.syntax import FROM_NOTHING, check_sides, repeated
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.node import Mark, ObjectNode, Source, State

_NO_ID = r"(?i:none|null|n/a)"
_OBJECT = re.compile(rf"[Oo](?:\d*|{_NO_ID})(?:[\t ]|\Z)")
_MOTION = re.compile(rf"[Mm](?:\d*|{_NO_ID})(?:[\t ]|\Z)")
_END = re.compile(r"//|[/\\]+[\t ]*\Z")


@dataclass
class _Object:
    label: str
    mark: Mark
    states: list[State] = field(default_factory=list)


@dataclass
class _Unit:
    inputs: list[_Object] = field(default_factory=list)
    outputs: list[_Object] = field(default_factory=list)
    motions: list[tuple[int, str]] = field(default_factory=list)
    sources: list[Source] = field(default_factory=list)
    line: int = 0
    blank: bool = True


class PlainReader:
    """Reads text files into one builder, as `TextReader` does."""

    def __init__(self, builder: FoonBuilder) -> None:
        self.findings: list[Finding] = []
        self.reported_units = 0
        self._builder = builder

    def read(self, text: str, file: str) -> None:
        self._file = file
        self._video = ""
        self._unit = _Unit()
        self._object: _Object | None = None
        rows = self._cleaned(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"))
        if not rows[-1]:
            rows.pop()
        closed = False
        for line, row in enumerate(rows, 1):
            if _END.match(row):
                self._end(line, row, doubled=closed and self._unit.blank)
                closed = True
                self._unit = _Unit()
                self._object = None
            else:
                self._read(line, row)
                self._unit.blank &= not row.strip()
        if self._finish():
            message = "the last unit is not closed by '//'"
            self._report(len(rows), "unit-not-closed", message, "write '//' below it")

    def _report(self, line: int, code: str, message: str, mend: str = "") -> None:
        self.findings.append(oddity(code, self._file, line, message, mend))

    def _cleaned(self, rows: list[str]) -> list[str]:
        for line, row in enumerate(rows, 1):
            if count := len(row) - len(without_control_characters(row)):
                message = f"control characters, left out: {count}"
                self._report(line, "control-character", message, "delete them")
        rows = list(map(without_control_characters, rows))
        for line, row in enumerate(rows, 1):
            if row.startswith("\ufeff"):
                message = "the line begins with a byte order mark"
                self._report(line, "byte-order-mark", message, "delete it")
        return [row.lstrip("\ufeff") for row in rows]

    def _read(self, line: int, row: str) -> None:
        unit = self._unit
        if _OBJECT.match(row):
            label, mark, odd = read_object(row)
            self._object = _Object(label, mark)
            (unit.outputs if unit.motions else unit.inputs).append(self._object)
            unit.line = unit.line or line
        elif _MOTION.match(row):
            self._object = None
            unit.motions.append((line, row))
            unit.line = unit.line or line
            return
        elif row.startswith("#"):
            self._object = None
            self._comment(row.lstrip("# \t"))
            return
        elif self._object is None:
            odd = (stray(row),)
        else:
            state, odd = read_state(row)
            if state is not None:
                if state in self._object.states:
                    odd += (("duplicate-state", f"{str(state)!r} is said twice", ""),)
                self._object.states.append(state)
        for one in odd:
            self._report(line, *one)

    def _comment(self, words: str) -> None:
        if words.lower().startswith("source:"):
            self._video = one_line(words[7:])
        elif words.lower().startswith("from:") and not self._unit.line:
            self._unit.sources.append(Source(*read_origin(words[5:].strip()), self._video))

    def _end(self, line: int, row: str, *, doubled: bool) -> None:
        found = self._finish()
        odd = read_end(row)
        for one in odd:
            self._report(line, *one)
        if not found:
            mend = "delete the line" if doubled and only_ends(row) else ""
            self._report(line, "empty-unit", "this '//' ends a unit that is empty", mend)

    def _finish(self) -> bool:
        unit = self._unit
        if not unit.line:
            return False
        if not unit.motions:
            self._report(unit.line, "unit-without-motion", "a unit without a motion is left out")
        elif len(unit.motions) > 1:
            message = "two motions: a '//' is missing; units left out"
            self._report(unit.motions[1][0], "two-motions", message)
        elif all(each.label for each in unit.inputs + unit.outputs):
            line, row = unit.motions[0]
            label, note, odd = read_motion(row)
            for one in odd:
                self._report(line, *one)
            if label and not unit.inputs:
                self._report(unit.line, *FROM_NOTHING)
            elif label:
                sources = unit.sources or [Source(self._file, unit.line, self._video)]
                marks = tuple(each.mark for each in unit.inputs + unit.outputs)
                inputs, outputs = (
                    [self._builder.object(ObjectNode.of(each.label, each.states)) for each in side]
                    for side in (unit.inputs, unit.outputs)
                )
                for code, message in check_sides(inputs, outputs):
                    self._report(unit.line, code, message)
                note = replace(note, sources=tuple(sources), marks=marks)
                number, added = self._builder.unit(label, inputs, outputs, note)
                for code, message in repeated(added, self._builder.rate(number)):
                    self._report(unit.line, code, message)
                return True
        self.reported_units += max(1, len(unit.motions))
        return True
