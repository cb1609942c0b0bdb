"""Reductions: what of a problem need not be given to the solver."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from foon_asp.model.and_or import AndOrGraph
from foon_asp.model.node import FunctionalUnit, ObjectId, UnitId
from foon_asp.model.reachability import backward, within
from foon_asp.model.world import World
from foon_asp.query.constraints import FREE, Constraints
from foon_asp.query.objective import Objective
from foon_asp.query.prices import rates_known
from foon_asp.query.problem import Problem

MOST = 2_000
"""Up to how many units it pays to look at which of them matter."""


def reducible(problem: Problem, objective: Objective) -> bool:
    """Whether reductions are sound for a problem at all.

    They speak of trees that can be executed, and rules of the user's own may forbid any of those, or pay for
    it. Where chances matter and a unit has none the question is refused, which takes all units.
    """
    constraints = problem.constraints
    if not problem.founded or constraints.rules or problem.whole or problem.switched:
        return False
    if not set(constraints.use_units) <= set(problem.units):
        return False
    by_success = "success" in objective.names
    return not (by_success or constraints.min_success is not None) or rates_known(problem)


def permitted(problem: Problem) -> Problem | None:
    """Return a problem without the units that constraints forbid, and what cannot be done without them.

    A unit that breaks a constraint by itself is in no tree. Once there is none the constraint is kept anyway,
    and nobody need look at it any more. None if nothing makes some goal then.
    """
    if problem.constraints == FREE:
        return problem
    left = replace(FREE, **{name: getattr(problem.constraints, name) for name in _ABOUT_TREES})
    if problem.constraints == left:
        return problem
    forbidden = set(_forbidden(problem))
    if not forbidden:
        return replace(problem, among=tuple(problem.units), constraints=left)
    world, demanded = problem.world, problem.constraints.use_units
    closure = within(world.units, world.stock, (unit for unit in problem.units if unit not in forbidden))
    wanted = [*problem.goals, *(need for unit in demanded for need in world.units.needs[unit])]
    if any(unit not in closure.executable for unit in demanded):
        return None
    if any(goal not in closure.available and goal not in world.stock for goal in problem.goals):
        return None
    kept = backward(world.units, wanted, world.stock, closure.executable)
    return replace(problem, among=tuple(sorted({*demanded, *kept})), constraints=left)


def _forbidden(problem: Problem) -> Iterator[UnitId]:
    """Yield the units that break a constraint by themselves, as `constraints.lp` has it."""
    constraints, units = problem.constraints, problem.world.foon.units
    motions = set(constraints.avoid_motions)
    allowed = None if constraints.only_motions is None else set(constraints.only_motions)
    avoided = set(constraints.avoid_units)
    labels = _Labels(problem)
    for number in problem.units:
        unit = units[number]
        if (
            number in avoided
            or unit.motion in motions
            or (allowed is not None and unit.motion not in allowed)
            or any(map(labels.forbid, (*unit.inputs, *unit.outputs)))
        ):
            yield number


_ABOUT_TREES = ("use_units", "max_units", "max_depth", "min_success", "human_steps", "rules")
"""Constraints that no unit breaks by being there."""


class _Labels:
    """Which objects no unit may list, each looked at once."""

    def __init__(self, problem: Problem) -> None:
        constraints: Constraints = problem.constraints
        self._world = problem.world
        self._touched = {
            *constraints.without,
            *(label for _, labels in constraints.diets for label in labels),
        }
        self._handled = set(constraints.without_tools)
        self._known: dict[ObjectId, bool] = {}

    def forbid(self, number: ObjectId) -> bool:
        """Whether an object has a label that must not be touched, or handled."""
        if not self._touched and not self._handled:
            return False
        if number not in self._known:
            node = self._world.node(number)
            self._known[number] = not (
                self._touched.isdisjoint(node.named_labels) and self._handled.isdisjoint(node.handled_labels)
            )
        return self._known[number]


def without_superfluous(problem: Problem, objective: Objective) -> Problem:
    """Return a problem with only the units of trees that have no superfluous one, if it is not too large.

    For the depth a tree may have a unit that makes earlier what another one makes, too: such units stay.
    """
    smaller = permitted(problem)
    if smaller is None or len(smaller.units) > MOST:
        return smaller or problem
    graph = _graph(smaller)
    if not _by_rounds(smaller, objective):
        graph.leave_made()
    return replace(smaller, among=tuple(graph.units))


def narrowed(problem: Problem, objective: Objective) -> Problem:
    """Return a problem with units that a best tree needs, so that at least one best tree is among them."""
    graph, prices = _graph(problem), _Prices(problem, objective)
    fewer = True
    while fewer and len(graph.needs) > len(graph.forced):
        fewer = not _by_rounds(problem, objective) and graph.leave_made()
        fewer |= graph.leave_dominated(prices.no_dearer)
    return replace(problem, among=tuple(graph.units), forced=len(graph.needs) == len(graph.forced))


def _graph(problem: Problem) -> AndOrGraph:
    world, demanded = problem.world, problem.constraints.use_units
    rounds = world.closure.executable
    if problem.among is None and not demanded:
        goals = [goal for goal in problem.goals if goal not in world.stock]
        return AndOrGraph.known(world.ways, goals, rounds)
    return AndOrGraph(world.units, world.stock, problem.units, problem.goals, demanded, rounds)


def _by_rounds(problem: Problem, objective: Objective) -> bool:
    """Whether it matters in which round something is done."""
    return "depth" in objective.names or problem.constraints.max_depth is not None


_ALIKE = {"units", "depth", "human"}
"""Criteria by which a unit is no dearer than one that it can stand in for, whatever units they are."""


class _Prices:
    """What a unit costs by all that is asked for; each is looked at once."""

    def __init__(self, problem: Problem, objective: Objective) -> None:
        constraints = problem.constraints
        self._world = problem.world
        # A criterion that is in neither table must not go unnoticed.
        self._names = set(objective.names) - _ALIKE
        if constraints.min_success is not None or constraints.human_steps is not None:
            self._names.add("success")
        self._known: dict[UnitId, tuple[Any, ...]] = {}

    def no_dearer(self, one: UnitId, other: UnitId) -> bool:
        """Whether a unit costs no more than another one, beside whatever other units."""
        return not self._names or all(map(operator.le, self._prices(one), self._prices(other)))

    def _prices(self, number: UnitId) -> tuple[Any, ...]:
        if number not in self._known:
            unit = self._world.foon.units[number]
            self._known[number] = tuple(_BY_UNIT[name](self._world, unit) for name in sorted(self._names))
        return self._known[number]


_BY_UNIT: dict[str, Callable[[World, FunctionalUnit], Any]] = {
    "inputs": lambda _, unit: len(unit.inputs),
    "time": lambda _, unit: unit.duration or 0,
    "cost": lambda world, unit: world.kitchen.cost(unit),
    "success": lambda world, unit: -world.kitchen.rate(unit),
    "tools": lambda world, unit: world.handled(unit),
    "dirty": lambda world, unit: world.filled(unit),
    "motions": lambda _, unit: {unit.motion},
}
"""What a unit pays by each criterion: sets are paid once for all units that have something of them."""
