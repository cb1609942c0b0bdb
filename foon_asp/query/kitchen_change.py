"""How the kitchen of a question differs from that of the data."""

from __future__ import annotations

from collections.abc import Iterable, Set
from dataclasses import dataclass

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.goals import Named, check_named, find_object
from foon_asp.values import a_list
from foon_asp.words import closest


@dataclass(frozen=True, slots=True)
class KitchenChange:
    """Other objects at hand: `objects` instead of those of the data, or some to `add` and to `remove`.

    A text in `remove` can only mean something that the kitchen has.
    """

    objects: tuple[Named, ...] | None = None
    add: tuple[Named, ...] = ()
    remove: tuple[Named, ...] = ()

    @classmethod
    def of(
        cls, objects: Iterable[Named] | None, add: Iterable[Named], remove: Iterable[Named]
    ) -> KitchenChange:
        """Make a change; raise `QueryError` if it names all objects and also changes, or no list."""
        change = cls(
            None if objects is None else _named(objects, "kitchen"),
            _named(add, "add"),
            _named(remove, "remove"),
        )
        if change.objects is not None and (change.add or change.remove):
            raise QueryError("'kitchen' names all objects; leave out 'add' and 'remove'")
        return change

    def __bool__(self) -> bool:
        return self.objects is not None or bool(self.add or self.remove)

    def nodes(self, world: World) -> frozenset[ObjectNode]:
        """Return the objects that are at hand after the change, on the level of a world.

        Raises `QueryError` for a text that names nothing, or something to remove that is not there.
        """
        if self.objects is not None:
            return frozenset(find_object(world, named) for named in self.objects)
        objects = set(world.kitchen.objects)
        gone = {_at_hand(world, named) for named in self.remove}
        return frozenset(objects - gone | {find_object(world, named) for named in self.add})

    def applied(self, world: World) -> World:
        """Return the world with the kitchen changed. The order of the objects does not matter."""
        return supplied(world, self.nodes(world)) if self else world


def _named(values: Iterable[Named], name: str) -> tuple[Named, ...]:
    listed = a_list(values, name, "objects")
    for value in listed:
        check_named(value, f"an object of {name!r}")
    return tuple(listed)


AS_IT_IS = KitchenChange()
"""The kitchen of the data."""


def supplied(world: World, objects: Set[ObjectNode]) -> World:
    """Return a world with these objects at hand, itself if they are its own."""
    if objects == set(world.kitchen.objects):
        return world
    return world.with_stock(sorted(objects, key=lambda node: node.sort_key))


def _at_hand(world: World, named: Named) -> ObjectNode:
    """Return the object of the kitchen that is named; raise `QueryError` if it has none."""
    if isinstance(named, str):
        try:
            return find_object(world.kitchen_alone, named)
        except QueryError as error:
            raise QueryError(f"nothing of the kitchen can be removed by this name: {error}") from None
    node = world.project(named)
    if node not in world.kitchen.objects:
        known = map(str, world.kitchen.objects)
        raise QueryError(f"the kitchen has no {node} to remove{closest(str(node), known)}")
    return node
