"""The FOON text format: reading all its dialects, writing labels only or with all annotations.

A file is a sequence of functional units, each ended by a `//` line. A unit is blocks of lines: an
object (an `O` line and the `S` lines of its states), a motion (an `M` line), a comment (`#`). Objects
before the motion are inputs, after it outputs. docs/format.md has the grammar and the dialects.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Literal

from foon_asp.builder import FoonBuilder
from foon_asp.findings import Finding
from foon_asp.graph import Annotation, Foon, FunctionalUnit, Mark, ObjectNode, Source, State
from foon_asp.mend import OF_ROWS, mend_row
from foon_asp.oddities import oddity
from foon_asp.state_syntax import Report, make_state, one_line, parse_state, without_control_characters
from foon_asp.unit_syntax import (
    LabelIds,
    check_sides,
    check_times,
    parse_rate,
    parse_time,
    split_motion,
    time_text,
)

Dialect = Literal["A", "B"]

_START = r"(?:[OM]\d*(?:[\t ]|$)|#)"
_BLOCK = re.compile(rf"^{_START}.*\n?(?:(?!{_START}).*\n|(?!{_START}).+\Z)*", re.MULTILINE)
_HEAD = re.compile(r"[OSM]\d*(?:[\t ]+|$)")
_PLAIN_CONTENTS = re.compile(r"S\d*\tcontains\t\{([a-z]+(?:[ ,][a-z]+)*)\}")
_LIKE_A_TIME = re.compile(r"[<\d]|assume|unknown|n/?a|-|$", re.IGNORECASE)
_NOT_A_LABEL = re.compile(r"[\d!]*")

_NO_MARK = Mark()
_DOUBTFUL = frozenset({"unbalanced-brackets", "stray-text"})
"""A line that is odd in one of these ways is not mended in others: what it means is not certain."""


@dataclass(slots=True)
class _Block:
    """A block once read: its object, and what is odd in it (line offset, code, message, mend).

    `number` is the object's id in the graph, which it gets with its first unit.
    """

    node: ObjectNode | None
    mark: Mark
    oddities: tuple[tuple[int, str, str, str], ...]
    lines: int
    number: int = -1


@dataclass(slots=True)
class _Unit:
    """The blocks of one unit while it is read."""

    inputs: list[_Block] = field(default_factory=list)
    outputs: list[_Block] = field(default_factory=list)
    motions: list[tuple[int, str]] = field(default_factory=list)
    sources: list[Source] = field(default_factory=list)
    line: int = 0
    broken: bool = False
    marked: bool = False


@dataclass(frozen=True, slots=True)
class _Motion:
    """An `M` line once read: its label, what it notes beside, and what is odd in it (code, message)."""

    label: str
    note: Annotation
    oddities: tuple[tuple[str, str], ...]


_StateLine = tuple[State | None, tuple[tuple[str, str, str], ...]]
"""An `S` line once read: the state, if it says one, and what is odd in it (code, message, mend)."""


class TextReader:
    """Reads text files into one builder. Blocks and lines recur, so each is read only once."""

    def __init__(self, builder: FoonBuilder) -> None:
        self.findings: list[Finding] = []
        self.reported_units = 0
        self._builder = builder
        self._blocks: dict[str, _Block] = {}
        self._states: dict[str, _StateLine] = {}
        self._motions: dict[str, _Motion] = {}
        self._file = ""
        self._video = ""

    def read(self, text: str, file: str) -> None:
        """Read all units of one file; what is odd in it is added to `findings`."""
        self._file = file
        self._video = ""
        text = self._plain(text)
        line = 1
        start = 0
        while start < len(text):
            stop, after = _end_of_unit(text, start)
            chunk = text[start:stop]
            found = bool(chunk) and self._read_unit(chunk, line)
            if stop == after and found:
                last = line + chunk.count("\n") - chunk.endswith("\n")
                mend = "write '//' below it"
                self._report(last, "unit-not-closed", "the last unit is not closed by '//'", mend)
            line += chunk.count("\n")
            if stop < after and (not found or after - stop > len("//\n")):
                self._check_end(text[stop:after], line, found, doubled=start > 0 and not chunk.strip())
            line += 1
            start = after

    def _plain(self, text: str) -> str:
        """Return the text with newlines only, without byte order marks and control characters."""
        text = text.replace("\r\n", "\n").replace("\r", "\n")
        plain = without_control_characters(text)
        if len(plain) != len(text):
            for line, row in enumerate(text.split("\n"), 1):
                count = len(row) - len(without_control_characters(row))
                if count:
                    message = f"control characters, left out: {count}"
                    self._report(line, "control-character", message, "delete them")
        if "\ufeff" in plain:
            # Files that were joined have the mark in the middle, too.
            rows = plain.split("\n")
            for line, row in enumerate(rows, 1):
                if row.startswith("\ufeff"):
                    self._report(
                        line, "byte-order-mark", "the line begins with a byte order mark", "delete it"
                    )
            plain = "\n".join(row.lstrip("\ufeff") for row in rows)
        return plain

    def _check_end(self, row: str, line: int, found: bool, *, doubled: bool) -> None:
        """Report what is odd about the `//` line behind a unit."""
        rest = row.strip("/ \t\n")
        if rest:
            self._report(line, "stray-text", f"{rest!r} behind '//' is left out")
        if not found:
            mend = "delete the line" if doubled and not rest else ""
            self._report(line, "empty-unit", "this '//' ends a unit that is empty", mend)

    def _report(self, line: int, code: str, message: str, mend: str = "") -> None:
        self.findings.append(oddity(code, self._file, line, message, mend))

    def _read_unit(self, chunk: str, line: int) -> bool:
        """Read the text between two `//` lines that begins at `line`. Return whether a unit is there."""
        unit = _Unit()
        rows = _BLOCK.findall(chunk)
        stray = len(chunk) - sum(map(len, rows))
        if stray:
            line = self._read_stray(chunk[:stray], line)
        for raw in rows:
            if raw[0] == "O":
                block = self._blocks.get(raw)
                if block is None:
                    block = self._blocks[raw] = self._read_object(raw)
                if block.oddities:
                    for offset, code, message, mend in block.oddities:
                        self._report(line + offset, code, message, mend)
                unit.line = unit.line or line
                if block.node is None:
                    unit.broken = True
                if block.mark is not _NO_MARK:
                    unit.marked = True
                (unit.outputs if unit.motions else unit.inputs).append(block)
                line += block.lines
                continue
            head, _, rest = raw.partition("\n")
            if raw[0] == "M":
                unit.motions.append((line, head))
                unit.line = unit.line or line
            else:
                self._read_comment(head, unit)
            line += 1
            if rest:
                line = self._read_stray(rest, line)
        return self._finish(unit)

    def _read_stray(self, text: str, line: int) -> int:
        """Report lines that belong to no object. Return the line behind them."""
        for row in text.removesuffix("\n").split("\n") if text else ():
            if _HEAD.match(row):
                self._report(line, "state-of-motion", f"the state {row!r} belongs to no object")
            elif row.strip():
                self._report(line, "unreadable-line", f"cannot read {row[:60]!r}")
            else:
                self._report(line, "blank-line", "a blank line", "delete the line")
            line += 1
        return line

    def _read_comment(self, line: str, unit: _Unit) -> None:
        """Take what a comment says of where units come from: the video, or the place of the next unit."""
        words = line.lstrip("# \t")
        kind = words[:7].lower()
        if kind == "source:":
            self._video = one_line(words[7:])
        elif kind[:5] == "from:" and not unit.line:
            unit.sources.append(_read_source(words[5:].strip(), self._video))

    def _read_object(self, raw: str) -> _Block:
        lines = raw.split("\n")
        if not lines[-1]:
            lines.pop()
        odd: list[tuple[str, str]] = []
        fields = _fields(lines[0])
        label = fields[0].lower() if fields else ""
        if not label:
            odd.append(("object-without-label", f"no label in {lines[0]!r}"))
        elif "\t" not in lines[0]:
            odd.append(("missing-tab", f"no tab in {lines[0]!r}"))
        more = _label_fields(fields, _NOT_A_LABEL.fullmatch) if label and len(fields) > 1 else 0
        if more:
            label = " ".join([label, *fields[1 : 1 + more]]).lower()
            odd.append(("tab-in-label", f"a tab inside of a label, read as {label!r}"))
        mark = _read_mark(fields[1 + more :], odd) if len(fields) > 1 else _NO_MARK
        oddities = [(0, code, message, _row_mend(lines[0], code)) for code, message in odd]
        states: dict[State, None] = {}
        for offset, row in enumerate(lines[1:], 1):
            known = self._states.get(row)
            if known is None:
                known = self._states[row] = _read_state(row)
            state, found = known
            if found:
                oddities += [(offset, *one) for one in found]
            if state is not None:
                if state in states:
                    oddities.append((offset, "duplicate-state", f"{str(state)!r} is said twice", ""))
                states[state] = None
        node = None
        if label:
            node = ObjectNode.of(label, states) if len(states) > 1 else ObjectNode(label, tuple(states))
        return _Block(node, mark, tuple(oddities), len(lines))

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
            motion = self._motion(*unit.motions[0])
            if motion.label:
                self._add(unit, motion)
                return True
        self.reported_units += max(1, len(unit.motions))
        return True

    def _add(self, unit: _Unit, motion: _Motion) -> None:
        inputs = [b.number if b.number >= 0 else self._number(b) for b in unit.inputs]
        outputs = [b.number if b.number >= 0 else self._number(b) for b in unit.outputs]
        for code, message in check_sides(inputs, outputs):
            self._report(unit.line, code, message)
        marks = [block.mark for block in (*unit.inputs, *unit.outputs)] if unit.marked else ()
        sources = unit.sources or (Source(self._file, unit.line, self._video),)
        if not self._builder.add(motion.label, inputs, outputs, motion.note, sources, marks)[1]:
            self._report(unit.line, "duplicate-unit", "this unit was there before")

    def _number(self, block: _Block) -> int:
        """Give a block's object its id; objects of units that are left out never get one."""
        assert block.node is not None
        block.number = self._builder.object(block.node)
        return block.number

    def _motion(self, line: int, row: str) -> _Motion:
        """Read an `M` line, and report what is odd in it."""
        motion = self._motions.get(row)
        if motion is None:
            motion = self._motions[row] = _read_motion(row)
        for code, message in motion.oddities:
            self._report(line, code, message, _row_mend(row, code))
        return motion


