"""What answers the queries of a batch: the data, opened once, and the processes of this machine."""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import signal
import threading
import time
from collections import OrderedDict, deque
from collections.abc import Collection, Generator, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from pathlib import Path

from foon_asp.batch_file import Chunk, Line, Named, Query, query_id, read_line, read_query
from foon_asp.builder import FoonBuilder
from foon_asp.dataset import Dataset, foon_files, load
from foon_asp.errors import FoonError, InternalError, QueryError, closest
from foon_asp.files import MANIFEST, is_store, read_bytes
from foon_asp.goals import find_on_level
from foon_asp.graph import ObjectNode
from foon_asp.levels import FULL
from foon_asp.problem import Domain
from foon_asp.render.batch import row_bytes, row_value
from foon_asp.resources import built_in_data
from foon_asp.retrieve import Retrieval, retrieve

Rows = list[bytes]
"""The answers to a chunk, one JSON line for each query, in its order."""

DIED = "the process that answered this query died"

_DOMAINS = 4
"""How many kitchens a worker keeps beside that of the data; each holds what can be made from it."""

_SOON = 0.2
"""Seconds after which answers are passed on, though their chunk is not done."""

_GOALS = 10_000
"""How many goal texts a kitchen remembers."""


@dataclass(frozen=True, slots=True)
class Sources:
    """The files of a run, and how they are read.

    `shown` are paths as results name them, where they are opened by another name.
    """

    folder: str
    foon: tuple[str, ...]
    kitchen: str | None = None
    rates: str | None = None
    utensils: str | None = None
    goals: str | None = None
    default_rate: float | None = None
    strict_format: bool = False
    strict: bool = False
    level: int = FULL
    shown: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(
        cls,
        folder: str | None = None,
        *,
        foon: Sequence[str] = (),
        kitchen: str | None = None,
        rates: str | None = None,
        utensils: str | None = None,
        default_rate: float | None = None,
        strict_format: bool = False,
        strict: bool = False,
        level: int = FULL,
    ) -> Sources:
        """Find the files that `dataset.load` would read; raise `InputError` if there is no FOON."""
        root = built_in_data() if folder is None else Path(folder)
        paths = list(foon) or [str(path) for path in foon_files(root)]
        if not paths or not root.is_dir():
            load(folder, foon=foon)  # It knows what to say.
        return cls(
            str(root),
            tuple(paths),
            kitchen or _there(root / "kitchen.json"),
            rates or _there(root / "motion.txt"),
            utensils or _there(root / "utensils.txt"),
            _there(root / "goal_nodes.json"),
            default_rate,
            strict_format,
            strict,
            level,
        )

    @property
    def beside(self) -> dict[str, str]:
        """The files that are read beside the FOON, by the names they have in a data folder."""
        named = {
            "kitchen.json": self.kitchen,
            "motion.txt": self.rates,
            "utensils.txt": self.utensils,
            "goal_nodes.json": self.goals,
        }
        return {name: path for name, path in named.items() if path is not None}

    def digest(self) -> str:
        """Return a hash of all that the answers depend on; raise `InputError` for a missing file.

        A compiled store is known by its manifest, which has the checksums of its tables.
        """
        hashes = [[path, _hash(Path(path))] for path in self.foon]
        hashes += [[name, _hash(Path(path))] for name, path in self.beside.items()]
        shown = dict(self.shown)
        named = [[shown.get(path, path), found] for path, found in hashes]
        settings = [self.default_rate, self.strict_format, self.strict, self.level]
        return hashlib.sha256(json.dumps([named, settings]).encode()).hexdigest()

    def absolute(self) -> Sources:
        """Return the same files by names that mean the same in any folder; results keep the old ones."""
        foon = tuple(str(Path(path).absolute()) for path in self.foon)
        return replace(
            self,
            folder=str(Path(self.folder).absolute()),
            foon=foon,
            kitchen=_absolute(self.kitchen),
            rates=_absolute(self.rates),
            utensils=_absolute(self.utensils),
            goals=_absolute(self.goals),
            shown=tuple(pair for pair in zip(foon, self.foon, strict=True) if pair[0] != pair[1]),
        )

    def load(self) -> Dataset:
        """Read all files; raise `InputError`."""
        return load(
            self.folder,
            foon=self.foon,
            kitchen=self.kitchen,
            rates=self.rates,
            utensils=self.utensils,
            goals=self.goals,
            default_rate=self.default_rate,
            strict_format=self.strict_format,
        )


def _there(path: Path) -> str | None:
    return str(path) if path.exists() else None


def _absolute(path: str | None) -> str | None:
    return None if path is None else str(Path(path).absolute())


def _hash(path: Path) -> str:
    return hashlib.sha256(read_bytes(path / MANIFEST if is_store(path) else path)).hexdigest()


@dataclass(frozen=True, slots=True)
class Settings:
    """What holds for every query of a run: a time limit where it has none, and whether rows have seconds."""

    time_limit: float | None = None
    timings: bool = False


