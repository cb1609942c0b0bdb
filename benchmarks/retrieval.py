"""Measure retrieval and the audit on the public data; prints a table, or writes it into the page.

Usage: python benchmarks/retrieval.py [--runs N] [--write] [--output FILE]

Writes benchmarks/results/commands.json, too. What of a cold `retrieve` is the start of Python and its imports
is measured by processes that do just that, with all modules that are loaded when the command ends.

The data is looked up in ../shared/foon beside the checkout, or in $FOON_PUBLIC_DATA.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from machine import DATA, RESULTS, ROOT, Machine
from tables import put_table

from foon_asp.io.folder import load
from foon_asp.io.text import TextReader
from foon_asp.model.foon import FoonBuilder
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve

GOAL = "cheese pizza"
ONE = f'process: `retrieve "{GOAL}"`'
COMPARE = "process: `compare`"
IMPORTS = "the same, its start and imports alone"
START = "the same, the start of Python alone"
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


@dataclass(frozen=True, slots=True)
class Commands:
    """The outcome of a run, for the report."""

    machine: Machine
    command: str
    rows: tuple[Row, ...]

    @classmethod
    def read(cls, path: Path) -> Commands:
        data = json.loads(path.read_text(encoding="utf-8"))
        rows = (Row(**row | {"seconds": tuple(row["seconds"])}) for row in data["rows"])
        return cls(Machine.of(data["machine"]), data["command"], tuple(rows))

    def write(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1) + "\n", encoding="utf-8")

    def median(self, name: str) -> float | None:
        return next((statistics.median(row.seconds) for row in self.rows if row.name == name), None)


HEAD = ("measured", "n", "min (ms)", "median (ms)", "max (ms)", "peak (MiB)")


def table(rows: Sequence[Row]) -> list[str]:
    """Return rows as a table, with its head."""
    ruler = "|".join(["---", *("---:" for _ in HEAD[1:])])
    return [f"| {' | '.join(HEAD)} |", f"|{ruler}|", *(row.markdown() for row in rows)]


def milliseconds(seconds: float) -> str:
    """Write a time with as many decimals as it takes to see it."""
    value = 1000 * seconds
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def process(name: str, arguments: Sequence[str], runs: int) -> Row:
    """Run the program, or other Python, to its exit, once to warm the file cache and then `runs` times."""
    measured = [run_once(arguments) for _ in range(runs + 1)][1:]
    return Row(name, tuple(seconds for seconds, _ in measured), max(peak for _, peak in measured))


def run_once(arguments: Sequence[str]) -> tuple[float, float]:
    """Return the wall seconds and the peak memory (MiB) of one process.

    Linux counts the memory of this process, up to the start of the other, into that peak: so processes
    come first, while this one holds nothing that they do not load too.
    """
    command = [sys.executable, *arguments]
    started = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.perf_counter() - started
    child.returncode = os.waitstatus_to_exitcode(status)
    # 1: two of the 25 goals have no task tree.
    if child.returncode not in (0, 1):
        raise SystemExit(f"exit status {child.returncode}: {' '.join(command)}")
    return seconds, usage.ru_maxrss / (1 << (20 if sys.platform == "darwin" else 10))


def imports_of(arguments: Sequence[str]) -> list[str]:
    """Return the modules that a command of the program has loaded at its end, in their order."""
    command = [sys.executable, "-c", _LIST_MODULES, *arguments]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    return [name for name in said.splitlines() if importable(name)]


_LIST_MODULES = """\
import sys
import foon_asp.cli.start, foon_asp.cli.signals
from foon_asp.cli.main import main
main()
print(*sys.modules, sep="\\n", file=sys.stderr)
"""


def _import_all(names: Sequence[str]) -> str:
    """Return a program that imports modules, and ends as the program does."""
    return "\n".join([*(f"import {name}" for name in names), "import os", "os._exit(0)"])


def importable(name: str) -> bool:
    """Whether a module can be imported by its name alone: not where it is made up while others are."""
    try:
        return find_spec(name) is not None
    except (ImportError, ValueError):
        return False


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
    data = load(DATA)
    world = data.world()
    medians = []
    for goal in data.goals:
        retrieve(world, Query(goal))
        again = partial(retrieve, world, Query(goal))
        medians.append(statistics.median(timed(again) for _ in range(REPEATS)))
    return Row(f"retrieve one goal, each of {len(medians)} (median of {REPEATS})", tuple(medians))


def main() -> int:
    options = argparse.ArgumentParser(description="Measure retrieval and the audit on the public data.")
    options.add_argument("--runs", type=int, default=7, help="runs of each measurement (default: 7)")
    options.add_argument("--write", action="store_true", help="write the table into benchmarks/README.md")
    options.add_argument("--output", type=Path, default=RESULTS / "commands.json", metavar="FILE")
    chosen = options.parse_args()
    runs: int = chosen.runs
    if not (DATA / "FOON.txt").exists():
        print(f"nothing measured: no FOON.txt in {DATA}; set FOON_PUBLIC_DATA", file=sys.stderr)
        return 0
    program, data = ["-m", "foon_asp"], ["--data", str(DATA)]
    subgraphs = sorted(map(str, (DATA.parent / "subgraphs").glob("*.txt")))
    all_goals = ["--goals", str(DATA / "goal_nodes.json"), "--by", "units", "--format", "json"]
    one = ["retrieve", GOAL, *data]
    rows = [
        process(
            "process: `retrieve --goals goal_nodes.json --by units --format json`",
            [*program, "retrieve", *all_goals, *data],
            runs,
        ),
        process(ONE, [*program, *one], runs),
        process(IMPORTS, ["-c", _import_all(imports_of(one))], runs),
        process(START, ["-c", ""], runs),
        process(COMPARE, [*program, "compare", *data], runs),
        process("process: `audit FOON.txt`", [*program, "audit", str(DATA / "FOON.txt")], runs),
        process("process: `audit subgraphs/*.txt`", [*program, "audit", *subgraphs], runs),
        parsing(runs),
        warm_retrieval(),
    ]
    machine, command = Machine.here(), f"python benchmarks/retrieval.py --runs {runs}"
    Commands(machine, command, tuple(rows)).write(chosen.output)
    if chosen.write:
        put_table(ROOT / "benchmarks" / "README.md", "commands", table(rows))
    else:
        print("\n".join(table(rows)))
    print(f"\nMachine: {machine}.\nCommand: `{command}`")
    return 0


if __name__ == "__main__":
    sys.exit(main())