def _end_of_unit(text: str, start: int) -> tuple[int, int]:
    """Return where the next `//` line begins and where the one behind it; twice the end if there is none."""
    stop = start
    if not text.startswith("//", start):
        before = text.find("\n//", start)
        if before < 0:
            return len(text), len(text)
        stop = before + 1
    return stop, text.find("\n", stop) + 1 or len(text)


def _read_motion(row: str) -> _Motion:
    """Read `M<id?> label [start end | start-end] [agent rate]`; the label is empty if there is none."""
    odd: list[tuple[str, str]] = []
    fields = _fields(row)
    label, composite = split_motion(fields[0].lower()) if fields else ("", False)
    if not label:
        odd.append(("motion-without-label", f"no label in {row!r}; the unit is left out"))
        return _Motion("", Annotation(), tuple(odd))
    if "\t" not in row:
        odd.append(("missing-tab", f"no tab in {row!r}"))
    more = _label_fields(fields, _LIKE_A_TIME.match)
    if more and len(fields) > 1 + more:
        label, composite = split_motion(" ".join(fields[: 1 + more]).lower())
        del fields[1 : 1 + more]
        odd.append(("tab-in-label", f"a tab inside of a label, read as {label!r}"))
    start, end, rest = _read_times(fields[1:], odd)
    agent = rest[0] if rest else ""
    rate = None
    if len(rest) > 1 and rest[1]:
        rate = parse_rate(rest[1])
        if rate is None:
            odd.append(("broken-rate", f"{rest[1]!r} is not a chance between 0 and 1"))
    if len(rest) > 2:
        odd.append(("stray-field", f"{rest[2]!r} behind the success rate is left out"))
    note = Annotation(composite=composite, start=start, end=end, agent=agent, rate=rate)
    return _Motion(label, note, tuple(odd))


