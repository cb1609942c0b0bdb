"""Functional units as a picture: what they take, do and make. Trees, plans and FOONs are drawn of it."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from foon_asp.draw import words
from foon_asp.draw.picture import Edge, Node, Role, Side
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.words import cut


@dataclass(frozen=True, slots=True)
class Drawn:
    """A unit as it is to be drawn.

    `place` is its number among the steps, None where there is no order. `origins` says of what it takes at
    which place that was made, where a thing may be made several times. `mark` is said above it, `faults`
    below its motion and in its title. `lacks` is what it needs and has not. `uses_up` is gone afterwards.
    """

    unit: UnitId
    place: int | str | None = None
    origins: Mapping[ObjectId, int] | None = None
    mark: str = ""
    faults: tuple[str, ...] = ()
    lacks: frozenset[ObjectId] = frozenset()
    uses_up: frozenset[ObjectId] = frozenset()
    side: Side = Side.ALONE


@dataclass(frozen=True, slots=True)
class Scene:
    """What is drawn of a world: units, and what is known of objects.

    `goals` have a double line. `at_hand` says what the kitchen has; None: whatever no drawn unit makes.
    `kept` are objects that are drawn even where they would be folded into a motion. `marks` and `sides` are
    those of objects, `missing` those that are not there. `strong` are the arrows that are drawn thick, by the
    object and the unit at their ends.
    """

    world: World
    units: Sequence[Drawn]
    goals: Collection[ObjectId] = ()
    at_hand: Container[ObjectId] | None = None
    kept: Collection[ObjectId] = ()
    marks: Mapping[ObjectId, str] = field(default_factory=dict)
    sides: Mapping[ObjectId, Side] = field(default_factory=dict)
    missing: Container[ObjectId] = ()
    strong: Container[tuple[ObjectId, UnitId]] = ()


_TOOLS = 32
"""How many letters of tools a motion has in a line."""

_FAULT = 36
"""How many letters of a fault are shown; the title has all."""

_Key = tuple[ObjectId, int | str | None]
"""An object, and at which place it was made, where that matters."""


def drawn(scene: Scene) -> tuple[list[Node], list[Edge]]:
    """Return the nodes and arrows of some units.

    Tools, and what is left over of utensils, are words in the motions that handle them: with arrows they
    would tie everything to everything. Nothing is lost by that, the titles have all.
    """
    return _Drawing(scene).all()


def is_tool(world: World, number: ObjectId) -> bool:
    """Whether an object is a tool: a utensil that contains nothing, or what has no states and is not made."""
    node = world.node(number)
    if world.labels_only or number in world.units.makers:
        return node.label in world.kitchen.utensils and not node.contents
    return world.is_tool(node)


class _Drawing:
    """Units that are being drawn."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._world = scene.world
        self._reading = scene.world.units
        self._nodes: dict[str, Node] = {}
        self._edges: list[Edge] = []
        self._keys: dict[_Key, str] = {}
        self._new: dict[ObjectId, set[str]] = {}
        units = [each.unit for each in scene.units]
        self._made = {number for unit in units for number in self._reading.makes[unit]}
        self._needed = {
            key for each in scene.units for key in (self._key(each, number) for number in self._needs(each))
        }
        self._shown = self._first_names(units)

    def all(self) -> tuple[list[Node], list[Edge]]:
        for each in self._scene.units:
            self._unit(each)
        for goal in self._scene.goals:
            if not any(number == goal for number, _ in self._keys):
                self._object((goal, None), self._role(goal))
        return list(self._nodes.values()), self._edges

    def _needs(self, each: Drawn) -> list[ObjectId]:
        """Return what a unit needs, each once, and is drawn with arrows."""
        return [
            number for number in dict.fromkeys(self._reading.needs[each.unit]) if self._is_drawn(each, number)
        ]

    def _is_drawn(self, each: Drawn, number: ObjectId) -> bool:
        scene = self._scene
        if number in scene.goals or number in scene.kept or number in each.lacks:
            return True
        if number in self._made and not self._is_stock(number):
            return True
        return not self._is_tool(number)

    def _is_tool(self, number: ObjectId) -> bool:
        return is_tool(self._world, number)

    def _is_stock(self, number: ObjectId) -> bool:
        return self._scene.at_hand is not None and number in self._scene.at_hand

    def _key(self, each: Drawn, number: ObjectId) -> _Key:
        return number, None if each.origins is None else each.origins.get(number)

    def _first_names(self, units: Iterable[UnitId]) -> dict[ObjectId, ObjectNode]:
        """Return how the first unit names each object: where relations are read alike, names may differ."""
        found: dict[ObjectId, ObjectNode] = {}
        for unit in units:
            listed = self._world.foon.units[unit]
            for number in (*listed.inputs, *listed.outputs):
                found.setdefault(self._reading.read(number), self._world.node(number))
        return found

    def _name(self, number: ObjectId) -> ObjectNode:
        return self._shown.get(number) or self._world.node(number)

    def _unit(self, each: Drawn) -> None:
        unit = self._world.foon.units[each.unit]
        key = f"u{len(self._nodes)}"
        needs, makes = self._needs(each), list(dict.fromkeys(self._reading.makes[each.unit]))
        self._nodes[key] = self._motion(key, each, unit)
        for number in needs:
            lacking = number in each.lacks
            tail = self._object(
                self._key(each, number), Role.MISSING if lacking else self._role(number), lacking=lacking
            )
            gone = number in each.uses_up
            self._edge(
                (tail, key),
                each,
                f"{self._name(number)} → {_said(each, unit)}",
                number,
                gone=gone,
                lacking=lacking,
            )
        made_at = None if each.origins is None else each.place
        wanted = {n for n in makes if (n, made_at) in self._needed or n in self._scene.goals}
        for number in makes:
            if number in wanted or self._stands_alone(unit, number, wanted):
                role = Role.MADE if number in wanted else Role.LEFT
                self._note_new(unit, number)
                head = self._object((number, made_at), self._role(number) if self._is_stock(number) else role)
                self._edge((key, head), each, f"{_said(each, unit)} → {self._name(number)}", number)

    def _note_new(self, unit: FunctionalUnit, number: ObjectId) -> None:
        """Remember which contents are new in what a unit makes, for these are named first."""
        node = self._world.node(number)
        if number not in self._new and node.contents:
            before = [self._world.node(other) for other in unit.inputs]
            held = {content for other in before if other.label == node.label for content in other.contents}
            self._new[number] = set(node.contents) - held

    def _stands_alone(self, unit: FunctionalUnit, number: ObjectId, wanted: Collection[ObjectId]) -> bool:
        """Whether what nothing needs is worth a node: no tool, and no view of something else that is made.

        A vessel is a view of what is in it, and what is in a vessel one of that if it is wanted itself.
        """
        node = self._world.node(number)
        if number in self._scene.kept:
            return True
        if self._is_stock(number) or self._is_tool(number):
            return False
        others = [self._world.node(other) for other in unit.outputs if other != number]
        inside = {other.label for other in others if node.label in _relata(other)}
        if node.contents and set(node.contents) <= inside:
            return False
        vessels = (self._world.node(other) for other in wanted)
        return not any(node.label in each.contents and each.label in _relata(node) for each in vessels)

    def _role(self, number: ObjectId) -> Role:
        if number in self._scene.missing:
            return Role.MISSING
        at_hand = number not in self._made if self._scene.at_hand is None else self._is_stock(number)
        return Role.AT_HAND if at_hand else Role.MADE

    def _object(self, which: _Key, role: Role, *, lacking: bool = False) -> str:
        scene, number = self._scene, which[0]
        if which in self._keys:
            key = self._keys[which]
            if lacking and self._nodes[key].role is not Role.MISSING and number not in self._made:
                self._nodes[key] = self._object_node(key, number, role)
            return key
        key = self._keys[which] = f"o{len(self._nodes)}"
        if role is Role.MISSING and number in self._made and number not in scene.missing:
            # It is made, only not by then.
            role = Role.MADE
        self._nodes[key] = self._object_node(key, number, role)
        return key

    def _object_node(self, key: str, number: ObjectId, role: Role) -> Node:
        scene, node = self._scene, self._name(number)
        goal = number in scene.goals
        mark = scene.marks.get(number) or ("missing" if role is Role.MISSING else "goal" if goal else "")
        what = {Role.AT_HAND: "at hand", Role.LEFT: "not needed any more", Role.MISSING: "missing"}.get(
            role, ""
        )
        said = [str(node), *(["goal"] if goal else []), *([what] if what else [])]
        if mark and mark not in said:
            said.append(mark)
        return Node(
            key,
            role,
            words.head(node),
            words.details(node, self._new.get(number, ())),
            mark,
            "\n".join(said),
            goal=goal,
            side=scene.sides.get(number, Side.ALONE),
        )

    def _motion(self, key: str, each: Drawn, unit: FunctionalUnit) -> Node:
        tools = [
            self._world.node(number)
            for number in unit.inputs
            if not self._is_drawn(each, self._reading.read(number)) and self._is_tool(number)
        ]
        names = list(dict.fromkeys(tool.label for tool in tools))
        details = words.lines(_with(names), wide=_TOOLS) + tuple(cut(fault, _FAULT) for fault in each.faults)
        takes, makes = (
            [str(self._world.node(number)) for number in side] for side in (unit.inputs, unit.outputs)
        )
        heading = "\n".join([_said(each, unit), *filter(None, [each.mark]), *each.faults])
        return Node(
            key,
            Role.BLOCKED if each.faults else Role.MOTION,
            words.short(_said(each, unit)),
            details,
            each.mark,
            words.unit_title(heading, unit, takes, makes),
            words.video_url(unit),
            side=each.side,
        )

    def _edge(
        self,
        ends: tuple[str, str],
        each: Drawn,
        title: str,
        number: ObjectId,
        *,
        gone: bool = False,
        lacking: bool = False,
    ) -> None:
        said = f"{title} (used up)" if gone else f"{title} (missing)" if lacking else title
        strong = lacking or (number, each.unit) in self._scene.strong
        self._edges.append(Edge(*ends, said, each.side, strong))


def _said(each: Drawn, unit: FunctionalUnit) -> str:
    return unit.motion if each.place is None else f"{each.place} {unit.motion}"


def _with(tools: Sequence[str]) -> list[str]:
    return [f"with {', '.join(tools)}"] if tools else []


def _relata(node: ObjectNode) -> set[str]:
    return {state.relatum for state in node.states if state.relatum is not None}