class _View:
    """A domain, and the goals that were looked up in it."""

    def __init__(self, domain: Domain, dataset: Dataset) -> None:
        self.domain = domain
        self._dataset = dataset
        self._found: dict[str, ObjectNode] = {}

    def node(self, named: Named) -> ObjectNode:
        """Return the object that is named, on the level of the domain; raise `QueryError`."""
        if isinstance(named, ObjectNode):
            return self.domain.project(named)
        node = self._found.get(named)
        if node is None:
            if len(self._found) >= _GOALS:
                self._found.clear()
            node = find_on_level(self.domain, named, self._dataset.goals, self._full)
            self._found[named] = node
        return node

    def _full(self) -> Domain:
        return self._dataset.domain(strict=self.domain.strict)


class Desk:
    """The data, opened once, and the answers to queries over it. Threads may share it."""

    def __init__(self, sources: Sources, settings: Settings) -> None:
        self.dataset = sources.load()
        self._settings = settings
        self._base = _View(self.dataset.domain(strict=sources.strict, level=sources.level), self.dataset)
        kitchen = self._base.domain.kitchen
        self._stock = dict.fromkeys(kitchen.objects)
        # A FOON that knows nothing: here a text can only mean what is in the kitchen.
        self._shelf = _View(Domain(FoonBuilder().build(), kitchen), self.dataset)
        self._views: OrderedDict[frozenset[ObjectNode], _View] = OrderedDict()
        self._lock = threading.Lock()
        self._renamed = [
            (json.dumps(real, ensure_ascii=False)[1:-1], json.dumps(given, ensure_ascii=False)[1:-1])
            for real, given in sources.shown
        ]

    def answer(self, chunk: Iterable[Line]) -> Rows:
        """Answer each query of a chunk; what is wrong with one is said in its row."""
        return [self._row(number, line) for number, line in chunk]

    def answer_soon(self, chunk: Iterable[Line]) -> Iterator[Rows]:
        """Answer each query of a chunk, and keep no answer back for long while others take their time."""
        rows: Rows = []
        told = time.monotonic()
        for line in chunk:
            rows += self.answer([line])
            if time.monotonic() - told > _SOON:
                yield rows
                rows, told = [], time.monotonic()
        if rows:
            yield rows

    def _row(self, number: int, line: bytes) -> bytes:
        name: str | int | float | None = None
        result: Retrieval | str
        try:
            value = read_line(line)
            name = query_id(value)
            result = self._retrieve(read_query(value))
        except FoonError as error:
            result = str(error)
        except InternalError as error:
            result = f"internal error, please report it: {error}"
        except Exception as error:  # Whatever it is, it must not end the other queries.
            result = f"internal error, please report it: {type(error).__name__}: {error}"
        row = row_bytes(row_value(number, name, result, timings=self._settings.timings))
        for real, given in self._renamed:
            row = row.replace(real.encode(), given.encode())
        return row

    def _retrieve(self, query: Query) -> Retrieval:
        view = self._view(query)
        limit = self._settings.time_limit if query.time_limit is None else query.time_limit
        return retrieve(
            view.domain,
            [view.node(goal) for goal in query.goals],
            query.method,
            query.by,
            founded=not query.reference,
            time_limit=limit,
            constraints=query.constraints,
        )

    def _view(self, query: Query) -> _View:
        """Return the FOON seen from the kitchen of a query, one of the last few if it was among them."""
        if query.kitchen is None and not query.add and not query.remove:
            return self._base
        objects = frozenset(self._objects(query))
        if objects == self._stock.keys():
            return self._base
        with self._lock:
            view = self._views.get(objects)
            if view is None:
                view = self._views[objects] = _View(self._seen_from(objects), self.dataset)
            self._views.move_to_end(objects)
            if len(self._views) > _DOMAINS:
                self._views.popitem(last=False)
            return view

    def _objects(self, query: Query) -> Collection[ObjectNode]:
        """Return what the kitchen of a query has."""
        if query.kitchen is not None:
            return [self._base.node(named) for named in query.kitchen]
        objects = self._stock.copy()
        for named in query.remove:
            objects.pop(self._at_hand(named), None)
        return objects | dict.fromkeys(self._base.node(named) for named in query.add)

    def _seen_from(self, objects: Iterable[ObjectNode]) -> Domain:
        """Return the FOON seen from another kitchen; the order of its objects makes no difference."""
        return self._base.domain.with_stock(sorted(objects, key=lambda node: node.sort_key))

    def _at_hand(self, named: Named) -> ObjectNode:
        """Return the object of the kitchen that is named; raise `QueryError` if it has none."""
        if isinstance(named, str):
            try:
                return self._shelf.node(named)
            except QueryError as error:
                raise QueryError(f"nothing of the kitchen can be removed by this name: {error}") from None
        node = self._base.node(named)
        if node not in self._stock:
            raise QueryError(
                f"the kitchen has no {node} to remove{closest(str(node), map(str, self._stock))}"
            )
        return node


