"""What an object node becomes if states or places of it are changed: among all nodes that are known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from foon_asp.model.node import ObjectId, ObjectNode, State
from foon_asp.model.relations import loosened
from foon_asp.model.world import World


def changes(one: ObjectNode, other: ObjectNode) -> int | None:
    """Return how many states and places are changed from one object to another; None if more is than these.

    To add one, to leave one out, and to put one of the same kind in its place are one change each.
    """
    if one.label != other.label:
        return None
    lost, won = ({*one.states} - {*other.states}, {*other.states} - {*one.states})
    if any(state.contents is not None for state in lost | won):
        return None
    plain, related = (max(sum(map(kind, lost)), sum(map(kind, won))) for kind in (_is_plain, _is_related))
    return plain + related


def _is_plain(state: State) -> bool:
    return state.relatum is None


def _is_related(state: State) -> bool:
    return state.relatum is not None


class Variants:
    """The objects of a world by label, as relations are read."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._by_label: dict[str, list[ObjectId]] = {}
        for number in world.ids:
            if world.units.read(number) == number:
                self._by_label.setdefault(world.node(number).label, []).append(number)

    def of(self, number: ObjectId, most: int) -> Iterator[tuple[ObjectId, int]]:
        """Yield the objects that one becomes with so many changes at most, and how many it takes."""
        node = self._seen(number)
        for other in self._by_label.get(node.label, ()):
            if other != self._world.units.read(number):
                count = changes(node, self._seen(other))
                if count is not None and count <= most:
                    yield other, count

    def _seen(self, number: ObjectId) -> ObjectNode:
        node = self._world.node(number)
        return loosened(node) if self._world.units.loose else node


def all_variants(
    variants: Variants, objects: Iterable[ObjectId], most: int
) -> Iterator[tuple[ObjectId, ObjectId, int]]:
    """Yield each of some objects with all that it may become, and at which cost."""
    for number in objects:
        for other, count in variants.of(number, most):
            yield number, other, count
