"""The generator of FOONs for benchmarks, and the report that is made of what they measure."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

import foon_asp
from foon_asp.dataset import Dataset
from foon_asp.problem import Domain
from foon_asp.text import write_text

BENCHMARKS = Path(__file__).parent.parent / "benchmarks"
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
    domain: Domain


@pytest.fixture(scope="module")
def all_generated(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Generated]:
    found = {}
    for family in UNITS:
        folder = _generate(tmp_path_factory.mktemp(family), family)
        data = foon_asp.load(folder)
        found[family] = Generated(family, folder, data, data.domain())
    return found


@pytest.fixture(params=list(UNITS))
def generated(request: pytest.FixtureRequest, all_generated: dict[str, Generated]) -> Generated:
    family: str = request.param
    return all_generated[family]


def _digests(folder: Path) -> list[str]:
    return [hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in FILES]


def _units_makers(domain: Domain) -> dict[int, int]:
    """Return how many units make each object that the kitchen does not have."""
    counts: dict[int, int] = {}
    for made in domain.reading.makes:
        for thing in made:
            if thing not in domain.stock:
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
    domain = generated.domain
    goals = [domain.id_of(goal) for goal in generated.data.goals]
    assert len(set(goals)) == 100
    assert not domain.stock.keys() & set(goals)
    assert set(goals) <= domain.closure.available.keys()


def test_every_motion_has_a_rate(generated: Generated) -> None:
    data = generated.data
    assert {data.kitchen.rate(unit) > 0 for unit in data.foon.units} == {True}


def test_units_have_the_sizes_of_real_ones(generated: Generated) -> None:
    units = generated.data.foon.units
    assert {len(unit.inputs) for unit in units} <= set(range(1, 13))
    assert {len(unit.outputs) for unit in units} <= set(range(1, 7))


@pytest.mark.parametrize("family", ["random", "dense"])
def test_the_shape_is_that_of_the_public_foon(family: str, all_generated: dict[str, Generated]) -> None:
    data, domain = all_generated[family].data, all_generated[family].domain
    units = len(data.foon.units)
    # At 2,376 units the public FOON has 1.81 objects a unit and 502 labels; 97% of its units can be executed,
    # 13% of what is made is made by several units, and it takes 28 rounds.
    assert 1.6 < len(data.foon.objects) / units < 2.3
    assert 300 < len(data.foon.labels) < 600
    assert len(domain.closure.executable) > 0.9 * units
    made = _units_makers(domain)
    assert 0.08 < sum(count > 1 for count in made.values()) / len(made) < 0.2
    assert 15 < max(domain.closure.available.values()) < 60
    slices = sorted(len(domain.problem([goal]).units) for goal in data.goals)
    assert slices[0] < 5
    assert 10 < slices[50] < 200


def test_the_chain_is_a_tenth_of_the_units_deep_and_has_circles(all_generated: dict[str, Generated]) -> None:
    domain = all_generated["chain"].domain
    assert max(domain.closure.available.values()) == UNITS["chain"] // 10
    assert len(domain.closure.executable) == UNITS["chain"]
    assert set(_units_makers(domain).values()) == {10}
    rounds = domain.closure.available
    back = [
        unit
        for unit in range(UNITS["chain"])
        if max(rounds[need] for need in domain.reading.needs[unit])
        > min(rounds[thing] for thing in domain.reading.makes[unit])
    ]
    assert back, "no unit leads back from a later link"


def test_the_report_is_written_from_what_was_measured(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    results = tmp_path / "results"
    run = ["--sizes", "200", "--families", "random", "--runs", "1", "--budget", "1"]
    _run("growth.py", *run, "--no-public", "--output", str(results / "growth.json"))
    _run("report.py", "--results", str(results), "--output", str(tmp_path / "RESULTS.md"))
    text = (tmp_path / "RESULTS.md").read_text(encoding="utf-8")
    assert "| random | 200 |" in text
    assert "| parse the text, time | 60.0 s | not measured |" in text
    assert "Not measured: run `python benchmarks/peers.py`." in text
    for name in ("growth", "queries", "slices"):
        assert (tmp_path / "plots" / f"{name}.png").read_bytes().startswith(b"\x89PNG")
