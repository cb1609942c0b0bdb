"""The peers of the benchmark: they are exact, and whatever they disagree on comes to light."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import cp_sat
import downward
import integer_program
import pytest
from peer_results import Peers
from proof import Proof

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.paths import ROOT
from support.proofs import CIRCLE, units
from support.small_foons import node, world

Solve = Callable[[World, ObjectNode], Proof]


@pytest.fixture(params=[cp_sat, integer_program], ids=["cp_sat", "integer_program"])
def peer(request: pytest.FixtureRequest) -> ModuleType:
    found: ModuleType = request.param
    return found


@pytest.fixture(params=[False, True], ids=["slice", "reduced"])
def solve(peer: ModuleType, request: pytest.FixtureRequest) -> Solve:
    return lambda where, goal: peer.solve(where, goal, 60.0, reduced=request.param)


@pytest.fixture
def fast_downward() -> Solve:
    assert downward.installed()
    return lambda where, goal: downward.solve(where, goal, 60.0)


def test_a_circle_does_not_hold_itself_up(solve: Solve) -> None:
    assert units(solve(CIRCLE, node("f"))) == 6
    assert units(solve(CIRCLE, node("milk"))) == 0


def test_fast_downward_finds_what_clingo_finds(fast_downward: Solve) -> None:
    for goal in ("f", "c"):
        ours = retrieve(CIRCLE, Query(node(goal))).tree
        assert ours is not None
        assert units(fast_downward(CIRCLE, node(goal))) == len(ours.units)


def test_fast_downward_finds_the_same_among_what_the_reductions_leave() -> None:
    for goal in ("f", "c"):
        proof = downward.solve(CIRCLE, node(goal), 60.0, reduced=True)
        assert units(proof) == units(downward.solve(CIRCLE, node(goal), 60.0))


def test_no_solver_is_asked_where_the_reductions_leave_nothing_to_choose(peer: ModuleType) -> None:
    where = world(["a -cut-> b", "b -fry-> c", "x -mix-> y"], kitchen="a")
    proof = peer.solve(where, node("c"), 60.0, reduced=True)
    assert (units(proof), "solve" in proof.phases) == (2, False)
    assert "solve" in peer.solve(where, node("c"), 60.0).phases
    assert peer.solve(where, node("y"), 60.0, reduced=True).status == "unreachable"


def test_fast_downward_proves_that_there_is_no_plan(fast_downward: Solve) -> None:
    where = world(["a -melt-> b", "b -freeze-> a"])
    assert fast_downward(where, node("b")).status == "unreachable"


def test_fast_downward_stops_in_time(fast_downward: Solve) -> None:
    assert units(fast_downward(CIRCLE, node("f"))) == 6
    assert downward.solve(CIRCLE, node("f"), 0.001).status == "limit"


def test_operator_counting_is_exact_or_says_what_it_lacks(fast_downward: Solve) -> None:
    assert units(fast_downward(CIRCLE, node("c"))) == 3
    for solver in downward.LP_SOLVERS:
        search = downward.OPERATOR_COUNTING.format(solver=solver)
        proof = downward.solve(CIRCLE, node("f"), 60.0, search)
        if lacking := downward.unsupported(solver):
            assert "without support" in lacking
            assert proof.status == "failed"
        else:
            assert units(proof) == 6


# What is made of the measurements


def test_the_benchmark_runs(tmp_path: Path) -> None:
    """On two goals of the built-in data, in the place of the public ones."""
    shutil.copytree(ROOT / "data", tmp_path / "universal")
    goals = json.loads((ROOT / "data" / "goal_nodes.json").read_text(encoding="utf-8"))
    (tmp_path / "universal" / "goal_nodes.json").write_text(json.dumps(goals[:2]), encoding="utf-8")
    command = [
        sys.executable,
        str(ROOT / "benchmarks" / "peers.py"),
        "--output",
        str(tmp_path / "peers.json"),
    ]
    command += ["--runs", "1", "--whole-runs", "1", "--everything-runs", "0"]
    command += ["--methods", "clingo", "clingo-unreduced", "cp-sat-reduced", "greedy-first"]
    environment = {**os.environ, "FOON_PUBLIC_DATA": str(tmp_path)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    result = Peers.read(tmp_path / "peers.json")
    ours, *others = result.methods
    assert [each.method for each in others] == ["clingo-unreduced", "cp-sat-reduced"]
    assert {(each.asked, each.proven, each.agreeing) for each in others} == {(2, 2, 2)}
    assert (ours.method, ours.asked, ours.proven, ours.agreeing, ours.ratio) == ("clingo", 2, 2, 2, 1.0)
    assert [each.optimum for each in result.rows] == [each.units["clingo"] for each in result.rows]
    assert all(each.optimum and each.whole["clingo"] > each.seconds["clingo"] for each in result.rows)
    assert "| clingo | 2 of 2 |" in done.stdout
    lines = (tmp_path / "peers.jsonl").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 2 * 4 + 2 * 3
