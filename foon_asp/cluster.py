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
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

from distributed import Client, Future, KilledWorker, Worker, WorkerPlugin, as_completed, get_worker
from distributed import TimeoutError as DaskTimeoutError
from distributed.comm.addressing import get_address_host_port

from foon_asp.batch_file import Chunk
from foon_asp.errors import FoonError, InputError, QueryError
from foon_asp.files import read_bytes
from foon_asp.workers import Desk, Rows, Settings, Sources, Task, TaskQueue, died

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


def answer_on_cluster(
    sources: Sources, settings: Settings, chunks: Iterable[Chunk], address: str, *, ship: bool = False
) -> Generator[Rows, None, None]:
    """Answer chunks on the workers of a Dask scheduler; what is ready first comes first.

    Workers open the data by their path if they find the same there; if one does not, or with `ship`, they
    are sent to each worker once. A chunk whose workers died time and again is tried query by query. Raises
    `QueryError` if the scheduler cannot be reached or is lost, or a worker cannot open the data.
    """
    with _connected(address) as client:
        _check_workers(client, address)
        data = _Delivery(client, sources, settings)
        if ship:
            data.ship()
        else:
            data.announce()
        try:
            yield from _answers(client, address, data, TaskQueue(chunks))
        except FoonError:
            raise
        except Exception as error:
            if client.status == "running":
                raise
            raise _lost(address) from error
        finally:
            data.withdraw()


@contextmanager
def _connected(address: str) -> Iterator[Client]:
    try:
        get_address_host_port(address, strict=True)
    except ValueError:
        raise QueryError(f"{address!r} is no address of a scheduler; write tcp://HOST:8786") from None
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
    levels = {name: logging.getLogger(name).level for name in names}
    try:
        for name in names:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
        yield
    finally:
        for name, level in levels.items():
            logging.getLogger(name).setLevel(level)


def _check_workers(client: Client, address: str) -> None:
    """Raise `QueryError` unless there are workers, all with this version of foon-asp."""
    try:
        client.wait_for_workers(1, timeout=_FIRST_WORKER)
    except DaskTimeoutError:
        raise QueryError(f"the scheduler has no workers; start some with: dask worker {address}") from None
    ours = version("foon-asp")
    for worker, theirs in client.run(_version, on_error="return").items():
        if isinstance(theirs, Exception):
            raise QueryError(
                f"the worker {worker} cannot run foon-asp ({theirs}); install foon-asp=={ours} there"
            )
        if theirs != ours:
            raise QueryError(f"the worker {worker} has foon-asp {theirs}, not {ours}; install the same there")


def _version() -> str:
    return version("foon-asp")


class _Delivery:
    """The data of a run on its way to the workers, also to those that join later."""

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
        self._register(FoonData(self.name, sources, self._settings, sources.digest(), {}))

    def ship(self) -> None:
        """Send the data to the workers."""
        self.shipped = True
        files = _files(self._sources)
        self._register(FoonData(self.name, self._sources, self._settings, "", files))

    def withdraw(self) -> None:
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

    `files` are those that were sent, by their names in the folder that they are written to; without any,
    the data lie where `sources` says and have the `digest`.
    """

    def __init__(
        self, name: str, sources: Sources, settings: Settings, digest: str, files: dict[str, bytes]
    ) -> None:
        self.name = name
        self._sources = sources
        self._settings = settings
        self._digest = digest
        self._files = files
        self._version = version("foon-asp")
        self._folder: Path | None = None
        self._lock: Any = None
        self._desk: Desk | None = None

    def setup(self, worker: Worker) -> None:
        if self._files:
            self._folder = Path(worker.local_directory) / self.name
            for name, data in self._files.items():
                path = self._folder / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
            self._sources = _moved(self._sources, self._folder)
            self._files = {}
        # Last of all: queries may come while this is going on, and wait for the lock to be there.
        self._lock = threading.Lock()

    def teardown(self, worker: Worker) -> None:  # noqa: ARG002 - the interface of Dask
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def desk(self) -> Desk:
        """Return the opened data; raise `DataElsewhereError` or `DataUnreadableError`."""
        patience = time.monotonic() + _ON_THE_WAY
        while self._lock is None:
            if time.monotonic() > patience:
                raise DataElsewhereError("the data are still on their way")
            time.sleep(_MOMENT)
        if _version() != self._version:
            raise DataUnreadableError(f"it has foon-asp {_version()}, not {self._version}")
        with self._lock:
            if self._desk is None:
                self._check()
                try:
                    self._desk = Desk(self._sources, self._settings)
                except FoonError as error:
                    raise DataUnreadableError(str(error)) from None
            return self._desk

    def _check(self) -> None:
        if self._folder is not None:
            return
        try:
            same = self._sources.digest() == self._digest
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
        kitchen=here.get("kitchen.json"),
        rates=here.get("motion.txt"),
        utensils=here.get("utensils.txt"),
        goals=here.get("goal_nodes.json"),
        shown=tuple(zip(foon, sources.foon, strict=True)),
    )


def _answer(name: str, chunk: Chunk) -> Rows:
    """Answer a chunk; this runs on a worker."""
    data = get_worker().plugins.get(name)
    if not isinstance(data, FoonData):
        raise DataElsewhereError("the worker was not told of the data")
    return data.desk().answer(chunk)


def _answers(client: Client, address: str, data: _Delivery, queue: TaskQueue) -> Iterator[Rows]:
    """Give out chunks, a few for each worker, and yield what comes back."""
    running: dict[Future[Any], tuple[Task, bool]] = {}
    finished = as_completed(loop=client.loop)
    crew = _Crew(client)
    refusals = 0

    def give_out(task: Task) -> None:
        future = client.submit(_answer, data.name, task.chunk, pure=False)
        running[future] = task, data.shipped
        finished.add(future)

    while True:
        while len(running) < crew.room():
            # A suspect is alone on the cluster: if a worker dies of it, nothing else is to blame.
            if running and (queue.suspects or any(task.suspect for task, _ in running.values())):
                break
            next_task = queue.next()
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
            if task.suspect:
                yield [died(line) for line in task.chunk]
            else:
                queue.suspect(task.chunk)
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


class _Crew:
    """How many chunks the workers can have at once; they are counted from time to time."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._threads = 1
        self._counted = 0.0

    def room(self) -> int:
        if time.monotonic() - self._counted > _COUNTED:
            with suppress(OSError):
                self._threads = max(1, sum(self._client.nthreads().values()))
            self._counted = time.monotonic()
        return _AHEAD * self._threads
