"""Retrieval: from a goal to a checked task tree, by any of the methods."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from foon_asp.constraints import FREE, Constraints
from foon_asp.criteria import Level, parse_by
from foon_asp.decode import column, decode_tree, rows
from foon_asp.errors import InternalError, QueryError, closest
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.program import all_levels, optimisers, solver, too_deep
from foon_asp.reasons import unreachable_reason
from foon_asp.solve import Answer
from foon_asp.tree import TaskTree

METHODS = ("optimal", "greedy", "ids", "first")
HEURISTICS = ("success", "inputs")


@dataclass(frozen=True, slots=True)
class Retrieval:
    """The answer to one goal, or to several at once.

    `status` is `optimal` (proven), `found` (by a method that does not optimise), `unreachable` (no tree
    exists; `reason` says why) or `limit` (the time ran out; the tree is the best so far, if there is
    one). `bound` then holds what `optimal` has proven on each level of `by`: no tree does better on the
    first, no tree that is best on the first does better on the second, and so on. `own` is what the tree
    pays by criteria of the user's own rules, at each priority that is not one of ours. `seconds` is wall
    time.
    """

    goals: tuple[ObjectNode, ...]
    method: str
    by: tuple[str, ...]
    founded: bool
    constraints: Constraints
    status: str
    tree: TaskTree | None
    bound: dict[str, float]
    own: dict[int, int]
    reason: str
    seconds: float

    @property
    def goal(self) -> ObjectNode:
        """The goal, or the first of several."""
        return self.goals[0]


def retrieve(
    domain: Domain,
    goal: ObjectNode | Iterable[ObjectNode],
    method: str = "optimal",
    by: str | Sequence[str] = (),
    *,
    founded: bool = True,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Retrieval:
    """Retrieve a task tree for a goal; every tree is replayed from the kitchen before it is returned.

    Several goals are made by one tree, and share its steps.
    `by` names the criteria of `optimal`, the most important first (`units` by default, `success` with a
    human), or the heuristic of `greedy` (`success` by default); a text may hold several, with commas, and
    weighted sums like `2*units+inputs`.
    `founded=False` reads units as the published programs do: the tree may go in circles.
    `time_limit` is in seconds. `constraints` hold for every method but `ids`. Raises `QueryError`.
    """
    started = time.perf_counter()
    goals = (goal,) if isinstance(goal, ObjectNode) else tuple(goal)
    by = check_method(method, by, founded, constraints)
    check_constraints(domain, method, constraints)
    problem = domain.problem(goals, founded=founded, constraints=constraints)
    deadline = None if time_limit is None else time.monotonic() + time_limit
    reason = unreachable_reason(problem)
    found = _NOTHING
    if not reason:
        if method == "optimal":
            found = _optimal(problem, check_levels(problem, by), deadline)
        elif method == "ids":
            found = _ids(problem, deadline)
        else:
            found = _greedy(problem, by[0] if method == "greedy" else "first", deadline)
        if found.status == "unreachable":
            reason = conflict_reason(problem)
    seconds = time.perf_counter() - started
    return Retrieval(goals, method, by, founded, constraints, *found, reason, seconds)


def reach(domain: Domain) -> tuple[list[int], list[int]]:
    """Return the ids of all available objects and all executable units, as clingo derives them.

    Raises `InternalError` if the plain graph search does not agree.
    """
    problem = Problem(domain, (), whole=True)
    answer = solver(problem, ["reachability.lp"], {}).best()
    available, executable = column(answer, "available"), column(answer, "executable")
    if domain.closure.available.keys() != set(available):
        raise InternalError("reachability.lp and the graph search disagree on what is available")
    if domain.closure.executable.keys() != set(executable):
        raise InternalError("reachability.lp and the graph search disagree on what is executable")
    return available, executable


def check_method(
    method: str, by: str | Sequence[str], founded: bool, constraints: Constraints = FREE
) -> tuple[str, ...]:
    """Return what a method goes by, its default if nothing is named; raise `QueryError`."""
    if method not in METHODS:
        raise QueryError(f"unknown method {method!r}; methods: {', '.join(METHODS)}")
    levels = parse_by(by)
    texts = tuple(map(str, levels))
    if method == "optimal":
        if not founded and any("depth" in level.names for level in levels):
            raise QueryError("'depth' is only defined for trees that can be executed; drop --reference")
        return texts or ("units" if constraints.human_steps is None else "success",)
    if method == "greedy":
        if unknown := [text for text in texts if text not in HEURISTICS]:
            raise QueryError(f"'greedy' goes by {' or '.join(HEURISTICS)}, not by {unknown[0]!r}")
        if len(texts) > 1:
            raise QueryError("'greedy' takes one criterion; use 'optimal' for several")
        return texts or ("success",)
    if texts:
        raise QueryError(f"the method {method!r} takes no criteria; leave out --by")
    if method == "ids" and not founded:
        raise QueryError(
            "'ids' is founded by construction; what the published program of that name prints is"
            " --method first --reference"
        )
    return ()


def check_levels(problem: Problem, by: str | Sequence[str]) -> tuple[Level, ...]:
    """Return the levels of a question; raise `QueryError` for criteria that the data know nothing of."""
    levels = parse_by(by)
    names = {name for level in levels for name in level.names}
    if names & {"tools", "dirty"} and not problem.domain.kitchen.utensils:
        raise QueryError("the data do not say what is a utensil; name a file with --utensils")
    if "time" in names:
        units = problem.domain.foon.units
        if not any(units[unit].duration for unit in problem.units):
            raise QueryError("no unit that can matter for this goal has a time in its video")
    return levels


def check_constraints(domain: Domain, method: str, constraints: Constraints) -> None:
    """Raise `QueryError` for constraints that make no sense here."""
    if constraints == FREE:
        return
    if constraints.human_steps is not None and method != "optimal":
        raise QueryError("steps for a human are chosen by the method 'optimal' alone")
    if method == "ids":
        raise QueryError("'ids' takes no constraints: the first bound decides; use optimal or greedy")
    check_labels(domain, (*constraints.without, *constraints.without_tools))
    motions = domain.foon.motions
    for motion in constraints.avoid_motions:
        if motion not in motions:
            raise QueryError(f"no unit has the motion {motion!r}{closest(motion, motions)}")
    for unit in (*constraints.use_units, *constraints.avoid_units):
        if not 0 <= unit < len(domain.foon.units):
            raise QueryError(f"there is no unit {unit}; ids go from 0 to {len(domain.foon.units) - 1}")
    if constraints.min_success is not None and not 0 < constraints.min_success <= 1:
        raise QueryError(f"a chance of success is above 0 and at most 1, not {constraints.min_success:g}")


def check_labels(domain: Domain, labels: Iterable[str]) -> None:
    """Raise `QueryError` for a label that nothing in the FOON has, as its own, a relatum or a content."""
    known = domain.foon.named_labels
    for label in labels:
        if label not in known:
            raise QueryError(f"nothing in this FOON is called {label!r}{closest(label, known)}")


def conflict_reason(problem: Problem) -> str:
    """Say which constraints must give way for a task tree to exist."""
    names = conflict(problem)
    if not names:
        return "the rules leave no task tree"
    return "the constraints leave no task tree; one exists without: " + "; ".join(names)


def conflict(problem: Problem) -> tuple[str, ...]:
    """Return the names of the constraints that must give way, the fewest that will do, sorted."""
    encodings = ["task_tree.lp", "conflict.lp"]
    founded: dict[str, str | int] = {"founded": int(problem.founded)}
    human = ""
    if problem.constraints.human_steps is not None:
        # To know whether more human steps would help, it must be open how many there are.
        encodings.append("criteria/human.lp")
        human = 'criterion("human",-2).\n'
    control = solver(problem, encodings, founded, extra_facts=human)
    return tuple(sorted(str(name) for (name,) in rows(control.best(), "waived")))


class Found(NamedTuple):
    """Status, tree, bound and payments, as in `Retrieval`."""

    status: str
    tree: TaskTree | None
    bound: dict[str, float]
    own: dict[int, int]


_NOTHING = Found("unreachable", None, {}, {})


def _optimal(problem: Problem, levels: Sequence[Level], deadline: float | None) -> Found:
    every = all_levels(levels)
    for control in optimisers(problem, every):
        first = control.first() if deadline is not None else None
        if first is not None and first.atoms is None:
            return _NOTHING
        answer = control.best(deadline)
        if not answer.proven:
            break
        if answer.atoms is None:
            return _NOTHING
        if not too_deep(answer):
            return Found("optimal", decode_tree(problem, answer), {}, _own(answer, every))
    candidates = [each for each in (answer, first) if each is not None and each.atoms is not None]
    trees = [decode_tree(problem, each) for each in candidates]
    # Rules of the user's own may pay by any criterion, and at any priority.
    known = len(answer.bounds) == len(every) and not problem.constraints.rules
    lower = answer.bounds if known else [0] * len(every)
    bound = {str(level): level.bound(paid) for level, paid in zip(every, lower, strict=True)}
    best = min(trees, key=lambda tree: [level.cost(tree.costs) for level in every])
    return Found("limit", best, {str(level): bound[str(level)] for level in levels}, {})


def _own(answer: Answer, levels: Sequence[Level]) -> dict[int, int]:
    """Return what a model pays at priorities that are not those of the levels."""
    paid = zip(answer.priorities, answer.costs, strict=True)
    return {priority: cost for priority, cost in paid if not 1 <= priority <= len(levels)}


def _greedy(problem: Problem, heuristic: str, deadline: float | None) -> Found:
    # The levels of a selection are about as many as the rounds of the closure.
    rounds = problem.domain.closure.available
    horizon = 4 + max(rounds.get(goal, 8) for goal in problem.goals)
    while True:
        control = solver(
            problem,
            ["greedy.lp"],
            {"founded": int(problem.founded), "by": heuristic, "horizon": horizon},
            rates_required=heuristic == "success",
        )
        first = control.first() if deadline is not None else None
        if first is not None and first.atoms is None:
            return _NOTHING
        answer = control.best(deadline)
        if not answer.proven:
            best = answer if answer.atoms is not None or first is None else first
            return Found("limit", decode_tree(problem, best) if best.atoms is not None else None, {}, {})
        if answer.atoms is None:
            return _NOTHING
        if not column(answer, "beyond"):
            return Found("found", decode_tree(problem, answer), {}, {})
        horizon *= 2


def _ids(problem: Problem, deadline: float | None) -> Found:
    control = solver(problem, ["ids.lp"], {})
    for bound in range(len(problem.units) + 1):
        if deadline is not None and time.monotonic() > deadline:
            return Found("limit", None, {}, {})
        if bound > 0:
            control.ground("step", bound)
        control.ground("check", bound)
        control.switch("bound", bound, True)
        if control.best().atoms is not None:
            control.ground("choose", bound)
            return Found("found", decode_tree(problem, control.best()), {}, {})
        control.switch("bound", bound, False)
    raise InternalError("depth-bounded search passed every depth without reaching a reachable goal")
