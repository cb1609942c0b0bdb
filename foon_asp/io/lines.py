"""What a line of FOON text says, whatever stands around it; docs/format.md has the grammar and the dialects.

Lines recur: `Lines` numbers the different ones, reads each once, and keeps what they say in columns.
"""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from foon_asp import limits
from foon_asp.characters import one_line, without_control_characters
from foon_asp.io.mend import ANY_ID, OF_ROWS, mend_row
from foon_asp.io.syntax import (
    Report,
    make_state,
    parse_rate,
    parse_times,
    says_none,
    split_motion,
    split_state,
)
from foon_asp.io.vocabulary import CURRENT, Vocabulary
from foon_asp.model.arrays import Numbers
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.node import NO_MARK, Annotation, Interval, Mark, State
from foon_asp.model.numbering import different

REST, OBJECT, MOTION, END, COMMENT, VIDEO, ORIGIN = range(7)
"""The kinds of lines. The rest are states, where they stand below an object. Two kinds of comments say
something: which video the units were seen in, and where the next one comes from."""

Oddity = tuple[str, str, str]
"""Code, message and mend of what is odd in a line."""

HEAD = re.compile(rf"([OMom]){ANY_ID}(?:[\t ]|\Z)|//|#|[/\\]+[\t ]*\Z")
"""How a line begins that is an object or a motion (the letter is its group), the end of a unit, a comment."""
_ID = re.compile(rf"[OSMosm]{ANY_ID}(?: *\t *| +|$)")
"""The id, and what parts it from the first field. A second tab ends that field, which is empty then."""

_PLAIN_CONTENTS = re.compile(r"S\d*\tcontains\t\{([a-z]+(?:[ ,][a-z]+)*)\}")
_LIKE_A_TIME = re.compile(r"[<\d]|assume|unknown|n/?a|-|$", re.IGNORECASE)
_NOT_A_LABEL = re.compile(r"[\d!]*|none|null|n/a", re.IGNORECASE)

_DOUBTFUL = frozenset({"unbalanced-brackets", "stray-text"})
"""A line that is odd in one of these ways is not mended in others: what it means is not certain."""

_PIECE = 1 << 22
"""How many characters are split into lines at once."""

_LONG = 1 << 23
"""How many characters are worth the time that pyarrow takes to load."""


@dataclass(frozen=True, slots=True)
class Columns:
    """What the lines say, by their numbers.

    `code` is the number of an object's label, a state, a video, or of a motion line or a comment in lists of
    their own; -1 where the line does not say it. `mark` is the number of an object's mark.
    """

    kind: npt.NDArray[np.int8]
    code: Numbers
    mark: Numbers
    odd: npt.NDArray[np.bool_]
    unclean: npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Motion:
    """What a motion line says: numbers of label and agent, and the rest as in `Notes`."""

    label: int
    composite: bool
    times: tuple[Interval, ...]
    rate: float
    agent: int


