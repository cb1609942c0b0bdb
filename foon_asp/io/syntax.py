"""How states, motions, times and rates are written in FOON files."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from foon_asp.characters import one_line
from foon_asp.model.foon import Added, Foon
from foon_asp.model.node import FunctionalUnit, Interval, ObjectId, State
from foon_asp.model.notation import PLACES

Report = Callable[[str, str], None]
"""Receives the code and the message of an oddity."""


_STATE = re.compile(r"(?P<name>[^\[\]{}]*)(?P<rest>.*)", re.DOTALL)


_GROUP = re.compile(r"\[(?P<relatum>[^\[\]{}]*)(?:\]|\Z)|\{(?P<contents>[^\[\]{}]*)(?:\}|\Z)")


LABEL_MARKS = re.compile(r"[\[\]{}]")
"""What cannot be part of the name of a state, of a relatum or of a content."""


def quiet(code: str, message: str) -> None:
    """Take a report and do nothing with it."""


def clean(text: str, report: Report = quiet) -> str:
    """Return the label in a text that may hold anything: one line, stripped, lower case."""
    plain = one_line(text)
    if plain != text.strip():
        report("control-character", f"{text[:60]!r} is read as {plain[:60]!r}")
    return plain.lower()


def parse_state(text: str, report: Report = quiet) -> State | None:
    """Read `name`, `name [relatum]` or `name {content, content}`; None if there is no name."""
    name, detail = split_state(text)
    return make_state(name, detail, report) if name else None


def split_state(text: str) -> tuple[str, str]:
    """Return the name of a state, which may be empty, and what stands in brackets behind it."""
    match = _STATE.fullmatch(text)
    assert match is not None
    return match["name"].strip().lower(), match["rest"]


_GLUED = re.compile(rf"(contains|{'|'.join(sorted(PLACES))}) +(.+)", re.DOTALL)
"""A relation or `contains`, and in the same field without brackets what it is about."""


def make_state(name: str, detail: str, report: Report = quiet) -> State:
    """Make a state of its name and of what stands in braces or brackets behind it."""
    detail = detail.strip()
    if not detail:
        if glued := _GLUED.fullmatch(name):
            return _without_groups(glued[1], _without_marks(glued[2]), report)
        if name == "contains":
            report("contains-without-braces", "'contains' does not say what")
        return State(name)
    groups = list(_GROUP.finditer(detail))
    contents_text = next((g["contents"] for g in groups if g["contents"] is not None), None)
    relatum_text = next((g["relatum"] for g in groups if g["relatum"] is not None), None)
    if detail.count("{") != detail.count("}") or detail.count("[") != detail.count("]"):
        report("unbalanced-brackets", f"the brackets of {detail!r} do not match")
    if not groups:
        return _without_groups(name, _without_marks(detail), report)
    rest = _GROUP.sub("", detail).strip()
    if rest or len(groups) > (contents_text is not None) + (relatum_text is not None):
        report("stray-text", f"{rest or detail!r} is more than one thing in brackets; the first counts")
    contents = None if contents_text is None else _parse_contents(contents_text, report)
    relatum = None if relatum_text is None else _parse_relatum(relatum_text, name, report)
    if name == "contains" and contents is None and relatum is not None:
        report("contains-in-brackets", f"contents stand in '[{relatum}]' instead of braces")
        return State(name, contents=_parse_contents(relatum, report))
    if name in PLACES and relatum is None and contents and len(contents) == 1:
        report("place-in-braces", f"a place stands in '{{{contents[0]}}}' instead of brackets")
        return State(name, relatum=contents[0])
    return State(name, relatum, contents)


def _without_marks(text: str) -> str:
    return " ".join(LABEL_MARKS.sub(" ", text).split())


def _without_groups(name: str, text: str, report: Report) -> State:
    """Make a state whose detail stands in no brackets."""
    if not text:
        return make_state(name, "", report)
    report("state-without-brackets", f"{text!r} stands without brackets")
    if name == "contains":
        return State(name, contents=_parse_contents(text, report))
    return State(name, text.lower())


def _parse_contents(text: str, report: Report) -> tuple[str, ...]:
    raw = text.lower().split(",")
    items = [item.strip() for item in raw]
    kept = sorted(item for item in items if item)
    if len(kept) != len(items):
        if kept:
            report("stray-comma", f"a comma too many in '{{{text}}}'")
        else:
            report("empty-braces", "nothing stands between the braces")
    if any(item != item.strip() for item in raw):
        report("space-in-braces", f"spaces beside a comma or brace in '{{{text}}}'")
    if len(set(kept)) != len(kept):
        report("duplicate-content", f"something is named twice in '{{{text}}}'")
    return tuple(kept)


def _parse_relatum(text: str, name: str, report: Report) -> str | None:
    relatum = text.strip().lower()
    if not relatum:
        report("empty-brackets", f"{name!r} does not say of what")
        return None
    if "," in relatum:
        report("comma-in-brackets", f"a comma inside '[{text}]'")
    return relatum


_NONE = frozenset({"none", "null", "n/a", ""})
"""The words by which programs say that there is nothing."""


def says_none(value: object, report: Report = quiet) -> bool:
    """Tell whether a value of JSON means that there is nothing: `null`, or a word for it."""
    if value is None:
        return True
    if not isinstance(value, str) or value.strip().lower() not in _NONE:
        return False
    if value:
        report("word-for-none", f"{value!r} is read as nothing")
    return True


def read_contents(texts: list[str], report: Report = quiet) -> tuple[str, ...]:
    """Return the contents that a list names, sorted; brackets and commas cannot be part of a content."""
    found: list[str] = []
    for text in texts:
        content = clean(text, report)
        parts = [part.strip() for part in LABEL_MARKS.sub(" ", content).split(",")]
        kept = [part for part in parts if part]
        if content and kept != [content]:
            report("odd-content", f"the content {text[:60]!r} is read as {kept}")
        found += kept
    return tuple(sorted(found))


def read_relatum(text: str, report: Report = quiet) -> str | None:
    """Return what a relation names; brackets cannot be part of it. None if nothing is left."""
    relatum = clean(text, report)
    kept = LABEL_MARKS.sub(" ", relatum).strip()
    if kept != relatum:
        report("odd-content", f"{text[:60]!r} is read as {kept!r}")
    return kept or None


# Hours are written as minutes, so that there may be more of these.
_TIME = re.compile(r"(?:([0-9]{1,6}):)?([0-9]{1,8}):([0-9]{1,2})(?:\.([0-9]+))?")


LONGEST_TIME = 4e9
"""The number of seconds that no time goes beyond: six digits of hours, eight of minutes."""


_UNKNOWN_TIME = re.compile(r"assume|unknown|n/?a|(?:none|null)$|-*$", re.IGNORECASE)


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
    time = ((hours * 60 + minutes) * 60000 + seconds * 1000 + thousandths) / 1000
    if time > LONGEST_TIME:
        raise ValueError(f"{text!r} is more than {LONGEST_TIME:.0f} seconds")
    return time


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


def known_times(times: Sequence[Interval], report: Report = quiet) -> tuple[Interval, ...]:
    """Return intervals as they are noted, none if nothing is known; report what ends too early."""
    for each in times:
        if each.start is not None and each.end is not None and each.end < each.start:
            report("times-backwards", f"the motion ends ({time_text(each.end)}) before it starts")
    return tuple(times) if any(each.start is not None or each.end is not None for each in times) else ()


_COLUMN = re.compile(r"[0-9:.]+|[A-Za-z]+")
"""A time or a word for none, and nothing else."""

_BRACKETS = "<>[]()"

_IN_BRACKETS = re.compile(r"<[^<>\[\]()]*>|\[[^<>\[\]()]*\]|\([^<>\[\]()]*\)|[^<>\[\]()]*")
"""What stands in brackets of one kind, or in none."""


def parse_times(fields: Sequence[str], report: Report) -> tuple[tuple[Interval, ...], int]:
    """Read when a motion was done from the front of some fields; return that, and how many fields it took.

    Two columns say start and end. One field says intervals, `<start-end,start-end>`, the brackets left out or
    not, or else `start,end`.
    """
    if not fields:
        return (), 0
    if len(fields) > 1 and _COLUMN.fullmatch(fields[0]) and _COLUMN.fullmatch(fields[1]):
        # Most times are written so.
        return known_times((_interval(fields[:2], report),), report), 2
    first = fields[0].strip(_BRACKETS)
    count = 1 if "," in first or "-" in first.strip("-") or _is_whole(fields) else min(2, len(fields))
    taken = fields[:count]
    if not (_IN_BRACKETS.fullmatch("".join(taken)) or all(map(_IN_BRACKETS.fullmatch, taken))):
        report("unbalanced-brackets", f"the brackets of {' '.join(taken)!r} do not match")
    groups = [text.strip() for text in first.split(",")]
    if count == 2:
        pairs = [[field.strip(_BRACKETS) for field in taken]]
    elif len(groups) == 2 and not any("-" in group.strip("-") for group in groups):
        pairs = [groups]
    else:
        pairs = [group.split("-") if group.strip("-") else [group] for group in groups]
    return known_times([_interval(pair, report) for pair in pairs], report), count


def _is_whole(fields: Sequence[str]) -> bool:
    """Tell whether a time in brackets has no second one beside it."""
    in_brackets = fields[0].startswith("<") and fields[0].endswith(">")
    return in_brackets and len(fields) > 1 and fields[1][:1] not in _BRACKETS and not _is_time(fields[1])


def _is_time(text: str) -> bool:
    try:
        parse_time(text)
    except ValueError:
        return False
    return True


def _interval(texts: Sequence[str], report: Report) -> Interval:
    """Read start and end; what cannot be read is not known."""
    times: list[float | None] = []
    for text in texts[:2]:
        try:
            times.append(parse_time(text.strip()))
        except ValueError as error:
            report("broken-time", str(error))
            times.append(None)
    if len(texts) > 2:
        report("broken-time", f"{'-'.join(texts)!r} is more than a start and an end")
    return Interval(*times)


def times_fields(times: Sequence[Interval]) -> list[str]:
    """Write when a motion was done: two columns, or one field with all intervals."""
    if len(times) > 1:
        return [f"<{','.join(f'{time_text(each.start)}-{time_text(each.end)}' for each in times)}>"]
    [one] = times or [Interval()]
    return [time_text(one.start), time_text(one.end)]


FROM_NOTHING = ("unit-without-inputs", "a unit without inputs is left out: nothing is made from nothing")
"""Code and message of a unit that would make something of nothing."""


def check_sides(inputs: Sequence[ObjectId], outputs: Sequence[ObjectId]) -> list[tuple[str, str]]:
    """Return code and message of each side of a unit that lists an object twice, or no output."""
    if inputs and outputs and len(set(inputs)) == len(inputs) and len(set(outputs)) == len(outputs):
        return []
    found = []
    for side, numbers in (("input", inputs), ("output", outputs)):
        if not numbers:
            found.append((f"unit-without-{side}s", f"a unit without {side}s"))
        elif len(set(numbers)) != len(numbers):
            found.append((f"duplicate-{side}", f"an {side} is listed twice"))
    return found


def repeated(added: Added, rate: float) -> list[tuple[str, str]]:
    """Return code and message of what is odd about a repeated unit; `rate` is the one it keeps."""
    if added is Added.NEW:
        return []
    found = [("duplicate-unit", "this unit was there before")]
    if added is Added.OTHER_RATE:
        found.append(("other-rate", other_rate(rate)))
    return found


def other_rate(rate: float) -> str:
    """Say that a unit was there before with another success rate, and which one is kept."""
    return f"this unit was there before with another success rate or none; the better one, {rate:g}, is kept"


@dataclass(frozen=True, slots=True)
class LabelIds:
    """The numbers that the labels of some units get when ids are to be written: their sorted places."""

    objects: dict[str, int]
    states: dict[str, int]
    motions: dict[str, int]

    @classmethod
    def of(cls, foon: Foon, units: Sequence[FunctionalUnit]) -> LabelIds:
        """Number the labels of some units, sorted, from 0."""
        nodes = [foon.objects[o] for o in {o for unit in units for o in unit.inputs + unit.outputs}]
        return cls(
            _numbered({node.label for node in nodes}),
            _numbered({state.name for node in nodes for state in node.states}),
            _numbered({unit.motion for unit in units}),
        )


def _numbered(labels: set[str]) -> dict[str, int]:
    return {label: number for number, label in enumerate(sorted(labels))}
