"""What a FOON is made of, as small values: states, object nodes, functional units and their annotation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from operator import attrgetter
from typing import NewType

from foon_asp.characters import is_label
from foon_asp.errors import QueryError
from foon_asp.model.notation import write_object
from foon_asp.values import said

UnitId = NewType("UnitId", int)
"""The number of a unit in one FOON, or in the FOON of one world."""

ObjectId = NewType("ObjectId", int)
"""The number of an object node in one FOON, or in one world, whose kitchen may bring further ones."""


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
        """Raise `QueryError` for what no state can be; contents are sorted."""
        check_label(self.name, "the name of a state")
        if self.relatum is not None:
            check_label(self.relatum, "the relatum of a state")
        if self.contents is not None:
            object.__setattr__(self, "contents", _contents(self.contents))
        # States are looked up all the time, and there are few of them.
        object.__setattr__(self, "_hash", hash((self.name, self.relatum, self.contents)))

    def __hash__(self) -> int:
        return self._hash

    def __reduce__(self) -> tuple[type[State], tuple[str, str | None, tuple[str, ...] | None]]:
        # The hash of a text is another one in another process.
        return State, (self.name, self.relatum, self.contents)

    @property
    def plain(self) -> bool:
        """Whether it is a mere word: no relation, no contents."""
        return self.relatum is None and self.contents is None

    @property
    def in_braces(self) -> bool:
        """Whether it is `contains {…}`, which a node is written with as braces alone."""
        return self.name == "contains" and self.relatum is None and self.contents is not None

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


def _contents(contents: Iterable[str]) -> tuple[str, ...]:
    """Return contents in their canonical order; raise `QueryError` if they are no labels."""
    if isinstance(contents, str) or not isinstance(contents, Iterable):
        raise QueryError(f'contents are a list of texts, not {said(contents)}; write contents=("salt",)')
    found = tuple(contents)
    for content in found:
        check_label(content, "a content")
    return tuple(sorted(found))


def check_label(label: object, what: str = "a label") -> None:
    """Raise `QueryError` if a value can be no label, no motion and no word of a state."""
    if not is_label(label):
        shown = said(label)
        if not isinstance(label, str):
            raise QueryError(f"{what} is a text, not {shown}")
        raise QueryError(f"{what} is a text in one line, without control characters, not {shown}")


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

    States in any order may be given; the node has them in their canonical order, each once. Raises
    `QueryError` for what no node can be.
    """

    label: str
    states: tuple[State, ...] = ()

    def __post_init__(self) -> None:
        if not (isinstance(self.label, str) and self.label.isprintable() and self.label.strip()):
            check_label(self.label)
        if self.states != ():
            object.__setattr__(self, "states", _in_order(self.label, self.states))

    @classmethod
    def of(cls, label: str, states: Iterable[State] = ()) -> ObjectNode:
        """Make a node with its states in their canonical order, each once."""
        return cls(label, tuple(states))

    @classmethod
    def in_order(cls, label: str, states: tuple[State, ...]) -> ObjectNode:
        """Make a node of a label and states that are known to be in canonical order; nothing is checked."""
        # Nodes of a large FOON are made all the time.
        node = object.__new__(cls)
        object.__setattr__(node, "label", label)
        object.__setattr__(node, "states", states)
        return node

    @property
    def bare(self) -> bool:
        """No state at all: a tool that happens to be listed, made by no unit."""
        return not self.states

    @property
    def plain_states(self) -> tuple[str, ...]:
        """The names of its plain states, sorted."""
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
    def handled_labels(self) -> Iterator[str]:
        """The labels that take part where the node is listed: its own, and those of relata."""
        yield self.label
        yield from (state.relatum for state in self.states if state.relatum is not None)

    @property
    def sort_key(self) -> tuple[str, tuple[tuple[int, str, str, tuple[str, ...]], ...]]:
        """By label, then by states."""
        return (self.label, tuple(state.sort_key for state in self.states))

    def __str__(self) -> str:
        """Write the node the way a goal is written: `label [state, state] {content} in [container]`.

        As a goal it means this node and no other; `notation` says what stands in quotes.
        """
        return write_object(
            self.label,
            self.plain_states,
            [state.contents or () for state in self.states if state.in_braces],
            [
                (state.name, state.relatum, state.contents)
                for state in self.states
                if not state.plain and not state.in_braces
            ],
        )


def _in_order(label: str, states: object) -> tuple[State, ...]:
    """Return states in their canonical order, each once; raise `QueryError` if they are none."""
    if isinstance(states, str) or not isinstance(states, Iterable):
        given = f"State({said(states)})" if isinstance(states, str) else "State('raw')"
        advice = f"write ObjectNode({said(label)}, ({given},))"
        raise QueryError(f"states are a list of State, not {said(states)}; {advice}")
    found = tuple(states)
    for state in found:
        if not isinstance(state, State):
            advice = f"; write State({said(state)})" if isinstance(state, str) else ""
            raise QueryError(f"a state of {said(label)} is a State, not {said(state)}{advice}")
    return tuple(sorted(set(found), key=_SORT_KEY)) if len(found) > 1 else found


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


NO_MARK = Mark()
"""It says nothing."""


@dataclass(frozen=True, slots=True)
class Interval:
    """A stretch of a video, in seconds from its beginning; None where that is not known."""

    start: float | None = None
    end: float | None = None

    @property
    def duration(self) -> int:
        """How many seconds it takes; 0 if that is not known, or if it ends before it starts."""
        return 0 if self.start is None or self.end is None else max(0, round(self.end) - round(self.start))


@dataclass(frozen=True, slots=True)
class Annotation:
    """What the annotator noted of a unit beside its meaning; nothing here is part of its identity.

    `times` are the stretches of the video that show it, several if it was done in several goes, none if
    nothing of them is known; `rate` is the chance of success in [0, 1]; `marks` runs parallel to the unit's
    inputs and then its outputs, and is empty if nothing is marked.
    """

    sources: tuple[Source, ...] = ()
    composite: bool = False
    times: tuple[Interval, ...] = ()
    agent: str = ""
    rate: float | None = None
    marks: tuple[Mark, ...] = ()

    @property
    def start(self) -> float | None:
        """When it starts for the first time."""
        return self.times[0].start if self.times else None

    @property
    def end(self) -> float | None:
        """When it ends for the last time."""
        return self.times[-1].end if self.times else None


@dataclass(frozen=True, slots=True)
class FunctionalUnit:
    """Input objects, one motion, output objects. Objects are ids into `Foon.objects`, each listed once."""

    id: UnitId
    motion: str
    inputs: tuple[ObjectId, ...]
    outputs: tuple[ObjectId, ...]
    annotation: Annotation = Annotation()

    @property
    def marks(self) -> tuple[Mark, ...]:
        """The mark of each input, then of each output."""
        return self.annotation.marks or (NO_MARK,) * (len(self.inputs) + len(self.outputs))

    @property
    def source(self) -> Source:
        """The place it was first read."""
        return self.annotation.sources[0] if self.annotation.sources else Source()

    @property
    def duration(self) -> int | None:
        """How many seconds it took in the annotated video, all goes together; None if not known, or 0."""
        return sum(interval.duration for interval in self.annotation.times) or None