def _read_times(
    fields: list[str], odd: list[tuple[str, str]]
) -> tuple[float | None, float | None, list[str]]:
    """Take the times from the front of the fields; return start, end (seconds) and the rest."""
    if not fields:
        return None, None, []
    first = fields[0].strip("<>")
    joined = "-" in first.strip("-")
    texts = first.split("-", 1) if joined else [first, *fields[1:2]]
    times: list[float | None] = []
    for text in texts:
        try:
            times.append(parse_time(text.strip("<> ")))
        except ValueError as error:
            odd.append(("broken-time", str(error)))
            times.append(None)
    start, end = [*times, None][:2]
    check_times(start, end, lambda code, message: odd.append((code, message)))
    return start, end, fields[1:] if joined else fields[2:]


def _read_source(text: str, video: str) -> Source:
    """Read the `file:line` of a `# From:` comment."""
    file, colon, number = text.rpartition(":")
    if colon and re.fullmatch(r"[0-9]{1,9}", number):
        return Source(file, int(number), video)
    return Source(text, 0, video)


def _fields(row: str) -> list[str]:
    """Split an O, S or M line behind its id; the fields are stripped, empty ones at the end dropped."""
    if row.count("\t") == 1 and row[1:2] == "\t":
        # Most lines are nothing but a label.
        field = row[2:].strip()
        return [field] if field else []
    head = _HEAD.match(row)
    fields = [field.strip() for field in row[head.end() if head else 0 :].split("\t")]
    while fields and not fields[-1]:
        fields.pop()
    return fields


