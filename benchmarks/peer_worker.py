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

from peer_results import EXACT, GREEDY, LIMIT, MENU, OURS, WAYS, Row
from proof import Proof, Stopwatch

import foon_asp
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain
from foon_asp.retrieve import retrieve

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("FOON_PUBLIC_DATA", ROOT.parent / "shared" / "foon")) / "universal"
SAMPLE = 30


def clingo(domain: Domain, goal: ObjectNode) -> Proof:
    """Retrieve as everybody does. Without a time limit: with one, it first looks for any tree at all."""
    watch = Stopwatch()
    found = retrieve(domain, goal)
    return watch.proof(found.status, found.tree, found.reason)


# What a method needs is imported by it, so that its time and memory count for no other.


def cp_sat(domain: Domain, goal: ObjectNode) -> Proof:
    import cp_sat

    return cp_sat.solve(domain, goal, LIMIT)


def integer_program(domain: Domain, goal: ObjectNode) -> Proof:
    import integer_program

    return integer_program.solve(domain, goal, LIMIT)


def lmcut(domain: Domain, goal: ObjectNode) -> Proof:
    import downward

    return downward.solve(domain, goal, LIMIT)


def operator_counting(domain: Domain, goal: ObjectNode) -> Proof:
    import downward

    return downward.solve(domain, goal, LIMIT, downward.OPERATOR_COUNTING.format(solver=_lp_solver()))


@cache
def _lp_solver() -> str:
    import downward

    return next(solver for solver in downward.LP_SOLVERS if not downward.unsupported(solver))


def by_heuristic(heuristic: str, domain: Domain, goal: ObjectNode) -> Proof:
    import greedy

    return greedy.solve(domain, goal, heuristic)


Method = Callable[[Domain, ObjectNode], Proof]

METHODS: dict[str, Method] = {
    **dict(zip(EXACT, (clingo, cp_sat, lmcut, operator_counting, integer_program), strict=True)),
    **{name: partial(by_heuristic, name.removeprefix("greedy-")) for name in GREEDY},
}


def _load() -> Domain:
    """Load the FOON and work out all that does not depend on the goal."""
    domain = foon_asp.load(DATA).domain()
    assert domain.closure.available
    return domain


def _peak() -> float:
    """Return the peak memory in MiB of the largest of this process and those that it started."""
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    most = max(resource.getrusage(kind).ru_maxrss for kind in kinds)
    return most / (1 << (20 if sys.platform == "darwin" else 10))


def _row(domain: Domain, kind: str, method: str, goal: int, run: int, loaded: float) -> Row:
    """Ask a method for a goal."""
    proof = METHODS[method](domain, domain.node(goal))
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
    domain = _load()
    loaded = _peak()
    warm = False
    for line in sys.stdin:
        goal, run = map(int, line.split())
        if not warm:
            _row(domain, "warm", method, goal, run, loaded)
            warm = True
        print(json.dumps(asdict(_row(domain, "warm", method, goal, run, loaded))), flush=True)


def answer_once(method: str, goal: int) -> None:
    """Answer one goal in this process, and no more."""
    domain = _load()
    print(json.dumps(asdict(_row(domain, "whole", method, goal, 0, _peak()))))


def prove_everything(way: str) -> None:
    """Prove an optimum for all objects that can be made; print the figures, with the units of each."""
    from foon_asp.suggest import suggest

    domain = _load()
    goals = makeable(domain)
    begun = time.perf_counter()
    if way == MENU:
        wanted = foon_asp.load(DATA).goals
        together = [goal for goal in wanted if domain.id_of(goal) in domain.closure.available]
        begun = time.perf_counter()
        menu = retrieve(domain, together)
        goals, found = goals[:1], {goal: len(menu.tree.units) for goal in goals[:1] if menu.tree}
        assert menu.status == "optimal", menu.status
    elif way == "plain":
        retrieved = [(goal, retrieve(domain, domain.node(goal))) for goal in goals]
        found = {
            goal: len(each.tree.units) for goal, each in retrieved if each.tree and each.status == "optimal"
        }
    else:
        dishes = suggest(domain, everything=True).dishes
        found = {domain.id_of(dish.dish): len(dish.tree.units) for dish in dishes}
    seconds = time.perf_counter() - begun
    print(json.dumps({"asked": len(goals), "found": found, "seconds": seconds, "peak": _peak()}))


def makeable(domain: Domain) -> list[int]:
    """Return all that the kitchen can make and does not have."""
    return sorted(thing for thing in domain.closure.available if thing not in domain.stock)


def list_goals(kind: str) -> None:
    """Print what there is to measure with: goals, with their text, methods, notes and the machine."""
    import downward
    from machine import Machine

    if not (DATA / "FOON.txt").exists():
        print(json.dumps({"reason": f"no FOON.txt in {DATA}; set FOON_PUBLIC_DATA"}))
        return
    data = foon_asp.load(DATA)
    domain = data.domain()
    goals = [domain.id_of(goal) for goal in data.goals]
    if kind != "25":
        goals = makeable(domain)[:: SAMPLE if kind == "sample" else 1]
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
    there = {goal: str(domain.node(goal)) for goal in goals}
    can = [goal for goal in goals if goal in domain.closure.available]
    found = {
        "goals": there,
        "makeable": can,
        "methods": methods,
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
