"""What resembles an object that is missing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from foon_asp.model.node import ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.words import alike

_NEAREST = 3


_SIMILAR = 0.8
"""How alike two labels are that are taken for similar: misspelt, or plural."""


@dataclass(frozen=True, slots=True)
class Near:
    """Something that resembles an object. `at_hand`: the kitchen has it; else the kitchen can make it."""

    node: ObjectNode
    at_hand: bool


class NearObjects:
    """What the kitchen has and can make, or some other objects, by name.

    A utensil with something in it goes by the names of its contents, everything else by its label.
    """

    def __init__(self, world: World, among: Iterable[ObjectId] | None = None) -> None:
        self._domain = world
        self._by_name: dict[str, list[ObjectId]] = {}
        for object_id in sorted(world.closure.available if among is None else among):
            for name in self._names(world.node(object_id)):
                self._by_name.setdefault(name, []).append(object_id)

    def near(self, object_id: ObjectId) -> tuple[Near, ...]:
        """Return what resembles an object: the same in another state or vessel, or else a similar name."""
        world = self._domain
        return tuple(Near(world.node(other), other in world.stock) for other in self.ids(object_id))

    def ids(self, object_id: ObjectId) -> list[ObjectId]:
        """Return the ids of the same, the nearest first."""
        wanted = self._domain.node(object_id)
        names = self._names(wanted)
        same = {other for name in names for other in self._by_name.get(name, ()) if other != object_id}
        found = [other for other in same if self._alike(names, other)]
        found.sort(key=lambda other: self._distance(wanted, other))
        found = self._all_names_first(found) or list(self._similar(wanted, names))
        return [other for other in found if other != object_id][:_NEAREST]

    def _names(self, node: ObjectNode) -> frozenset[str]:
        if node.contents and node.label in self._domain.kitchen.utensils:
            return frozenset(node.contents)
        return frozenset((node.label,))

    def _alike(self, names: frozenset[str], object_id: ObjectId) -> bool:
        """Whether an object is for the most part what names say: egg, but not a cake with egg in it."""
        others = self._names(self._domain.node(object_id))
        return others <= names or 2 * len(names & others) > len(names | others)

    def _all_names_first(self, ranked: Sequence[ObjectId]) -> list[ObjectId]:
        """Bring those to the front that have a name none before them has."""
        seen: set[str] = set()
        fresh: list[ObjectId] = []
        rest: list[ObjectId] = []
        for object_id in ranked:
            names = self._names(self._domain.node(object_id))
            (rest if names <= seen else fresh).append(object_id)
            seen |= names
        return fresh + rest

    def _similar(self, wanted: ObjectNode, names: frozenset[str]) -> Iterator[ObjectId]:
        """Yield the nearest object of each similar name: spelt alike, or the same with words more or less."""
        if len(names) > 1:
            return
        [name] = names
        words = set(name.split())
        akin = [
            other
            for other, object_ids in self._by_name.items()
            if set(other.split()) < words or set(other.split()) > words
            if self._domain.is_tool(self._domain.node(object_ids[0])) == self._domain.is_tool(wanted)
        ]
        near = alike(name, self._by_name, _NEAREST, _SIMILAR)
        for other in dict.fromkeys([*near, *sorted(akin, key=lambda other: (len(other), other))]):
            object_ids = [
                object_id
                for object_id in self._by_name[other]
                if len(self._names(self._domain.node(object_id))) == 1
            ]
            if object_ids:
                yield min(object_ids, key=lambda object_id: self._distance(wanted, object_id))

    def _distance(self, wanted: ObjectNode, object_id: ObjectId) -> tuple[int, int, bool, ObjectId]:
        """How unlike an object is: in names, in label and states; what is at hand is nearer."""
        node = self._domain.node(object_id)
        names = len(self._names(wanted) ^ self._names(node))
        rest = len(set(_features(wanted)) ^ set(_features(node)))
        return names, rest, object_id not in self._domain.stock, object_id


def _features(node: ObjectNode) -> Iterator[tuple[str, ...]]:
    yield ("label", node.label)
    for state in node.states:
        if state.relatum is not None:
            yield (state.name, "relatum", state.relatum)
        for content in state.contents or ():
            yield (state.name, "content", content)
        if state.relatum is None and not state.contents:
            yield (state.name,)
