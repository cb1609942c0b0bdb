"""Measure how many queries a second `foon-asp batch` answers, on one core and on two.

    python benchmarks/throughput.py [--data-cache DIR] [--units N]

Asks for every object that the kitchen of the public universal FOON can make, and 20 times for each of the 100
goals of a generated FOON of N units (default: 1,000,000), opened from its store. A run is a whole process; a
first run with a single query says what the start takes, with opening the data in each process, and is taken
off. `--jobs 1` answers in the process itself. Writes benchmarks/results/throughput.json.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from growth import SEED, prepare
from machine import DATA, RESULTS, Machine
from msgspec import to_builtins

from foon_asp.io.folder import load
from foon_asp.io.object_wire import object_to_json

PUBLIC = "universal FOON"
JOBS = (1, 2)
AGAIN = 20
"""How often the goals of the generated FOON are asked for."""


@dataclass(frozen=True, slots=True)
class Rate:
    """One run: seconds from start to exit, those of the start alone, and the peak of a process in MiB."""

    data: str
    units: int
    queries: int
    jobs: int
    start: float
    seconds: float
    peak: float

    @property
    def each_job(self) -> float:
        """Queries a second and process, without the start."""
        return (self.queries - 1) / (self.seconds - self.start) / self.jobs


@dataclass(frozen=True, slots=True)
class Throughput:
    """The outcome of a run, for the report."""

    machine: Machine
    command: str
    rates: tuple[Rate, ...]

    @classmethod
    def read(cls, path: Path) -> Throughput:
        data = json.loads(path.read_text(encoding="utf-8"))
        return cls(
            Machine.of(data["machine"]), data["command"], tuple(Rate(**rate) for rate in data["rates"])
        )

    def write(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1) + "\n", encoding="utf-8")


def measure(name: str, units: int, queries: Sequence[object], data: Sequence[str]) -> list[Rate]:
    """Answer all queries with each number of processes."""
    rates = []
    with tempfile.TemporaryDirectory() as folder:
        one, all_ = (_write(Path(folder) / f"{len(part)}.jsonl", part) for part in (queries[:1], queries))
        for jobs in JOBS:
            start, _ = _run(one, jobs, data)
            seconds, peak = _run(all_, jobs, data)
            rates.append(Rate(name, units, len(queries), jobs, start, seconds, peak))
            print(rates[-1], f"{rates[-1].each_job:.1f} queries a second and process", flush=True)
    return rates


def _write(path: Path, goals: Iterable[object]) -> Path:
    path.write_text("".join(json.dumps({"goal": goal}) + "\n" for goal in goals), encoding="utf-8")
    return path


def _run(queries: Path, jobs: int, data: Sequence[str]) -> tuple[float, float]:
    """Return the seconds and the peak memory of a run; every query must have an answer."""
    out = queries.with_suffix(".out")
    command = [sys.executable, "-m", "foon_asp", "batch", "--queries", str(queries), "-o", str(out)]
    begun = time.perf_counter()
    process = subprocess.Popen(
        [*command, "--jobs", str(jobs), "--overwrite", *data], stderr=subprocess.DEVNULL
    )
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begun
    process.returncode = os.waitstatus_to_exitcode(status)
    rows: list[dict[str, Any]] = [json.loads(line) for line in out.read_text(encoding="utf-8").splitlines()]
    if process.returncode or not rows or any(row["status"] != "optimal" for row in rows):
        raise SystemExit(f"exit status {process.returncode}, or not all proven: {' '.join(command)}")
    return seconds, usage.ru_maxrss / (1 << (20 if sys.platform == "darwin" else 10))


def main() -> None:
    parser = argparse.ArgumentParser(description="Measure how many queries a second batch answers.")
    parser.add_argument("--data-cache", type=Path, metavar="DIR", help="where generated FOONs are kept")
    parser.add_argument("--units", type=int, default=1_000_000, help="of the generated FOON")
    parser.add_argument("--output", type=Path, default=RESULTS / "throughput.json")
    options = parser.parse_args()
    rates = []
    if (DATA / "FOON.txt").exists():
        world = load(DATA).world()
        makeable = sorted(thing for thing in world.closure.available if thing not in world.stock)
        goals = to_builtins([object_to_json(world.node(thing)) for thing in makeable])
        rates += measure(PUBLIC, len(world.foon.units), goals, ["--data", str(DATA)])
    with tempfile.TemporaryDirectory() as temporary:
        folder = prepare("random", options.units, options.data_cache or Path(temporary))
        store = folder / "FOON.foon"
        if not store.exists():
            command = [sys.executable, "-m", "foon_asp", "compile", str(folder / "FOON.txt")]
            subprocess.run([*command, "-o", str(store)], check=True)
        goals = json.loads((folder / "goal_nodes.json").read_text(encoding="utf-8")) * AGAIN
        name = f"generated, `random`, seed {SEED}"
        rates += measure(name, options.units, goals, ["--data", str(folder), "--foon", str(store)])
    said = f"python benchmarks/throughput.py --units {options.units}"
    Throughput(Machine.here(), said, tuple(rates)).write(options.output)


if __name__ == "__main__":
    main()
