"""The FOON text format: reading all its dialects, writing labels only or with all annotations.

A file is a sequence of functional units, each ended by a `//` line. A unit is blocks of lines: an
object (an `O` line and the `S` lines of its states), a motion (an `M` line), a comment (`#`). Objects
before the motion are inputs, after it outputs. docs/format.md has the grammar and the dialects.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal

import numpy as np

from foon_asp import limits
from foon_asp.io.findings import Finding, oddity
from foon_asp.io.lines import END, Lines, only_ends
from foon_asp.io.syntax import FROM_NOTHING, LabelIds, check_sides, repeated, times_fields
from foon_asp.io.units import Units, ranks
from foon_asp.io.vocabulary import CURRENT, Vocabulary
from foon_asp.model.arrays import Mask, Numbers, Rows, distinct, places
from foon_asp.model.foon import Foon, FoonBuilder, UnitColumns
from foon_asp.model.node import FunctionalUnit, Mark, ObjectId, ObjectNode, State

Dialect = Literal["A", "B"]


_STRETCH = 1 << 20
"""How many lines are put together to units at once."""

_AT_ONCE = 1 << 14
"""How many findings are made until limits are looked at again."""


class TextReader:
    """Reads text files into one builder: numbers the lines, and puts units together on the numbers."""

    def __init__(self, builder: FoonBuilder, words: Vocabulary = CURRENT) -> None:
        self.findings: list[Finding] = []
        self.reported_units = 0
        self._builder = builder
        self._lines = Lines(builder, words)
        self._file = ""

    def read(self, text: str, file: str) -> None:
        """Read all units of one file; what is odd in it is added to `findings`."""
        self._file = file
        lines = self._lines.numbers(text)
        known = self._lines.columns
        self._report_cleaned(lines, known.unclean)
        if len(lines) and not (self._lines.texts[lines[-1]] or text.endswith(("\n", "\r"))):
            # Nothing is left of it: the file ends with the line before.
            lines = lines[:-1]
        video = self._builder.videos[""]
        begin = 0
        for stop in _stops(known.kind[lines] == END):
            limits.check()
            units = Units(lines[begin:stop], known, video)
            self._read_units(units, begin + 1)
            video = int(units.video[-1])
            begin = stop

    def _report(self, line: int, code: str, message: str, mend: str = "") -> None:
        self.findings.append(oddity(code, self._file, line, message, mend))

    def _report_cleaned(self, lines: Numbers, unclean: Mask) -> None:
        """Report what was left out of lines: first all control characters, then all byte order marks."""
        marked = []
        for place in np.flatnonzero(unclean[lines]).tolist():
            count, has_mark = self._lines.cleaned[int(lines[place])]
            if count:
                message = f"control characters, left out: {count}"
                self._report(place + 1, "control-character", message, "delete them")
            if has_mark:
                marked.append(place + 1)
        for line in marked:
            self._report(line, "byte-order-mark", "the line begins with a byte order mark", "delete it")

    def _read_units(self, units: Units, line: int) -> None:
        """Add the units that are whole, and report what is odd in all; the first line is number `line`."""
        inputs, outputs = units.sides(self._builder)
        codes = units.known.code[units.lines[units.motion[units.whole]]]
        motions = distinct(codes)
        motion, _ = places(codes, motions)
        said = [self._lines.motions[code] for code in motions.tolist()]
        intervals = [interval for each in said for interval in each.times]
        times: Rows[int, int] = Rows.parted(
            np.arange(len(intervals), dtype=np.int32), [len(each.times) for each in said]
        )
        repeats = self._builder.units(
            UnitColumns(
                np.array([each.label for each in said], np.int32)[motion],
                inputs.objects,
                outputs.objects,
                inputs.marks,
                outputs.marks,
                np.array([each.composite for each in said], np.bool_)[motion],
                Rows.parted(times.gather(motion), times.lengths[motion]),
                np.array([each.start for each in intervals], np.float64),
                np.array([each.end for each in intervals], np.float64),
                np.array([each.rate for each in said], np.float64)[motion],
                np.array([each.agent for each in said], np.int32)[motion],
                self._places(units, line),
            )
        )
        whole = np.flatnonzero(units.whole).tolist()
        found: dict[int, list[tuple[str, str]]] = {
            whole[place]: check_sides(inputs.listed[place], outputs.listed[place])
            for place in np.flatnonzero(inputs.odd | outputs.odd).tolist()
        }
        for repeat in repeats:
            found.setdefault(whole[repeat.place], []).extend(repeated(repeat.added, repeat.rate))
        self.reported_units += int(np.maximum(units.motion_count, 1)[units.found & ~units.whole].sum())
        self._report_all(units, line, found)

    def _places(self, units: Units, line: int) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """Return where the whole units were read: what comments say of it, or else their own lines."""
        plain = units.whole.copy()
        plain[units.unit_of_origin] = False
        own = np.flatnonzero(plain)
        file = self._builder.files[self._file] if len(own) else 0
        origins = [self._lines.origins[code] for code in units.origin.tolist()]
        columns = (
            ranks(units.whole)[np.append(own, units.unit_of_origin)],
            np.append(np.full(len(own), file), [file for file, _ in origins]),
            np.append(units.first[own] + line, [line for _, line in origins]),
            np.append(units.video[own], units.video_of_origin),
        )
        order = np.argsort(columns[0], kind="stable")
        unit, files, lines, videos = (column[order].astype(np.int32) for column in columns)
        return unit, files, lines, videos

    def _report_all(self, units: Units, line: int, found: Mapping[int, Iterable[tuple[str, str]]]) -> None:
        """Report what is odd: in the lines of a unit, then in the unit, then in the `//` line behind it.

        `found` is what was found in whole units.
        """
        odd = ~units.readable
        odd[units.readable] = units.known.odd[units.lines[units.motion[units.readable]]]
        odd[units.is_from_nothing] = True
        odd[[*found]] = True
        odd[len(units.ends) :] = True
        chosen = np.flatnonzero(odd)
        stops = units.closing[chosen] + ~units.found[chosen]
        places = units.odd_lines
        rows = list(
            zip(
                (places + line).tolist(),
                units.lines[places].tolist(),
                units.is_stray[places].tolist(),
                units.is_repeated[places].tolist(),
                strict=True,
            )
        )
        begin = 0
        for unit, stop in zip(chosen.tolist(), np.searchsorted(places, stops).tolist(), strict=True):
            if begin < stop:
                self._report_lines(rows[begin:stop])
            self._report_unit(units, line, unit, found.get(unit, ()))
            begin = stop
        self._report_lines(rows[begin:])

    def _report_lines(self, rows: Sequence[tuple[int, int, bool, bool]]) -> None:
        file, odd = self._file, self._lines.odd_where
        for begin in range(0, len(rows), _AT_ONCE):
            limits.check()
            self.findings += [
                oddity(code, file, line, message, mend)
                for line, number, is_stray, is_repeated in rows[begin : begin + _AT_ONCE]
                for code, message, mend in odd(number, is_stray, is_repeated)
            ]

    def _report_unit(self, units: Units, line: int, unit: int, found: Iterable[tuple[str, str]]) -> None:
        if not units.found[unit]:
            self._report_nothing(units, line, unit)
            return
        begin, motion = line + int(units.first[unit]), int(units.motion[unit])
        if units.motion_count[unit] == 0:
            self._report(begin, "unit-without-motion", "a unit without a motion is left out")
        elif units.motion_count[unit] > 1:
            second = line + int(units.motions[np.searchsorted(units.motions, motion) + 1])
            self._report(second, "two-motions", "two motions: a '//' is missing; units left out")
        elif units.readable[unit]:
            for one in self._lines.oddities.get(int(units.lines[motion]), ()):
                self._report(line + motion, *one)
            if units.is_from_nothing[unit]:
                self._report(begin, *FROM_NOTHING)
            for code, message in found:
                self._report(begin, code, message)
        if unit == len(units.ends):
            mend = "write '//' below it"
            last = line + units.nowhere - 1
            self._report(last, "unit-not-closed", "the last unit is not closed by '//'", mend)

    def _report_nothing(self, units: Units, line: int, unit: int) -> None:
        """Report a `//` that ends a unit where there is none; below another one it can be deleted."""
        if unit == len(units.ends):
            return
        end = int(units.ends[unit])
        begin = int(units.ends[unit - 1]) + 1 if unit else 0
        between = (self._lines.texts[each] for each in units.lines[begin:end].tolist())
        doubled = line + begin > 1 and not any(map(str.strip, between))
        needless = doubled and only_ends(self._lines.texts[int(units.lines[end])])
        mend = "delete the line" if needless else ""
        self._report(line + end, "empty-unit", "this '//' ends a unit that is empty", mend)


def _stops(ends: Mask) -> list[int]:
    """Return where to part the lines of a file so that no unit is parted; the last stop is behind all."""
    behind = np.flatnonzero(ends) + 1
    places = np.searchsorted(behind, np.arange(_STRETCH, len(ends), _STRETCH))
    stops = behind[places[places < len(behind)]]
    return distinct(np.append(stops, len(ends))).tolist() if len(ends) else []


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
        lines = [self._object(number, mark) for number, mark in zip(ports, unit.marks, strict=True)]
        for place, rows in enumerate(lines):
            if place == len(unit.inputs):
                yield self._motion(unit)
            yield from rows
        if not unit.outputs:
            yield self._motion(unit)

    def _object(self, number: ObjectId, mark: Mark) -> Iterator[str]:
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
        fields = [label, *times_fields(note.times), note.agent, rate]
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
