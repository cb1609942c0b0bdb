"""Many queries on a Dask cluster: the data reach each worker once, and chunks survive workers that die."""

# Dask has types in some places only.
# mypy: allow-untyped-calls

from __future__ import annotations

import logging
import shutil
import threading
import time
import uuid
from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from distributed import Client, Future, KilledWorker, Worker, WorkerPlugin, as_completed, get_worker
from distributed import TimeoutError as DaskTimeoutError
from distributed.comm.addressing import get_address_host_port

from foon_asp.batch.answerer import Answerer, Settings
from foon_asp.batch.digest import digest
from foon_asp.batch.query_file import Chunk
from foon_asp.batch.rows import Rows
from foon_asp.batch.tasks import Task, TaskQueue
from foon_asp.errors import FoonError, InputError, QueryError
from foon_asp.io import atomic
from foon_asp.io.files import read_bytes
from foon_asp.io.folder import Sources
from foon_asp.resources import program_version
from foon_asp.values import said

_CONNECT = 5
"""Seconds to wait for the scheduler."""

_FIRST_WORKER = 15
"""Seconds to wait for a worker."""

_AHEAD = 2
"""How many chunks a worker has for each of its threads: one at work, the others at hand."""

_REFUSALS = 100
"""How often workers may lack data that were sent: some join while they are on the way."""

_ON_THE_WAY, _MOMENT = 600.0, 0.05
"""Seconds that a query waits for the data to be written where it is, and after which it looks again."""

_COUNTED = 2.0
"""Seconds after which the workers are counted again: they come and go."""


class DataElsewhereError(Exception):
    """A worker has no data, or other data, where the coordinator has them."""


class DataUnreadableError(Exception):
    """A worker has the data and cannot open them."""


@dataclass(frozen=True, slots=True)
class Scheduler:
    """A Dask scheduler: its address, and whether data are sent to its workers wherever they lie."""

    address: str
    ship: bool = False


def answer_on_cluster(
    sources: Sources, settings: Settings, chunks: Iterable[Chunk], scheduler: Scheduler
) -> Generator[Rows, None, None]:
    """Answer chunks on the workers of a scheduler; what is ready first comes first.

    Workers open the data by their path if they find the same there; if one does not, or with `ship`, they
    are sent to each worker once. A chunk whose workers died time and again is tried query by query. Raises
    `QueryError` if the scheduler cannot be reached or is lost, or a worker cannot open the data.
    """
    address = scheduler.address
    with _connected(address) as client:
        _check_workers(client, address)
        data = _DataOfRun(client, sources, settings)
        if scheduler.ship:
            data.ship()
        else:
            data.announce()
        try:
            yield from _answers(client, address, data, TaskQueue(chunks))
        except FoonError:
            raise
        except Exception as error:
            if _is_there(client):
                raise
            raise _lost(address) from error
        finally:
            data.remove()


def _is_there(client: Client) -> bool:
    """Tell whether the scheduler is; a client may notice that it is gone only after a call has failed."""
    latest = time.monotonic() + _CONNECT
    while client.status == "running":
        if time.monotonic() > latest:
            return True
        time.sleep(_MOMENT)
    return False


@contextmanager
def _connected(address: str) -> Iterator[Client]:
    try:
        get_address_host_port(address, strict=True)
    except ValueError:
        raise QueryError(f"{said(address)} is no address of a scheduler; write tcp://HOST:8786") from None
    try:
        client = Client(address, timeout=_CONNECT, set_as_default=False)
    except (OSError, DaskTimeoutError):
        raise QueryError(
            f"no Dask scheduler answers at {address}; start one with: dask scheduler, or check the address"
        ) from None
    with _silence():
        try:
            yield client
        finally:
            # The scheduler may be gone; then there is nothing to take leave of.
            with suppress(OSError, DaskTimeoutError):
                client.close(timeout=_CONNECT)


