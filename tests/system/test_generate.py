"""The generator of FOONs for benchmarks, and the report that is made of what they measure."""

from __future__ import annotations

import hashlib
import math
import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from growth import Asked, Growth, Queries
from report import limits_of_dense, seconds
from retrieval import imports_of

from foon_asp.io.folder import Dataset, load
from foon_asp.io.text import write_text
from foon_asp.model.node import UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from support.paths import ROOT

BENCHMARKS = ROOT / "benchmarks"
UNITS = {"random": 2_000, "dense": 2_000, "chain": 1_000}
FILES = ("FOON.txt", "kitchen.json", "utensils.txt", "motion.txt", "goal_nodes.json")


def _run(script: str, *arguments: str, seed: str = "0") -> None:
    command = [sys.executable, str(BENCHMARKS / script), *arguments]
    subprocess.run(command, check=True, capture_output=True, env=os.environ | {"PYTHONHASHSEED": seed})


def _generate(folder: Path, family: str, *more: str, seed: str = "0") -> Path:
    _run("generate.py", "--units", str(UNITS[family]), "--family", family, str(folder), *more, seed=seed)
    return folder


@dataclass(frozen=True, slots=True)
class Generated:
    """A FOON that was generated into a folder, and read from it."""

    family: str
    folder: Path
    data: Dataset
    world: World


@pytest.fixture(scope="module")
def all_generated(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Generated]:
    found = {}
    for family in UNITS:
        folder = _generate(tmp_path_factory.mktemp(family), family)
        data = load(folder)
        found[family] = Generated(family, folder, data, data.world())
    return found


@pytest.fixture(params=list(UNITS))
def generated(request: pytest.FixtureRequest, all_generated: dict[str, Generated]) -> Generated:
    family: str = request.param
    return all_generated[family]


def _digests(folder: Path) -> list[str]:
    return [hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in FILES]


def _units_makers(world: World) -> dict[int, int]:
    """Return how many units make each object that the kitchen does not have."""
    counts: dict[int, int] = {}
    for made in world.units.makes:
        for thing in made:
            if thing not in world.stock:
                counts[thing] = counts.get(thing, 0) + 1
    return counts


def test_the_same_seed_gives_the_same_bytes(generated: Generated, tmp_path: Path) -> None:
    again = _generate(tmp_path / "again", generated.family, seed="4711")
    assert _digests(again) == _digests(generated.folder)
    other = _generate(tmp_path / "other", generated.family, "--seed", "2")
    assert _digests(other)[0] != _digests(generated.folder)[0]


def test_it_reads_without_findings_and_writes_back_the_same(generated: Generated) -> None:
    data = generated.data
    # The `//` at the top, which `write_text` writes, too, ends an empty unit.
    assert [(finding.code, finding.line) for finding in data.findings] == [("empty-unit", 2)]
    assert len(data.foon.units) == data.units_read == UNITS[generated.family]
    text = (generated.folder / "FOON.txt").read_text(encoding="utf-8")
    comment = text.splitlines()[0].removeprefix("# ")
    assert write_text(data.foon, data.foon.units, [comment]) == text


def test_every_goal_can_be_made_and_is_not_in_the_kitchen(generated: Generated) -> None:
    world = generated.world
    goals = [world.id_of(goal) for goal in generated.data.goals]
    assert len(set(goals)) == 100
    assert not world.stock.keys() & set(goals)
    assert set(goals) <= world.closure.available.keys()


def test_every_motion_has_a_rate(generated: Generated) -> None:
    data = generated.data
    assert {data.kitchen.rate(unit) > 0 for unit in data.foon.units} == {True}


def test_units_have_the_sizes_of_real_ones(generated: Generated) -> None:
    units = generated.data.foon.units
    assert {len(unit.inputs) for unit in units} <= set(range(1, 13))
    assert {len(unit.outputs) for unit in units} <= set(range(1, 7))


@pytest.mark.parametrize("family", ["random", "dense"])
def test_the_shape_is_that_of_the_public_foon(family: str, all_generated: dict[str, Generated]) -> None:
    data, world = all_generated[family].data, all_generated[family].world
    units = len(data.foon.units)
    # At 2,376 units the public FOON has 1.81 objects a unit and 502 labels; 97% of its units can be executed,
    # 13% of what is made is made by several units, and it takes 28 rounds.
    assert 1.6 < len(data.foon.objects) / units < 2.3
    assert 300 < len(data.foon.labels) < 600
    assert len(world.closure.executable) > 0.9 * units
    made = _units_makers(world)
    assert 0.08 < sum(count > 1 for count in made.values()) / len(made) < 0.2
    assert 15 < max(world.closure.available.values()) < 60
    slices = sorted(len(Problem.of(world, [goal]).units) for goal in data.goals)
    assert slices[0] < 5
    assert 10 < slices[50] < 200


