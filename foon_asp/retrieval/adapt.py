"""A dish adapted: the nearest dish of a kind, with what is wanted and without what is not.

After Sakib, Paulius and Sun: Approximate task tree retrieval in a knowledge network for robotic cooking (RA-L
2022). `encodings/retrieval/adapt.lp` says what an adapted tree is.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from foon_asp.errors import QueryError
from foon_asp.io.wire import dumps
from foon_asp.limits import Limit, LimitReachedError, limited
from foon_asp.model.node import ObjectNode, check_label
from foon_asp.model.reachability import backward, within
from foon_asp.model.world import World
from foon_asp.query.dishes import find_dishes
from foon_asp.query.goals import Named
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.substitutes import Substitutes
from foon_asp.query.substitution import Replacement, Substitution
from foon_asp.query.unreachable import unreachable_reason
from foon_asp.retrieval.adapt_wire import adaptation_json
from foon_asp.retrieval.answer import Answer, Answered
from foon_asp.retrieval.conflict import conflict_reason
from foon_asp.retrieval.methods.found import Found
from foon_asp.retrieval.substitute import Space, likest
from foon_asp.retrieval.tree import TaskTree
from foon_asp.values import a_list, said

_ENCODINGS = ("retrieval/adapt.lp",)

_THOUSANDTHS = 1000


@dataclass(frozen=True, slots=True)
class Candidate:
    """A dish that was looked at, and how far it is from what was asked.

    `distance` is None if it cannot be made so, for a `reason`, or if a limit came before any tree.
    """

    dish: ObjectNode
    status: Status
    distance: float | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, repr=False)
class Adaptation(Answered):
    """An adapted dish; it is true if there is one.

    `answer` has the tree of the nearest dish, with all that was `replaced` or left out and all `additions`,
    each as if it replaced the label that it is beside. `distance` is how far that is from the dish as it was
    asked for, in likeness. `missing` could not be added: nothing that goes into the dish is known to be like
    it. `brought` is wanted, and the kitchen lacks it. `candidates` are all dishes that were looked at, the
    nearest first.
    """

    wanted: tuple[str, ...]
    distance: float | None
    additions: tuple[Replacement, ...]
    missing: tuple[str, ...]
    candidates: tuple[Candidate, ...]
    seconds: float

    def __repr__(self) -> str:
        far = "" if self.distance is None else f", {self.distance:g} away"
        return f"<Adaptation: {self.answer!r}{far}>"

    def __str__(self) -> str:
        from foon_asp.render.adapt import adaptation_text

        return adaptation_text(self).rstrip()

    @property
    def dish(self) -> ObjectNode:
        """The dish that was adapted, or the first that could not be."""
        return self.answer.goal

    @property
    def tree(self) -> TaskTree | None:
        """The tree, with all changes made."""
        return self.answer.tree

    @property
    def replaced(self) -> tuple[Replacement, ...]:
        """What was replaced or left out."""
        return () if self.tree is None else self.tree.replacements

    @property
    def brought(self) -> tuple[ObjectNode, ...]:
        """What is wanted and taken to be at hand, though the kitchen lacks it."""
        return () if self.tree is None else self.tree.brought

    def to_json(self) -> str:
        """Return what the command writes with `--format json`."""
        return dumps(adaptation_json(self))


@dataclass(frozen=True, slots=True)
class _Adapted:
    """The best that can be made of one dish."""

    query: Query
    found: Found
    distance: int = 0
    additions: tuple[Replacement, ...] = ()
    missing: tuple[str, ...] = ()
    reason: str = ""

    @property
    def rank(self) -> tuple[int, list[float]]:
        """What dishes that can be made are compared by."""
        tree = self.found.tree
        assert tree is not None
        return self.distance, self.query.objective.complete.costs(tree.costs)

    @property
    def candidate(self) -> Candidate:
        """What is told of the dish beside others."""
        far = None if self.found.tree is None else self.distance / _THOUSANDTHS
        return Candidate(self.query.nodes[0], self.found.status, far, self.reason)


def adapt_dish(world: World, question: Query | Named, wanted: Iterable[str] = ()) -> Adaptation:
    """Return the nearest of the dishes that a question means, adapted.

    The question names one dish as `find_dishes` reads it; what it is to be without stands in its constraints,
    and `substitute` says who tells what is alike, the FOON if nobody is named. `wanted` are labels that the
    dish is to have. The time limit is for all dishes together. Raises `QueryError`.
    """
    started = time.perf_counter()
    query = Query.of(question)
    if len(query.goals) > 1:
        raise QueryError("one dish is adapted at a time")
    query = query.replace(substitute=query.substitute or Substitution.of(True))
    world = query.seen_in(world)
    labels = _wanted(world, query, wanted)
    dishes = find_dishes(world, query.goals[0])
    search = _Search(world, query, labels)
    with limited(query.time_limit, query.memory_limit):
        judged = list(search.judged(dishes))
        return search.nearest(judged, started)


def _wanted(world: World, query: Query, wanted: Iterable[str]) -> tuple[str, ...]:
    """Return the labels that are wanted; raise `QueryError` for what no dish can have."""
    listed = a_list(wanted, "wanted", "labels")
    for label in listed:
        check_label(label)
    labels = tuple(dict.fromkeys(label.strip().lower() for label in listed))
    avoided = _avoided(query)
    for label in labels:
        if label in world.kitchen.utensils:
            raise QueryError(f"{said(label)} is a utensil; only food is added")
        if label in avoided:
            raise QueryError(
                f"{said(label)} is wanted, and is not to be there: {avoided[label]!r} forbids it"
            )
    return labels


def _avoided(query: Query) -> dict[str, str]:
    """Return the labels that the dish is to be without, and the constraint that says so."""
    named = query.constraints.named()
    return {str(label): name for atom, name, labels in named if atom == "without" for label in labels}


class _Search:
    """The best that can be made of each of some dishes, and the nearest of them."""

    def __init__(self, world: World, query: Query, wanted: tuple[str, ...]) -> None:
        assert query.substitute is not None
        self._world = world
        self._query = query
        self._wanted = wanted
        self._avoided = frozenset(_avoided(query))
        self._substitutes = Substitutes(world, query.substitute, wanted, self._avoided)

    def judged(self, dishes: Iterable[ObjectNode]) -> Iterator[_Adapted]:
        """Yield for each dish the best that can be made of it until a limit."""
        for dish in dishes:
            query = self._query.replace(goals=[dish], time_limit=None, memory_limit=None).checked(self._world)
            try:
                yield self._adapted(query)
            except LimitReachedError as error:
                yield _Adapted(query, Found(Status.LIMIT, limit=error.limit))

    def _adapted(self, query: Query) -> _Adapted:
        problem = self._problem(query)
        space = Space(problem, self._substitutes, self._must_go(problem))
        found, model = likest(space, query.objective, _ENCODINGS, space.tree)
        if model is None:
            reason = ""
            if found.status is Status.UNREACHABLE:
                reason = f"{unreachable_reason(problem) or conflict_reason(problem)}; no replacement helps"
            return _Adapted(query, found, reason=reason)
        missing = tuple(str(label) for (label,) in model.rows("absent"))
        rows, additions = space.replacements(model), space.additions(model)
        distance = sum(row.cost + 1 for row in rows) + sum(row.cost for row in additions)
        return _Adapted(query, found, distance + _THOUSANDTHS * len(missing), additions, missing)

    def _problem(self, query: Query) -> Problem:
        """Return the question of a dish in a kitchen that does not have it yet."""
        [dish] = query.nodes
        world = self._world
        if dish in world.kitchen.objects:
            world = world.with_stock(node for node in world.kitchen.objects if node != dish)
        return Problem.posed(world, query)

    def _must_go(self, problem: Problem) -> frozenset[str]:
        """Return the labels that may be replaced: what is avoided, and what the dish cannot have.

        The dish cannot have a label if a step that may lead to it needs something of this food alone, and
        that cannot be had by steps without what is avoided.
        """
        world, utensils = problem.world, problem.world.kitchen.utensils
        steps = backward(world.units, problem.goals, world.stock)
        units = world.foon.units
        clean = [unit for unit in steps if self._avoided.isdisjoint(world.touched(units[unit]))]
        available = within(world.units, world.stock, clean).available
        needed = {number for unit in steps for number in world.units.needs[unit]}
        food = (
            set(world.node(number).named_labels) - utensils for number in needed if number not in available
        )
        return self._avoided.union(*(labels for labels in food if len(labels) == 1))

    def nearest(self, judged: list[_Adapted], started: float) -> Adaptation:
        """Return the nearest of some dishes."""
        made = [each for each in judged if each.found.tree is not None]
        best = min(made, key=lambda each: each.rank, default=judged[0])
        limit = next((each.found.limit for each in judged if each.found.status is Status.LIMIT), None)
        found = best.found
        if any(each.found.status is Status.LIMIT for each in judged):
            found = Found(Status.LIMIT, found.tree, found.bound, found.own, limit or Limit.TIME)
        reason = best.reason
        if found.status is Status.UNREACHABLE and len(judged) > 1:
            reason = f"none of {len(judged)} dishes can be made so"
        seconds = time.perf_counter() - started
        answer = Answer(best.query, *found[:4], reason, seconds, limit=found.limit)
        candidates = sorted(
            (each.candidate for each in judged),
            key=lambda each: (each.distance is None, each.distance or 0, each.dish != answer.goal),
        )
        return Adaptation(
            answer,
            self._wanted,
            None if found.tree is None else best.distance / _THOUSANDTHS,
            best.additions,
            best.missing,
            tuple(candidates),
            seconds,
        )
