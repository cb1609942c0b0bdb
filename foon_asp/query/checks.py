"""Every refusal of a question, in one place: what can be told from it alone, and what takes the data."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from foon_asp.errors import QueryError
from foon_asp.model.levels import FULL
from foon_asp.model.node import FunctionalUnit
from foon_asp.model.world import World
from foon_asp.numbers import COUNT, LEAST_SUCCESS, MEGABYTES, SECONDS
from foon_asp.query.constraints import FREE, KINDS, Constraints, Form
from foon_asp.query.method import HEURISTICS, Method
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.values import said
from foon_asp.words import closest

if TYPE_CHECKING:
    from foon_asp.query.query import Query


def check_query(query: Query) -> None:
    """Raise `QueryError` for whatever is wrong whatever the data are."""
    _check_method(query.method, query.by, query.founded)
    _check_numbers(query.constraints)
    if query.time_limit is not None:
        SECONDS.checked(query.time_limit, "time_limit")
    if query.memory_limit is not None:
        MEGABYTES.checked(query.memory_limit, "memory_limit")
    if query.substitute is not None and (query.method != Method.OPTIMAL or not query.founded):
        raise QueryError(
            "replacements are chosen by the method 'optimal' alone, for trees that can be executed"
        )
    constraints = query.constraints
    if constraints.human_steps is not None and query.method != Method.OPTIMAL:
        raise QueryError("steps for a human are chosen by the method 'optimal' alone")
    if query.method == Method.IDS and constraints != FREE:
        raise QueryError("'ids' takes no constraints: the first bound decides; use optimal or greedy")


def _check_method(method: Method, by: Objective, founded: bool) -> None:
    if method == Method.OPTIMAL:
        if not founded and "depth" in by.names:
            raise QueryError("'depth' is only defined for trees that can be executed; drop --reference")
    elif method == Method.GREEDY:
        if unknown := [text for text in by.texts if text not in HEURISTICS]:
            raise QueryError(f"'greedy' goes by {' or '.join(HEURISTICS)}, not by {said(unknown[0])}")
        if len(by) > 1:
            raise QueryError("'greedy' takes one criterion; use 'optimal' for several")
    elif by:
        raise QueryError(f"the method {said(method.value)} takes no criteria; leave out --by")
    elif method == Method.IDS and not founded:
        raise QueryError(
            "'ids' is founded by construction; what the published program of that name prints is"
            " --method first --reference"
        )


def _check_numbers(constraints: Constraints) -> None:
    for kind in KINDS:
        value = getattr(constraints, kind.name) if kind.form is Form.COUNT else None
        if value is not None:
            COUNT.checked(value, kind.name)
    if constraints.min_success is not None:
        LEAST_SUCCESS.checked(constraints.min_success, "min_success")


def check_in_world(query: Query, world: World) -> None:
    """Raise `QueryError` for constraints and criteria that make no sense for a FOON and its kitchen."""
    constraints = query.constraints
    if query.substitute is not None:
        query.substitute.check(world)
    _check_seen(world, constraints)
    check_labels(world, (*constraints.without, *constraints.without_tools))
    motions = world.foon.motions if constraints.avoid_motions else ()
    for motion in constraints.avoid_motions:
        if motion not in motions:
            raise QueryError(f"no unit has the motion {said(motion)}{closest(motion, motions)}")
    for unit in (*constraints.use_units, *constraints.avoid_units):
        if not 0 <= unit < len(world.foon.units):
            raise QueryError(f"there is no unit {unit}; ids go from 0 to {len(world.foon.units) - 1}")


def _check_seen(world: World, constraints: Constraints) -> None:
    """Raise `QueryError` for a label that a unit has to do with, but no longer on the level of the world.

    A tree that is found there could be one that the constraint forbids on level 3.
    """
    if world.level == FULL:
        return
    for atom, touched in (("without", World.touched), ("without_tool", _handled)):
        forbidden = [(name, labels) for each, name, labels in constraints.named() if each == atom]
        hidden: set[str] = set()
        for unit, image in zip(world.full.foon.units, world.images, strict=True) if forbidden else ():
            hidden |= touched(world.full, unit) - touched(world, world.foon.units[image])
        for name, labels in forbidden:
            for label in sorted(hidden.intersection(map(str, labels)))[:1]:
                raise QueryError(
                    f"level {world.level} does not show all that has to do with {label!r}, so {name!r} cannot"
                    " hold there; ask on level 3"
                )


def _handled(world: World, unit: FunctionalUnit) -> set[str]:
    """Return the labels that a unit handles, as `touching.lp` has it."""
    return {label for number in (*unit.inputs, *unit.outputs) for label in world.node(number).handled_labels}


def refuse_substitution(query: Query, what: str) -> None:
    """Raise `QueryError` if a question asks for replacements where none are made."""
    if query.substitute is not None:
        raise QueryError(f"{what} without replacements; leave out 'substitute'")


def check_labels(world: World, labels: Iterable[str]) -> None:
    """Raise `QueryError` for a label that nothing in the FOON has, as its own, a relatum or a content."""
    labels = list(labels)
    known = world.foon.named_labels if labels else ()
    for label in labels:
        if label not in known:
            raise QueryError(f"nothing in this FOON is called {said(label)}{closest(label, known)}")


def check_objective(problem: Problem, objective: Objective) -> Objective:
    """Return an objective; raise `QueryError` if the data know nothing of one of its criteria.

    Where there is nothing to do, whatever that costs, every criterion will do.
    """
    if not problem.units:
        return objective
    if objective.names & {"tools", "dirty"} and not problem.world.kitchen.utensils:
        raise QueryError("the data do not say what is a utensil; name a file with --utensils")
    if "cost" in objective.names:
        for unit in problem.units:
            problem.world.kitchen.cost(problem.world.foon.units[unit])
    if "time" in objective.names:
        units = problem.world.foon.units
        if not any(units[unit].duration for unit in problem.units):
            raise QueryError("no unit that can matter for this goal has a time in its video")
    return objective
