"""How an object node is written as text, `LABEL [state, state] {content, content} in [PLACE]`, and read back.

A word that would be read otherwise stands in double quotes, in which a double quote is written twice and
everything else stands for itself: `"egg [raw]" in [bowl]`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence, Set
from dataclasses import dataclass, field

from foon_asp.errors import QueryError
from foon_asp.values import said

PLACES = frozenset({"in", "on", "under", "with", "inside", "attached to", "around", "between"})
"""What relations are called that say where an object is."""

FORM = "LABEL [state, state] {content, content} in CONTAINER"
"""How an object is written, as messages say it."""

LONGEST = 10_000
"""How many characters an object is written in at most; those of the public data take 214."""

_NAMES = "|".join(sorted(PLACES))
_QUOTED = re.compile(r'"([^"]*(?:""[^"]*)*)"(?!")')
_RUN = re.compile(r"[^\[\]{}]*")
_ITEM = re.compile(r"[^\[\]{},]*")
_SPACE = re.compile(r"\s*")
_BRACKET = re.compile(r"[\[\]{}]")
_BRACKET_OR_COMMA = re.compile(r"[\[\]{},]")
_PLACE = re.compile(rf"(?:^|\s)({_NAMES})(?=\s+\S)")
_PLACE_AT_END = re.compile(rf"\s({_NAMES}|contains)$")


@dataclass(slots=True)
class Parts:
    """What a text says of an object node; a part that is None was left out.

    `others` are the states that are neither plain nor `contains`: name, relatum, contents.
    """

    label: str = ""
    states: list[str] | None = None
    contents: list[tuple[str, ...]] | None = None
    others: list[tuple[str, str | None, tuple[str, ...] | None]] = field(default_factory=list)

    def add(self, name: str, relatum: str | None, contents: tuple[str, ...] | None) -> None:
        """Add a state that is not plain."""
        if name == "contains" and relatum is None and contents is not None:
            self.contents = self.contents or []
            self.contents.append(contents)
        else:
            self.others.append((name, relatum, contents))


def tidy(text: str) -> str:
    """Return a text as it is read outside quotes: lower case, one space between words."""
    return " ".join(text.lower().split())


def write_object(
    label: str,
    states: Sequence[str],
    contents: Sequence[Sequence[str]],
    others: Sequence[tuple[str, str | None, tuple[str, ...] | None]],
) -> str:
    """Write an object node; `contents` are those of each state `contains`, `others` as in `Parts`."""
    parts = []
    if states:
        parts.append(f"[{_listed(states)}]")
    parts += [f"{{{_listed(each)}}}" for each in contents]
    # Behind a bare label only a place or a bracket tells where it ends.
    unclear = not parts and bool(others) and others[0][0] not in PLACES
    parts += [_written_state(*other) for other in others]
    if unclear or _unclear_label(label, alone=not parts):
        label = _in_quotes(label)
    return " ".join((label, *parts))


def _written_state(name: str, relatum: str | None, contents: tuple[str, ...] | None) -> str:
    text = _word(name, _BRACKET)
    if relatum is not None:
        text += f" [{_word(relatum, _BRACKET)}]"
        if contents is not None:
            # Without a space: a brace of its own would say what the object contains.
            return f"{text}{{{_listed(contents)}}}"
    return text if contents is None else f"{text} {{{_listed(contents)}}}"


def _listed(items: Sequence[str]) -> str:
    return ", ".join(_word(item, _BRACKET_OR_COMMA) for item in items)


def _unclear_label(label: str, *, alone: bool) -> bool:
    """Return whether a label would be read as something else without quotes."""
    if _word(label, _BRACKET) != label or _PLACE_AT_END.search(label):
        return True
    return alone and _place(label) is not None


def _word(text: str, signs: re.Pattern[str]) -> str:
    """Return a word, in quotes if it would be read otherwise without them."""
    bare = text and text[0] != '"' and not signs.search(text) and text == tidy(text)
    return text if bare else _in_quotes(text)


def _in_quotes(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _place(text: str) -> re.Match[str] | None:
    """Return where the first place in a text without brackets is named, behind something else."""
    return next((match for match in _PLACE.finditer(text) if match.start() > 0), None)


def read_object(text: str, labels: Set[str] = frozenset()) -> Parts:
    """Read an object node; its label is the longest of some labels that the text begins with, if one is.

    Takes time in proportion to the text and to the number of labels. Raises `QueryError`, also for a text of
    more than `LONGEST` characters.
    """
    if len(text) > LONGEST:
        raise QueryError(
            f"the goal {said(text)} has {len(text):,} characters; an object is written in at most {LONGEST:,}"
        )
    return _Reader(text).read(labels)


class _Reader:
    """A text, and how far it is read."""

    def __init__(self, text: str) -> None:
        self._whole = self._text = text
        self._at = 0
        self._parts = Parts()

    def read(self, labels: Set[str]) -> Parts:
        label = self._known(labels)
        if label is None:
            self._read_label()
        else:
            self._parts.label = label
        while self._skip():
            self._read_part()
        return self._parts

    def _known(self, labels: Set[str]) -> str | None:
        """Take the longest known label; "ice cream" begins with the label "ice", but is another object."""
        if not labels:
            return None
        whole = tidy(self._text)
        begins = [known for known in labels if whole.startswith(known) and _ends(whole, len(known))]
        if not begins:
            return None
        label = max(begins, key=len)
        rest = whole[len(label) :]
        if rest and not _BRACKET.search(rest) and not _PLACE.match(rest):
            label, rest = whole, ""
        self._text = rest
        return label

    def _skip(self) -> bool:
        """Skip spaces, and return whether there is more."""
        space = _SPACE.match(self._text, self._at)
        self._at = space.end() if space else self._at
        return self._at < len(self._text)

    def _next(self) -> str:
        return self._text[self._at : self._at + 1]

    def _read_label(self) -> None:
        self._skip()
        label, quoted = self._take(_RUN)
        at_end = not self._next()
        place = None if quoted else _place(label) if at_end else _PLACE_AT_END.search(label)
        self._parts.label = label if place is None else label[: place.start()]
        if place is not None and at_end:
            self._parts.add(place[1], label[place.end() :].strip(), None)
        elif place is not None:
            self._read_state(place[1])

    def _read_part(self) -> None:
        start, parts = self._at, self._parts
        if self._next() == "[":
            parts.states = parts.states or []
            parts.states += self._items("]")
        elif self._next() == "{":
            parts.add("contains", None, self._contents())
        elif self._next() in "]}":
            raise self._unreadable(start)
        else:
            name, quoted = self._take(_RUN)
            self._skip()
            place = None if quoted or self._next() else _PLACE.match(name)
            if place is not None:
                parts.add(place[1], name[place.end() :].strip(), None)
            elif name and self._next() and self._next() in "[{":
                self._read_state(name)
            else:
                raise self._unreadable(start)

    def _read_state(self, name: str) -> None:
        """Read what stands in brackets behind the name of a state."""
        relatum = None
        if self._next() == "[":
            start = self._at
            self._at += 1
            self._skip()
            relatum, _ = self._take(_RUN)
            self._close("]", start)
        contents = self._contents() if self._next() == "{" else None
        self._parts.add(name, relatum, contents)

    def _contents(self) -> tuple[str, ...]:
        return tuple(sorted(self._items("}")))

    def _items(self, closing: str) -> list[str]:
        """Read a list in brackets."""
        start, items = self._at, []
        while True:
            # Behind the bracket or the comma.
            self._at += 1
            self._skip()
            item, quoted = self._take(_ITEM)
            if item or quoted:
                items.append(item)
            self._skip()
            if self._next() != ",":
                self._close(closing, start)
                return items

    def _take(self, bare: re.Pattern[str]) -> tuple[str, bool]:
        """Take a word, in quotes or else what `bare` matches, and return whether it was in quotes."""
        match = _QUOTED.match(self._text, self._at)
        if match:
            self._at = match.end()
            return match[1].replace('""', '"'), True
        match = bare.match(self._text, self._at)
        self._at = match.end() if match else self._at
        return tidy(match[0]) if match else "", False

    def _close(self, closing: str, start: int) -> None:
        self._skip()
        if self._next() != closing:
            raise self._unreadable(start)
        self._at += 1

    def _unreadable(self, start: int) -> QueryError:
        return QueryError(
            f"cannot read {said(self._text[start:].strip())} in the goal {said(self._whole)}; write {FORM}"
        )


def _ends(text: str, place: int) -> bool:
    """Return whether a label may end at a place in a text."""
    return place == len(text) or text[place] in " [{"
