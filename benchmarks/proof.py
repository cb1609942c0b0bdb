"""What the exact peers share: the part of a problem that they are given, and what they answer."""

from __future__ import annotations

import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.objective import UNITS
from foon_asp.query.problem import Problem
from foon_asp.query.reduction import MOST, narrowed
from foon_asp.retrieval.tree import TaskTree


@dataclass(frozen=True, slots=True)
class Proof:
    """What a method says of a goal, and the wall seconds from the loaded problem to the checked tree.

    `status` is `optimal` (proven), `unreachable` (proven), `limit` (the time ran out; the tree is the best
    so far, if there is one) or `failed`, with a message. `phases` are the parts of the time.
    """

    status: str
    tree: TaskTree | None
    seconds: float
    phases: Mapping[str, float]
    message: str = ""


class Stopwatch:
    """Splits the time since it was made into phases."""

    def __init__(self) -> None:
        self._begun = self._last = time.perf_counter()
        self.phases: dict[str, float] = {}

    def lap(self, phase: str) -> None:
        """Count the time since the last lap to a phase."""
        now = time.perf_counter()
        self.phases[phase] = self.phases.get(phase, 0.0) + now - self._last
        self._last = now

    def proof(self, status: str, tree: TaskTree | None = None, message: str = "") -> Proof:
        """Return the answer that ends the time."""
        return Proof(status, tree, time.perf_counter() - self._begun, self.phases, message)


@dataclass(frozen=True, slots=True)
class Slice:
    """What matters of a problem: the units of `Problem.units`, without all that the kitchen has anyway.

    `goals`: wanted objects that are not in the kitchen. `needs[U]`: what U needs besides the kitchen.
    `makers[O]`: the units that make O and do not need it, for each wanted or needed object. `circles`: for
    objects that can come to be needed for themselves, the number of their strongly connected component; all
    others can be put in an order once and for all, whatever units are chosen.
    """

    goals: tuple[ObjectId, ...]
    needs: Mapping[UnitId, Collection[ObjectId]]
    makers: Mapping[ObjectId, Collection[UnitId]]
    circles: Mapping[ObjectId, int]

    @classmethod
    def of(cls, problem: Problem) -> Slice:
        """Cut a problem down to what matters."""
        world = problem.world
        stock, reading = world.stock, world.units
        goals = tuple(goal for goal in problem.goals if goal not in stock)
        needs = {unit: [need for need in reading.needs[unit] if need not in stock] for unit in problem.units}
        makers: dict[ObjectId, list[UnitId]] = {thing: [] for thing in goals}
        for things in needs.values():
            makers.update((thing, []) for thing in things)
        for unit in needs:
            for thing in reading.makes[unit]:
                if thing in makers and thing not in needs[unit]:
                    makers[thing].append(unit)
        return cls(goals, needs, makers, _circles(needs, makers))

    def before(self, thing: ObjectId, unit: UnitId) -> list[ObjectId]:
        """Return what a unit needs of the circle of an object that it makes."""
        circle = self.circles.get(thing)
        if circle is None:
            return []
        return [need for need in self.needs[unit] if self.circles.get(need) == circle]


def _circles(
    needs: Mapping[UnitId, Collection[ObjectId]], makers: Mapping[ObjectId, Collection[UnitId]]
) -> dict[ObjectId, int]:
    """Number the strongly connected components of several objects.

    Nearly all objects are settled by peeling off what depends on nothing; the components are those of the
    rest.
    """
    after: dict[ObjectId, list[ObjectId]] = {}
    waiting = dict.fromkeys(makers, 0)
    for thing, units in makers.items():
        for unit in units:
            waiting[thing] += len(needs[unit])
            for need in needs[unit]:
                after.setdefault(need, []).append(thing)
    free = [thing for thing, count in waiting.items() if count == 0]
    while free:
        thing = free.pop()
        del waiting[thing]
        for other in after.get(thing, ()):
            waiting[other] -= 1
            if waiting[other] == 0:
                free.append(other)
    if not waiting:
        return {}
    # It takes longer to import than most problems to solve.
    import networkx as nx

    graph = nx.DiGraph((need, thing) for need in waiting for thing in after.get(need, ()) if thing in waiting)
    graph.add_nodes_from(waiting)
    components = [part for part in nx.strongly_connected_components(graph) if len(part) > 1]
    return {thing: number for number, part in enumerate(components) for thing in part}


def loaded_problem(world: World, goal: ObjectNode, *, reduced: bool = False) -> Problem | None:
    """Return the problem of a goal, if asked for as clingo gets it; None if the kitchen cannot make it."""
    problem = Problem.of(world, [goal])
    if problem.goals[0] not in world.closure.available:
        return None
    if reduced and len(problem.units) <= MOST:
        return narrowed(problem, UNITS.complete)
    return problem


def posed(watch: Stopwatch, world: World, goal: ObjectNode, *, reduced: bool) -> Problem | Proof:
    """Return the problem of a goal, or the answer where no solver is needed.

    None is if nothing makes the goal, nor if all units that the reductions leave must be in the tree.
    """
    problem = loaded_problem(world, goal, reduced=reduced)
    if problem is None:
        return watch.proof("unreachable")
    if problem.forced:
        return watch.proof("optimal", TaskTree.of(world, problem.goals, problem.units))
    return problem
