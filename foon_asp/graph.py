"""The FOON itself: object nodes, functional units, and the graph they form. Pure data, no I/O."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace


@dataclass(frozen=True, slots=True)
class State:
    """One state of an object: plain (`whole`), a relation (`in [cup]`) or contents (`contains {salt}`).

    `contents` is a sorted multiset; an empty tuple means that braces were written with nothing in them.
    """

    name: str
    relatum: str | None = None
    contents: tuple[str, ...] | None = None

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


@dataclass(frozen=True, slots=True)
class ObjectNode:
    """An object node: a label and a set of states. Two nodes are the same if both are equal.

    Make one with `ObjectNode.of`, which brings the states into their canonical order.
    """

    label: str
    states: tuple[State, ...] = ()

    @classmethod
    def of(cls, label: str, states: Iterable[State] = ()) -> ObjectNode:
        return cls(label, tuple(sorted(set(states), key=lambda state: state.sort_key)))

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


@dataclass(frozen=True, slots=True)
class Foon:
    """A FOON: object nodes and functional units, each named by its index."""

    objects: Sequence[ObjectNode]
    units: Sequence[FunctionalUnit]
    duplicates: int = 0
    _ids: dict[ObjectNode, int] = field(default_factory=dict, repr=False, compare=False)

    def id_of(self, node: ObjectNode) -> int | None:
        """Return the id of a node, or None if the FOON does not know it."""
        return self._ids.get(node)

    @property
    def motions(self) -> list[str]:
        """All motion labels, sorted."""
        return sorted({unit.motion for unit in self.units})

    @property
    def labels(self) -> set[str]:
        return {node.label for node in self.objects}

    def marked_goals(self) -> list[ObjectNode]:
        """Return the outputs that the annotators marked as intended goals, in file order."""
        found: dict[ObjectNode, None] = {}
        for unit in self.units:
            ports = unit.inputs + unit.outputs
            for port, mark in zip(ports, unit.annotation.marks, strict=False):
                if mark.goal:
                    found[self.objects[port]] = None
        return list(found)


UnitKey = tuple[frozenset[int], str, frozenset[int]]


class FoonBuilder:
    """Collects objects and units into a `Foon`: every object node once, every functional unit once."""

    def __init__(self) -> None:
        self._objects: list[ObjectNode] = []
        self._ids: dict[ObjectNode, int] = {}
        self._units: list[FunctionalUnit] = []
        self._seen: dict[UnitKey, int] = {}
        self._more_sources: dict[int, list[Source]] = {}
        self.read = 0

    def object(self, node: ObjectNode) -> int:
        """Return the id of a node, a new one if it was not seen before."""
        number = self._ids.setdefault(node, len(self._objects))
        if number == len(self._objects):
            self._objects.append(node)
        return number

    def unit(
        self, motion: str, inputs: Sequence[int], outputs: Sequence[int], note: Annotation
    ) -> FunctionalUnit | None:
        """Add a unit. Return it, or None if the same inputs, motion and outputs were there already."""
        self.read += 1
        key = (frozenset(inputs), motion, frozenset(outputs))
        number = self._seen.setdefault(key, len(self._units))
        if number < len(self._units):
            self._more_sources.setdefault(number, []).extend(note.sources)
            return None
        if len(key[0]) != len(inputs) or len(key[2]) != len(outputs):
            inputs, outputs, note = _without_repeats(inputs, outputs, note)
        unit = FunctionalUnit(number, motion, tuple(inputs), tuple(outputs), note)
        self._units.append(unit)
        return unit

    def include(self, foon: Foon) -> None:
        """Add every unit of another FOON."""
        ids = [self.object(node) for node in foon.objects]
        for unit in foon.units:
            self.unit(
                unit.motion,
                [ids[number] for number in unit.inputs],
                [ids[number] for number in unit.outputs],
                unit.annotation,
            )

    def build(self) -> Foon:
        """Return what was collected; each unit knows all places where it was read."""
        units = list(self._units)
        for number, sources in self._more_sources.items():
            unit = units[number]
            places = dict.fromkeys((*unit.annotation.sources, *sources))
            note = replace(unit.annotation, sources=tuple(places))
            units[number] = replace(unit, annotation=note)
        return Foon(self._objects, units, self.read - len(units), self._ids)


def _without_repeats(
    inputs: Sequence[int], outputs: Sequence[int], note: Annotation
) -> tuple[list[int], list[int], Annotation]:
    """Keep the first of each object on either side, and the marks that belong to those kept."""
    keep_in = _first_places(inputs)
    keep_out = _first_places(outputs)
    marks: tuple[Mark, ...] = ()
    if note.marks:
        places = keep_in + [len(inputs) + place for place in keep_out]
        marks = tuple(note.marks[place] for place in places)
    return (
        [inputs[place] for place in keep_in],
        [outputs[place] for place in keep_out],
        replace(note, marks=marks),
    )


def _first_places(items: Sequence[int]) -> list[int]:
    first: dict[int, int] = {}
    for place, item in enumerate(items):
        first.setdefault(item, place)
    return list(first.values())


def merge(foons: Iterable[Foon]) -> Foon:
    """Return the universal FOON: the union, duplicate units removed, the earliest kept."""
    builder = FoonBuilder()
    for foon in foons:
        builder.include(foon)
        builder.read += foon.duplicates
    return builder.build()