@contextmanager
def _silence() -> Iterator[None]:
    """Keep Dask from telling at length of lost connections, which `_answers` does in one line."""
    names = [name for name in logging.root.manager.loggerDict if name.split(".")[0] == "distributed"]
    before = {name: logging.getLogger(name).level for name in names}
    try:
        for name in names:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
        yield
    finally:
        for name, severity in before.items():
            logging.getLogger(name).setLevel(severity)


def _check_workers(client: Client, address: str) -> None:
    """Raise `QueryError` unless there are workers, all with this version of foon-asp."""
    try:
        client.wait_for_workers(1, timeout=_FIRST_WORKER)
    except DaskTimeoutError:
        raise QueryError(f"the scheduler has no workers; start some with: dask worker {address}") from None
    ours = program_version()
    for worker, theirs in client.run(program_version, on_error="return").items():
        if isinstance(theirs, Exception):
            raise QueryError(
                f"the worker {worker} cannot run foon-asp ({theirs}); install foon-asp=={ours} there"
            )
        if theirs != ours:
            raise QueryError(f"the worker {worker} has foon-asp {theirs}, not {ours}; install the same there")


class _DataOfRun:
    """The data of a run, which all workers are told of, also those that join later."""

    def __init__(self, client: Client, sources: Sources, settings: Settings) -> None:
        # Two runs may use the same workers at once.
        self.name = f"foon-asp-{uuid.uuid4().hex}"
        self.shipped = False
        self._client = client
        self._sources = sources
        self._settings = settings

    def announce(self) -> None:
        """Tell the workers where the data lie."""
        sources = self._sources.absolute()
        self._register(FoonData(self.name, sources, self._settings, digest(sources)))

    def ship(self) -> None:
        """Send the data to the workers."""
        self.shipped = True
        self._register(FoonData(self.name, self._sources, self._settings, _files(self._sources)))

    def remove(self) -> None:
        """Let the workers forget the data; those that cannot be reached have other troubles."""
        with suppress(Exception):
            self._client.unregister_worker_plugin(self.name)

    def _register(self, plugin: FoonData) -> None:
        try:
            self._client.register_plugin(plugin, name=self.name)
        except Exception as error:  # Whatever a worker has against it, a full disk for instance.
            raise QueryError(f"the workers cannot take the data: {error}") from None


