"""FOONs in JSON: the list of units (J1) and the FOON API's `functional_units` (J2); see docs/format.md.

Reading takes both, and mixtures of them, by what each object says; writing is one form or the other.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from foon_asp.characters import one_line
from foon_asp.io.document import Document
from foon_asp.io.files import kind_of
from foon_asp.io.findings import Finding, oddity
from foon_asp.io.object_wire import object_to_json
from foon_asp.io.objects import check_keys, object_from_json
from foon_asp.io.syntax import (
    FROM_NOTHING,
    LONGEST_TIME,
    LabelIds,
    check_sides,
    clean,
    known_times,
    parse_rate,
    parse_time,
    repeated,
    says_none,
    split_motion,
    time_text,
)
from foon_asp.io.wire import dumps
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.node import (
    NO_MARK,
    Annotation,
    FunctionalUnit,
    Interval,
    Mark,
    ObjectId,
    ObjectNode,
    Source,
    contains,
)

_UNIT_KEYS = ("input_nodes", "motion_node", "output_nodes", "source")
_TIME_KEYS = ("start_time", "end_time")
_MOTION_KEYS = (
    *("motion_label", "label", *_TIME_KEYS, "times", "robot_type", "weight_success", "motion_id"),
)
_OF_TEXT_ONLY = frozenset({"space-in-braces"})


class JsonReader:
    """Reads JSON files into one builder."""

    def __init__(self, builder: FoonBuilder) -> None:
        self.findings: list[Finding] = []
        self.reported_units = 0
        self._builder = builder
        self._unknown_keys: set[str] = set()
        self._file = ""
        self._line = 0
        self.part = 0
        """Which list of units of the file is being read, from 0."""

    def read(self, text: str, file: str) -> None:
        """Read all units of one file; what is odd is added to `findings`, at the line of its unit.

        Raises `InputError` if the text is no JSON, or neither a list nor has `functional_units`.
        """
        self._file = file
        self._unknown_keys.clear()
        if text.startswith("\ufeff"):
            self._line = 1
            self._report("byte-order-mark", "the file begins with a byte order mark")
            text = text.lstrip("\ufeff")
        document = Document(text, Path(file))
        document.read()
        for line, code, message in document.oddities:
            self._line = line
            self._report(code, message)
        self.reported_units += document.broken
        video = _one_line(document.source)
        for item in document.items:
            self._line, self.part = item.line, item.part
            for key in item.repeated:
                self._report("duplicate-key", f"the key {key[:60]!r} stands twice; the last counts")
            try:
                self._read_unit(item.value, video)
            except ValueError as error:
                self.reported_units += 1
                self._report("unreadable-unit", f"{error}; the unit is left out")

    def _report(self, code: str, message: str) -> None:
        if code == "unknown-key":
            # Every unit of a file of another program may have it.
            if message in self._unknown_keys:
                return
            self._unknown_keys.add(message)
        if code not in _OF_TEXT_ONLY:
            self.findings.append(oddity(code, self._file, self._line, message))

    def _read_unit(self, item: object, video: str) -> None:
        if not isinstance(item, dict):
            raise ValueError(f"expected a unit, found {kind_of(item)}")
        node = item.get("motion_node")
        note = node if isinstance(node, dict) else {}
        check_keys(item, _UNIT_KEYS, self._report)
        check_keys(note, _MOTION_KEYS, self._report)
        label = note.get("motion_label", note.get("label")) if note else node
        if says_none(label) or not isinstance(label, str):
            raise ValueError("'motion_node' is missing or has no label")
        motion, composite = split_motion(clean(label, self._report))
        if not motion:
            raise ValueError("the motion has no label")
        inputs, input_marks = self._read_side(item, "input_nodes")
        outputs, output_marks = self._read_side(item, "output_nodes")
        if not inputs:
            self.reported_units += 1
            self._report(*FROM_NOTHING)
            return
        marks = input_marks + output_marks
        annotation = Annotation(
            sources=(Source(self._file, self._line, _one_line(item.get("source")) or video),),
            composite=composite,
            times=self._read_times(note),
            agent=_one_line(note.get("robot_type")),
            rate=self._read_rate(note),
            marks=() if all(mark == NO_MARK for mark in marks) else tuple(marks),
        )
        self._add(motion, inputs, outputs, annotation)

    def _read_side(self, item: dict[str, object], key: str) -> tuple[list[ObjectNode], list[Mark]]:
        value = item.get(key)
        if says_none(value, self._report):
            value = []
        if not isinstance(value, list):
            raise ValueError(f"{key!r} is not a list")
        nodes: list[ObjectNode] = []
        marks: list[Mark] = []
        for place, item in enumerate(value, 1):
            try:
                nodes.append(object_from_json(item, self._report))
            except ValueError as error:
                raise ValueError(f"{key!r}, object {place}: {error}") from None
            marks.append(self._read_mark(item))
        return nodes, marks

    def _read_mark(self, item: dict[str, object]) -> Mark:
        moves = item.get("object_in_motion")
        if moves is None or moves == "":
            return NO_MARK
        if isinstance(moves, bool | int | str) and str(moves).lower() in ("0", "1", "true", "false"):
            return Mark(str(moves).lower() in ("1", "true"))
        self._report("stray-field", f"'object_in_motion' is {kind_of(moves)}, not 0 or 1")
        return NO_MARK

    def _read_times(self, note: dict[str, object]) -> tuple[Interval, ...]:
        """Read start and end, or all of several intervals."""
        listed = note.get("times")
        if says_none(listed, self._report):
            return known_times([self._read_interval(note)], self._report)
        found = []
        for each in listed if isinstance(listed, list) else [listed]:
            if isinstance(each, dict):
                check_keys(each, _TIME_KEYS, self._report)
                found.append(self._read_interval(each))
            else:
                message = f'\'times\' has {kind_of(each)}, not {{"start_time": …, "end_time": …}}'
                self._report("broken-time", message)
        return known_times(found, self._report)

    def _read_interval(self, note: dict[str, object]) -> Interval:
        return Interval(*(self._read_time(note, key) for key in _TIME_KEYS))

    def _read_time(self, note: dict[str, object], key: str) -> float | None:
        value = note.get(key)
        if value is None:
            return None
        if isinstance(value, int | float) and not isinstance(value, bool) and 0 <= value <= LONGEST_TIME:
            return round(value * 1000) / 1000
        try:
            if not isinstance(value, str):
                raise ValueError(f"{kind_of(value)} that is no time (m:ss or h:mm:ss)")
            return parse_time(value.strip())
        except ValueError as error:
            self._report("broken-time", f"{key!r} is {error}")
            return None

    def _read_rate(self, note: dict[str, object]) -> float | None:
        value = note.get("weight_success")
        if value is None or value == "":
            return None
        rate = parse_rate(value)
        if rate is None:
            said = repr(value) if isinstance(value, str | int | float) else kind_of(value)
            self._report("broken-rate", f"'weight_success' is {said}, not a chance between 0 and 1")
        return rate

    def _add(
        self, motion: str, inputs: Iterable[ObjectNode], outputs: Iterable[ObjectNode], note: Annotation
    ) -> None:
        left = [self._builder.object(node) for node in inputs]
        right = [self._builder.object(node) for node in outputs]
        for code, message in check_sides(left, right):
            self._report(code, message)
        number, added = self._builder.unit(motion, left, right, note)
        for code, message in repeated(added, self._builder.rate(number)):
            self._report(code, message)


def _one_line(value: object) -> str:
    """Return a text as it can stand in one field; nothing if it is no text."""
    return one_line(value) if isinstance(value, str) else ""


def write_units(foon: Foon, units: Iterable[FunctionalUnit]) -> str:
    """Write units as J1: a list of `{input_nodes, motion_node, output_nodes}`, meaning only."""
    values = [
        {
            "input_nodes": [object_to_json(foon.objects[number]) for number in unit.inputs],
            "motion_node": _motion_label(unit),
            "output_nodes": [object_to_json(foon.objects[number]) for number in unit.outputs],
        }
        for unit in units
    ]
    return dumps(values)


def write_api(foon: Foon, units: Iterable[FunctionalUnit]) -> str:
    """Write units as J2, the FOON API's form: with ids, motion flags, times, agent and success rate.

    The video is `source` of the whole if all units have the same, else `source` of each unit.
    """
    chosen = list(units)
    videos = {unit.source.video for unit in chosen}
    writer = _Api(foon, LabelIds.of(foon, chosen), own_source=len(videos) > 1)
    value: dict[str, object] = {"functional_units": [writer.unit(unit) for unit in chosen]}
    if len(videos) == 1 and (video := videos.pop()):
        value["source"] = video
    return dumps(value)


@dataclass(frozen=True, slots=True)
class _Api:
    """Writes single units as J2."""

    foon: Foon
    ids: LabelIds
    own_source: bool

    def unit(self, unit: FunctionalUnit) -> dict[str, object]:
        ports = unit.inputs + unit.outputs
        objects = [self._object(number, mark) for number, mark in zip(ports, unit.marks, strict=True)]
        value: dict[str, object] = {
            "input_nodes": objects[: len(unit.inputs)],
            "motion_node": self._motion(unit),
            "output_nodes": objects[len(unit.inputs) :],
        }
        if self.own_source and unit.source.video:
            value["source"] = unit.source.video
        return value

    def _object(self, number: ObjectId, mark: Mark) -> dict[str, object]:
        node = self.foon.objects[number]
        ingredients = _ingredients(node)
        value: dict[str, object] = {
            "object_id": self.ids.objects[node.label],
            "object_label": node.label,
            "object_states": list(self._states(node, ingredients)),
            "ingredients": list(ingredients),
        }
        if mark.moves is not None:
            value["object_in_motion"] = int(mark.moves)
        return value

    def _states(self, node: ObjectNode, ingredients: tuple[str, ...]) -> Iterator[dict[str, object]]:
        for state in node.states:
            value: dict[str, object] = {"state_id": self.ids.states[state.name]}
            if state.relatum is not None and state.contents is None:
                yield {**value, "state_label": state.name, "relative_object": state.relatum}
            elif ingredients and state == contains(*ingredients):
                yield {**value, "state_label": state.name}
            else:
                yield {**value, "state_label": str(state)}

    def _motion(self, unit: FunctionalUnit) -> dict[str, object]:
        note = unit.annotation
        value: dict[str, object] = {
            "motion_id": self.ids.motions[unit.motion],
            "motion_label": _motion_label(unit),
            "start_time": time_text(note.start),
            "end_time": time_text(note.end),
        }
        if len(note.times) > 1:
            value["times"] = [
                {"start_time": time_text(each.start), "end_time": time_text(each.end)} for each in note.times
            ]
        if note.agent:
            value["robot_type"] = note.agent
        if note.rate is not None:
            value["weight_success"] = note.rate
        return value


def _ingredients(node: ObjectNode) -> tuple[str, ...]:
    """Return the contents that stand beside the states: those of `contains`, if it is there but once."""
    found = [state for state in node.states if state.name == "contains"]
    if len(found) == 1 and found[0].contents and found[0] == contains(*found[0].contents):
        return found[0].contents
    return ()


def _motion_label(unit: FunctionalUnit) -> str:
    return unit.motion + "*" * unit.annotation.composite
