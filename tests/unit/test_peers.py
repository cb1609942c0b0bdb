"""Whatever the peers of the benchmark disagree on comes to light."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from peer_results import Row, Rows, Tally, summarise, summarise_greedy
from proof import Slice

from foon_asp.query.problem import Problem
from support.proofs import CIRCLE
from support.small_foons import node


def test_only_what_can_go_in_a_circle_is_put_in_order() -> None:
    part = Slice.of(Problem.of(CIRCLE, [node("f")]))
    names = {str(CIRCLE.node(thing)) for thing in part.circles}
    assert names == {str(node("a")), str(node("b"))}


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
