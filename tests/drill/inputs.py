"""Mutated inputs over all readers, in process, on all cores; the seed alone says which."""

from __future__ import annotations

import multiprocessing
import signal
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random
from types import FrameType
from typing import NoReturn

from drill.part import Outcome, Span, fast_folder, rate
from drill.readers import Reader, readers
from foon_asp.errors import FoonError

_MEGABYTE = 1_000_000
_STUCK = 60
"""Seconds after which an input is given up."""
_SHOWN = 10
_CURRENT = "current"
"""The file that holds the input that is being read; what kills the process is found there."""


class StuckError(BaseException):
    """An input takes so long that it is given up."""


def mutated_inputs(span: Span) -> Outcome:
    """Try inputs until the time is over or each process has had so many turns of all readers."""
    context = multiprocessing.get_context("spawn")
    outcome = Outcome()
    total: Counter[str] = Counter()
    spent: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="drill-", dir=fast_folder()) as folder:
        workers = []
        for job in range(span.jobs):
            receiver, sender = context.Pipe(duplex=False)
            home = Path(folder, str(job))
            home.mkdir()
            process = context.Process(target=_work, args=(span, job, home, sender))
            process.start()
            sender.close()
            workers.append((process, receiver, home))
        for process, receiver, home in workers:
            try:
                counts, seconds, failures = receiver.recv()
            except EOFError:
                process.join()
                data = (home / _CURRENT).read_bytes()[:2000]
                outcome.failures.append(f"a process ended with {process.exitcode} at the input {data!r}")
                continue
            process.join()
            total.update(counts)
            spent.update(seconds)
            outcome.failures += failures
    busy = sum(spent.values()) / span.jobs
    outcome.lines = [rate(name, count, spent[name] / span.jobs) for name, count in total.items()]
    outcome.lines.append(rate("all readers", total.total(), busy))
    return outcome


def _work(span: Span, job: int, folder: Path, sender: Connection) -> None:
    """Take turns over all readers; each process has every so many of the inputs."""
    counts: Counter[str] = Counter()
    spent: dict[str, float] = {}
    failures: list[str] = []
    tried = readers(folder)
    signal.signal(signal.SIGALRM, _give_up)
    turn = 0
    while span.goes_on(turn) and len(failures) < _SHOWN:
        for name, reader in tried.items():
            begun = time.monotonic()
            for number in range(turn * reader.turn, (turn + 1) * reader.turn):
                label = f"{span.seed}/{name}/{number * span.jobs + job}"
                failures += filter(None, [try_input(reader, label, folder / _CURRENT)])
                counts[name] += 1
            spent[name] = spent.get(name, 0.0) + time.monotonic() - begun
        turn += 1
    sender.send((counts, spent, failures))


def _give_up(_number: int, _frame: FrameType | None) -> NoReturn:
    raise StuckError


@contextmanager
def _patient() -> Iterator[None]:
    signal.alarm(_STUCK)
    try:
        yield
    finally:
        signal.alarm(0)


def try_input(reader: Reader, label: str, path: Path) -> str | None:
    """Have an input read that the label draws; return what went wrong."""
    data = reader.draw(Random(label))
    if reader.filed:
        path.write_bytes(data)
    begun = time.process_time()
    try:
        with _patient():
            reader.read(data, path)
    except FoonError:
        pass
    except (Exception, StuckError):
        return f"{label}: {traceback.format_exc(limit=-4)}\ninput: {data[:2000]!r}"
    seconds = time.process_time() - begun
    if seconds > reader.seconds + len(data) / _MEGABYTE:
        return f"{label}: {seconds:.1f} s for {len(data):,} bytes: {data[:300]!r}"
    return None
