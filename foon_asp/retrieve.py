"""Retrieval: from a goal to a checked task tree, by any of the methods."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from foon_asp.constraints import FREE, Constraints
from foon_asp.decode import column, decode_tree, rows
from foon_asp.errors import InternalError, QueryError, closest
from foon_asp.facts import facts, success_chance
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.reasons import unreachable_reason
from foon_asp.solve import ProgramError, Solver
from foon_asp.tree import TaskTree

METHODS = ("optimal", "greedy", "ids", "first")
CRITERIA = ("units", "success", "inputs", "depth")
HEURISTICS = ("success", "inputs")

OPTIMISE = ("--opt-strategy=usc",)


@dataclass(frozen=True, slots=True)
class Retrieval:
    """The answer to one goal.

    `status` is `optimal` (proven), `found` (by a method that does not optimise), `unreachable` (no tree
    exists; `reason` says why) or `limit` (the time ran out; the tree is the best so far, if there is
    one). `bound` then holds what `optimal` has proven of each criterion: no tree does better by the first,
    no tree that is best by the first does better by the second, and so on. `seconds` is wall time.
    """

    goal: ObjectNode
    method: str
    by: tuple[str, ...]
    founded: bool
    status: str
    tree: TaskTree | None
    bound: dict[str, float]
    reason: str
    seconds: float


def retrieve(
    domain: Domain,
    goal: ObjectNode,
    method: str = "optimal",
    by: str | Sequence[str] = (),
    *,
    founded: bool = True,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Retrieval:
    """Retrieve a task tree for a goal; every tree is replayed from the kitchen before it is returned.

    `by` names the criteria of `optimal`, the most important first (`units` by default), or the
    heuristic of `greedy` (`success` by default); a text may hold several, with commas.
    `founded=False` reads units as the published programs do: the tree may go in circles.
    `time_limit` is in seconds. `constraints` hold for every method but `ids`. Raises `QueryError`.
    """
    started = time.perf_counter()
    by = check_method(method, by, founded)
    check_constraints(domain, method, constraints)
    problem = domain.problem([goal], founded=founded, constraints=constraints)
    deadline = None if time_limit is None else time.monotonic() + time_limit
    reason = unreachable_reason(problem)
    status = "unreachable"
    tree: TaskTree | None = None
    bound: dict[str, float] = {}
    if not reason:
        if method == "optimal":
            status, tree, bound = _optimal(problem, by, deadline)
        elif method == "ids":
            status, tree, bound = _ids(problem, deadline)
        else:
            heuristic = by[0] if method == "greedy" else "first"
            status, tree, bound = _greedy(problem, heuristic, deadline)
        if status == "unreachable":
            reason = conflict_reason(problem)
    seconds = time.perf_counter() - started
    return Retrieval(goal, method, by, founded, status, tree, bound, reason, seconds)


def reach(domain: Domain) -> tuple[list[int], list[int]]:
    """Return the ids of all available objects and all executable units, as clingo derives them.

    Raises `InternalError` if the plain graph search does not agree.
    """
    problem = Problem(domain, (), whole=True)
    answer = _solver(problem, ["reachability.lp"], {}).best()
    available, executable = column(answer, "available"), column(answer, "executable")
    if domain.closure.available.keys() != set(available):
        raise InternalError("reachability.lp and the graph search disagree on what is available")
    if domain.closure.executable.keys() != set(executable):
        raise InternalError("reachability.lp and the graph search disagree on what is executable")
    return available, executable


def check_method(method: str, by: str | Sequence[str], founded: bool) -> tuple[str, ...]:
    """Return the criteria of a method, its default if none are named; raise `QueryError`."""
    if isinstance(by, str):
        by = [name.strip() for name in by.split(",")] if by.strip() else ()
    choices = {"optimal": CRITERIA, "greedy": HEURISTICS, "ids": (), "first": ()}
    if method not in choices:
        raise QueryError(f"unknown method {method!r}; methods: {', '.join(METHODS)}")
    known = choices[method]
    if not known:
        if by:
            raise QueryError(f"the method {method!r} takes no criteria; leave out --by")
        if method == "ids" and not founded:
            raise QueryError(
                "'ids' is founded by construction; what the published program of that name prints is"
                " --method first --reference"
            )
        return ()
    if unknown := [name for name in by if name not in known]:
        raise QueryError(f"{method!r} knows no criterion {unknown[0]!r}; one of {', '.join(known)}")
    if len(set(by)) != len(by):
        raise QueryError(f"a criterion is named twice in {','.join(by)!r}")
    if method == "greedy" and len(by) > 1:
        raise QueryError("'greedy' takes one criterion; use 'optimal' for several")
    if "depth" in by and not founded:
        raise QueryError("'depth' is only defined for trees that can be executed; drop --reference")
    return tuple(by) or (known[0] if method == "optimal" else "success",)


def check_constraints(domain: Domain, method: str, constraints: Constraints) -> None:
    """Raise `QueryError` for constraints that make no sense here."""
    if constraints == FREE:
        return
    if method == "ids":
        raise QueryError("'ids' takes no constraints: the first bound decides; use optimal or greedy")
    labels = {label for node in domain.foon.objects for label in node.named_labels}
    for label in (*constraints.without, *constraints.without_tools):
        if label not in labels:
            raise QueryError(f"nothing in this FOON is called {label!r}{closest(label, labels)}")
    motions = domain.foon.motions
    for motion in constraints.avoid_motions:
        if motion not in motions:
            raise QueryError(f"no unit has the motion {motion!r}{closest(motion, motions)}")
    for unit in constraints.use_units:
        if not 0 <= unit < len(domain.foon.units):
            raise QueryError(f"there is no unit {unit}; ids go from 0 to {len(domain.foon.units) - 1}")
    if constraints.min_success is not None and not 0 < constraints.min_success <= 1:
        raise QueryError(f"a chance of success is above 0 and at most 1, not {constraints.min_success:g}")


def conflict_reason(problem: Problem) -> str:
    """Say which constraints must give way for a task tree to exist: the fewest that will do."""
    constants: dict[str, str | int] = {"founded": int(problem.founded), "horizon": len(problem.units) + 1}
    solver = _solver(problem, ["task_tree.lp", "conflict.lp"], constants)
    names = [str(name) for (name,) in rows(solver.best(), "waived")]
    if not names:
        return "the rules leave no task tree"
    return "the constraints leave no task tree; one exists without: " + "; ".join(sorted(names))


def _solver(
    problem: Problem,
    encodings: Sequence[str],
    constants: dict[str, str | int],
    *,
    extra_facts: str = "",
    rates_required: bool = False,
) -> Solver:
    constants = {**constants, "strict": int(problem.domain.strict)}
    constraints = problem.constraints
    if constraints != FREE:
        encodings = [*encodings, "constraints.lp"]
        rates_required |= constraints.min_success is not None
    if constraints.max_depth is not None and "criteria/depth.lp" not in encodings:
        # Last of all criteria it changes no choice that another one makes.
        encodings = [*encodings, "criteria/depth.lp"]
        extra_facts += 'criterion("depth",-1).\n'
    if constraints.max_depth is not None:
        constants["horizon"] = max(int(constants.get("horizon", 1)), constraints.max_depth)
    text = facts(problem, rates_required=rates_required) + extra_facts
    try:
        return Solver(encodings, "\n".join([text, *constraints.rules]), constants, OPTIMISE)
    except ProgramError as error:
        if not constraints.rules:
            raise
        problems = "; ".join(line.split(": ", 1)[-1] for line in str(error).splitlines() if ": " in line)
        raise QueryError(f"the rules do not work: {problems}") from None


_BASE = 1
"""Every tree pays this by every criterion, so that clingo's bounds have a place for each of them."""

