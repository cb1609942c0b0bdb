"""Run the benchmarks and write benchmarks/RESULTS.md.

    python benchmarks/run.py [SECTION …] [--quick]

Sections: commands (whole processes), peers (the 25 public goals), peers-sample (every 30th object that can be
made), peers-all (all of them, by the methods that take milliseconds), configurations, growth, throughput,
report; the default is all of these. The report is always written at the end. `--quick` measures every section
on a small scale, to see that it works.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent


def _more_peers(goals: str, *options: str) -> list[str]:
    out = str(HERE / "results" / f"peers-{goals}.json")
    once = ["--runs", "1", "--whole-runs", "0", "--everything-runs", "0"]
    return ["peers.py", "--goals", goals, *once, *options, "--output", out]


_QUICKEST = (
    *("clingo", "clingo-unreduced", "cp-sat", "cp-sat-reduced"),
    *("integer-program", "integer-program-reduced"),
)
SECTIONS = {
    "commands": ["retrieval.py", "--write"],
    "growth": ["growth.py"],
    "throughput": ["throughput.py"],
    "configurations": ["configurations.py"],
    "peers": ["peers.py", "--goals", "25"],
    "peers-sample": _more_peers("sample"),
    "peers-all": _more_peers("all", "--methods", *_QUICKEST),
}
QUICK = {
    "commands": ["--runs", "1"],
    "growth": ["--sizes", "1000", "--runs", "1", "--goals", "10"],
    "throughput": ["--units", "1000"],
    "configurations": ["--sample", "2", "--only", "bb", "usc,oll,stratify"],
    "peers": ["--runs", "1", "--whole-runs", "0", "--everything-runs", "0"],
    "peers-sample": ["--methods", "clingo", "cp-sat", "cp-sat-reduced"],
    "peers-all": ["--methods", "clingo"],
}
USUAL = ("commands", "peers", "peers-sample", "peers-all", "configurations", "growth", "throughput")


def main() -> int:
    parser = argparse.ArgumentParser(description="Run the benchmarks and write benchmarks/RESULTS.md.")
    parser.add_argument("sections", nargs="*", metavar="SECTION", help=", ".join([*SECTIONS, "report"]))
    parser.add_argument("--quick", action="store_true", help="on a small scale, to see that it works")
    options = parser.parse_args()
    sections = options.sections or list(USUAL)
    unknown = [name for name in sections if name not in SECTIONS and name != "report"]
    if unknown:
        parser.error(f"unknown section {unknown[0]!r}; there are {', '.join([*SECTIONS, 'report'])}")
    worst = 0
    for name in [*(name for name in sections if name != "report"), "report"]:
        arguments = SECTIONS.get(name, ["report.py"]) + (QUICK.get(name, []) if options.quick else [])
        begun = time.perf_counter()
        status = subprocess.run(
            [sys.executable, str(HERE / arguments[0]), *arguments[1:]], check=False
        ).returncode
        print(f"{name}: {time.perf_counter() - begun:.0f} s, exit status {status}", flush=True)
        worst = max(worst, abs(status))
    return worst


if __name__ == "__main__":
    sys.exit(main())
