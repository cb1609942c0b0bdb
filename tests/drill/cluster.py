"""Deaths of Dask workers and of the scheduler: their tests, again and again."""

from __future__ import annotations

import os
import subprocess
import sys
import time

from drill.part import Outcome, Span, rate
from support.paths import ROOT

_TESTS = "killed_worker or query_that_kills"


def deaths(span: Span) -> Outcome:
    """Run the tests of deaths until the time is over."""
    outcome = Outcome()
    done, begun = 0, time.monotonic()
    while span.goes_on(done) and not outcome.failures:
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-p",
            "no:cacheprovider",
            "tests/system/test_cluster.py",
        ]
        run = subprocess.run(
            [*command, "-k", _TESTS],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ},
        )
        if run.returncode:
            outcome.failures.append(run.stdout[-3000:])
        done += 1
    outcome.lines = [rate("cluster deaths", done * 2, time.monotonic() - begun)]
    return outcome