Found = tuple[str, TaskTree | None, dict[str, float]]
"""Status, tree and bound, as in `Retrieval`."""


def _optimal(problem: Problem, by: tuple[str, ...], deadline: float | None) -> Found:
    criteria = by if "units" in by else (*by, "units")
    constants: dict[str, str | int] = {"founded": int(problem.founded)}
    if "depth" in by:
        horizon, unfinished = _horizon(problem, by, deadline)
        if unfinished:
            return unfinished
        constants["horizon"] = horizon
    solver = _solver(
        problem,
        ["task_tree.lp", *(f"criteria/{name}.lp" for name in criteria)],
        constants,
        extra_facts="".join(
            f'criterion("{name}",{len(criteria) - place}). penalty("{name}","base",{_BASE}).\n'
            for place, name in enumerate(criteria)
        ),
        rates_required="success" in by,
    )
    first = solver.first() if deadline is not None else None
    if first is not None and first.atoms is None:
        return "unreachable", None, {}
    answer = solver.best(deadline)
    if answer.proven:
        if answer.atoms is None:
            return "unreachable", None, {}
        return "optimal", decode_tree(problem, answer), {}
    candidates = [each for each in (answer, first) if each is not None and each.atoms is not None]
    trees = [decode_tree(problem, each) for each in candidates]
    # Criteria of the user's own have priorities that are not known here.
    known = len(answer.bounds) == len(criteria)
    lower = dict(zip(criteria, answer.bounds if known else [_BASE] * len(criteria), strict=True))
    bound = {name: _as_cost(name, max(0, lower[name] - _BASE)) for name in by}
    return "limit", min(trees, key=lambda tree: _key(tree, criteria)), bound