class Lines(dict[str, int]):
    """The different lines of text files, and what they say; words get numbers from a builder."""

    def __init__(self, builder: FoonBuilder, words: Vocabulary = CURRENT) -> None:
        super().__init__()
        self._words = words
        self.texts: list[str] = []
        self.oddities: dict[int, tuple[Oddity, ...]] = {}
        self.cleaned: dict[int, tuple[int, bool]] = {}
        """How many control characters were left out of a line, and whether a byte order mark was."""
        self.origins: list[tuple[int, int]] = []
        """The numbers of the files and the lines that comments name."""
        self.motions: list[Motion] = []
        self._odd_where: dict[tuple[int, bool, bool], tuple[Oddity, ...]] = {}
        self._builder = builder
        self._kind = array("b")
        self._code = array("i")
        self._mark = array("i")
        self._odd = array("b")
        self._unclean = array("b")

    def numbers(self, text: str) -> Numbers:
        """Return the number of each line of a text."""
        if "\r" in text:
            text = text.replace("\r\n", "\n").replace("\r", "\n")
        number = self._numbers_of_many if len(text) >= _LONG else self._numbers_of_few
        pieces = [np.zeros(0, np.int32)]
        begin = 0
        while begin < len(text):
            limits.check()
            end = text.find("\n", begin + _PIECE) + 1 or len(text)
            pieces.append(number(text[begin:end]))
            begin = end
        return np.concatenate(pieces)

    def _numbers_of_few(self, text: str) -> Numbers:
        rows = text.split("\n")
        if not rows[-1]:
            rows.pop()
        return np.fromiter(map(self.__getitem__, rows), np.int32, len(rows))

    def _numbers_of_many(self, text: str) -> Numbers:
        data = text.removesuffix("\n").encode() + b"\n"
        ends = np.flatnonzero(np.frombuffer(data, np.uint8) == ord("\n")) + 1
        rows, place = different(data, np.append(0, ends), text=True)
        return np.fromiter((self[row[:-1]] for row in rows), np.int32, len(rows))[place]

    @property
    def columns(self) -> Columns:
        """What the lines numbered so far say. While this is kept, none can be numbered that is new."""
        return Columns(
            np.frombuffer(self._kind, np.int8),
            np.frombuffer(self._code, np.int32),
            np.frombuffer(self._mark, np.int32),
            np.frombuffer(self._odd, np.bool_),
            np.frombuffer(self._unclean, np.bool_),
        )

    def odd_where(self, number: int, is_stray: bool, is_repeated: bool) -> tuple[Oddity, ...]:
        """Return what is odd in a line where it stands: below no object, or below one that has the state."""
        odd = self._odd_where.get((number, is_stray, is_repeated))
        if odd is None:
            odd = (stray(self.texts[number]),) if is_stray else self.oddities.get(number, ())
            if is_repeated:
                state, _ = read_state(self.texts[number], self._words)
                odd += (("duplicate-state", f"{str(state)!r} is said twice", ""),)
            self._odd_where[number, is_stray, is_repeated] = odd
        return odd

    def __missing__(self, row: str) -> int:
        contents = _plain_contents(row)
        if contents is not None:
            return self._add(row, row, REST, self._builder.state("contains", None, contents), 0, ())
        plain = without_control_characters(row)
        left_out = len(row) - len(plain)
        if plain.startswith("\ufeff") or left_out:
            # Files that were joined have a byte order mark in the middle, too.
            known = self[plain.lstrip("\ufeff")]
            said = self._kind[known], self._code[known], self._mark[known], self.oddities.get(known, ())
            number = self._add(row, self.texts[known], *said)
            self.cleaned[number] = left_out, plain.startswith("\ufeff")
            self._unclean[number] = 1
            return number
        return self._add(row, row, *self._read(row))

    def _add(self, row: str, plain: str, kind: int, code: int, mark: int, odd: tuple[Oddity, ...]) -> int:
        number = self[row] = len(self)
        self.texts.append(plain)
        self._kind.append(kind)
        self._code.append(code)
        self._mark.append(mark)
        self._odd.append(bool(odd))
        self._unclean.append(0)
        if odd:
            self.oddities[number] = odd
        return number

    def _read(self, row: str) -> tuple[int, int, int, tuple[Oddity, ...]]:
        """Return kind, code and mark of a line, and what is odd in it."""
        head = HEAD.match(row)
        if head is None:
            state, odd = read_state(row, self._words)
            if state is None:
                return REST, -1, 0, odd
            return REST, self._builder.state(state.name, state.relatum, state.contents), 0, odd
        if head[0][0] in "/\\":
            return END, -1, 0, read_end(row)
        if head[0] == "#":
            return *self._read_comment(row), 0, ()
        if head[1] in "Mm":
            label, note, odd = read_motion(row, self._words)
            return MOTION, self._motion(label, note) if label else -1, 0, odd
        label, mark, odd = read_object(row)
        return OBJECT, self._builder.labels[label] if label else -1, self._builder.marks[mark], odd

    def _read_comment(self, row: str) -> tuple[int, int]:
        """Take what a comment says of where units come from: the video, or the place of the next unit."""
        words = row.lstrip("# \t")
        start = words[:7].lower()
        if start == "source:":
            return VIDEO, self._builder.videos[one_line(words[7:])]
        if start[:5] == "from:":
            file, line = read_origin(words[5:].strip())
            self.origins.append((self._builder.files[file], line))
            return ORIGIN, len(self.origins) - 1
        return COMMENT, -1

    def _motion(self, label: str, note: Annotation) -> int:
        motion = Motion(
            self._builder.motions[label],
            note.composite,
            note.times,
            math.nan if note.rate is None else note.rate,
            self._builder.agents[note.agent],
        )
        self.motions.append(motion)
        return len(self.motions) - 1


