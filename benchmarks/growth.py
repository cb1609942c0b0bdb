"""Measure how time and memory grow with the size of a FOON, stage by stage.

    python benchmarks/growth.py [--sizes N …] [--families NAME …] [--runs N] [--data-cache DIR]

FOONs come from generate.py, each size and family from one seed; the public universal FOON is measured
beside them where it is there. Every run of a stage is a process of its own: `parse` reads the text, `compile`
is the whole command, `open` opens the store, then brings it together with its kitchen (`domain`: kitchen and
readings) and computes the forward closure. `query` opens the store and asks for each of the 100 goals, warm:
the backward slice, the facts, loading and grounding, solving (by units, to the proof), and decoding with the
replay; and then the same as one call of `foon_asp.retrieve`. A goal whose slice has more than --most-units is
not asked, nor are goals once --budget seconds are over (`chain` and `dense`: a fifth of that): they are asked
in a shuffled order, and the results say how many were.

Writes benchmarks/results/growth.json.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from machine import DATA, RESULTS, Machine

# Linux counts the memory of a process into the peak of those that it starts: so nothing large is imported.

SIZES = (1_000, 10_000, 100_000, 1_000_000)
FAMILIES = ("random", "chain", "dense")
DENSE_TO = 100_000
"""The largest size of the family `dense`: beyond, most slices are too large to be asked."""
SEED = 1
_SHARE = 0.2
"""Of the seconds for all goals, for families whose slices grow with the FOON: they cannot all be asked."""

STEPS = ("slice", "facts", "ground", "solve", "decode", "retrieve")
LARGE = 300_000
"""From this size on, a single run, unless asked otherwise."""


@dataclass(frozen=True, slots=True)
class Stage:
    """Seconds of a stage and the peak memory of its process in MiB, each the median over the runs."""

    name: str
    seconds: float
    peak: float
    runs: int


@dataclass(frozen=True, slots=True)
class Spread:
    """Seconds over the goals that were asked; a goal's time is the median over its runs."""

    median: float
    p90: float
    maximum: float


@dataclass(frozen=True, slots=True)
class Queries:
    """What asking for goals took, by step. `slices` and `retrieve` run parallel, goal by goal.

    `goals` is how many there are, `too_large` how many of them have a slice that is too large, `proven`
    how many were proven optimal.
    """

    goals: int
    asked: int
    too_large: int
    proven: int
    runs: int
    peak: float
    steps: dict[str, Spread]
    all_slices: tuple[int, ...]
    slices: tuple[int, ...]
    retrieve: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Size:
    """One FOON: how large it is, and what each stage took."""

    family: str
    units: int
    objects: int
    lines: int
    megabytes: float
    store_megabytes: float
    kitchen: int
    rounds: int
    stages: tuple[Stage, ...]
    queries: Queries


@dataclass(frozen=True, slots=True)
class Growth:
    """The outcome of a run, for the report."""

    machine: Machine
    command: str
    sizes: tuple[Size, ...]

    @classmethod
    def read(cls, path: Path) -> Growth:
        data = json.loads(path.read_text(encoding="utf-8"))
        return cls(Machine.of(data["machine"]), data["command"], tuple(map(_size, data["sizes"])))

    def write(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1) + "\n", encoding="utf-8")


def _size(row: dict[str, Any]) -> Size:
    stages = tuple(Stage(**stage) for stage in row.pop("stages"))
    queries = row.pop("queries")
    steps = {name: Spread(**spread) for name, spread in queries.pop("steps").items()}
    queries |= {name: tuple(queries[name]) for name in ("all_slices", "slices", "retrieve")}
    return Size(**row, stages=stages, queries=Queries(**queries, steps=steps))


# What follows up to `measure` runs in a process of its own.


