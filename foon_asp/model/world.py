"""A world: a FOON seen from a kitchen, on one numbering. It never changes: another kitchen, another world."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from foon_asp.errors import QueryError
from foon_asp.model.arrays import Mask
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen, seen_as
from foon_asp.model.landmarks import Ways
from foon_asp.model.levels import FULL, check_level, lasting, planning_view, project
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.reachability import Closure, forward
from foon_asp.model.relations import Matching
from foon_asp.model.similarity import Uses
from foon_asp.model.stock import listed
from foon_asp.model.units import Units, Vessels
from foon_asp.numbers import QUANTITY
from foon_asp.values import said
from foon_asp.words import closest


@dataclass(frozen=True, eq=False, repr=False)
class World:
    """A FOON seen from a kitchen; everything that does not depend on the goal is worked out once.

    Kitchen objects that the FOON does not know get the ids after the FOON's own. `goals` are the dishes that
    the data name: of several objects that a text may mean, one of these is meant.

    Below level 3 the world is a view of `full`: what units need and make is read on level 3 and then
    projected, and so is the kitchen. `foon` is the FOON of that view, with unit and object ids of its own;
    `images` says for each unit of the full FOON which unit of the view it becomes.

    Make one with `World.of`. Threads may share it: what is worked out late is worked out alike by all.
    """

    units: Units
    kitchen: Kitchen
    goals: tuple[ObjectNode, ...] = ()
    level: int = FULL
    images: Sequence[UnitId] = ()
    seen_from: World | None = None

    @classmethod
    def of(
        cls,
        foon: Foon,
        kitchen: Kitchen,
        *,
        strict: bool = False,
        match_relations: Matching = "strict",
        level: int = FULL,
        goals: Iterable[ObjectNode] = (),
    ) -> World:
        """See a FOON from a kitchen, on a level of detail; with `strict` every input is needed.

        Where relations are matched loosely, the first object of the FOON stands for all that differ from it
        only in how they are related to others, in the kitchen and among the goals, too. Where nothing says
        what is at hand, it is what no unit makes.
        """
        units = Units(foon, kitchen.utensils, strict=strict, match_relations=match_relations)
        stock = listed(kitchen, units)
        if units.loose:
            stock = seen_as(stock, units.stand_in)
        return cls(units, stock, tuple(map(units.stand_in, goals)), images=foon.units.ids).on_level(level)

    def on_level(self, level: int) -> World:
        """Return the view of a full world on a level of detail, 1 (labels) to 3 (everything)."""
        if check_level(level) == self.level:
            return self
        foon, utensils, strict, matching = self.foon, self.kitchen.utensils, self.strict, self.match_relations
        # A FOON without any state was cut down to its labels before: nothing in it is a tool by that.
        cut = level == 1 and all(node.bare for node in foon.objects)
        read = Units(foon, utensils, strict=strict, labels_only=True) if cut else self.units
        view, images = planning_view(foon, read, level)
        units = Units(view, utensils, strict=strict, labels_only=level == 1, match_relations=matching)

        def image(node: ObjectNode) -> ObjectNode:
            return units.stand_in(project(node, level))

        return World(
            units,
            seen_as(self.kitchen, image),
            tuple(dict.fromkeys(map(image, self.goals))),
            level,
            images,
            self,
        )

    def with_stock(self, objects: Iterable[ObjectNode]) -> World:
        """See the same FOON from a kitchen with other objects at hand.

        What units need and make is worked out once for both. Of objects that are counted here there are as
        many.
        """
        listed = dict.fromkeys(map(self.project, objects))
        counts = {node: count for node, count in self.kitchen.quantities.items() if node in listed}
        return replace(self, kitchen=replace(self.kitchen, objects=tuple(listed), quantities=counts))

    def __repr__(self) -> str:
        units, objects, stock = len(self.foon.units), len(self.foon.objects), len(self.kitchen.objects)
        level = "" if self.level == FULL else f", on level {self.level}"
        return f"<World: {units:,} units, {objects:,} objects, kitchen of {stock:,}{level}>"

    @property
    def foon(self) -> Foon:
        """The FOON on the level of this world."""
        return self.units.foon

    @property
    def strict(self) -> bool:
        """Whether every input is needed, implied views too."""
        return self.units.strict

    @property
    def match_relations(self) -> Matching:
        """How relations between objects are matched."""
        return self.units.match_relations

    @property
    def full(self) -> World:
        """The same on level 3."""
        return self if self.seen_from is None else self.seen_from

    @property
    def labels_only(self) -> bool:
        """Whether nodes are labels alone, so that a bare one may well be made."""
        return self.units.labels_only

    @cached_property
    def _numbered(self) -> tuple[dict[ObjectId, None], list[ObjectNode]]:
        """The ids of the kitchen's objects, in its order, and those of them that the FOON does not know."""
        stock = list(dict.fromkeys(self.kitchen.objects))
        known = self.foon.objects.find(stock)
        strangers = [node for node, number in zip(stock, known, strict=True) if number is None]
        new = map(ObjectId, itertools.count(len(self.foon.objects)))
        return {next(new) if number is None else number: None for number in known}, strangers

    @property
    def stock(self) -> dict[ObjectId, None]:
        """The ids of the objects at hand, in the order of the kitchen."""
        return self._numbered[0]

    @cached_property
    def at_hand(self) -> Mask:
        """Say of the id of each object node whether it is at hand."""
        mask = np.zeros(len(self.ids), dtype=np.bool_)
        mask[list(self.stock)] = True
        return mask

    @property
    def strangers(self) -> list[ObjectNode]:
        """The objects at hand that the FOON does not know."""
        return self._numbered[1]

    @property
    def ids(self) -> Sequence[ObjectId]:
        """The ids of all object nodes, of the FOON and of the kitchen."""
        return cast(Sequence[ObjectId], range(len(self.foon.objects) + len(self.strangers)))

    def project(self, node: ObjectNode) -> ObjectNode:
        """Return what the level of this world shows of an object node, as relations are matched."""
        return self.units.stand_in(project(self.full.units.stand_in(node), self.level))

    @cached_property
    def quantities(self) -> dict[ObjectId, int]:
        """How many there are of the objects in stock of which there are not plenty."""
        ids = zip(self.stock, dict.fromkeys(self.kitchen.objects), strict=True)
        counts = self.kitchen.quantities
        return {number: counts[node] for number, node in ids if QUANTITY.fits(counts.get(node))}

    @cached_property
    def lasting(self) -> frozenset[ObjectId]:
        """The objects that are never used up: tools, which are bare and made by no unit.

        On a lower level these are the images of all bare objects, and those that stand for several, as one of
        them might be another: docs/levels.md says why. In a FOON without any state nothing is a tool by that.
        """
        if self.seen_from is None:
            return self._tools
        full = self.seen_from
        nodes = lasting((*full.foon.objects, *full.strangers), self.level)
        return frozenset(number for number in self.ids if self.node(number) in nodes)

    @property
    def _tools(self) -> frozenset[ObjectId]:
        made = np.zeros(len(self.ids), dtype=np.bool_)
        made[self.units.makes.values] = True
        bare = np.zeros(len(self.ids), dtype=np.bool_)
        bare[: len(self.foon.objects)] = self.foon.objects.states.lengths == 0
        bare[len(self.foon.objects) :] = [node.bare for node in self.strangers]
        if bare.all():
            return frozenset()
        return frozenset(map(ObjectId, np.flatnonzero(bare & ~made).tolist()))

    @cached_property
    def kitchen_alone(self) -> World:
        """The same kitchen beside a FOON that knows nothing: a text can only mean what is at hand there."""
        nothing = Units(FoonBuilder().build(), self.kitchen.utensils)
        return World(nothing, self.kitchen, self.goals, self.level)

    @cached_property
    def labels(self) -> frozenset[str]:
        """The labels of all object nodes, of the FOON and of the kitchen."""
        return frozenset(self.foon.labels).union(node.label for node in self.strangers)

    @cached_property
    def remembered(self) -> dict[str, ObjectNode]:
        """What texts were found to mean here; `query.goals` keeps it."""
        return {}

    @cached_property
    def pieces(self) -> dict[tuple[UnitId, frozenset[str]], Any]:
        """What is said of units to a solver, by the details that are wanted; `asp.facts` keeps it."""
        return {}

    @cached_property
    def closure(self) -> Closure:
        """All that the kitchen can make, and all units that it can execute."""
        return forward(self.units, self.stock)

    @cached_property
    def ways(self) -> Ways:
        """The ways to make what can be made, as far as they were asked for."""
        return Ways(self.units, self.stock, self.closure.executable)

    @cached_property
    def uses(self) -> Uses:
        """Which labels are alike by what is done with them here."""
        return Uses(self.foon, self.kitchen.utensils)

    @cached_property
    def rates(self) -> npt.NDArray[np.float64]:
        """The chance that each unit succeeds, NaN where nothing says it."""
        units = self.foon.units
        # None becomes NaN.
        by_motion = np.array([self.kitchen.motion_rate(motion) for motion in units.motions], dtype=np.float64)
        own = units.notes.rate
        return np.where(np.isnan(own), by_motion[units.motion], own)

    def node(self, number: ObjectId) -> ObjectNode:
        """Return the object node with an id, one of the FOON's or of the kitchen's."""
        known = len(self.foon.objects)
        return self.foon.objects[number] if number < known else self.strangers[number - known]

    def id_of(self, node: ObjectNode) -> ObjectId:
        """Return the id of an object node, seen on this level.

        Raises `QueryError` if neither FOON nor kitchen has it.
        """
        node = self.project(node)
        number = self.foon.id_of(node)
        if number is None:
            if node in self.strangers:
                return ObjectId(len(self.foon.objects) + self.strangers.index(node))
            same_label = [str(other) for other in self.foon.labelled(node.label)]
            hint = closest(str(node), same_label) or closest(node.label, self.foon.labels)
            raise QueryError(f"unknown goal {said(str(node))}{hint}")
        return number

    def is_tool(self, node: ObjectNode) -> bool:
        """Whether a node is bare, or a utensil that contains nothing."""
        return node.bare or (node.label in self.kitchen.utensils and not node.contents)

    def touched(self, *units: FunctionalUnit) -> Set[str]:
        """Return the labels that some units have to do with, as `touching.lp` has it."""
        numbers = {number for unit in units for number in (*unit.inputs, *unit.outputs)}
        return {label for number in numbers for label in self.node(number).named_labels}

    def handled(self, *units: FunctionalUnit) -> Set[str]:
        """Return the utensils that some units handle: what they list, and what that is in or on."""
        return frozenset().union(*(vessels.handled for vessels in self._vessels(units)))

    def filled(self, *units: FunctionalUnit) -> Set[str]:
        """Return the utensils that hold something in some units, before or after their motions."""
        return frozenset().union(*(vessels.filled for vessels in self._vessels(units)))

    def cost_of(self, units: Iterable[FunctionalUnit]) -> float | None:
        """Return what the motions of some units cost together; None if nothing says it of one of them."""
        if not self.kitchen.costs and self.kitchen.default_cost is None:
            return None
        costs = [self.kitchen.known_cost(unit) for unit in units]
        known = [cost for cost in costs if cost is not None]
        return float(sum(known)) if len(known) == len(costs) else None

    def _vessels(self, units: Iterable[FunctionalUnit]) -> Iterator[Vessels]:
        """Yield the utensils in each object that some units list."""
        vessels = self.units.vessels
        return (vessels[number] for unit in units for number in (*unit.inputs, *unit.outputs))
