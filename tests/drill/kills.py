"""Signals at random moments: the old file or the new one, never half; and no process is left."""

from __future__ import annotations

import os
import secrets
import shutil
import signal
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from random import Random

import psutil

from drill.commands import Command, commands, restore
from drill.part import Outcome, Span, rate
from support.batch_runs import program
from support.writers import snapshot

_SIGNALS = {signal.SIGKILL: {-9}, signal.SIGTERM: {143, -15}, signal.SIGINT: {130, -2}}
"""How a command may end; by a negative one where nothing of the program runs yet."""

_MARK = "FOON_ASP_DRILL"
_PATIENCE = 20.0
"""Seconds that a command and all it has started have to end."""


@dataclass(frozen=True, slots=True)
class Ended:
    """How a command ended that got a signal, and what was left of it."""

    status: int
    err: str
    left: list[str]

    def problem(self, number: signal.Signals) -> str | None:
        if self.left:
            return f"processes are left: {self.left}"
        if self.status == 0 or (self.status in _SIGNALS[number] and "Traceback" not in self.err):
            return None
        if number == signal.SIGINT and "KeyboardInterrupt" in self.err and not self.started:
            return None
        return f"status {self.status}: {self.err[-1500:]}"

    @property
    def started(self) -> bool:
        """Whether anything of the program ran: what comes before is Python's own."""
        return "start.py" in self.err and " in _run" in self.err


def disturbed(words: tuple[object, ...], folder: Path, number: signal.Signals, moment: float) -> Ended:
    """Run a command, and send it a signal after so many seconds."""
    mark = secrets.token_hex(8)
    with subprocess.Popen(
        program(*words),
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={**os.environ, _MARK: mark},
    ) as process:
        with suppress(subprocess.TimeoutExpired):
            process.wait(moment)
        process.send_signal(number)
        try:
            _, err = process.communicate(timeout=_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            return Ended(process.wait(), "it did not end", left_behind(mark, 0))
    return Ended(process.returncode, err, left_behind(mark, _PATIENCE))


def left_behind(mark: str, seconds: float) -> list[str]:
    """Wait until all is gone that was started with a mark; end what is not, and return it."""
    end = time.monotonic() + seconds
    while found := _marked(mark):
        if time.monotonic() > end:
            for process in found:
                with suppress(psutil.Error):
                    process.kill()
            return [f"{process}" for process in found]
        time.sleep(0.05)
    return []


def _marked(mark: str) -> list[psutil.Process]:
    found = []
    for process in psutil.process_iter():
        with suppress(psutil.Error, OSError):
            if process.status() != psutil.STATUS_ZOMBIE and process.environ().get(_MARK) == mark:
                found.append(process)
    return found


def kills(span: Span) -> Outcome:
    """Disturb the commands that write."""
    with tempfile.TemporaryDirectory(prefix="drill-") as name:
        homes = [Path(name, str(job)) for job in range(span.jobs)]
        for home in homes[:1]:
            home.mkdir()
        tried = list(islice(commands(homes[0], 4 if span.rounds is None else 1), span.rounds))
        for home in homes[1:]:
            shutil.copytree(homes[0], home)
        begun = time.monotonic()
        with ThreadPoolExecutor(span.jobs) as pool:
            parts = list(pool.map(lambda job: _disturb_all(span, job, homes[job], tried), range(span.jobs)))
    outcome = Outcome()
    for _, failures in parts:
        outcome.failures += failures
    outcome.lines = [rate("kills", sum(done for done, _ in parts), time.monotonic() - begun)]
    return outcome


def _disturb_all(span: Span, job: int, folder: Path, tried: list[Command]) -> tuple[int, list[str]]:
    done, failures = 0, []
    while span.goes_on(done):
        random = Random(f"{span.seed}/{done}/{job}")
        command, number = tried[done % len(tried)], random.choice(list(_SIGNALS))
        moment = random.uniform(0, 1.1 * command.seconds)
        problem = _disturb(command, folder, number, moment)
        if problem:
            failures.append(f"{command.name}, {number.name} after {moment:.3f} s: {problem}")
        done += 1
    return done, failures


def _disturb(command: Command, folder: Path, number: signal.Signals, moment: float) -> str | None:
    """Disturb a command once, and run it again; return what was wrong."""
    out = folder / "out"
    restore(out, command.before)
    ended = disturbed(command.words, folder, number, moment)
    found = snapshot(out)
    problem = ended.problem(number) or _unlike(command, ended, found, number)
    if problem or found == command.behind:
        return problem
    again = command.run(folder)
    if again.returncode or "Traceback" in again.stderr:
        return f"run again: status {again.returncode}: {again.stderr}"
    if snapshot(out) != command.behind:
        return f"run again: {_difference(snapshot(out), command.behind)}"
    return None


def _unlike(command: Command, ended: Ended, found: dict[str, bytes], number: signal.Signals) -> str | None:
    """Say what is neither as it was before nor as it is behind."""
    plain = {name: data for name, data in found.items() if not _unfinished(name)}
    if ended.status == 0:
        return None if found == command.behind else f"done, and {_difference(found, command.behind)}"
    if plain not in (command.before, command.behind):
        return f"half: {_difference(plain, command.before)}"
    # A journal is what a batch goes on from.
    if number != signal.SIGKILL and plain != found and not command.resumes:
        return f"left behind: {sorted(set(found) - set(plain))}"
    return None


def _unfinished(name: str) -> bool:
    return name.startswith(".") or ".partial" in name


def _difference(found: dict[str, bytes], wanted: dict[str, bytes]) -> str:
    names = [name for name in sorted({*found, *wanted}) if found.get(name) != wanted.get(name)]
    return ", ".join(f"{name}: {len(found.get(name, b''))} bytes" for name in names)


def planners(span: Span) -> Outcome:
    """Disturb a planner at work, by signals to the command."""
    words = ("plan", "greek salad", "--engine", "fast-downward-opt", "--by", "success")
    outcome = Outcome()
    done, begun = 0, time.monotonic()
    with tempfile.TemporaryDirectory(prefix="drill-") as folder:
        while span.goes_on(done):
            random = Random(f"{span.seed}/planners/{done}")
            number, moment = random.choice(list(_SIGNALS)), random.uniform(0.5, 5)
            problem = disturbed(words, Path(folder), number, moment).problem(number)
            if problem:
                outcome.failures.append(f"plan, {number.name} after {moment:.3f} s: {problem}")
            done += 1
    outcome.lines = [rate("planners killed", done, time.monotonic() - begun)]
    return outcome