def run_stage(name: str, folder: Path, options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Run a stage; yield rows of what it took."""
    if name == "parse":
        from foon_asp.dataset import read_foon

        begun = time.perf_counter()
        files = read_foon([folder / "FOON.txt"])
        yield {"parse": time.perf_counter() - begun, "units": len(files.foon.units)}
        return
    yield from (_open if name == "open" else _query)(folder, options)


def _timed(took: dict[str, Any], name: str, action: Callable[[], Any]) -> Any:
    begun = time.perf_counter()
    outcome = action()
    took[name] = time.perf_counter() - begun
    return outcome


def _open_domain(folder: Path, took: dict[str, Any]) -> Any:
    from foon_asp.dataset import read_foon
    from foon_asp.files import read_rates, read_stock, read_utensils
    from foon_asp.kitchen import Kitchen
    from foon_asp.problem import Domain

    def look() -> Domain:
        stock = tuple(read_stock(folder / "kitchen.json"))
        utensils = read_utensils(folder / "utensils.txt")
        domain = Domain(files.foon, Kitchen(stock, utensils, read_rates(folder / "motion.txt")))
        assert domain.reading is not None
        return domain

    files = _timed(took, "open", lambda: read_foon([folder / "FOON.foon"]))
    return _timed(took, "domain", look)


def _open(folder: Path, _: argparse.Namespace) -> Iterator[dict[str, Any]]:
    took: dict[str, Any] = {}
    domain = _open_domain(folder, took)
    _timed(took, "closure", lambda: domain.closure)
    took |= {"objects": len(domain.foon.objects), "units": len(domain.foon.units)}
    took |= {"kitchen": len(domain.stock), "rounds": max(domain.closure.available.values(), default=0)}
    yield took


def _query(folder: Path, options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Yield a row for each goal that can be made: the steps, or only its slice if it is not asked."""
    from foon_asp.files import read_objects

    domain = _open_domain(folder, {})
    goals = [goal for goal in read_objects(folder / "goal_nodes.json") if _reachable(domain, goal)]
    order = list(enumerate(goals))
    random.Random(0).shuffle(order)
    # The first question builds what all share.
    rounds = domain.closure.available
    _ask(domain, min(goals, key=lambda goal: rounds[domain.id_of(goal)]), {}, options.limit)
    begun = time.perf_counter()
    for place, goal in order:
        row: dict[str, Any] = {"goal": place}
        problem = domain.problem([goal])
        size = len(problem.units)
        row["units"] = size
        if size <= options.most_units and time.perf_counter() - begun < options.budget:
            _ask(domain, goal, row, options.limit)
        yield row


def _reachable(domain: Any, goal: Any) -> bool:
    return domain.id_of(goal) in domain.closure.available


def _ask(domain: Any, goal: Any, row: dict[str, Any], limit: float) -> None:
    """Ask for one goal, step by step and then in one call."""
    import foon_asp
    from foon_asp.criteria import parse_by
    from foon_asp.decode import decode_tree
    from foon_asp.facts import read_facts
    from foon_asp.program import optimisers

    problem = domain.problem([goal])
    _timed(row, "slice", lambda: problem.units)
    _timed(row, "facts", lambda: read_facts(problem))
    solver = _timed(row, "ground", lambda: next(optimisers(problem, parse_by("units"))))
    row["ground"] = max(0.0, row["ground"] - row["facts"])
    answer = _timed(row, "solve", lambda: solver.best(time.monotonic() + limit))
    if not answer.proven:
        return
    _timed(row, "decode", lambda: decode_tree(problem, answer))
    found = _timed(row, "retrieve", lambda: foon_asp.retrieve(domain, goal))
    row["proven"] = found.status == "optimal"


# What follows runs in the process that was started, and starts the others.


def child(name: str, folder: Path, options: argparse.Namespace) -> tuple[list[dict[str, Any]], float, float]:
    """Run a stage in a process of its own; return its rows, wall seconds, and peak memory in MiB."""
    limits = [f"--most-units={options.most_units}", f"--budget={options.budget}", f"--limit={options.limit}"]
    return _process([sys.executable, __file__, "--stage", name, str(folder), *limits])


def _process(command: Sequence[str]) -> tuple[list[dict[str, Any]], float, float]:
    begun = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    rows = [json.loads(line) for line in process.stdout if line.startswith("{")]
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begun
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"exit status {process.returncode}: {' '.join(command)}")
    return rows, seconds, usage.ru_maxrss / (1 << (20 if sys.platform == "darwin" else 10))


def prepare(family: str, units: int, cache: Path) -> Path:
    """Return the folder of a FOON: the public one, or one that is generated if it is not in the cache."""
    if family == "public":
        folder = cache / "public"
        if not folder.exists():
            shutil.copytree(DATA, folder)
        return folder
    folder = cache / f"{family}-{units}-{SEED}"
    if not (folder / "goal_nodes.json").exists():
        generator = Path(__file__).with_name("generate.py")
        arguments = ["--units", str(units), "--family", family, "--seed", str(SEED), str(folder)]
        subprocess.run([sys.executable, str(generator), *arguments], check=True)
    return folder


def measure(family: str, units: int, folder: Path, options: argparse.Namespace) -> Size:
    """Measure every stage of one FOON."""
    runs = options.runs or (1 if units >= LARGE else 3)
    if family in ("chain", "dense"):
        options = argparse.Namespace(**vars(options) | {"budget": options.budget * _SHARE})
    store = folder / "FOON.foon"
    took: dict[str, list[float]] = {}
    peaks: dict[str, list[float]] = {}

    def note(names: Sequence[str], row: dict[str, Any], peak: float) -> None:
        for name in names:
            took.setdefault(name, []).append(row[name])
            peaks.setdefault(name, []).append(peak)

    facts: dict[str, Any] = {}
    answers: list[list[dict[str, Any]]] = []
    query_peaks = []
    for _ in range(runs):
        rows, _, peak = child("parse", folder, options)
        note(["parse"], rows[0], peak)
        shutil.rmtree(store, ignore_errors=True)
        compile_ = [sys.executable, "-m", "foon_asp", "compile", str(folder / "FOON.txt"), "-o", str(store)]
        _, seconds, peak = _process(compile_)
        note(["compile"], {"compile": seconds}, peak)
        rows, _, peak = child("open", folder, options)
        facts = rows[0]
        note(["open", "domain", "closure"], facts, peak)
        rows, _, peak = child("query", folder, options)
        answers.append(rows)
        query_peaks.append(peak)
    with (folder / "FOON.txt").open("rb") as text:
        lines = sum(1 for _ in text)
    return Size(
        family,
        facts["units"],
        facts["objects"],
        lines,
        (folder / "FOON.txt").stat().st_size / 1e6,
        sum(path.stat().st_size for path in store.iterdir()) / 1e6,
        facts["kitchen"],
        facts["rounds"],
        tuple(
            Stage(name, statistics.median(took[name]), statistics.median(peaks[name]), runs) for name in took
        ),
        _queries(answers, statistics.median(query_peaks), options.most_units),
    )


