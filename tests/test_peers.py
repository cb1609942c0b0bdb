"""The peers of the benchmark: they are exact, and whatever they disagree on comes to light."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import brute_force
import pytest
from conftest import ROOT
from hypothesis import given
from small_foons import domain, many, node, queries

from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain
from foon_asp.retrieve import retrieve

sys.path.append(str(ROOT / "benchmarks"))

import downward
from peer_results import Peers, Row, Rows, Tally, summarise, summarise_greedy
from proof import Proof, Slice

Query = tuple[Domain, ObjectNode]
Solve = Callable[[Domain, ObjectNode], Proof]

CIRCLE = domain(
    [
        "b -melt-> a",
        "a + salt -freeze-> b",
        "c -press-> b",
        "milk -heat-> d",
        "d -stir-> e",
        "e -cool-> c",
        "a + b -mix-> f",
    ],
    "milk + salt",
)
"""A and B make each other; it takes four units more to make either from the kitchen."""


@pytest.fixture(params=["cp_sat", "integer_program"])
def solve(request: pytest.FixtureRequest) -> Solve:
    pytest.importorskip("ortools", reason="OR-tools is not installed")
    peer = pytest.importorskip(request.param)
    return lambda where, goal: peer.solve(where, goal, 60.0)


@pytest.fixture
def fast_downward() -> Solve:
    if not downward.installed():
        pytest.skip("Fast Downward is not installed; pip install up-fast-downward")
    return lambda where, goal: downward.solve(where, goal, 60.0)


def units(proof: Proof) -> int:
    assert proof.status == "optimal"
    assert proof.tree is not None
    assert proof.tree.executable
    assert sum(proof.phases.values()) <= proof.seconds
    return len(proof.tree.units)


def test_peers_are_exact() -> None:
    pytest.importorskip("ortools", reason="OR-tools is not installed")
    peers = [pytest.importorskip(name) for name in ("cp_sat", "integer_program")]

    @many(60)
    @given(queries())
    def check(query: Query) -> None:
        where, goal = query
        trees = brute_force.trees(where, goal)
        for peer in peers:
            proof = peer.solve(where, goal, 60.0)
            if not trees:
                assert proof.status == "unreachable"
                continue
            assert units(proof) == brute_force.best(trees, ["units"])["units"]
            assert brute_force.replays(where, goal, proof.tree.units)

    check()


def test_a_circle_does_not_hold_itself_up(solve: Solve) -> None:
    assert units(solve(CIRCLE, node("f"))) == 6
    assert units(solve(CIRCLE, node("milk"))) == 0


def test_only_what_can_go_in_a_circle_is_put_in_order() -> None:
    part = Slice.of(CIRCLE.problem([node("f")]))
    names = {str(CIRCLE.node(thing)) for thing in part.circles}
    assert names == {str(node("a")), str(node("b"))}


def test_fast_downward_finds_what_clingo_finds(fast_downward: Solve) -> None:
    for goal in ("f", "c"):
        ours = retrieve(CIRCLE, node(goal)).tree
        assert ours is not None
        assert units(fast_downward(CIRCLE, node(goal))) == len(ours.units)


def test_fast_downward_proves_that_there_is_no_plan(fast_downward: Solve) -> None:
    where = domain(["a -melt-> b", "b -freeze-> a"])
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


def row(method: str, status: str = "optimal", units: int | None = 3, **more: Any) -> Row:
    return replace(Row("warm", method, 7, 0, 1.0, status, units), **more)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ([row("clingo"), row("cp-sat")], []),
        ([row("clingo"), row("cp-sat", "limit", 4)], []),
        ([row("clingo"), row("greedy-first", "found", 2, executable=False)], []),
        ([row("clingo"), row("cp-sat", units=4)], ["clingo says optimal with 3 units, cp-sat"]),
        ([row("clingo"), row("fd-lmcut", "unreachable", None)], ["fd-lmcut says unreachable"]),
        ([row("clingo"), row("clingo", units=4, run=1)], ["with 4 units, but before that clingo says"]),
        ([row("cp-sat", executable=False)], ["the tree of cp-sat fails its replay"]),
        ([row("fd-lmcut", "failed", None, message="no")], ["fd-lmcut failed: no"]),
    ],
)
def test_disagreements_come_to_light(rows: list[Row], said: list[str]) -> None:
    found = Tally.of(rows, {7: "soup"}).disagreements
    assert len(found) == len(said)
    for quarrel, words in zip(found, said, strict=True):
        assert quarrel.startswith("soup: ")
        assert words in quarrel


def test_times_are_medians_and_ratios_geometric_means() -> None:
    there = {1: "soup", 2: "salad", 3: "none"}
    rows = [
        row(method, goal=goal, run=run, seconds=base * factor * goal, peak=50.0)
        for method, base in (("clingo", 1.0), ("cp-sat", 4.0))
        for goal in (1, 2)
        for run, factor in enumerate((1, 2, 30))
    ]
    rows += [row(method, "unreachable", None, goal=3, seconds=99.0) for method in ("clingo", "cp-sat")]
    rows += [row("greedy-first", "found", 6, goal=1, executable=True)]
    rows += [row("greedy-first", "found", 2, goal=2, executable=False)]
    tally = Tally.of(rows, there)
    summary = summarise("cp-sat", rows, tally, list(there))
    assert (summary.asked, summary.proven, summary.trees, summary.agreeing) == (3, 3, 2, 3)
    assert (summary.median, summary.maximum, summary.peak) == (12.0, 16.0, 50.0)
    assert summary.geometric_mean == pytest.approx((8.0 * 16.0) ** 0.5)
    assert summary.ratio == pytest.approx(4.0)
    heuristic = summarise_greedy("greedy-first", rows, tally, list(there))
    assert (heuristic.asked, heuristic.executable, heuristic.smaller, heuristic.optimal) == (2, 1, 1, 0)
    assert heuristic.mean_excess == heuristic.largest_excess == 1.0


def test_a_second_run_knows_the_rows_of_the_first(tmp_path: Path) -> None:
    rows = Rows(tmp_path / "rows.jsonl", fresh=False)
    rows.add(row("clingo", phases={"solve": 0.5}))
    rows.close()
    again = Rows(tmp_path / "rows.jsonl", fresh=False)
    assert list(again) == list(rows)
    assert not again.missing("warm", "clingo", 7, 0)
    assert again.missing("warm", "clingo", 7, 1)
    again.close()
    Rows(tmp_path / "rows.jsonl", fresh=True).close()
    assert not (tmp_path / "rows.jsonl").read_text()


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
    command += ["--methods", "clingo", "greedy-first"]
    environment = {**os.environ, "FOON_PUBLIC_DATA": str(tmp_path)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    result = Peers.read(tmp_path / "peers.json")
    (ours,) = result.methods
    assert (ours.method, ours.asked, ours.proven, ours.agreeing, ours.ratio) == ("clingo", 2, 2, 2, 1.0)
    assert [each.optimum for each in result.rows] == [each.units["clingo"] for each in result.rows]
    assert all(each.optimum and each.whole["clingo"] > each.seconds["clingo"] for each in result.rows)
    assert "| clingo | 2 of 2 |" in done.stdout
    lines = (tmp_path / "peers.jsonl").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 2 * 2 + 2
