"""Measure how time and memory grow with the size of a FOON, stage by stage.

    python benchmarks/growth.py [--sizes N …] [--families NAME …] [--runs N] [--data-cache DIR]

FOONs come from generate.py, each size and family from one seed; the public universal FOON is measured
beside them where it is there. Every run of a stage is a process of its own: `parse` reads the text, `compile`
is the whole command, `open` opens the store, then brings it together with its kitchen (`domain`: kitchen and
readings) and computes the forward closure. `query` opens the store and asks for each of the 100 goals, warm,
by units and with a time limit, in one call of `retrieve`; of families whose slices grow, for ten of them
where there are a million units. However large its slice, a goal is asked, and what did not come to its proof
counts with the limit. Each better tree is noted as it is found.

Writes benchmarks/results/growth.json: a size that was measured before is replaced there, others stay, each
with the machine, the day and the command of its measurement.
"""

from __future__ import annotations

import argparse
import json
import math
import os
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

from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve

# Linux counts the memory of a process into the peak of those that it starts: so nothing large is imported.

SIZES = (1_000, 10_000, 100_000, 1_000_000)
FAMILIES = ("random", "chain", "dense")
SEED = 1

LARGE = 100_000
"""From this size on, a single run, unless asked otherwise."""
HUGE = 1_000_000
"""From this size on, few goals of families whose slices grow with the FOON, and a longer limit for each."""
FEW = 10
LIMITS = (10.0, 19.0)
"""Seconds for a goal, below that size and from there on: an answer is to be there after 20."""


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
class Asked:
    """What came of a goal: units in its slice, seconds, and the tree; of several runs the middle one.

    `better` has each tree that was better than those before, as seconds since the question and units.
    `bound` says how few units any tree has at least, where that is all that is proven.
    """

    slice: int
    seconds: float
    status: str
    units: int | None
    bound: float | None
    better: tuple[tuple[float, int], ...]

    @property
    def proven(self) -> bool:
        return self.status in ("optimal", "unreachable")

    def counted(self, limit: float) -> float:
        """Return the seconds to the proof; without one, those of the limit at least."""
        return self.seconds if self.proven else max(limit, self.seconds)

    def until(self, units: float) -> float:
        """Return the seconds until there was a tree with so many units or fewer; infinite without one."""
        return min((seconds for seconds, count in self.better if count <= units), default=math.inf)


@dataclass(frozen=True, slots=True)
class Queries:
    """What asking for goals took, with a limit of so many seconds each."""

    limit: float
    runs: int
    peak: float
    asked: tuple[Asked, ...]

    @property
    def proven(self) -> int:
        return sum(each.proven for each in self.asked)

    @property
    def whole(self) -> Spread:
        """Seconds to the proof over all goals."""
        return spread([each.counted(self.limit) for each in self.asked])


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
    queries: Queries | None
    machine: Machine
    command: str

    @property
    def key(self) -> tuple[str, int]:
        return self.family, self.units


@dataclass(frozen=True, slots=True)
class Growth:
    """The sizes that were measured, for the report."""

    sizes: tuple[Size, ...]

    @classmethod
    def read(cls, path: Path) -> Growth:
        return cls(tuple(map(_size, json.loads(path.read_text(encoding="utf-8"))["sizes"])))

    def write(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1) + "\n", encoding="utf-8")

    def into(self, path: Path) -> None:
        """Write these sizes in the place of those that were measured before, and leave the others."""
        before = Growth.read(path).sizes if path.exists() else ()
        found = {size.key: size for size in (*before, *self.sizes)}
        families = ("public", *FAMILIES)
        order = sorted(found, key=lambda key: (key[0] != "public", key[1], families.index(key[0])))
        Growth(tuple(found[key] for key in order)).write(path)


def _size(row: dict[str, Any]) -> Size:
    stages = tuple(Stage(**stage) for stage in row.pop("stages"))
    machine, queries = Machine.of(row.pop("machine")), row.pop("queries")
    if queries is not None:
        asked = tuple(
            Asked(**goal | {"better": tuple((seconds, units) for seconds, units in goal["better"])})
            for goal in queries["asked"]
        )
        queries = Queries(**queries | {"asked": asked})
    return Size(**row, stages=stages, queries=queries, machine=machine)


# What follows up to `measure` runs in a process of its own.