def cores() -> int:
    """Return how many processors this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def answer_here(sources: Sources, settings: Settings, chunks: Iterable[Chunk]) -> Generator[Rows, None, None]:
    """Answer chunks in this process, one after the other."""
    desk = Desk(sources, settings)
    for chunk in chunks:
        yield from desk.answer_soon(chunk)


def answer_in_processes(
    sources: Sources, settings: Settings, chunks: Iterable[Chunk], jobs: int
) -> Generator[Rows, None, None]:
    """Answer chunks in so many processes; what is ready first comes first.

    A process that dies is replaced. What is not answered of its chunk is tried again query by query, and a
    query at which a process dies again has a row that says so. Raises `QueryError` if the data cannot be
    opened.
    """
    queue = TaskQueue(chunks)
    crew = _Crew(sources, settings)
    try:
        crew.hire(jobs)
        while busy := [worker for worker in crew.workers if worker.opening or worker.task]:
            ready = wait([worker.connection for worker in busy])
            for worker in busy:
                if worker.connection in ready:
                    yield from crew.hear(worker, queue)
            for worker in crew.idle():
                if task := queue.next():
                    worker.send(task)
    finally:
        crew.stop()


@dataclass(frozen=True, slots=True)
class Task:
    """A chunk to answer. A suspect is a single query of a chunk at which a process died."""

    chunk: Chunk
    suspect: bool = False


class TaskQueue:
    """Chunks that are not given out yet; suspects come first."""

    def __init__(self, chunks: Iterable[Chunk]) -> None:
        self._chunks = iter(chunks)
        self._suspects: deque[Task] = deque()

    @property
    def suspects(self) -> bool:
        """Whether a suspect waits."""
        return bool(self._suspects)

    def next(self) -> Task | None:
        """Return a task, or None if there is none."""
        if self._suspects:
            return self._suspects.popleft()
        chunk = next(self._chunks, None)
        return None if chunk is None else Task(chunk)

    def suspect(self, chunk: Chunk) -> None:
        self._suspects.extend(Task((line,), suspect=True) for line in chunk)


class _Crew:
    """The processes of a run."""

    def __init__(self, sources: Sources, settings: Settings) -> None:
        self.workers: list[_Worker] = []
        self._sources = sources
        self._settings = settings

    def hire(self, count: int) -> None:
        for _ in range(count):
            self.workers.append(_Worker(self._sources, self._settings))

    def stop(self) -> None:
        for worker in self.workers:
            worker.stop()

    def idle(self) -> list[_Worker]:
        """Return the workers that wait for a task; those that died over their waiting are replaced."""
        for worker in [each for each in self.workers if not each.opening and not each.alive()]:
            if worker.task is None:
                self._replace(worker)
        return [worker for worker in self.workers if not worker.opening and worker.task is None]

    def hear(self, worker: _Worker, queue: TaskQueue) -> Iterator[Rows]:
        """Yield what a worker has to say, or replace it if it died."""
        try:
            message = worker.receive()
        except (EOFError, OSError):
            if worker.opening:
                raise QueryError(
                    f"a process died while it opened the data ({worker.fate()}); is there enough memory?"
                    " Run fewer at once with --jobs"
                ) from None
            task = worker.task
            self._replace(worker)
            if task is not None and task.suspect:
                yield [died(line) for line in task.chunk]
            elif task is not None:
                queue.suspect(task.chunk)
            return
        if isinstance(message, str):
            raise QueryError(message)
        if message:
            yield message

    def _replace(self, worker: _Worker) -> None:
        worker.stop()
        self.workers[self.workers.index(worker)] = _Worker(self._sources, self._settings)


def died(line: Line) -> bytes:
    """Return the row of a query whose process died."""
    number, text = line
    name = None
    with suppress(FoonError):
        name = query_id(read_line(text))
    return row_bytes(row_value(number, name, DIED, timings=False))


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
        self.task = task
        # If it has just died, receiving says so.
        with suppress(OSError):
            self.connection.send(task.chunk)

    def receive(self) -> Rows | str:
        """Return rows, none once the data are open, or what is wrong with the data."""
        message: Rows | str = self.connection.recv()
        self.opening = False
        if self.task is not None:
            left = self.task.chunk[len(message) :]
            self.task = replace(self.task, chunk=left) if left else None
        return message

    def alive(self) -> bool:
        return self._process.is_alive()

    def fate(self) -> str:
        self._process.join(5)
        code = self._process.exitcode or 0
        return f"signal {-code}" if code < 0 else f"exit status {code}"

    def stop(self) -> None:
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
    threading.Thread(target=_leave_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):
        try:
            desk = Desk(sources, settings)
        except FoonError as error:
            connection.send(str(error))
            return
        connection.send([])
        while True:
            for rows in desk.answer_soon(connection.recv()):
                connection.send(rows)


def _leave_with_parent() -> None:
    """End this process when the one that started it ends, however that is."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