def _queries(answers: Sequence[Sequence[dict[str, Any]]], peak: float, most: int) -> Queries:
    """Bring the rows of several runs together, goal by goal; a goal counts as asked if all runs asked it."""
    by_goal: dict[int, list[dict[str, Any]]] = {}
    for rows in answers:
        for row in rows:
            by_goal.setdefault(row["goal"], []).append(row)
    asked = {
        goal: rows
        for goal, rows in sorted(by_goal.items())
        if len(rows) == len(answers) and all("retrieve" in row for row in rows)
    }
    middle = {
        step: [statistics.median(row[step] for row in rows) for rows in asked.values()] for step in STEPS
    }
    return Queries(
        goals=len(by_goal),
        asked=len(asked),
        too_large=sum(rows[0]["units"] > most for rows in by_goal.values()),
        proven=sum(all(row["proven"] for row in rows) for rows in asked.values()),
        runs=len(answers),
        peak=peak,
        steps={step: spread(values) for step, values in middle.items() if values},
        all_slices=tuple(sorted(rows[0]["units"] for rows in by_goal.values())),
        slices=tuple(rows[0]["units"] for rows in asked.values()),
        retrieve=tuple(round(seconds, 6) for seconds in middle["retrieve"]),
    )


def spread(values: Sequence[float]) -> Spread:
    """Return median, 90th percentile and maximum."""
    ordered = sorted(values)
    return Spread(statistics.median(ordered), ordered[(len(ordered) * 9 - 1) // 10], ordered[-1])


def in_short(size: Size) -> str:
    """Say in a line what was measured."""
    stages = ", ".join(f"{stage.name} {stage.seconds:.3g} s {stage.peak:.0f} MiB" for stage in size.stages)
    queries = size.queries
    query = queries.steps.get("retrieve")
    times = (
        f"{query.median * 1000:.1f} / {query.p90 * 1000:.1f} / {query.maximum * 1000:.0f} ms"
        if query
        else "-"
    )
    middle = queries.all_slices[len(queries.all_slices) // 2]
    return (
        f"{size.family} {size.units}: {stages}; slice median {middle}; "
        f"query {times} ({queries.asked} of {queries.goals} asked, {queries.proven} proven)"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="Measure how time and memory grow with the size of a FOON.")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, metavar="N")
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=FAMILIES)
    parser.add_argument(
        "--runs", type=int, help=f"runs of each stage (default: 3; from {LARGE:,} units on, 1)"
    )
    parser.add_argument("--data-cache", type=Path, metavar="DIR", help="where generated FOONs are kept")
    parser.add_argument("--most-units", type=int, default=5_000, help="largest slice (default: 5,000)")
    parser.add_argument("--budget", type=float, default=60.0, help="seconds for all goals (default: 60)")
    parser.add_argument("--limit", type=float, default=20.0, help="seconds to solve a goal (default: 20)")
    parser.add_argument("--output", type=Path, default=RESULTS / "growth.json")
    parser.add_argument("--no-public", action="store_true", help="leave out the public FOON")
    parser.add_argument("--stage", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.stage:
        name, folder = options.stage
        for row in run_stage(name, Path(folder), options):
            print(json.dumps(row), flush=True)
        return
    with tempfile.TemporaryDirectory() as temporary:
        cache = options.data_cache or Path(temporary)
        cache.mkdir(parents=True, exist_ok=True)
        plan = [(family, units) for units in options.sizes for family in options.families]
        plan = [(family, units) for family, units in plan if family != "dense" or units <= DENSE_TO]
        if not options.no_public and (DATA / "FOON.txt").exists():
            plan.insert(0, ("public", 0))
        sizes = []
        for family, units in plan:
            sizes.append(measure(family, units, prepare(family, units, cache), options))
            print(in_short(sizes[-1]), flush=True)
    command = f"python benchmarks/growth.py --sizes {' '.join(map(str, options.sizes))}"
    command += f" --families {' '.join(options.families)}" + (
        f" --runs {options.runs}" if options.runs else ""
    )
    Growth(Machine.here(), command, tuple(sizes)).write(options.output)


if __name__ == "__main__":
    main()
