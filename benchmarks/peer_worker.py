"""The processes in which the peers answer: one method for many goals, or for one, or everything by clingo.

Started by peers.py. Each prints JSON.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import sys
import time
from collections.abc import Callable
from dataclasses import asdict
from functools import cache, partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from peer_results import EXACT, GREEDY, LIMIT, MENU, OURS, REDUCED, UNREDUCED, WAYS, Row, base
from proof import Proof, Stopwatch, loaded_problem

from foon_asp.io.folder import load
from foon_asp.model.node import ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.query.objective import UNITS
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("FOON_PUBLIC_DATA", ROOT.parent / "shared" / "foon")) / "universal"
SAMPLE = 30


def clingo(world: World, goal: ObjectNode) -> Proof:
    """Retrieve as everybody does. Without a time limit: with one, it first looks for any tree at all."""
    watch = Stopwatch()
    found = retrieve(world, Query(goal))
    return watch.proof(found.status, found.tree, found.reason)


def clingo_unreduced(world: World, goal: ObjectNode) -> Proof:
    """Give clingo the whole slice."""
    from foon_asp.retrieval.methods.proven import solved

    watch = Stopwatch()
    problem = loaded_problem(world, goal)
    if problem is None:
        return watch.proof("unreachable")
    found = solved(problem, UNITS)
    return watch.proof(found.status, found.tree)


# What a method needs is imported by it, so that its time and memory count for no other.


def cp_sat(world: World, goal: ObjectNode, *, reduced: bool = False) -> Proof:
    import cp_sat

    return cp_sat.solve(world, goal, LIMIT, reduced=reduced)


def integer_program(world: World, goal: ObjectNode, *, reduced: bool = False) -> Proof:
    import integer_program

    return integer_program.solve(world, goal, LIMIT, reduced=reduced)


def lmcut(world: World, goal: ObjectNode, *, reduced: bool = False) -> Proof:
    import downward

    return downward.solve(world, goal, LIMIT, reduced=reduced)


def operator_counting(world: World, goal: ObjectNode) -> Proof:
    import downward

    return downward.solve(world, goal, LIMIT, downward.OPERATOR_COUNTING.format(solver=_lp_solver()))


@cache
def _lp_solver() -> str:
    import downward

    return next(solver for solver in downward.LP_SOLVERS if not downward.unsupported(solver))


def by_heuristic(heuristic: str, world: World, goal: ObjectNode) -> Proof:
    import greedy

    return greedy.solve(world, goal, heuristic)


Method = Callable[[World, ObjectNode], Proof]

_PEERS = {"cp-sat": cp_sat, "fd-lmcut": lmcut, "integer-program": integer_program}
"""Peers that can be given what the reductions leave, too."""

METHODS: dict[str, Method] = {
    OURS: clingo,
    OURS + UNREDUCED: clingo_unreduced,
    **_PEERS,
    **{name + REDUCED: partial(peer, reduced=True) for name, peer in _PEERS.items()},
    "fd-operator-counting": operator_counting,
    **{name: partial(by_heuristic, name.removeprefix("greedy-")) for name in GREEDY},
}


def _load() -> World:
    """Load the FOON and work out all that does not depend on the goal."""
    world = load(DATA).world()
    assert world.closure.available
    return world


def _peak() -> float:
    """Return the peak memory in MiB of the largest of this process and those that it started."""
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    most = max(resource.getrusage(kind).ru_maxrss for kind in kinds)
    return most / (1 << (20 if sys.platform == "darwin" else 10))


def _row(world: World, kind: str, method: str, goal: ObjectId, run: int, loaded: float) -> Row:
    """Ask a method for a goal."""
    proof = METHODS[method](world, world.node(goal))
    tree = proof.tree
    return Row(
        kind,
        method,
        goal,
        run,
        proof.seconds,
        proof.status,
        len(tree.units) if tree else None,
        tree.executable if tree else None,
        proof.phases,
        loaded,
        _peak(),
        proof.message if proof.status == "failed" else "",
    )


def serve(method: str) -> None:
    """Answer goals for a method: `goal run` on standard input, a row on standard output."""
    world = _load()
    loaded = _peak()
    warm = False
    for line in sys.stdin:
        number, run = map(int, line.split())
        goal = ObjectId(number)
        if not warm:
            _row(world, "warm", method, goal, run, loaded)
            warm = True
        print(json.dumps(asdict(_row(world, "warm", method, goal, run, loaded))), flush=True)


def answer_once(method: str, goal: ObjectId) -> None:
    """Answer one goal in this process, and no more."""
    world = _load()
    print(json.dumps(asdict(_row(world, "whole", method, goal, 0, _peak()))))


def prove_everything(way: str) -> None:
    """Prove an optimum for all objects that can be made; print the figures, with the units of each."""
    from foon_asp.retrieval.suggest import suggest

    world = _load()
    goals = makeable(world)
    begun = time.perf_counter()
    if way == MENU:
        wanted = load(DATA).goals
        together = [goal for goal in wanted if world.id_of(goal) in world.closure.available]
        begun = time.perf_counter()
        menu = retrieve(world, Query(*together))
        goals, found = goals[:1], {goal: len(menu.tree.units) for goal in goals[:1] if menu.tree}
        assert menu.status == "optimal", menu.status
    elif way == "plain":
        retrieved = [(goal, retrieve(world, Query(world.node(goal)))) for goal in goals]
        found = {
            goal: len(each.tree.units) for goal, each in retrieved if each.tree and each.status == "optimal"
        }
    else:
        dishes = suggest(world, Query(), everything=True).dishes
        found = {world.id_of(dish.dish): len(dish.tree.units) for dish in dishes}
    seconds = time.perf_counter() - begun
    print(json.dumps({"asked": len(goals), "found": found, "seconds": seconds, "peak": _peak()}))


def makeable(world: World) -> list[ObjectId]:
    """Return all that the kitchen can make and does not have."""
    return sorted(thing for thing in world.closure.available if thing not in world.stock)


def list_goals(kind: str) -> None:
    """Print what there is to measure with: goals, with their text, methods, notes and the machine."""
    import downward
    from machine import Machine

    if not (DATA / "FOON.txt").exists():
        print(json.dumps({"reason": f"no FOON.txt in {DATA}; set FOON_PUBLIC_DATA"}))
        return
    data = load(DATA)
    world = data.world()
    goals = [world.id_of(goal) for goal in data.goals]
    if kind != "25":
        goals = makeable(world)[:: SAMPLE if kind == "sample" else 1]
    notes, methods = [], [OURS]
    try:
        notes.append(f"OR-tools {version('ortools')}")
        methods.append("cp-sat")
    except PackageNotFoundError:
        notes.append("no CP-SAT and no integer program: OR-tools is not installed; pip install ortools")
    lacking = ["up-fast-downward is not installed"]
    if downward.installed():
        methods.append("fd-lmcut")
        notes.append(f"Fast Downward of up-fast-downward {version('up-fast-downward')}")
        lacking = [downward.unsupported(solver) for solver in downward.LP_SOLVERS]
    if all(lacking):
        notes += [f"no operator counting by Fast Downward: {reason}" for reason in lacking]
        methods += ["integer-program"] if "cp-sat" in methods else []
    else:
        methods.append("fd-operator-counting")
    there = {goal: str(world.node(goal)) for goal in goals}
    can = [goal for goal in goals if goal in world.closure.available]
    found = {
        "goals": there,
        "makeable": can,
        "methods": [name for name in EXACT if base(name) in map(base, methods)],
        "notes": notes,
        "machine": str(Machine.here()),
    }
    print(json.dumps(found))


def main() -> None:
    options = argparse.ArgumentParser(description="Answer as a peer; started by peers.py.")
    jobs = options.add_mutually_exclusive_group(required=True)
    jobs.add_argument("--list", choices=("25", "sample", "all"))
    jobs.add_argument("--serve", choices=METHODS)
    jobs.add_argument("--once", choices=METHODS)
    jobs.add_argument("--everything", choices=WAYS)
    options.add_argument("--goal", type=int)
    given = options.parse_args()
    if given.list:
        list_goals(given.list)
    elif given.serve:
        serve(given.serve)
    elif given.once:
        answer_once(given.once, given.goal)
    else:
        prove_everything(given.everything)


if __name__ == "__main__":
    main()