def stray(row: str) -> Oddity:
    """Say what is odd about one of the rest that stands below no object."""
    if _ID.match(row):
        return "state-of-motion", f"the state {row!r} belongs to no object", ""
    if row.strip():
        return "unreadable-line", f"cannot read {row[:60]!r}", ""
    return BLANK


BLANK = "blank-line", "a blank line", "delete the line"


def read_end(row: str) -> tuple[Oddity, ...]:
    """Read a `//` line, or one of backslashes."""
    if not row.startswith("//"):
        return (
            ("other-end", f"in another dialect {row.strip()[:60]!r} ends a unit, as '//' does", "write '//'"),
        )
    rest = row.strip("/ \t")
    return (("stray-text", f"{rest!r} behind '//' is left out", ""),) if rest else ()


def only_ends(row: str) -> bool:
    """Whether a line that ends a unit says nothing else, so that it can be deleted where there is none."""
    return all(code == "other-end" for code, *_ in read_end(row))


def read_object(row: str) -> tuple[str, Mark, tuple[Oddity, ...]]:
    """Read `O<id?> label [flag [goal mark]]`; the label is empty if there is none."""
    odd = _odd_head(row)
    fields = _fields(row)
    label = fields[0].lower() if fields else ""
    if not label:
        odd.append(("object-without-label", f"no label in {row!r}"))
    elif "\t" not in row:
        odd.append(("missing-tab", f"no tab in {row!r}"))
    more = _label_fields(fields, _NOT_A_LABEL.fullmatch) if label and len(fields) > 1 else 0
    if more:
        label = " ".join([label, *fields[1 : 1 + more]]).lower()
        odd.append(("tab-in-label", f"a tab inside of a label, read as {label!r}"))
    mark = _read_mark(fields[1 + more :], odd) if len(fields) > 1 else NO_MARK
    return label, mark, _mended(row, odd)


def read_motion(row: str, words: Vocabulary = CURRENT) -> tuple[str, Annotation, tuple[Oddity, ...]]:
    """Read `M<id?> label [start end | intervals] [agent rate]`; the label is empty if there is none."""
    odd = _odd_head(row)
    fields = _fields(row)
    label, composite = split_motion(fields[0].lower()) if fields else ("", False)
    if not label:
        odd.append(("motion-without-label", f"no label in {row!r}; the unit is left out"))
        return "", Annotation(), _mended(row, odd)
    if "\t" not in row:
        odd.append(("missing-tab", f"no tab in {row!r}"))
    more = _label_fields(fields, _LIKE_A_TIME.match)
    if more and len(fields) > 1 + more:
        label, composite = split_motion(" ".join(fields[: 1 + more]).lower())
        del fields[1 : 1 + more]
        odd.append(("tab-in-label", f"a tab inside of a label, read as {label!r}"))

    def report(code: str, message: str) -> None:
        odd.append((code, message))

    label = words.motion(label, report)
    times, count = parse_times(fields[1:], report)
    rest = fields[1 + count :]
    agent = rest[0] if rest else ""
    rate = None
    if len(rest) > 1 and not says_none(rest[1], report):
        rate = parse_rate(rest[1])
        if rate is None:
            odd.append(("broken-rate", f"{rest[1]!r} is not a chance between 0 and 1"))
    if len(rest) > 2:
        odd.append(("stray-field", f"{rest[2]!r} behind the success rate is left out"))
    note = Annotation(composite=composite, times=times, agent=agent, rate=rate)
    return label, note, _mended(row, odd)


def _odd_head(row: str) -> list[tuple[str, str]]:
    """Say what is odd in the letter that a line begins with."""
    letter = row[0]
    if letter.isupper():
        return []
    return [("lower-case", f"in the lower-case dialect {letter!r} stands for {letter.upper()!r}")]


