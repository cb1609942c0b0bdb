"""Compare clingo with its peers on the universal FOON: exact methods, and the paper's greedy.

    python benchmarks/peers.py [--goals 25|sample|all] [--runs N] [--output FILE.json]

Every goal is asked of every method in turn, in one run: clingo (`retrieve`, by units; and given the whole
slice), CP-SAT, Fast Downward with LM-cut and with its operator-counting h+ (or, where its binary has no LP
solver, that integer program solved by SCIP), and the published heuristics in plain Python. CP-SAT, LM-cut and
the integer program are also given what clingo's reductions leave (`…-reduced`). Each method has a process of
its own, which loads the FOON once; a goal's time goes from the loaded problem to the proven and replayed
tree. Then whole processes are timed, from start to exit, one goal each; and clingo proves all objects that
can be made.

All exact methods must agree, and every tree of theirs must pass its replay; else the exit status is 1.

Rows go to FILE.jsonl as they come, and a second run goes on where the first one stopped. `--fresh` starts
anew, as one must after a change of the code or the data. FILE.json has the summary, as `Peers`. `all` are the
objects that the kitchen can make and does not have, `sample` is every 30th of them. The data is looked up in
../shared/foon beside the checkout, or in $FOON_PUBLIC_DATA.
"""

from __future__ import annotations

import argparse
import json
import os
import select
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import IO, Any

from peer_results import (
    EXACT,
    GREEDY,
    LIMIT,
    MENU,
    OURS,
    WAYS,
    Everything,
    Peers,
    Row,
    Rows,
    Tally,
    goal_row,
    in_short,
    summarise,
    summarise_greedy,
)

# Linux counts the memory of a process into the peak of those that it starts: so nothing large is imported.

WORKER = Path(__file__).resolve().parent / "peer_worker.py"
OUTPUT = Path(__file__).resolve().parent / "results" / "peers.json"


class Worker:
    """A process that serves one method; it is ended, and started again, when a goal takes too long."""

    def __init__(self, method: str) -> None:
        self.method = method
        self._process: subprocess.Popen[str] | None = None

    def ask(self, goal: int, run: int) -> Row:
        """Ask for a goal; the first one is asked twice, and the second answer counts."""
        process = self._process = self._process or _start("--serve", self.method, stdin=subprocess.PIPE)
        sent, answers = _pipe(process.stdin), _pipe(process.stdout)
        sent.write(f"{goal} {run}\n")
        sent.flush()
        # Loading and another answer come on top for the first; who keeps to the limit is done by then.
        ready, _, _ = select.select([answers], [], [], 2 * LIMIT + 30)
        line = answers.readline() if ready else ""
        if line:
            row = Row(**json.loads(line))
            return row if row.seconds <= LIMIT else replace(row, status="limit")
        process.kill()
        process.wait()
        self._process = None
        if ready:
            raise SystemExit(
                f"the process of {self.method} ended at goal {goal}: status {process.returncode}"
            )
        return Row("warm", self.method, goal, run, LIMIT, "limit")

    def close(self) -> None:
        if self._process is not None:
            _pipe(self._process.stdin).close()
            self._process.wait()


def _pipe(stream: IO[str] | None) -> IO[str]:
    assert stream is not None
    return stream


def _start(*arguments: str, stdin: int = subprocess.DEVNULL) -> subprocess.Popen[str]:
    command = [sys.executable, str(WORKER), *arguments]
    return subprocess.Popen(command, stdin=stdin, stdout=subprocess.PIPE, text=True)


def _whole(*arguments: str) -> tuple[Any, float, float]:
    """Run a process to its end; return what it said, its wall seconds, and its peak memory in MiB."""
    begun = time.perf_counter()
    process = _start(*arguments)
    said = _pipe(process.stdout).read()
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begun
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"exit status {process.returncode}: {' '.join(arguments)}")
    return json.loads(said), seconds, usage.ru_maxrss / (1 << (20 if sys.platform == "darwin" else 10))


def measure(rows: Rows, goals: Sequence[int], methods: Sequence[str], runs: int) -> None:
    """Ask every goal of every method in turn, as often as it takes."""
    workers = {method: Worker(method) for method in methods}
    for run in range(runs):
        for place, goal in enumerate(goals):
            for method, worker in workers.items():
                if rows.missing("warm", method, goal, run):
                    rows.add(worker.ask(goal, run))
            _progress(f"run {run + 1} of {runs}: {place + 1} of {len(goals)} goals")
    for worker in workers.values():
        worker.close()


def measure_whole(rows: Rows, goals: Sequence[int], methods: Sequence[str], runs: int) -> None:
    """Time whole processes, one goal each."""
    for run in range(runs):
        for place, goal in enumerate(goals):
            for method in methods:
                if rows.missing("whole", method, goal, run):
                    said, seconds, peak = _whole("--once", method, "--goal", str(goal))
                    said |= {"run": run, "seconds": seconds, "peak": max(said["peak"], peak)}
                    rows.add(Row(**said))
            _progress(f"whole processes, run {run + 1} of {runs}: {place + 1} of {len(goals)} goals")


