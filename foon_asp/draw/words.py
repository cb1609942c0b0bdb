"""What is written into a node: labels short enough to be read, and where an action was filmed."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from textwrap import wrap
from urllib.parse import urlsplit

from foon_asp.model.node import FunctionalUnit, ObjectNode, Source
from foon_asp.words import short_source

_WIDE = 26
"""How many letters a line has, where words allow."""

_MOST = 30
"""How many letters of a word without spaces are shown."""

_LINES = 2
"""How many lines there are below the label."""

_CONTENTS = 2
"""How many contents are named; the others are counted."""


def head(node: ObjectNode) -> str:
    """Return the label of an object node, short enough to be read."""
    return short(node.label)


def details(node: ObjectNode, new: Container[str] = ()) -> tuple[str, ...]:
    """Return the states of an object node in one or two lines: what it is like, where it is, what it holds.

    Of many contents those that are `new` in it are named first.
    """
    parts = []
    if node.plain_states:
        parts.append(", ".join(node.plain_states))
    parts += [
        f"{state.name} {state.relatum}" for state in node.states if state.relatum and not state.contents
    ]
    for state in node.states:
        if state.contents is not None:
            word = "" if state.in_braces else f"{state.name} {state.relatum or ''}".strip() + " "
            parts.append(word + _folded(state.contents, new))
    return lines(parts)


def _folded(contents: tuple[str, ...], new: Container[str]) -> str:
    """Return some of the contents, and how many there are besides."""
    first = sorted(contents, key=lambda content: content not in new)
    shown = len(first) if len(first) <= _CONTENTS else _CONTENTS
    # Those that fit into a line, at least one.
    while shown > 1 and len(_braces(first, shown)) > _WIDE:
        shown -= 1
    return _braces(first, shown)


def _braces(contents: Sequence[str], shown: int) -> str:
    more = [f"{len(contents) - shown}\N{NO-BREAK SPACE}more"] if shown < len(contents) else []
    return "{" + ", ".join([*contents[:shown], *more]) + "}"


def contents_head(node: ObjectNode) -> str:
    """Return what an object node contains, as the name of a thing; nothing if it contains nothing."""
    first, *rest = node.contents or ("",)
    return f"{first} + {len(rest)} more" if rest else first


def lines(parts: Iterable[str], most: int = _LINES, wide: int = _WIDE) -> tuple[str, ...]:
    """Return parts as lines, at most so many; the last one ends in `…` if there is more."""
    found: list[str] = []
    for part in parts:
        if found and len(found[-1]) + len(part) + 1 <= wide:
            found[-1] += " " + part
        else:
            found += wrap(part, wide, break_long_words=False, break_on_hyphens=False)
    cut = [short(line) for line in found[:most]]
    if len(found) > most:
        cut[-1] = cut[-1].rstrip(",…") + "…"
    return tuple(cut)


def short(text: str) -> str:
    """Return the beginning of a text that is too long to be read in a node."""
    return text if len(text) <= _MOST else text[: _MOST - 1] + "…"


def unit_title(head_line: str, unit: FunctionalUnit, takes: Iterable[str], makes: Iterable[str]) -> str:
    """Return all that there is to say of a unit: what it does, takes and makes, and where it was seen."""
    return "\n".join([head_line, *_listed("takes", takes), *_listed("makes", makes), *_origin(unit)])


def _listed(word: str, names: Iterable[str]) -> list[str]:
    found = "; ".join(names)
    return [f"{word}: {found}"] if found else []


def _origin(unit: FunctionalUnit) -> Iterator[str]:
    note, source = unit.annotation, unit.source
    if source.file:
        yield f"from {short_source(source.file, source.line)}"
    if source.video:
        yield f"video: {source.video}"
    if note.times:
        yield f"filmed at {', '.join(f'{_clock(each.start)} to {_clock(each.end)}' for each in note.times)}"


def _clock(seconds: float | None) -> str:
    if seconds is None:
        return "?"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02}"


def video_url(unit: FunctionalUnit) -> str:
    """Return the address of the video of a unit, at its second if that is known; empty if there is none.

    Only http and https count. What the address holds is escaped by the formats.
    """
    # The times are those of the place where it was read first.
    starts = [unit.annotation.start, *[None] * len(unit.annotation.sources)]
    return next(filter(None, map(_at_second, unit.annotation.sources, starts)), "")


def _at_second(source: Source, start: float | None) -> str:
    video = source.video.strip()
    try:
        parts = urlsplit(video)
    except ValueError:
        return ""
    if parts.scheme not in ("http", "https") or not parts.netloc or set(video) & set(' \t"<>\\^`{|}'):
        return ""
    if start is None:
        return video
    second = f"t={int(start)}"
    if "youtu" in parts.netloc:
        return parts._replace(query="&".join(filter(None, (parts.query, second + "s")))).geturl()
    return parts._replace(fragment=second).geturl()