class FoonData(WorkerPlugin):
    """The data at a worker: opened at the first query, shared by its threads.

    `content` is the digest that the data must have where `sources` says that they lie; or, if they are sent,
    all files, by their names in the folder that they are written to.
    """

    def __init__(
        self, name: str, sources: Sources, settings: Settings, content: str | dict[str, bytes]
    ) -> None:
        self.name = name
        self._sources = sources
        self._settings = settings
        self._content = content
        self._version = program_version()
        self._folder: Path | None = None
        self._lock: Any = None
        self._answerer: Answerer | None = None

    def setup(self, worker: Worker) -> None:
        """Write the files that a worker was sent into a folder of its own."""
        if not isinstance(self._content, str):
            self._folder = Path(worker.local_directory) / self.name
            for name, data in self._content.items():
                atomic.write_bytes(self._folder / name, data)
            self._sources = _moved(self._sources, self._folder)
            self._content = ""
        # Last of all: queries may come while this is going on, and wait for the lock to be there.
        self._lock = threading.Lock()

    def teardown(self, worker: Worker) -> None:  # noqa: ARG002 - the interface of Dask
        """Remove that folder."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def answerer(self) -> Answerer:
        """Return the opened data; raise `DataElsewhereError` or `DataUnreadableError`."""
        latest = time.monotonic() + _ON_THE_WAY
        while self._lock is None:
            if time.monotonic() > latest:
                raise DataElsewhereError("the data are still on their way")
            time.sleep(_MOMENT)
        if program_version() != self._version:
            raise DataUnreadableError(f"it has foon-asp {program_version()}, not {self._version}")
        with self._lock:
            if self._answerer is None:
                self._check()
                try:
                    self._answerer = Answerer(self._sources, self._settings)
                except FoonError as error:
                    raise DataUnreadableError(str(error)) from None
            return self._answerer

    def _check(self) -> None:
        if self._folder is not None:
            return
        try:
            same = digest(self._sources) == self._content
        except InputError as error:
            raise DataElsewhereError(str(error)) from None
        if not same:
            raise DataElsewhereError(f"other data in {self._sources.folder}")


def _files(sources: Sources) -> dict[str, bytes]:
    """Return all files of the data, as they are to lie in a folder of their own."""
    files = {f"beside/{name}": read_bytes(Path(path)) for name, path in sources.beside.items()}
    for place, name in enumerate(sources.foon):
        path = Path(name)
        inside = sorted(each for each in path.rglob("*") if each.is_file()) if path.is_dir() else [path]
        for each in inside:
            files[str(Path(str(place), path.name, each.relative_to(path)))] = read_bytes(each)
    return files


def _moved(sources: Sources, folder: Path) -> Sources:
    """Return where the files of `_files` lie in a folder; results name them as they were."""
    beside = folder / "beside"
    beside.mkdir(exist_ok=True)
    here = {name: str(beside / name) for name in sources.beside}
    foon = tuple(str(folder / str(place) / Path(name).name) for place, name in enumerate(sources.foon))
    return replace(
        sources,
        folder=str(beside),
        foon=foon,
        kitchen=here.get("kitchen"),
        rates=here.get("rates"),
        costs=here.get("costs"),
        utensils=here.get("utensils"),
        goals=here.get("goals"),
        shown=tuple(zip(foon, sources.foon, strict=True)),
    )


def _answer(name: str, chunk: Chunk) -> Rows:
    """Answer a chunk; this runs on a worker."""
    data = get_worker().plugins.get(name)
    if not isinstance(data, FoonData):
        raise DataElsewhereError("the worker was not told of the data")
    return data.answerer().answer(chunk)


def _answers(client: Client, address: str, data: _DataOfRun, tasks: TaskQueue) -> Iterator[Rows]:
    """Give out chunks, a few for each worker, and yield what comes back."""
    running: dict[Future[Any], tuple[Task, bool]] = {}
    finished = as_completed(loop=client.loop)
    capacity = _Capacity(client)
    refusals = 0

    def give_out(task: Task) -> None:
        future = client.submit(_answer, data.name, task.chunk, pure=False)
        running[future] = task, data.shipped
        finished.add(future)

    while True:
        while len(running) < capacity.chunks():
            # What is tried again is alone on the cluster: if a worker dies, nothing else is to blame.
            if running and (tasks.has_retries or any(task.retried for task, _ in running.values())):
                break
            next_task = tasks.next()
            if next_task is None:
                break
            give_out(next_task)
        if not running:
            return
        future = next(finished)
        task, was_shipped = running.pop(future)
        if future.cancelled() or client.status != "running":
            raise _lost(address)
        error = future.exception() if future.status == "error" else None
        if error is None:
            yield future.result()
        elif isinstance(error, KilledWorker):
            if rows := tasks.failed(task):
                yield rows
        elif isinstance(error, DataElsewhereError) and not was_shipped:
            # Others that were given out before say the same.
            if not data.shipped:
                data.ship()
            give_out(task)
        elif isinstance(error, DataElsewhereError) and refusals < _REFUSALS:
            refusals += 1
            give_out(task)
        else:
            raise QueryError(f"a worker cannot answer: {error}")


def _lost(address: str) -> QueryError:
    return QueryError(
        f"the scheduler {address} is gone; once there is one again, the same command goes on from here"
    )


class _Capacity:
    """What the workers can take at once; they are counted from time to time."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._threads = 1
        self._counted = 0.0

    def chunks(self) -> int:
        """Return how many chunks may be at the workers now."""
        if time.monotonic() - self._counted > _COUNTED:
            with suppress(OSError):
                self._threads = max(1, sum(self._client.nthreads().values()))
            self._counted = time.monotonic()
        return _AHEAD * self._threads
