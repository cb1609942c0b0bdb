"""The least that the kitchen would have to have for a goal to be made."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from foon_asp.asp.model import Model
from foon_asp.asp.program import solver
from foon_asp.errors import InternalError
from foon_asp.limits import limited_now
from foon_asp.model.node import ObjectId
from foon_asp.model.reachability import within
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.unreachable import is_raw


@dataclass(frozen=True, slots=True)
class MissingSets:
    """The smallest sets of objects with any of which the kitchen could make a goal; none if no set helps.

    `proven` says that none is smaller, and that none holds the dish in another guise if that can be helped.
    `complete` says that these are all of them. `same_dish` are the objects in the sets that are the dish in
    another guise.
    """

    sets: tuple[tuple[ObjectId, ...], ...]
    same_dish: frozenset[ObjectId]
    proven: bool
    complete: bool


def missing_sets(world: World, goal: ObjectId, *, most: int = 1) -> MissingSets:
    """Return the smallest sets of objects with which the kitchen could make a goal; `most` at most.

    Raw objects come before prepared ones, and the dish in another state, vessel or place comes last; the goal
    itself and what units make of the dish never do. At a limit, the set is not proven to be the
    smallest, but nothing in it is superfluous.
    """
    if goal not in world.units.makers:
        return MissingSets((), frozenset(), proven=True, complete=True)
    made = world.closure.available.keys() - world.stock.keys()
    # How the kitchen makes what it can make need not be looked at.
    supplied = stocked(world, made) if made else world
    problem = Problem(supplied, (goal,), founded=False)
    control = solver(problem, ["retrieval/missing.lp"], {})
    first = control.first() if limited_now() else None
    answer = control.best()
    if answer.atoms is None and first is not None:
        answer = first
    if answer.atoms is None:
        return MissingSets((), frozenset(), proven=answer.proven, complete=answer.proven)
    answers: tuple[Model, ...] = (answer,)
    complete = False
    if most > 1 and answer.proven:
        every = control.all_best("missing", most)
        answers, complete = every.found or answers, every.complete
    same_dish = frozenset(ObjectId(number) for each in answers for number in each.column("same_dish"))
    sets = [list(map(ObjectId, each.column("missing"))) for each in answers]
    for each in sets:
        _check(problem, each)
    if not answer.proven:
        sets = [shrunk(problem, each, same_dish) for each in sets]
    found = tuple(map(tuple, sets))
    return MissingSets(found, same_dish & set().union(*found), proven=answer.proven, complete=complete)


def _enough(problem: Problem, object_ids: Iterable[ObjectId]) -> bool:
    """Whether the goal can be made with some objects more, by plain graph search."""
    world = problem.world
    return problem.goals[0] in within(world.units, {*world.stock, *object_ids}, problem.units).available


def _check(problem: Problem, object_ids: Sequence[ObjectId]) -> None:
    """Raise `InternalError` if the goal cannot be made with what is added: then the encoding is wrong."""
    if not _enough(problem, object_ids):
        goal = problem.world.node(problem.goals[0])
        raise InternalError(f"{goal} cannot be made with what missing.lp adds")


def shrunk(
    problem: Problem, object_ids: Sequence[ObjectId], same_dish: Collection[ObjectId]
) -> list[ObjectId]:
    """Leave out what is superfluous: the dish in another guise first, then what is prepared."""
    world = problem.world
    kept = list(object_ids)
    for object_id in sorted(
        object_ids, key=lambda object_id: (object_id not in same_dish, is_raw(world, object_id), object_id)
    ):
        fewer = [other for other in kept if other != object_id]
        if _enough(problem, fewer):
            kept = fewer
    return kept


def stocked(world: World, object_ids: Iterable[ObjectId]) -> World:
    """Return a domain whose kitchen has some more objects."""
    return world.with_stock((*world.kitchen.objects, *map(world.node, object_ids)))
