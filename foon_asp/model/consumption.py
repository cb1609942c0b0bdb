"""What executing a unit uses up and adds: three semantics, from "nothing" to "everything it takes"."""

from __future__ import annotations

from functools import cached_property

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.values import said

SEMANTICS = ("add", "transform", "consume")


class Effects:
    """What each unit of a domain needs, adds and deletes, under one of the semantics.

    - `add`: nothing is ever used up. This is the delete relaxation, and what retrieval assumes.
    - `transform`: an input that is not among the outputs is deleted if its label is that of an output in
      another state, or among the contents of an output: it became that output, or went into it.
    - `consume`: every input that is not among the outputs is deleted.

    What a unit needs and does not use up it adds no second time, though its outputs list it: it is given
    back. So is a counted implied view, which need not be there: `restores`. Implied views are deleted like
    all other inputs. `lasting` objects are never deleted, by default `World.lasting`: tools, and on a lower
    level what stands for several objects. What the kitchen holds is in stock and never used up, unless the
    kitchen says how many there are: `counted`.
    """

    def __init__(self, world: World, semantics: str, lasting: frozenset[ObjectId] | None = None) -> None:
        if semantics not in SEMANTICS:
            raise QueryError(f"unknown semantics {said(semantics)}; there are {', '.join(SEMANTICS)}")
        self.world = world
        self.semantics = semantics
        self._lasting = lasting
        self._deletes: dict[UnitId, tuple[ObjectId, ...]] = {}

    @cached_property
    def counted(self) -> dict[ObjectId, int]:
        """How many there are at first of each kitchen object that can be used up."""
        return {} if self.semantics == "add" else self.world.quantities

    @cached_property
    def endless(self) -> set[ObjectId]:
        """Kitchen objects that are never used up."""
        return self.world.stock.keys() - self.counted.keys()

    def needs(self, unit: UnitId) -> tuple[ObjectId, ...]:
        """Return the objects that a unit needs, in the order in which it lists them."""
        return self.world.units.needs[unit]

    def adds(self, unit: UnitId) -> tuple[ObjectId, ...]:
        """Return what is there after a unit, and need not have been there before."""
        # No output is used up, so all that a unit needs and makes is given back.
        kept = {*self.needs(unit), *self.restores(unit)}
        return tuple(object_id for object_id in self.world.units.makes[unit] if object_id not in kept)

    def restores(self, unit: UnitId) -> tuple[ObjectId, ...]:
        """Return what is there after a unit, but of which there is no more if it was there before.

        These are counted implied views that the unit gives back: they need not be there.
        """
        if not self.counted:
            return ()
        views = self.counted.keys() & set(self.world.units.takes[unit]) - set(self.needs(unit))
        return tuple(object_id for object_id in self.world.units.makes[unit] if object_id in views)

    def makes_a_difference(self, unit: UnitId) -> bool:
        """Whether a unit brings anything about: more than what it gives back."""
        return bool(self.adds(unit) or self.restores(unit))

    def deletes(self, unit: UnitId) -> tuple[ObjectId, ...]:
        """Return the inputs that a unit uses up, in the order in which it lists them."""
        if unit not in self._deletes:
            self._deletes[unit] = () if self.semantics == "add" else self._used_up(unit)
        return self._deletes[unit]

    def _used_up(self, unit: UnitId) -> tuple[ObjectId, ...]:
        world = self.world
        takes, gives = world.units.takes[unit], world.units.gives[unit]
        became = {world.node(object_id).label for object_id in world.units.makes[unit]}
        became |= {content for object_id in gives for content in world.node(object_id).contents}
        kept = self.endless | (world.lasting if self._lasting is None else self._lasting) | set(gives)
        return tuple(
            object_id
            for object_id in takes
            if object_id not in kept
            and (self.semantics == "consume" or world.node(object_id).label in became)
        )
