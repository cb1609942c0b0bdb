"""`python -m drill`, with tests/ on the path: all parts of the drill, one after the other."""

from __future__ import annotations

import argparse
import os
import sys
import time

from drill.cluster import deaths
from drill.damage import damaged_stores
from drill.disk import bad_disks
from drill.inputs import mutated_inputs
from drill.kills import kills, planners
from drill.memory import warm_questions
from drill.part import Part, Span

SECONDS = 300
"""How long the whole takes by default."""

PARTS: dict[str, tuple[Part, float]] = {
    "inputs": (mutated_inputs, 0.27),
    "stores": (damaged_stores, 0.18),
    "kills": (kills, 0.2),
    "disks": (bad_disks, 0.1),
    "memory": (warm_questions, 0.13),
    "planners": (planners, 0.06),
    "cluster": (deaths, 0.06),
}
"""Each part, and its share of the time."""


def main() -> int:
    """Run the parts; 1 if anything failed."""
    options = _options()
    failed = 0
    for name in options.parts or PARTS:
        part, share = PARTS[name]
        begun = time.monotonic()
        alone = len(options.parts) == 1
        seconds = SECONDS * options.times * (1 if alone else share)
        outcome = part(Span.of(options.seed, seconds, jobs=options.jobs))
        print(f"{name}: {time.monotonic() - begun:.0f} s, failures: {len(outcome.failures)}")
        print("".join(f"  {line}\n" for line in outcome.lines), end="", flush=True)
        for failure in outcome.failures:
            print(f"  FAILED {failure}", flush=True)
        failed += len(outcome.failures)
    return 1 if failed else 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="drill", description=__doc__)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"some of {', '.join(PARTS)}; default: all")
    parser.add_argument("--times", type=float, default=1.0, help="how many times five minutes (default: 1)")
    parser.add_argument(
        "--seed", type=int, default=int(time.time()), help="what is tried (default: the time)"
    )
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count() or 1, help="processes (default: all cores)"
    )
    options = parser.parse_args()
    if unknown := set(options.parts) - PARTS.keys():
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    print(f"seed {options.seed}", flush=True)
    return options


if __name__ == "__main__":
    sys.exit(main())
