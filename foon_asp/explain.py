"""Why there is no task tree, and what is missing; where there is one, what each step is in it for."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches

from foon_asp.constraints import FREE, Constraints
from foon_asp.decode import column
from foon_asp.errors import InternalError, QueryError
from foon_asp.graph import FunctionalUnit, ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.program import solver
from foon_asp.reasons import Circle, Lack, circles, is_raw, unreachable_reason
from foon_asp.retrieve import Retrieval, check_constraints, check_method, conflict, retrieve
from foon_asp.solve import Answer
from foon_asp.tree import TaskTree

MOST = 50
"""How many sets of missing things are sought, unless more are asked for."""

_NEAREST = 3
_SIMILAR = 0.8
"""How alike two labels are that are taken for similar: misspelt, or plural."""


@dataclass(frozen=True, slots=True)
class Near:
    """Something that resembles an object. `at_hand`: the kitchen has it; else the kitchen can make it."""

    node: ObjectNode
    at_hand: bool


@dataclass(frozen=True, slots=True)
class MissingThing:
    """What the kitchen would have to have, and what it has instead.

    `raw`: no unit makes it, or it is an empty utensil. `same_dish`: it is the goal in another state, vessel
    or place.
    """

    node: ObjectNode
    raw: bool
    same_dish: bool
    near: tuple[Near, ...]


@dataclass(frozen=True, slots=True)
class MissingSets:
    """The smallest sets of objects with any of which the kitchen could make a goal; none if no set helps.

    `proven` says that none is smaller, and that none holds the dish in another guise if that can be helped.
    `complete` says that these are all of them. `same_dish` are the objects in the sets that are the dish in
    another guise.
    """

    sets: tuple[tuple[int, ...], ...]
    same_dish: frozenset[int]
    proven: bool
    complete: bool


@dataclass(frozen=True, slots=True)
class Deadlock:
    """Units that go round in a circle, and what the kitchen has that resembles the first thing of it."""

    circle: Circle
    near: tuple[Near, ...]


@dataclass(frozen=True, slots=True)
class Taken:
    """An input of a step. `step` is the place (1, 2, …) of the step that makes it, None for the kitchen.

    If the kitchen does not have it either (`at_hand` is false), another input shows the same thing.
    """

    node: ObjectNode
    step: int | None
    at_hand: bool


@dataclass(frozen=True, slots=True)
class Made:
    """What a step makes, the places of the later steps that take it, and whether it is a goal."""

    node: ObjectNode
    steps: tuple[int, ...]
    goal: bool


@dataclass(frozen=True, slots=True)
class Step:
    """What a step of a task tree is in it for.

    `way` are the places of the steps by which what it makes gets into a goal, itself the first: the shortest
    way there is. It is empty if no goal needs what the step makes.
    """

    place: int
    unit: FunctionalUnit
    takes: tuple[Taken, ...]
    makes: tuple[Made, ...]
    way: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Instead:
    """The best tree without a unit, if there is one; the units that go and those that come, by id."""

    unit: int
    retrieval: Retrieval
    goes: tuple[int, ...]
    comes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Explanation:
    """Why there is no task tree for a goal, or why there is one and what its steps are for.

    `status` is `unreachable` (the kitchen cannot make the goal; `missing` says what it lacks, `deadlocks`
    what needs itself), `constrained` (only the constraints leave no tree), `reachable` (there is a tree) or
    `limit` (the time ran out before a tree was found, or proven best). `give_way` are the names of the
    constraints that have to be given up, as few as possible; if the goal is unreachable, then those that the
    first of the sets does not help against. `near` resembles the goal, where no set helps. `steps` are all of
    the tree, or only that of the unit `step`. `seconds` is wall time.
    """

    domain: Domain
    goal: ObjectNode
    status: str
    reason: str
    missing: MissingSets | None = None
    things: tuple[MissingThing, ...] = ()
    deadlocks: tuple[Deadlock, ...] = ()
    near: tuple[Near, ...] = ()
    give_way: tuple[str, ...] = ()
    retrieval: Retrieval | None = None
    step: int | None = None
    steps: tuple[Step, ...] = ()
    instead: Instead | None = None
    seconds: float = 0.0


def first_sentence(problem: Problem) -> str:
    """Say why the kitchen cannot make a goal, or nothing if it can; plain graph search, before any solver."""
    return unreachable_reason(problem)


def explain(
    domain: Domain,
    goal: ObjectNode,
    by: str | Sequence[str] = (),
    *,
    constraints: Constraints = FREE,
    step: int | None = None,
    instead: bool = False,
    everything: bool = False,
    most: int = MOST,
    time_limit: float | None = None,
) -> Explanation:
    """Explain why there is no task tree for a goal, or what the steps of the best one are for.

    `step` is the id of a unit of the tree: only that step is explained. `instead` adds the best tree without
    it. `everything` asks for all smallest sets of missing things, `most` at most. `time_limit` is in seconds,
    for each solve. Raises `QueryError`.
    """
    started = time.perf_counter()
    if instead and step is None:
        raise QueryError("name the step to do without: --step ID")
    by = check_method("optimal", by, True, constraints)
    check_constraints(domain, "optimal", constraints)
    problem = domain.problem([goal], constraints=constraints)
    reason = first_sentence(problem)
    if reason:
        found = _without_tree(problem, reason, most if everything else 1, time_limit)
    else:
        result = retrieve(domain, goal, by=by, constraints=constraints, time_limit=time_limit)
        found = _with_result(problem, result, step, instead, time_limit)
    return replace(found, seconds=time.perf_counter() - started)


def _without_tree(problem: Problem, reason: str, most: int, time_limit: float | None) -> Explanation:
    domain, constraints = problem.domain, problem.constraints
    [goal] = problem.goals
    missing = missing_sets(domain, goal, most=most, time_limit=time_limit)
    things = sorted({thing for each in missing.sets for thing in each})
    pantry = Pantry(domain)
    lack = Lack.of(domain, goal) if goal in domain.reading.makers else None
    rings = circles(domain, lack) if lack is not None and lack.circular else []
    give_way: tuple[str, ...] = ()
    if missing.sets and constraints != FREE:
        stocked = _stocked(domain, missing.sets[0])
        if retrieve(stocked, domain.node(goal), constraints=constraints).status == "unreachable":
            give_way = conflict(stocked.problem([domain.node(goal)], constraints=constraints))
    return Explanation(
        domain,
        domain.node(goal),
        "unreachable",
        reason,
        missing=missing,
        things=tuple(
            MissingThing(
                domain.node(thing), is_raw(domain, thing), thing in missing.same_dish, pantry.near(thing)
            )
            for thing in things
        ),
        deadlocks=tuple(Deadlock(each, pantry.near(each.things[0])) for each in rings),
        near=() if missing.sets else pantry.near(goal),
        give_way=give_way,
    )


def missing_sets(domain: Domain, goal: int, *, most: int = 1, time_limit: float | None = None) -> MissingSets:
    """Return the smallest sets of objects with which the kitchen could make a goal; `most` at most.

    Raw things come before prepared ones, and the dish in another state, vessel or place comes last; the goal
    itself and what units make of the dish never do. If the time runs out, the set is not proven to be the
    smallest, but nothing in it is superfluous.
    """
    if goal not in domain.reading.makers:
        return MissingSets((), frozenset(), proven=True, complete=True)
    made = domain.closure.available.keys() - domain.stock.keys()
    # How the kitchen makes what it can make need not be looked at.
    supplied = _stocked(domain, made) if made else domain
    problem = Problem(supplied, (goal,), founded=False)
    control = solver(problem, ["missing.lp"], {})
    deadline = None if time_limit is None else time.monotonic() + time_limit
    first = control.first() if deadline is not None else None
    answer = control.best(deadline)
    if answer.atoms is None and first is not None:
        answer = first
    if answer.atoms is None:
        return MissingSets((), frozenset(), proven=True, complete=True)
    answers: tuple[Answer, ...] = (answer,)
    complete = False
    if most > 1 and answer.proven:
        every = control.all_best("missing", deadline, most)
        answers, complete = every.found or answers, every.complete
    same_dish = frozenset(thing for each in answers for thing in column(each, "same_dish"))
    sets = [column(each, "missing") for each in answers]
    for each in sets:
        _check(problem, each)
    if not answer.proven:
        sets = [shrunk(problem, each, same_dish) for each in sets]
    found = tuple(map(tuple, sets))
    return MissingSets(found, same_dish & set().union(*found), proven=answer.proven, complete=complete)


def _enough(problem: Problem, things: Iterable[int]) -> bool:
    """Whether the goal can be made with some things more, by plain graph search."""
    domain = problem.domain
    return problem.goals[0] in domain.reading.execute({*domain.stock, *things}, problem.units).available


def _check(problem: Problem, things: Sequence[int]) -> None:
    """Raise `InternalError` if the goal cannot be made with what is added: then the encoding is wrong."""
    if not _enough(problem, things):
        goal = problem.domain.node(problem.goals[0])
        raise InternalError(f"{goal} cannot be made with what missing.lp adds")


def shrunk(problem: Problem, things: Sequence[int], same_dish: Collection[int]) -> list[int]:
    """Leave out what is superfluous: the dish in another guise first, then what is prepared."""
    domain = problem.domain
    kept = list(things)
    for thing in sorted(things, key=lambda thing: (thing not in same_dish, is_raw(domain, thing), thing)):
        fewer = [other for other in kept if other != thing]
        if _enough(problem, fewer):
            kept = fewer
    return kept


def _stocked(domain: Domain, things: Iterable[int]) -> Domain:
    """Return a domain whose kitchen has some more objects."""
    return domain.with_stock((*domain.kitchen.objects, *map(domain.node, things)))


class Pantry:
    """What the kitchen has and can make, by name.

    A utensil with something in it goes by the names of its contents, everything else by its label.
    """

    def __init__(self, domain: Domain) -> None:
        self._domain = domain
        self._by_name: dict[str, list[int]] = {}
        for thing in sorted(domain.closure.available):
            for name in self._names(domain.node(thing)):
                self._by_name.setdefault(name, []).append(thing)

    def near(self, thing: int) -> tuple[Near, ...]:
        """Return what resembles an object: the same in another state or vessel, or else a similar name."""
        domain = self._domain
        wanted = domain.node(thing)
        names = self._names(wanted)
        same = {other for name in names for other in self._by_name.get(name, ()) if other != thing}
        found = [other for other in same if self._alike(names, other)]
        found.sort(key=lambda other: self._distance(wanted, other))
        found = self._all_names_first(found) or list(self._similar(wanted, names))
        return tuple(Near(domain.node(other), other in domain.stock) for other in found[:_NEAREST])

    def _names(self, node: ObjectNode) -> frozenset[str]:
        if node.contents and node.label in self._domain.kitchen.utensils:
            return frozenset(node.contents)
        return frozenset((node.label,))

    def _alike(self, names: frozenset[str], thing: int) -> bool:
        """Whether an object is for the most part what names say: egg, but not a cake with egg in it."""
        others = self._names(self._domain.node(thing))
        return others <= names or 2 * len(names & others) > len(names | others)

    def _all_names_first(self, ranked: Sequence[int]) -> list[int]:
        """Bring those to the front that have a name none before them has."""
        seen: set[str] = set()
        fresh: list[int] = []
        rest: list[int] = []
        for thing in ranked:
            names = self._names(self._domain.node(thing))
            (rest if names <= seen else fresh).append(thing)
            seen |= names
        return fresh + rest

    def _similar(self, wanted: ObjectNode, names: frozenset[str]) -> Iterator[int]:
        """Yield the nearest object of each similar name: spelt alike, or the same with words more or less."""
        if len(names) > 1:
            return
        [name] = names
        words = set(name.split())
        akin = [
            other
            for other, things in self._by_name.items()
            if set(other.split()) < words or set(other.split()) > words
            if self._domain.is_tool(self._domain.node(things[0])) == self._domain.is_tool(wanted)
        ]
        alike = get_close_matches(name, self._by_name, n=_NEAREST, cutoff=_SIMILAR)
        for other in dict.fromkeys([*alike, *sorted(akin, key=lambda other: (len(other), other))]):
            things = [
                thing for thing in self._by_name[other] if len(self._names(self._domain.node(thing))) == 1
            ]
            if things:
                yield min(things, key=lambda thing: self._distance(wanted, thing))

    def _distance(self, wanted: ObjectNode, thing: int) -> tuple[int, int, bool, int]:
        """How unlike an object is: in names, in label and states; what is at hand is nearer."""
        node = self._domain.node(thing)
        names = len(self._names(wanted) ^ self._names(node))
        rest = len(set(_features(wanted)) ^ set(_features(node)))
        return names, rest, thing not in self._domain.stock, thing


def _features(node: ObjectNode) -> Iterator[tuple[str, ...]]:
    yield ("label", node.label)
    for state in node.states:
        if state.relatum is not None:
            yield (state.name, "relatum", state.relatum)
        for content in state.contents or ():
            yield (state.name, "content", content)
        if state.relatum is None and not state.contents:
            yield (state.name,)


def _with_result(
    problem: Problem, result: Retrieval, step: int | None, instead: bool, time_limit: float | None
) -> Explanation:
    domain = problem.domain
    tree = result.tree
    goal = domain.node(problem.goals[0])
    if result.status == "unreachable":
        return Explanation(
            domain, goal, "constrained", result.reason, give_way=conflict(problem), retrieval=result
        )
    status = "limit" if result.status == "limit" else "reachable"
    if tree is None:
        return Explanation(domain, goal, status, "", retrieval=result)
    if step is not None and step not in tree.units:
        listed = ", ".join(f"{unit.id} {unit.motion}" for unit in tree.steps) or "none at all"
        raise QueryError(f"the unit {step} is not in the task tree of {goal}; its units are {listed}")
    steps = explain_steps(tree)
    if step is not None:
        steps = (steps[tree.units.index(step)],)
    other = without_unit(result, step, time_limit) if instead and step is not None else None
    return Explanation(domain, goal, status, "", retrieval=result, step=step, steps=steps, instead=other)


def explain_steps(tree: TaskTree) -> tuple[Step, ...]:
    """Say of each step of a task tree what it takes from where, and what it makes for which steps."""
    domain = tree.domain
    reading = domain.reading
    maker: dict[int, int] = {}
    users: dict[int, list[int]] = {}
    takes: list[tuple[Taken, ...]] = []
    for place, unit in enumerate(tree.steps, 1):
        takes.append(
            tuple(Taken(domain.node(thing), maker.get(thing), thing in domain.stock) for thing in unit.inputs)
        )
        for thing in reading.needs[unit.id]:
            if thing in maker:
                users.setdefault(thing, []).append(place)
        for thing in reading.makes[unit.id]:
            if thing not in domain.stock:
                maker.setdefault(thing, place)
    makes = []
    for place, unit in enumerate(tree.steps, 1):
        mine = [thing for thing in reading.makes[unit.id] if maker.get(thing) == place]
        makes.append(
            tuple(
                Made(
                    domain.node(thing),
                    tuple(users.get(thing, ())) if thing in mine else (),
                    thing in mine and thing in tree.goals,
                )
                for thing in reading.makes[unit.id]
            )
        )
    ways = _ways(makes)
    return tuple(
        Step(place, unit, takes[place - 1], makes[place - 1], ways[place - 1])
        for place, unit in enumerate(tree.steps, 1)
    )


def _ways(makes: Sequence[tuple[Made, ...]]) -> list[tuple[int, ...]]:
    """Return for each step the shortest way over later steps to a goal."""
    ways: list[tuple[int, ...]] = [()] * len(makes)
    # Users of a thing come later, so going backwards their ways are known.
    for place in range(len(makes), 0, -1):
        made = makes[place - 1]
        if any(each.goal for each in made):
            ways[place - 1] = (place,)
            continue
        onward = [ways[user - 1] for each in made for user in each.steps if ways[user - 1]]
        if onward:
            ways[place - 1] = (place, *min(onward, key=lambda way: (len(way), way)))
    return ways


def without_unit(result: Retrieval, unit: int, time_limit: float | None = None) -> Instead:
    """Retrieve the best tree that does without a unit of a tree, by the same criteria and constraints."""
    tree = result.tree
    assert tree is not None
    avoid = replace(result.constraints, avoid_units=(*result.constraints.avoid_units, unit))
    other = retrieve(
        tree.domain,
        [tree.domain.node(goal) for goal in tree.goals],
        by=result.by,
        constraints=avoid,
        time_limit=time_limit,
    )
    units = other.tree.units if other.tree else ()
    goes = tuple(each for each in tree.units if each not in units) if other.tree else ()
    comes = tuple(each for each in units if each not in tree.units)
    return Instead(unit, other, goes, comes)