def measure_everything(rows: Rows, runs: int) -> dict[str, list[Any]]:
    """Let clingo prove everything, one way and the other in turn; return what was said in each run."""
    said: dict[str, list[Any]] = {way: [] for way in WAYS if runs}
    for run in range(runs):
        for way, before in said.items():
            _progress(f"everything, {way}: run {run + 1} of {runs}")
            found, seconds, peak = _whole("--everything", way)
            before.append({**found, "whole": seconds, "peak": peak})
            rows.add(Row("everything", way, -1, run, found["seconds"], peak=peak))
    return said


def _everything(way: str, found: Sequence[Any]) -> Everything:
    first = found[0]
    return Everything(
        way,
        first["asked"],
        min(len(each["found"]) for each in found),
        sum(first["found"].values()),
        statistics.median(each["seconds"] for each in found),
        statistics.median(each["whole"] for each in found),
        max(each["peak"] for each in found),
    )


def _progress(text: str) -> None:
    if sys.stderr.isatty():
        print(f"\r{text}\033[K", end="", file=sys.stderr, flush=True)


def run(options: argparse.Namespace, asked: dict[str, Any]) -> int:
    """Measure, write the results, and print them in short."""
    there = {int(goal): text for goal, text in asked["goals"].items()}
    exact = [name for name in asked["methods"] if not options.methods or name in options.methods]
    greedy = [name for name in GREEDY if not options.methods or name in options.methods]
    rows = Rows(options.output.with_suffix(".jsonl"), fresh=options.fresh)
    measure(rows, list(there), [*exact, *greedy], options.runs)
    measure_whole(rows, asked["makeable"], exact, options.whole_runs)
    said = measure_everything(rows, options.everything_runs)
    rows.close()
    _progress("")
    kept = [row for row in rows if row.goal in there]
    tally = Tally.of(kept, there)
    quarrels = [*tally.disagreements, *_everything_agrees(said, tally, there)]
    result = Peers(
        asked["machine"],
        f"python benchmarks/peers.py --goals {options.goals} --runs {options.runs}"
        f" --whole-runs {options.whole_runs} --everything-runs {options.everything_runs}"
        + (f" --methods {' '.join(options.methods)}" if options.methods else ""),
        options.goals,
        len(there),
        len(asked["makeable"]),
        options.runs,
        LIMIT,
        tuple(summarise(name, kept, tally, list(there)) for name in exact),
        tuple(summarise_greedy(name, kept, tally, list(there)) for name in greedy),
        tuple(goal_row(goal, text, [*exact, *greedy], tally) for goal, text in there.items())
        if options.goals == "25"
        else (),
        tuple(_everything(way, found) for way, found in said.items()),
        tuple(quarrels),
        tuple(asked["notes"]),
    )
    result.write(options.output)
    for line in in_short(result):
        print(line)
    for quarrel in quarrels:
        print(f"DISAGREEMENT: {quarrel}", file=sys.stderr)
    return 1 if quarrels else 0


def _everything_agrees(
    said: Mapping[str, Sequence[Any]], tally: Tally, there: Mapping[int, str]
) -> Iterator[str]:
    """Yield where the two ways, or two runs of one, disagree, and where an answer to a single goal does."""
    found = [(way, each["found"]) for way, runs in said.items() for each in runs if way != MENU]
    for way, optima in found[1:]:
        first, before = found[0]
        differing = [goal for goal in optima.keys() | before.keys() if optima.get(goal) != before.get(goal)]
        if differing:
            yield f"everything: {way} and {first} disagree on {len(differing)} objects"
    for goal, text in there.items():
        best = tally.optimum(goal)
        for way, optima in found:
            if best is not None and optima.get(str(goal), best) != best:
                yield f"{text}: {best} units, but {optima[str(goal)]} when everything is proven ({way})"


def main() -> int:
    options = argparse.ArgumentParser(description="Compare clingo with its peers on the universal FOON.")
    options.add_argument("--goals", choices=("25", "sample", "all"), default="25", help="(default: 25)")
    options.add_argument("--runs", type=int, default=5, help="runs of each goal (default: 5)")
    options.add_argument(
        "--whole-runs", type=int, help="runs in whole processes (default: 3; sample, all: 0)"
    )
    options.add_argument("--everything-runs", type=int, default=3, help="runs of all objects (default: 3)")
    options.add_argument("--methods", nargs="+", choices=(*EXACT, *GREEDY), help="only these")
    options.add_argument(
        "--output", type=Path, default=OUTPUT, help="(default: benchmarks/results/peers.json)"
    )
    options.add_argument("--fresh", action="store_true", help="measure anew what the output has already")
    given = options.parse_args()
    asked, _, _ = _whole("--list", given.goals)
    if "goals" not in asked:
        print(f"nothing measured: {asked['reason']}", file=sys.stderr)
        return 0
    if given.whole_runs is None:
        given.whole_runs = 3 if given.goals == "25" else 0
    if given.methods and OURS not in given.methods:
        given.methods = [OURS, *given.methods]
    return run(given, asked)


if __name__ == "__main__":
    sys.exit(main())
