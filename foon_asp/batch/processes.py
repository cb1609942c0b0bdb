"""The processes of this machine: each opens the data and answers chunks, and one that dies is replaced."""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import threading
from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess

from foon_asp.batch.answerer import Answerer, Settings
from foon_asp.batch.query_file import Chunk
from foon_asp.batch.rows import Rows
from foon_asp.batch.tasks import Task, TaskQueue
from foon_asp.errors import FoonError, QueryError
from foon_asp.io.folder import Dataset, Sources
from foon_asp.processes import leave_with_parent

_CYCLES = 50_000
"""How many objects a process makes before Python looks for cycles among them.

A query makes many objects at once. Python would look a hundred times meanwhile.
"""


def cores() -> int:
    """Return how many processors this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def answer_here(
    sources: Sources, dataset: Dataset, settings: Settings, chunks: Iterable[Chunk]
) -> Generator[Rows, None, None]:
    """Answer chunks over data that are open, in this process, one after the other."""
    answerer = Answerer(sources, settings, dataset)
    before = gc.get_threshold()
    gc.set_threshold(_CYCLES)
    try:
        for chunk in chunks:
            yield from answerer.stream(chunk)
    finally:
        gc.set_threshold(*before)


def answer_in_processes(
    sources: Sources, settings: Settings, chunks: Iterable[Chunk], jobs: int
) -> Generator[Rows, None, None]:
    """Answer chunks in so many processes; what is ready first comes first.

    A process that dies is replaced. What is not answered of its chunk is tried again query by query, and a
    query at which a process dies again has a row that says so. Raises `QueryError` if the data cannot be
    opened.
    """
    tasks = TaskQueue(chunks)
    pool = _ProcessPool(sources, settings)
    try:
        pool.start(jobs)
        while busy := pool.busy():
            ready = wait([worker.connection for worker in busy])
            for worker in busy:
                if worker.connection in ready:
                    yield from pool.receive(worker, tasks)
            for worker in pool.idle():
                if task := tasks.next():
                    worker.send(task)
    finally:
        pool.stop()


class _ProcessPool:
    """The worker processes of a run."""

    def __init__(self, sources: Sources, settings: Settings) -> None:
        self._workers: list[_Worker] = []
        self._sources = sources
        self._settings = settings

    def start(self, count: int) -> None:
        for _ in range(count):
            self._workers.append(_Worker(self._sources, self._settings))

    def stop(self) -> None:
        for worker in self._workers:
            worker.stop()

    def busy(self) -> list[_Worker]:
        """Return the workers that open the data or have a task."""
        return [worker for worker in self._workers if worker.opening or worker.task]

    def idle(self) -> list[_Worker]:
        """Return the workers that wait for a task; those that died over their waiting are replaced."""
        for worker in [each for each in self._workers if not each.opening and not each.alive()]:
            if worker.task is None:
                self._replace(worker)
        return [worker for worker in self._workers if not worker.opening and worker.task is None]

    def receive(self, worker: _Worker, tasks: TaskQueue) -> Iterator[Rows]:
        """Yield the rows that a worker has ready; replace it if it died."""
        try:
            message = worker.receive()
        except (EOFError, OSError):
            if worker.opening:
                raise QueryError(
                    f"a process died while it opened the data ({worker.exit_reason()}); is there enough"
                    " memory? Run fewer at once with --jobs"
                ) from None
            self._replace(worker)
            message = tasks.failed(worker.task) if worker.task else []
        if isinstance(message, str):
            raise QueryError(message)
        if message:
            yield message

    def _replace(self, worker: _Worker) -> None:
        worker.stop()
        self._workers[self._workers.index(worker)] = _Worker(self._sources, self._settings)


class _Worker:
    """A process with its own copy of the data, seen from here. It does one chunk at a time."""

    def __init__(self, sources: Sources, settings: Settings) -> None:
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self._process: SpawnProcess = context.Process(
            target=_work, args=(theirs, sources, settings), name="foon-asp batch", daemon=True
        )
        with _interrupts_ignored():
            self._process.start()
        theirs.close()
        self.opening = True
        self.task: Task | None = None

    def send(self, task: Task) -> None:
        """Give it a task to answer."""
        self.task = task
        # If it has just died, receiving says so.
        with suppress(OSError):
            self.connection.send(task.chunk)

    def receive(self) -> Rows | str:
        """Return rows, none once the data are open, or what is wrong with the data.

        Raises `EOFError` or `OSError` if the process died; `task` is then what it did not answer.
        """
        message: Rows | str = self.connection.recv()
        self.opening = False
        if self.task is not None:
            left = self.task.chunk[len(message) :]
            self.task = replace(self.task, chunk=left) if left else None
        return message

    def alive(self) -> bool:
        """Whether the process still runs."""
        return self._process.is_alive()

    def exit_reason(self) -> str:
        """Return why the process ended: a signal, or an exit status."""
        self._process.join(5)
        code = self._process.exitcode or 0
        return f"signal {-code}" if code < 0 else f"exit status {code}"

    def stop(self) -> None:
        """End the process, whatever it is at."""
        self._process.kill()
        self._process.join()
        self._process.close()
        self.connection.close()


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Let processes that are started ignore Ctrl-C, which reaches all of them: the first one stops them."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _work(connection: Connection, sources: Sources, settings: Settings) -> None:
    """Open the data, then answer chunks until nobody sends any."""
    leave_with_parent()
    with suppress(EOFError, OSError):
        try:
            answerer = Answerer(sources, settings)
        except FoonError as error:
            connection.send(str(error))
            return
        connection.send([])
        gc.set_threshold(_CYCLES)
        while True:
            for rows in answerer.stream(connection.recv()):
                connection.send(rows)