def read_origin(text: str) -> tuple[str, int]:
    """Read the `file:line` of a `# From:` comment."""
    file, colon, number = text.rpartition(":")
    if colon and re.fullmatch(r"[0-9]{1,9}", number):
        return file, int(number)
    return text, 0


def _fields(row: str) -> list[str]:
    """Split an O, S or M line behind its id; the fields are stripped, empty ones at the end dropped."""
    if row.count("\t") == 1 and row[1:2] == "\t":
        # Most lines are nothing but a label.
        field = row[2:].strip()
        return [field] if field else []
    head = _ID.match(row)
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
        return NO_MARK
    moves: bool | None = None
    goal = ""

    def report(code: str, message: str) -> None:
        odd.append((code, message))

    for place, text in enumerate(fields):
        if place == 0 and text in ("0", "1"):
            moves = text == "1"
        elif place == 0 and text.strip("0") in ("", "1") and text:
            odd.append(("odd-flag", f"the flag {text!r} is read as {text[-1]!r}"))
            moves = text[-1] == "1"
        elif says_none(text, report):
            pass
        elif not goal and (text == "!" or (place > 0 and text.isdigit())):
            goal = text
        else:
            odd.append(("stray-field", f"{text!r} is neither a flag nor a goal mark"))
    return Mark(moves, goal) if goal or moves is not None else NO_MARK


def _plain_contents(row: str) -> list[str] | None:
    """Return the contents, sorted, if that is all that a line says, and nothing is odd in it.

    Of all lines these are the most varied in a large FOON.
    """
    match = _PLAIN_CONTENTS.fullmatch(row)
    contents = sorted(match[1].split(",")) if match else []
    return contents if contents and len(set(contents)) == len(contents) else None


def read_state(row: str, words: Vocabulary = CURRENT) -> tuple[State | None, tuple[Oddity, ...]]:
    """Read an `S` line of an object."""
    if not row.strip():
        return None, (BLANK,)
    odd: list[tuple[str, str]] = []
    state = _state_of(row, words, lambda code, message: odd.append((code, message)))
    all_codes = {code for code, _ in odd}
    codes = OF_ROWS & all_codes
    mend = _state_mend(row, state, codes, words) if codes and _DOUBTFUL.isdisjoint(all_codes) else ""
    return state, tuple((code, message, mend if code in codes else "") for code, message in odd)


def _state_mend(row: str, state: State | None, codes: frozenset[str], words: Vocabulary) -> str:
    """Return how to mend a state line, or nothing if that would change what it says."""
    mended = mend_row(row, codes)
    left: list[tuple[str, str]] = []
    same = _state_of(mended, words, lambda code, message: left.append((code, message))) == state
    certain = same and OF_ROWS.isdisjoint(code for code, _ in left)
    return f"write {mended!r}" if certain else ""


def _mended(row: str, odd: list[tuple[str, str]]) -> tuple[Oddity, ...]:
    """Say how to mend an object or motion line."""
    return tuple((code, message, _row_mend(row, code)) for code, message in odd)


def _row_mend(row: str, code: str) -> str:
    mended = mend_row(row, {code}) if code in OF_ROWS else row
    return f"write {mended!r}" if mended != row else ""


def _state_of(row: str, words: Vocabulary, report: Report) -> State | None:
    if not _ID.match(row):
        report("unreadable-line", f"cannot read {row[:60]!r}")
        return None
    for code, message in _odd_head(row):
        report(code, message)
    fields = _fields(row)
    glued = bool(fields) and any(mark in fields[0] for mark in "[]{}")
    if fields and fields[0] and (glued or "\t" not in row):
        report("missing-tab", f"no tab {'before the bracket ' if glued else ''}in {row!r}")
    name, detail = (
        split_state(" ".join(fields))
        if glued
        else (fields[0].lower() if fields else "", " ".join(fields[1:]))
    )
    if not name:
        report("state-without-name", f"no state in {row!r}")
        return None
    name, detail = words.state(name, detail, report)
    return make_state(name, detail, report) if name else None