def run_stage(name: str, folder: Path, options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Run a stage; yield rows of what it took."""
    if name == "parse":
        from foon_asp.io.folder import read_foon

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
    from foon_asp.io.folder import read_foon
    from foon_asp.io.kitchen import KitchenFiles
    from foon_asp.model.world import World

    def look() -> World:
        kitchen, utensils, rates = (
            str(folder / name) for name in ("kitchen.json", "utensils.txt", "motion.txt")
        )
        beside = KitchenFiles(kitchen, utensils, rates)
        world = World.of(files.foon, beside.read(files.foon)[0])
        assert world.units is not None
        return world

    files = _timed(took, "open", lambda: read_foon([folder / "FOON.foon"]))
    return _timed(took, "domain", look)


def _open(folder: Path, _: argparse.Namespace) -> Iterator[dict[str, Any]]:
    took: dict[str, Any] = {}
    world = _open_domain(folder, took)
    _timed(took, "closure", lambda: world.closure)
    took |= {"objects": len(world.foon.objects), "units": len(world.foon.units)}
    took |= {"kitchen": len(world.stock), "rounds": max(world.closure.available.values(), default=0)}
    yield took


def _query(folder: Path, options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Yield a row for each goal that can be made, or for so many of them, spread evenly."""
    from foon_asp.io.kitchen import read_goals
    from foon_asp.query.problem import Problem

    world = _open_domain(folder, {})
    rounds = world.closure.available
    listed, _ = read_goals(str(folder / "goal_nodes.json"), world.foon)
    goals = [goal for goal in listed if world.id_of(goal) in rounds]
    count = min(options.goals, len(goals))
    # The first question builds what all share.
    _ask(world, min(goals, key=lambda goal: rounds[world.id_of(goal)]), options.limit)
    for goal in (goals[len(goals) * place // count] for place in range(count)):
        yield {"slice": len(Problem.of(world, [goal]).units), **_ask(world, goal, options.limit)}


def _ask(world: Any, goal: Any, limit: float) -> dict[str, Any]:
    """Ask for one goal; note each better tree as it is found."""
    better: list[tuple[float, int]] = []
    begun = time.perf_counter()

    def note(tree: Any) -> None:
        better.append((round(time.perf_counter() - begun, 6), len(tree.units)))

    found = retrieve(world, Query(goal, time_limit=limit), on_better=note)
    seconds = round(time.perf_counter() - begun, 6)
    units = None if found.tree is None else len(found.tree.units)
    if units is not None and (not better or better[-1][1] > units):
        better.append((seconds, units))
    return {
        "seconds": seconds,
        "status": str(found.status),
        "units": units,
        "bound": found.bound.get("units"),
        "better": better,
    }


# What follows runs in the process that was started, and starts the others.


def child(name: str, folder: Path, options: argparse.Namespace) -> tuple[list[dict[str, Any]], float, float]:
    """Run a stage in a process of its own; return its rows, wall seconds, and peak memory in MiB."""
    asked = [f"--goals={options.goals}", f"--limit={options.limit}"]
    return _process([sys.executable, __file__, "--stage", name, str(folder), *asked])


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


def measure(
    family: str, units: int, folder: Path, options: argparse.Namespace, machine: Machine, command: str
) -> Size:
    """Measure every stage of one FOON."""
    runs = options.runs or (1 if units >= LARGE else 3)
    huge = units >= HUGE
    goals = min(options.goals, FEW) if huge and family in ("chain", "dense") else options.goals
    limit = options.limit or LIMITS[huge]
    options = argparse.Namespace(goals=goals, limit=limit)
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
        Queries(limit, runs, statistics.median(query_peaks), tuple(map(_middle, zip(*answers, strict=True)))),
        machine,
        command,
    )


def _middle(rows: Sequence[dict[str, Any]]) -> Asked:
    """Return what came of a goal in the run with the median of the times."""
    row = sorted(rows, key=lambda row: row["seconds"])[(len(rows) - 1) // 2]
    return Asked(**row | {"better": tuple((seconds, units) for seconds, units in row["better"])})


def spread(values: Sequence[float]) -> Spread:
    """Return median, 90th percentile and maximum."""
    ordered = sorted(values)
    return Spread(statistics.median(ordered), ordered[(len(ordered) * 9 - 1) // 10], ordered[-1])


def in_short(size: Size) -> str:
    """Say in a line what was measured."""
    stages = ", ".join(f"{stage.name} {stage.seconds:.3g} s {stage.peak:.0f} MiB" for stage in size.stages)
    assert size.queries is not None
    queries, whole = size.queries, size.queries.whole
    slices = sorted(each.slice for each in queries.asked)
    return (
        f"{size.family} {size.units}: {stages}; slice median {slices[len(slices) // 2]}; "
        f"query {whole.median * 1000:.1f} / {whole.p90 * 1000:.1f} / {whole.maximum * 1000:.0f} ms "
        f"({queries.proven} of {len(queries.asked)} proven)"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="Measure how time and memory grow with the size of a FOON.")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, metavar="N")
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=FAMILIES)
    parser.add_argument(
        "--runs", type=int, help=f"runs of each stage (default: 3; from {LARGE:,} units on, 1)"
    )
    parser.add_argument("--data-cache", type=Path, metavar="DIR", help="where generated FOONs are kept")
    parser.add_argument("--goals", type=int, default=100, metavar="N", help="at most (default: 100)")
    parser.add_argument(
        "--limit",
        type=float,
        metavar="S",
        help=f"seconds for a goal (default: {LIMITS[0]:g}, {LIMITS[1]:g} if huge)",
    )
    parser.add_argument("--output", type=Path, default=RESULTS / "growth.json")
    parser.add_argument("--no-public", action="store_true", help="leave out the public FOON")
    parser.add_argument("--stage", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.stage:
        name, folder = options.stage
        for row in run_stage(name, Path(folder), options):
            print(json.dumps(row), flush=True)
        return
    command = f"python benchmarks/growth.py --sizes {' '.join(map(str, options.sizes))}"
    command += f" --families {' '.join(options.families)}"
    command += f" --runs {options.runs}" if options.runs else ""
    command += f" --goals {options.goals}" if options.goals != parser.get_default("goals") else ""
    command += f" --limit {options.limit:g}" if options.limit else ""
    machine = Machine.here()
    with tempfile.TemporaryDirectory() as temporary:
        cache = options.data_cache or Path(temporary)
        cache.mkdir(parents=True, exist_ok=True)
        plan = [(family, units) for units in options.sizes for family in options.families]
        if not options.no_public and (DATA / "FOON.txt").exists():
            plan.insert(0, ("public", 0))
        for family, units in plan:
            folder = prepare(family, units, cache)
            size = measure(family, units, folder, options, machine, command)
            print(in_short(size), flush=True)
            Growth((size,)).into(options.output)


if __name__ == "__main__":
    main()
