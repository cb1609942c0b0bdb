"""What a FOON is made of, as small values: states, object nodes, functional units and their annotation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from operator import attrgetter


@dataclass(frozen=True, slots=True)
class State:
    """One state of an object: plain (`whole`), a relation (`in [cup]`) or contents (`contains {salt}`).

    `contents` is a sorted multiset; an empty tuple means that braces were written with nothing in them.
    """

    name: str
    relatum: str | None = None
    contents: tuple[str, ...] | None = None
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        # States are looked up all the time, and there are few of them.
        object.__setattr__(self, "_hash", hash((self.name, self.relatum, self.contents)))

    def __hash__(self) -> int:
        return self._hash

    def __reduce__(self) -> tuple[type[State], tuple[str, str | None, tuple[str, ...] | None]]:
        # The hash of a text is another one in another process.
        return State, (self.name, self.relatum, self.contents)

    @property
    def plain(self) -> bool:
        return self.relatum is None and self.contents is None

    @property
    def sort_key(self) -> tuple[int, str, str, tuple[str, ...]]:
        """Plain states first, then relations, then contents, each by name."""
        kind = 0 if self.plain else 1 if self.contents is None else 2
        return (kind, self.name, self.relatum or "", self.contents or ())

    def __str__(self) -> str:
        text = self.name
        if self.relatum is not None:
            text += f" [{self.relatum}]"
        if self.contents is not None:
            text += " {" + ", ".join(self.contents) + "}"
        return text


def contains(*contents: str) -> State:
    """Make the state `contains {…}`."""
    return State("contains", contents=tuple(sorted(contents)))


def inside(container: str) -> State:
    """Make the state `in [container]`."""
    return State("in", relatum=container)


_SORT_KEY = attrgetter("sort_key")


@dataclass(frozen=True, slots=True)
class ObjectNode:
    """An object node: a label and a set of states. Two nodes are the same if both are equal.

    Make one with `ObjectNode.of`, which brings the states into their canonical order.
    """

    label: str
    states: tuple[State, ...] = ()

    @classmethod
    def of(cls, label: str, states: Iterable[State] = ()) -> ObjectNode:
        return cls(label, tuple(sorted(set(states), key=_SORT_KEY)))

    @property
    def bare(self) -> bool:
        """No state at all: a tool that happens to be listed, made by no unit."""
        return not self.states

    @property
    def plain_states(self) -> tuple[str, ...]:
        return tuple(state.name for state in self.states if state.plain)

    @property
    def contents(self) -> tuple[str, ...]:
        """The contents of `contains`, sorted."""
        found = [c for s in self.states if s.name == "contains" for c in s.contents or ()]
        return tuple(sorted(found))

    @property
    def containers(self) -> tuple[str, ...]:
        """The relata of `in`."""
        return tuple(s.relatum for s in self.states if s.name == "in" and s.relatum is not None)

    @property
    def named_labels(self) -> Iterator[str]:
        """Every label that the node names: its own, those of relata and of contents."""
        yield self.label
        for state in self.states:
            if state.relatum is not None:
                yield state.relatum
            yield from state.contents or ()

    @property
    def sort_key(self) -> tuple[str, tuple[tuple[int, str, str, tuple[str, ...]], ...]]:
        return (self.label, tuple(state.sort_key for state in self.states))

    def __str__(self) -> str:
        """Write the node the way a goal is written: `label [state, state] {content} in [container]`."""
        parts = [self.label]
        if plain := self.plain_states:
            parts.append("[" + ", ".join(plain) + "]")
        for state in self.states:
            if state.name == "contains" and state.relatum is None and state.contents is not None:
                parts.append("{" + ", ".join(state.contents) + "}")
        for state in self.states:
            is_contains = state.name == "contains" and state.relatum is None
            if not state.plain and not is_contains:
                parts.append(str(state))
        return " ".join(parts)


@dataclass(frozen=True, slots=True)
class Source:
    """Where a unit was read: file, line of its first object, and the video that was annotated."""

    file: str = ""
    line: int = 0
    video: str = ""

    def __str__(self) -> str:
        return f"{self.file}:{self.line}" if self.line else self.file


@dataclass(frozen=True, slots=True)
class Mark:
    """What an object line says beside the label: does it move, is it the intended goal.

    `goal` is `!`, or the number of the dish category (0-29) as text; empty if the object is not marked.
    """

    moves: bool | None = None
    goal: str = ""


@dataclass(frozen=True, slots=True)
class Annotation:
    """What the annotator noted of a unit beside its meaning; nothing here is part of its identity.

    `start` and `end` are seconds into the video; `rate` is the chance of success in [0, 1];
    `marks` runs parallel to the unit's inputs and then its outputs, and is empty if nothing is marked.
    """

    sources: tuple[Source, ...] = ()
    composite: bool = False
    start: float | None = None
    end: float | None = None
    agent: str = ""
    rate: float | None = None
    marks: tuple[Mark, ...] = ()


@dataclass(frozen=True, slots=True)
class FunctionalUnit:
    """Input objects, one motion, output objects. Objects are ids into `Foon.objects`, each listed once."""

    id: int
    motion: str
    inputs: tuple[int, ...]
    outputs: tuple[int, ...]
    annotation: Annotation = Annotation()

    @property
    def source(self) -> Source:
        """The place it was first read."""
        return self.annotation.sources[0] if self.annotation.sources else Source()

    @property
    def duration(self) -> int | None:
        """How many seconds it took in the annotated video; None if that is not known, or not above 0."""
        start, end = self.annotation.start, self.annotation.end
        return None if start is None or end is None else max(0, round(end) - round(start)) or None
