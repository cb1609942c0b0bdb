"""What a planner is asked: the units that can matter for a plan."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.reachability import backward, within
from foon_asp.model.world import World
from foon_asp.query.checks import check_objective
from foon_asp.query.problem import Problem

if TYPE_CHECKING:
    # Only their types are needed here.
    from foon_asp.planning.query import PlanQuery
    from foon_asp.planning.schedule_query import ScheduleQuery

Asked = TypeVar("Asked", "PlanQuery", "ScheduleQuery")


class PlanProblem(Problem):
    """A problem with the units that can matter for a plan.

    That the kitchen holds an object which it counts does not make its makers superfluous: it can run out.
    """

    def __init__(
        self, effects: Effects, goals: tuple[ObjectId, ...], among: Collection[UnitId] | None = None
    ) -> None:
        """Ask for goals, with no other units than those that are named, if any are."""
        super().__init__(effects.world, goals)
        self.effects = effects
        self._among = among

    @cached_property
    def units(self) -> list[UnitId]:
        """Ids of the units given to the solver, in file order.

        Other units make nothing that a goal or one of these needs, or only give back what they take, so a
        plan can do without them.
        """
        world, effects = self.world, self.effects
        allowed: Collection[UnitId] = world.closure.executable
        if self._among is not None:
            allowed = within(world.units, world.stock, self._among).executable
        units = backward(world.units, self.goals, effects.endless, allowed)
        return [unit for unit in units if effects.makes_a_difference(unit)]


def posed(world: World, asked: Asked) -> tuple[Asked, PlanProblem]:
    """Return a question as it is meant in a world, and the problem that it poses there.

    Raises `QueryError` if the question does not fit the data.
    """
    world = asked.query.seen_in(world)
    asked = replace(asked, query=asked.query.checked(world))
    problem = PlanProblem(Effects(world, asked.semantics), Problem.posed(world, asked.query).goals)
    check_objective(problem, asked.query.by)
    return asked, problem
