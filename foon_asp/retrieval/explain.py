"""Why there is no task tree, and what is missing; where there is one, what each step is in it for."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from foon_asp.errors import QueryError
from foon_asp.io.wire import dumps
from foon_asp.limits import Limit, LimitReachedError, limited
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.checks import refuse_substitution
from foon_asp.query.constraints import FREE
from foon_asp.query.goals import Named
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.unreachable import Circle, Lack, circles, is_raw, unreachable_reason
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.conflict import conflict
from foon_asp.retrieval.explain_wire import explanation_json
from foon_asp.retrieval.missing import MissingSets, missing_sets, stocked
from foon_asp.retrieval.nearest import Near, NearObjects
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.steps import Instead, StepRole, explain_steps, without_unit

if TYPE_CHECKING:
    from foon_asp.draw.formats import Drawing

MOST = 50
"""How many sets of missing objects are sought, unless more are asked for."""


@dataclass(frozen=True, slots=True)
class MissingObject:
    """What the kitchen would have to have, and what it has instead.

    `raw`: no unit makes it, or it is an empty utensil. `same_dish`: it is the goal in another state, vessel
    or place.
    """

    node: ObjectNode
    raw: bool
    same_dish: bool
    near: tuple[Near, ...]


@dataclass(frozen=True, slots=True)
class Deadlock:
    """Units that go round in a circle, and what the kitchen has that resembles the first object of it."""

    circle: Circle
    near: tuple[Near, ...]


@dataclass(frozen=True, slots=True, repr=False)
class Explanation:
    """Why there is no task tree for a goal, or why there is one and what its steps are for.

    `status` is `UNREACHABLE` (the kitchen cannot make the goal; `missing` says what it lacks, `deadlocks`
    what needs itself), `CONSTRAINED` (only the constraints leave no tree), `REACHABLE` (there is a tree) or
    `LIMIT` (`limit` was reached before a tree was found, or proven best). `give_way` are the names of the
    constraints that have to be given up, as few as possible; if the goal is unreachable, then those that the
    first of the sets does not help against. `near` resembles the goal, where no set helps. `steps` are all of
    the tree, or only that of the unit `step`. `seconds` is wall time.
    """

    world: World
    query: Query
    status: Status
    reason: str
    missing: MissingSets | None = None
    missing_objects: tuple[MissingObject, ...] = ()
    deadlocks: tuple[Deadlock, ...] = ()
    near: tuple[Near, ...] = ()
    give_way: tuple[str, ...] = ()
    answer: Answer | None = None
    step: UnitId | None = None
    steps: tuple[StepRole, ...] = ()
    instead: Instead | None = None
    seconds: float = 0.0
    limit: Limit | None = None

    def __repr__(self) -> str:
        return f"<Explanation: {self.goal}, {self.status}>"

    def __str__(self) -> str:
        from foon_asp.render.explain import explanation_text

        return explanation_text(self).rstrip()

    def to_json(self) -> str:
        """Return the answer as the command writes it with `--format json`."""
        return dumps(explanation_json(self))

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return what is missing and why as a picture; where nothing is, the tree."""
        from foon_asp.draw.views import explanation_drawing

        return explanation_drawing(self, dark)

    @property
    def goal(self) -> ObjectNode:
        """The goal that is explained."""
        return self.query.nodes[0]


def explain(world: World, query: Query | Named, *, most: int = 1) -> Explanation:
    """Explain why there is no task tree for a goal, or what the steps of the best one are for.

    At most so many smallest sets of missing objects are sought. Raises `QueryError`.
    """
    return _explained(world, Query.of(query), most, None)


def explain_step(world: World, query: Query | Named, unit: UnitId, *, instead: bool = False) -> Explanation:
    """Explain one step of the best task tree, by the id of its unit; `instead` adds the best tree without it.

    Where there is no tree, that is explained. Raises `QueryError`, also if the unit is not in the tree.
    """
    return _explained(world, Query.of(query), 1, (unit, instead))


def _explained(world: World, query: Query, most: int, chosen: tuple[UnitId, bool] | None) -> Explanation:
    started = time.perf_counter()
    if len(query.goals) != 1:
        raise QueryError("one goal at a time is explained")
    refuse_substitution(query, "goals are explained")
    world = query.seen_in(world)
    query = query.checked(world)
    with limited(query.time_limit, query.memory_limit):
        try:
            problem = Problem.posed(world, query)
            reason = unreachable_reason(problem)
            if reason:
                found = _without_tree(problem, query, reason, most)
            else:
                found = _with_answer(problem, retrieve(world, query.replace(time_limit=None)), chosen)
        except LimitReachedError as error:
            found = Explanation(world, query, Status.LIMIT, "", limit=error.limit)
    return replace(found, query=query, seconds=time.perf_counter() - started)


def _without_tree(problem: Problem, query: Query, reason: str, most: int) -> Explanation:
    world, constraints = problem.world, problem.constraints
    [goal] = problem.goals
    missing = missing_sets(world, goal, most=most)
    object_ids = sorted({object_id for each in missing.sets for object_id in each})
    nearest = NearObjects(world)
    lack = Lack.of(world, goal) if goal in world.units.makers else None
    rings = circles(world, lack) if lack is not None and lack.circular else []
    give_way: tuple[str, ...] = ()
    if missing.sets and constraints != FREE:
        supplied = stocked(world, missing.sets[0])
        if retrieve(supplied, query.replace(by=(), time_limit=None)).status == Status.UNREACHABLE:
            give_way = conflict(Problem.posed(supplied, query))
    return Explanation(
        world,
        query,
        Status.UNREACHABLE,
        reason,
        missing=missing,
        missing_objects=tuple(
            MissingObject(
                world.node(object_id),
                is_raw(world, object_id),
                object_id in missing.same_dish,
                nearest.near(object_id),
            )
            for object_id in object_ids
        ),
        deadlocks=tuple(Deadlock(each, nearest.near(each.objects[0])) for each in rings),
        near=() if missing.sets else nearest.near(goal),
        give_way=give_way,
    )


def _with_answer(problem: Problem, answer: Answer, chosen: tuple[UnitId, bool] | None) -> Explanation:
    world, query, tree = problem.world, answer.query, answer.tree
    if answer.status == Status.UNREACHABLE:
        return Explanation(
            world, query, Status.CONSTRAINED, answer.reason, give_way=conflict(problem), answer=answer
        )
    status = Status.LIMIT if answer.status == Status.LIMIT else Status.REACHABLE
    found = Explanation(world, query, status, "", answer=answer, limit=answer.limit)
    if tree is None:
        return found
    if chosen is None:
        return replace(found, steps=explain_steps(tree))
    unit, instead = chosen
    if unit not in tree.units:
        listed = ", ".join(f"{unit.id} {unit.motion}" for unit in tree.functional_units) or "none at all"
        raise QueryError(f"the unit {unit} is not in the task tree of {answer.goal}; its units are {listed}")
    steps = (explain_steps(tree)[tree.units.index(unit)],)
    other = without_unit(answer, unit) if instead else None
    return replace(found, step=unit, steps=steps, instead=other)
