"""Measure retrieval and the audit on the public data; prints a markdown table.

Usage: python benchmarks/retrieval.py [--runs N]

The data is looked up in ../shared/foon beside the checkout, or in $FOON_PUBLIC_DATA.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from machine import DATA, Machine

import foon_asp
from foon_asp.builder import FoonBuilder
from foon_asp.text import TextReader

GOAL = "cheese pizza"
REPEATS = 5


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the table: seconds of each run, and the highest peak memory in MiB if measured."""

    name: str
    seconds: tuple[float, ...]
    peak: float | None = None

    def markdown(self) -> str:
        times = (min(self.seconds), statistics.median(self.seconds), max(self.seconds))
        cells = [self.name, str(len(self.seconds)), *(milliseconds(seconds) for seconds in times)]
        cells.append("" if self.peak is None else f"{self.peak:.0f}")
        return "| " + " | ".join(cells) + " |"


def milliseconds(seconds: float) -> str:
    """Write a time with as many decimals as it takes to see it."""
    value = 1000 * seconds
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def process(name: str, arguments: Sequence[str], runs: int) -> Row:
    """Run the program from its start to its exit, once to warm the file cache and then `runs` times."""
    measured = [run_once(arguments) for _ in range(runs + 1)][1:]
    return Row(name, tuple(seconds for seconds, _ in measured), max(peak for _, peak in measured))


def run_once(arguments: Sequence[str]) -> tuple[float, float]:
    """Return the wall seconds and the peak memory (MiB) of one process.

    Linux counts the memory of this process, up to the start of the other, into that peak: so processes
    come first, while this one holds nothing that they do not load too.
    """
    command = [sys.executable, "-m", "foon_asp", *arguments]
    started = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.perf_counter() - started
    child.returncode = os.waitstatus_to_exitcode(status)
    # 1: two of the 25 goals have no task tree.
    if child.returncode not in (0, 1):
        raise SystemExit(f"exit status {child.returncode}: {' '.join(command)}")
    return seconds, usage.ru_maxrss / (1 << (20 if sys.platform == "darwin" else 10))


def timed(action: Callable[[], object]) -> float:
    started = time.perf_counter()
    action()
    return time.perf_counter() - started


def parsing(runs: int) -> Row:
    """Parse the FOON from a string, with a fresh reader each time."""
    text = (DATA / "FOON.txt").read_text(encoding="utf-8")

    def parse() -> None:
        builder = FoonBuilder()
        TextReader(builder).read(text, "FOON.txt")
        builder.build()

    parse()
    return Row("parse FOON.txt", tuple(timed(parse) for _ in range(runs)))


def warm_retrieval() -> Row:
    """Retrieve each goal in this process; a goal's time is the median of its repeats."""
    data = foon_asp.load(DATA)
    domain = data.domain()
    medians = []
    for goal in data.goals:
        foon_asp.retrieve(domain, goal)
        again = partial(foon_asp.retrieve, domain, goal)
        medians.append(statistics.median(timed(again) for _ in range(REPEATS)))
    return Row(f"retrieve one goal, each of {len(medians)} (median of {REPEATS})", tuple(medians))


def main() -> int:
    options = argparse.ArgumentParser(description="Measure retrieval and the audit on the public data.")
    options.add_argument("--runs", type=int, default=7, help="runs of each measurement (default: 7)")
    runs: int = options.parse_args().runs
    if not (DATA / "FOON.txt").exists():
        print(f"nothing measured: no FOON.txt in {DATA}; set FOON_PUBLIC_DATA", file=sys.stderr)
        return 0
    goals = str(DATA / "goal_nodes.json")
    data = ["--data", str(DATA)]
    subgraphs = sorted(map(str, (DATA.parent / "subgraphs").glob("*.txt")))
    all_goals = ["retrieve", "--goals", goals, "--by", "units", "--format", "json", *data]
    rows = [
        process("process: `retrieve --goals goal_nodes.json --by units --format json`", all_goals, runs),
        process(f'process: `retrieve "{GOAL}"`', ["retrieve", GOAL, *data], runs),
        process("process: `compare`", ["compare", *data], runs),
        process("process: `audit FOON.txt`", ["audit", str(DATA / "FOON.txt")], runs),
        process("process: `audit subgraphs/*.txt`", ["audit", *subgraphs], runs),
        parsing(runs),
        warm_retrieval(),
    ]
    print("| measured | n | min (ms) | median (ms) | max (ms) | peak (MiB) |")
    print("|---|---:|---:|---:|---:|---:|")
    for row in rows:
        print(row.markdown())
    print(f"\nMachine: {Machine.here()}.")
    print(f"Command: `python benchmarks/retrieval.py --runs {runs}`")
    return 0


if __name__ == "__main__":
    sys.exit(main())