def _as_cost(criterion: str, value: int) -> float:
    return success_chance(value) if criterion == "success" else value


def _key(tree: TaskTree, criteria: Sequence[str]) -> list[float]:
    """Return the costs of a tree by each criterion; the less the better."""
    costs = tree.costs
    values = {
        "units": costs.units,
        "inputs": costs.inputs,
        "success": -(costs.success or 0.0),
        "depth": costs.depth or 0,
    }
    return [values[name] for name in criteria]


def _horizon(problem: Problem, by: tuple[str, ...], deadline: float | None) -> tuple[int, Found | None]:
    """Return a depth that some best tree does not exceed, or what was found if time ran out before.

    If depth comes first it is the round in which the closure reaches the goals, unless constraints make
    that impossible. Else any tree that is best by the criteria before it will do: a best tree is no deeper.
    Rules may bring criteria of any priority, so with them only the number of units is safe.
    """
    if problem.constraints.rules:
        return max(1, len(problem.units)), None
    before = by[: by.index("depth")]
    if not before and problem.constraints != FREE:
        before = ("units",)
    if not before:
        closure = problem.domain.closure
        return max(1, *(closure.available[goal] for goal in problem.goals)), None
    status, tree, bound = _optimal(problem, before, deadline)
    if status != "optimal":
        bound = {name: value for name, value in bound.items() if name in by}
        return 1, (status, tree, bound | {name: 0 for name in by if name not in before})
    return max(1, tree.depth or 1) if tree else 1, None


def _greedy(problem: Problem, heuristic: str, deadline: float | None) -> Found:
    # The levels of a selection are about as many as the rounds of the closure.
    rounds = problem.domain.closure.available
    horizon = 4 + max(rounds.get(goal, 8) for goal in problem.goals)
    while True:
        solver = _solver(
            problem,
            ["greedy.lp"],
            {"founded": int(problem.founded), "by": heuristic, "horizon": horizon},
            rates_required=heuristic == "success",
        )
        first = solver.first() if deadline is not None else None
        if first is not None and first.atoms is None:
            return "unreachable", None, {}
        answer = solver.best(deadline)
        if not answer.proven:
            best = answer if answer.atoms is not None or first is None else first
            return "limit", decode_tree(problem, best) if best.atoms is not None else None, {}
        if answer.atoms is None:
            return "unreachable", None, {}
        if not column(answer, "beyond"):
            return "found", decode_tree(problem, answer), {}
        horizon *= 2


def _ids(problem: Problem, deadline: float | None) -> Found:
    solver = _solver(problem, ["ids.lp"], {})
    for bound in range(len(problem.units) + 1):
        if deadline is not None and time.monotonic() > deadline:
            return "limit", None, {}
        if bound > 0:
            solver.ground("step", bound)
        solver.ground("check", bound)
        solver.switch("bound", bound, True)
        if solver.best().atoms is not None:
            solver.ground("choose", bound)
            return "found", decode_tree(problem, solver.best()), {}
        solver.switch("bound", bound, False)
    raise InternalError("depth-bounded search passed every depth without reaching a reachable goal")