def _label_fields(fields: list[str], ends_label: Callable[[str], object]) -> int:
    """Return how many fields behind the first belong to a label that has tabs inside."""
    count = 0
    for text in fields[1:]:
        if ends_label(text):
            break
        count += 1
    return count


def _read_mark(fields: list[str], odd: list[tuple[str, str]]) -> Mark:
    """Read the flag (0/1: it moves) and the goal mark (`!` or a dish category)."""
    if not fields:
        return _NO_MARK
    moves: bool | None = None
    goal = ""
    for place, text in enumerate(fields):
        if place == 0 and text in ("0", "1"):
            moves = text == "1"
        elif place == 0 and text.strip("0") in ("", "1") and text:
            odd.append(("odd-flag", f"the flag {text!r} is read as {text[-1]!r}"))
            moves = text[-1] == "1"
        elif text and not goal and (text == "!" or (place > 0 and text.isdigit())):
            goal = text
        elif text:
            odd.append(("stray-field", f"{text!r} is neither a flag nor a goal mark"))
    return Mark(moves, goal) if goal or moves is not None else _NO_MARK


def _read_state(row: str) -> _StateLine:
    """Read an `S` line of an object."""
    plain = _PLAIN_CONTENTS.fullmatch(row)
    if plain:
        # Of all lines these are the most varied in a large FOON, and hardly ever is one odd.
        contents = sorted(plain[1].split(","))
        if len(set(contents)) == len(contents):
            return State("contains", contents=tuple(contents)), ()
    if not row.strip():
        return None, (("blank-line", "a blank line", "delete the line"),)
    odd: list[tuple[str, str]] = []
    state = _state_of(row, lambda code, message: odd.append((code, message)))
    all_codes = {code for code, _ in odd}
    codes = OF_ROWS & all_codes
    mend = _state_mend(row, state, codes) if codes and _DOUBTFUL.isdisjoint(all_codes) else ""
    return state, tuple((code, message, mend if code in codes else "") for code, message in odd)


def _state_mend(row: str, state: State | None, codes: frozenset[str]) -> str:
    """Return how to mend a state line, or nothing if that would change what it says."""
    mended = mend_row(row, codes)
    left: list[tuple[str, str]] = []
    same = _state_of(mended, lambda code, message: left.append((code, message))) == state
    certain = same and OF_ROWS.isdisjoint(code for code, _ in left)
    return f"write {mended!r}" if certain else ""


def _row_mend(row: str, code: str) -> str:
    """Return how to mend an object or motion line."""
    mended = mend_row(row, {code}) if code in OF_ROWS else row
    return f"write {mended!r}" if mended != row else ""


