"""A problem: goals over a world, with only the units that can matter for them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World
from foon_asp.query.constraints import FREE, Constraints

if TYPE_CHECKING:
    from foon_asp.query.query import Query


@dataclass(frozen=True, eq=False)
class Problem:
    """What the solver is asked: goals over a world, with only the units that can matter for them.

    `founded` keeps the units that the kitchen can execute; without it (the reading of the published
    programs) every unit that leads to a goal stays, even in circles. Units that the constraints demand
    are there, too, with what leads to them. `whole`: the entire FOON. `switched`: none of the goals is wanted
    at first, each is switched on by itself. `among`: the units that a reduction has left, None if none was
    made (`query/reduction.py`).
    """

    world: World
    goals: tuple[ObjectId, ...]
    founded: bool = True
    whole: bool = False
    constraints: Constraints = FREE
    switched: bool = False
    among: tuple[UnitId, ...] | None = None
    forced: bool = False

    @classmethod
    def of(
        cls,
        world: World,
        goals: Iterable[ObjectNode],
        *,
        founded: bool = True,
        constraints: Constraints = FREE,
    ) -> Problem:
        """Ask for goals by their nodes; raise `QueryError` for one that neither FOON nor kitchen has."""
        ids = tuple(world.id_of(goal) for goal in goals)
        return cls(world, ids, founded=founded, constraints=constraints)

    @classmethod
    def posed(cls, world: World, query: Query) -> Problem:
        """Pose a question that was checked against the world."""
        return cls.of(world, query.nodes, founded=query.founded, constraints=query.constraints)

    @cached_property
    def units(self) -> list[UnitId]:
        """Ids of the units given to the solver, in file order."""
        world = self.world
        if self.among is not None:
            return list(self.among)
        if self.whole:
            return list(world.foon.units.ids)
        allowed = world.closure.executable if self.founded else None
        required = [unit for unit in self.constraints.use_units if allowed is None or unit in allowed]
        wanted = [*self.goals, *(need for unit in required for need in world.units.needs[unit])]
        units = backward(world.units, wanted, world.stock, allowed)
        return sorted({*required, *units}) if required else units

    @cached_property
    def objects(self) -> list[ObjectId]:
        """Ids of the objects given to the solver, sorted."""
        world = self.world
        if self.whole:
            return list(world.ids)
        seen = set(self.goals)
        for number in self.units:
            unit, units = world.foon.units[number], world.units
            seen.update(unit.inputs, unit.outputs, units.takes[number], units.gives[number])
        return sorted(seen)