def test_the_chain_is_a_tenth_of_the_units_deep_and_has_circles(all_generated: dict[str, Generated]) -> None:
    world = all_generated["chain"].world
    assert max(world.closure.available.values()) == UNITS["chain"] // 10
    assert len(world.closure.executable) == UNITS["chain"]
    assert set(_units_makers(world).values()) == {10}
    rounds = world.closure.available
    back = [
        unit
        for unit in map(UnitId, range(UNITS["chain"]))
        if max(rounds[need] for need in world.units.needs[unit])
        > min(rounds[thing] for thing in world.units.makes[unit])
    ]
    assert back, "no unit leads back from a later link"


def test_the_report_is_written_from_what_was_measured(tmp_path: Path) -> None:
    results = tmp_path / "results"
    run = ["--runs", "1", "--goals", "4", "--no-public", "--output", str(results / "growth.json")]
    _run("growth.py", "--sizes", "200", "--families", "random", *run)
    first = Growth.read(results / "growth.json").sizes
    _run("growth.py", "--sizes", "100", "--families", "dense", *run)
    added, *before = Growth.read(results / "growth.json").sizes
    assert (added.key, tuple(before)) == (("dense", 100), first)
    for size in (added, *before):
        assert size.queries is not None
        assert len(size.queries.asked) == size.queries.proven == 4
        for goal in size.queries.asked:
            assert goal.units == goal.better[-1][1]
            assert goal.until(goal.units) == goal.better[-1][0] <= goal.seconds
    _run("report.py", "--results", str(results), "--output", str(tmp_path / "RESULTS.md"))
    text = (tmp_path / "RESULTS.md").read_text(encoding="utf-8")
    assert "| random | 200 |" in text
    assert "| dense | 100 | 10.0 s | 4 of 4 |" in text
    assert "| read 10⁶ units of text, time | at most 15.0 s | not measured |" in text
    assert "Not measured: run `python benchmarks/peers.py`." in text
    for name in ("growth", "queries", "slices"):
        assert (tmp_path / "plots" / f"{name}.png").read_bytes().startswith(b"\x89PNG")


def test_what_is_not_proven_counts_with_the_limit() -> None:
    proven = Asked(10, 1.0, "optimal", 5, None, ((0.1, 9), (0.5, 5)))
    cut_off = Asked(10, 9.5, "limit", 8, 6.0, ((3.0, 8),))
    nothing = Asked(10, 10.5, "limit", None, 6.0, ())
    queries = Queries(10.0, 1, 100.0, (proven, cut_off, nothing))
    assert queries.proven == 1
    assert (queries.whole.median, queries.whole.maximum) == (10.0, 10.5)
    assert [each.until(8) for each in queries.asked] == [0.5, 3.0, math.inf]
    assert seconds(math.inf) == "none"


def test_what_large_slices_must_keep_is_judged_by_all_goals(tmp_path: Path) -> None:
    """One goal of four is late with a good tree, and one has no proof."""
    _run("growth.py", "--sizes", "100", "--families", "dense", "--runs", "1", "--goals", "1", "--no-public",
         "--output", str(tmp_path / "growth.json"))  # fmt: skip
    (size,) = Growth.read(tmp_path / "growth.json").sizes
    good = Asked(10, 1.0, "optimal", 5, None, ((0.1, 5),))
    late = Asked(10, 9.0, "optimal", 5, None, ((0.1, 9), (8.0, 5)))
    open_ = Asked(10, 10.1, "limit", 5, 3.0, ((0.2, 5),))
    queries = Queries(10.0, 1, 100.0, (good, late, open_, good))
    growth = Growth((replace(size, units=100_000, queries=queries),))
    rows = [row.row()[2:4] for row in limits_of_dense(growth)]
    assert rows[:3] == [("3", "**not met**"), ("8.00 s", "**not met**"), ("3", "**not met**")]
    assert [row.measured for row in limits_of_dense(growth)][3:] == [None, None]


def test_the_imports_of_a_command_are_found() -> None:
    names = imports_of(["goals", "--data", str(ROOT / "data")])
    assert {"foon_asp.cli.commands.goals", "argparse"} <= set(names)
    subprocess.run([sys.executable, "-c", "\n".join(f"import {name}" for name in names)], check=True)
