"""A disk that is full and a folder that is read-only: one clear line, and what was there is as it was."""

from __future__ import annotations

import ctypes
import os
import resource
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from drill.commands import Command, commands, restore
from drill.part import Outcome, Span, rate
from support.batch_runs import program
from support.writers import snapshot

_PR_CAPBSET_DROP = 24
_CAPABILITIES = (1, 2, 3)
"""What lets root write and read all the same: CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH, CAP_FOWNER."""


def bad_disks(span: Span) -> Outcome:
    """Run each command with room for a part of what it writes only, and in a folder that it may not write."""
    outcome = Outcome()
    done, begun = 0, time.monotonic()
    with tempfile.TemporaryDirectory(prefix="drill-") as name:
        folder = Path(name)
        for command in commands(folder, 2):
            largest = max(map(len, command.behind.values()))
            for size in (0, largest // 2, largest - 1):
                problem = _full(command, folder, size)
                if problem:
                    outcome.failures.append(f"{command.name}, room for {size} bytes: {problem}")
                done += 1
            problem = _read_only(command, folder)
            if problem:
                outcome.failures.append(f"{command.name}, read-only: {problem}")
            done += 1
            if not span.goes_on(done):
                break
    outcome.lines = [rate("bad disks", done, time.monotonic() - begun)]
    return outcome


def _full(command: Command, folder: Path, size: int) -> str | None:
    """Play a full disk by a limit on the size of files."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    restore(folder / "out", command.before)
    problem = _refused(command, folder, limit)
    if problem is None and command.run(folder).returncode:
        return "it cannot be run again"
    if problem is None and snapshot(folder / "out") != command.behind:
        return "run again, it writes something else"
    return problem


def _read_only(command: Command, folder: Path) -> str | None:
    out = folder / "out"
    restore(out, command.before)
    inside = [path for path in out.rglob("*") if path.is_dir()]
    for path in (out, *inside):
        path.chmod(0o555)
    try:
        return _refused(command, folder, _no_privileges)
    finally:
        for path in (out, *inside):
            path.chmod(0o755)


def _no_privileges() -> None:
    """Let root be refused what others are."""
    if os.geteuid() == 0:
        for number in _CAPABILITIES:
            ctypes.CDLL(None).prctl(_PR_CAPBSET_DROP, number, 0, 0, 0)


def _refused(command: Command, folder: Path, before: Callable[[], None]) -> str | None:
    """Run a command that must be refused in one line, and change nothing."""
    done = subprocess.run(
        program(*command.words),
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        timeout=120,
        preexec_fn=before,
        check=False,
    )
    if done.returncode != 2 or "Traceback" in done.stderr or "cannot be written" not in done.stderr:
        return f"status {done.returncode}: {done.stderr[-1500:]}"
    left = {name: data for name, data in snapshot(folder / "out").items() if ".partial" not in name}
    return None if left == command.before else f"left behind: {sorted(left)}"