def _state_of(row: str, report: Report) -> State | None:
    if not _HEAD.match(row):
        report("unreadable-line", f"cannot read {row[:60]!r}")
        return None
    fields = _fields(row)
    if not fields or not fields[0]:
        report("state-without-name", f"no state in {row!r}")
        return None
    glued = any(mark in fields[0] for mark in "[]{}")
    if glued or "\t" not in row:
        report("missing-tab", f"no tab {'before the bracket ' if glued else ''}in {row!r}")
    if not glued:
        return make_state(fields[0].lower(), " ".join(fields[1:]), report)
    state = parse_state(" ".join(fields), report)
    if state is None:
        report("state-without-name", f"no state in {row!r}")
    return state


def write_text(
    foon: Foon,
    units: Iterable[FunctionalUnit],
    comments: Iterable[str] = (),
    dialect: Dialect = "B",
    *,
    provenance: bool = False,
) -> str:
    """Write units in a dialect: B is labels only, A is all that the annotators noted, with ids.

    With `provenance` a `# From:` comment names each place where a unit was read, and reading the text
    brings these places back. Writing what was read from this text gives the same text.
    """
    chosen = list(units)
    writer = _Annotated(foon, chosen) if dialect == "A" else _Plain(foon)
    lines = [f"# {' '.join(comment.splitlines())}" for comment in comments]
    lines.append("//")
    video = ""
    for unit in chosen:
        for source in unit.annotation.sources if provenance else unit.annotation.sources[:1]:
            if source.video != video and (provenance or dialect == "A"):
                video = source.video
                lines.append(f"# Source:\t{video}")
            if provenance:
                lines.append(f"# From:\t{' '.join(source.file.splitlines())}:{source.line}")
        lines += writer.unit(unit)
        lines.append("//")
    return "\n".join(lines) + "\n"


class _Plain:
    """Writes units with labels only, one field a tab."""

    def __init__(self, foon: Foon) -> None:
        self._objects = foon.objects

    def unit(self, unit: FunctionalUnit) -> Iterator[str]:
        for number in unit.inputs:
            yield from object_lines(self._objects[number])
        yield f"M\t{unit.motion}" + "*" * unit.annotation.composite
        for number in unit.outputs:
            yield from object_lines(self._objects[number])


class _Annotated:
    """Writes units with ids, flags, goal marks, times, agent and success rate."""

    def __init__(self, foon: Foon, units: Sequence[FunctionalUnit]) -> None:
        self._foon = foon
        self._ids = LabelIds.of(foon, units)

    def unit(self, unit: FunctionalUnit) -> Iterator[str]:
        ports = unit.inputs + unit.outputs
        marks = unit.annotation.marks or (_NO_MARK,) * len(ports)
        lines = [self._object(number, mark) for number, mark in zip(ports, marks, strict=True)]
        for place, rows in enumerate(lines):
            if place == len(unit.inputs):
                yield self._motion(unit)
            yield from rows
        if not unit.outputs:
            yield self._motion(unit)

    def _object(self, number: int, mark: Mark) -> Iterator[str]:
        node = self._foon.objects[number]
        moves = "" if mark.moves is None else str(int(mark.moves))
        row = f"O{self._ids.objects[node.label]}\t{node.label}\t{moves}\t{mark.goal}"
        yield row.rstrip("\t")
        for state in node.states:
            yield f"S{self._ids.states[state.name]}\t{_state_fields(state)}"

    def _motion(self, unit: FunctionalUnit) -> str:
        note = unit.annotation
        rate = "" if note.rate is None else repr(note.rate)
        label = unit.motion + "*" * note.composite
        fields = [label, time_text(note.start), time_text(note.end), note.agent, rate]
        return f"M{self._ids.motions[unit.motion]}\t" + "\t".join(fields).rstrip("\t")


def object_lines(node: ObjectNode) -> list[str]:
    """Write an object and its states, a line each."""
    return [f"O\t{node.label}", *(f"S\t{_state_fields(state)}" for state in node.states)]


def _state_fields(state: State) -> str:
    text = state.name
    if state.relatum is not None:
        text += f"\t[{state.relatum}]"
    if state.contents is not None:
        text += "\t{" + ",".join(state.contents) + "}"
    return text
