"""Many queries at once: a journal that survives everything, and results in the order of the query file."""

from __future__ import annotations

import fcntl
import json
import mmap
import os
import shutil
import time
from array import array
from collections import Counter
from collections.abc import Callable, Generator, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from importlib.metadata import version
from itertools import islice
from pathlib import Path
from typing import BinaryIO, NoReturn, TextIO

from tqdm import tqdm

from foon_asp.batch_file import Chunk, QueryFile
from foon_asp.errors import InputError
from foon_asp.render.batch import parquet_schema, parquet_table, row_start
from foon_asp.workers import Rows

CHUNK = 16
"""How many queries a worker is given at a time, if there are many."""

_SHARES = 4
"""Into how many chunks the queries of each process are split at least, so that all end together."""

_SYNCED = 1.0
"""Seconds after which further rows make sure that all are on the disk, whatever happens to the machine."""

_ROW_GROUP = 5_000
"""How many rows of a Parquet file are held in memory."""

_KIND = "foon-asp batch"
_MAGIC = b'{"foon-asp batch": 1, '
"""How the first line of a journal begins."""

_AFRESH = "remove the file to start afresh"
_NOT_DONE = -1

Answer = Callable[[Iterator[Chunk]], Generator[Rows, None, None]]
"""Answers chunks, in whatever order; it takes a new one only when a worker is free for it."""


@dataclass(frozen=True, slots=True)
class Summary:
    """How a run ended: rows by their status, those that an earlier run had made, and seconds."""

    statuses: dict[str, int]
    resumed: int
    seconds: float

    def __str__(self) -> str:
        total = sum(self.statuses.values())
        counts = ", ".join(f"{count} {status}" for status, count in sorted(self.statuses.items()))
        resumed = f"; {self.resumed} done before" if self.resumed else ""
        rate = (total - self.resumed) / max(self.seconds, 1e-9)
        return f"{total} {'query' if total == 1 else 'queries'}: {counts}{resumed}; {rate:.1f} queries/s"


def chunk_size(queries: int, jobs: int) -> int:
    """Return how many queries a worker is given at a time."""
    return max(1, min(CHUNK, queries // (_SHARES * jobs)))


def run_batch(
    queries: QueryFile,
    out: Path,
    answer: Answer,
    fingerprint: dict[str, str],
    *,
    chunk: int = CHUNK,
    overwrite: bool = False,
    progress: TextIO | None = None,
) -> Summary:
    """Answer all queries of a file, and write a row for each to `out`: JSON lines, or Parquet by its suffix.

    Rows go to `OUT.partial` first; if that is there, of a run with the same fingerprint, the run goes on
    where it stopped. The fingerprint names what answers depend on beside the queries and the version of the
    program: the data and the settings. Raises `InputError` if the output cannot be written or belongs to
    something else.
    """
    started = time.monotonic()
    own = {"version of foon-asp": version("foon-asp"), "query file": queries.digest}
    out = _checked(out, queries.path, overwrite=overwrite)
    with Journal(out.with_name(out.name + ".partial"), own | fingerprint, queries.lines) as journal:
        resumed = len(journal)
        if resumed < queries.queries:
            chunks = queries.chunks(chunk, journal.__contains__)
            with _bar(queries.queries, resumed, progress) as bar, closing(answer(chunks)) as answers:
                for rows in answers:
                    bar.update(journal.append(rows))
        seconds = time.monotonic() - started
        _write(out, journal)
        journal.remove()
    return Summary(dict(journal.statuses), resumed, seconds)


def _bar(total: int, done: int, progress: TextIO | None) -> tqdm[NoReturn]:
    """Return a bar with rate and time left; without a place to show it, one that shows nothing."""
    return tqdm(
        total=total,
        initial=done,
        unit=" queries",
        file=progress,
        disable=progress is None,
        dynamic_ncols=True,
        mininterval=0.2,
        smoothing=0.05,
    )


def _checked(out: Path, queries: Path, *, overwrite: bool) -> Path:
    """Return the file that the results go to, links followed; raise `InputError` if they cannot."""
    target = out.resolve()
    if target == queries.resolve():
        raise InputError(out, None, "this would replace the queries", "name another output")
    if target.exists():
        if not target.is_file():
            raise InputError(out, None, "this is no regular file", "name a file")
        if not overwrite and not target.with_name(target.name + ".partial").exists():
            raise InputError(out, None, "this file is there already", "name another one, or add --overwrite")
    return target


def _parquet(path: Path) -> bool:
    return path.suffix.lower() == ".parquet"


class Journal:
    """The rows that are done, in the order in which they came, in a file that only grows.

    A last row that was not written to its end is cut off. `statuses` counts the rows. One process alone
    may have a journal open. Raises `InputError` if the file is no journal or that of another run.
    """

    def __init__(self, path: Path, fingerprint: dict[str, str], lines: int) -> None:
        self.path = path
        self.statuses: Counter[str] = Counter()
        self._offsets = array("q", [_NOT_DONE]) * (lines + 1)
        self._end = 0
        self._synced = time.monotonic()
        with _told(path):
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
        try:
            with _told(path):
                self._lock()
                self._begin(fingerprint)
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_: object) -> None:
        # What cannot be written now, on a full disk, was complained of before.
        with suppress(OSError):
            self._sync()
            if not len(self):
                self.path.unlink(missing_ok=True)
        with suppress(OSError):
            self._file.close()

    def __len__(self) -> int:
        return self.statuses.total()

    def __contains__(self, line: int) -> bool:
        return self._offsets[line] != _NOT_DONE

    def append(self, rows: Rows) -> int:
        """Add rows, and return how many of them are new; those that are there already do not change."""
        new = [row for row in rows if self._note(row, self._end, move=True)]
        with _told(self.path):
            self._file.writelines(row + b"\n" for row in new)
            self._file.flush()
            if time.monotonic() - self._synced > _SYNCED:
                self._sync()
        return len(new)

    def rows(self) -> Iterator[bytes]:
        """Yield all rows in the order of the query file."""
        self._sync()
        with mmap.mmap(self._file.fileno(), 0, access=mmap.ACCESS_READ) as journal:
            for offset in self._offsets:
                if offset != _NOT_DONE:
                    yield journal[offset : journal.find(b"\n", offset)]

    def remove(self) -> None:
        with _told(self.path):
            self.path.unlink()

    def _lock(self) -> None:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(self.path, None, "another run is writing this", "wait for its end") from None
        if os.fstat(self._file.fileno()).st_nlink == 0:
            raise InputError(self.path, None, "another run has just ended", "start again")

    def _begin(self, fingerprint: dict[str, str]) -> None:
        """Read what is there already, and stand behind it."""
        header = self._file.readline()
        if header.endswith(b"\n") or not _MAGIC.startswith(header[: len(_MAGIC)]):
            self._check(header, fingerprint)
            self._end = len(header)
            for row in self._file:
                if not (row.endswith(b"}\n") and b"\0" not in row and self._note(row[:-1], self._end)):
                    break
                self._end += len(row)
        self._file.seek(self._end)
        self._file.truncate()
        if not self._end:
            self._end = self._file.write(json.dumps({_KIND: 1, **fingerprint}).encode() + b"\n")
        self._sync()
        _sync_folder(self.path.parent)

    def _check(self, header: bytes, fingerprint: dict[str, str]) -> None:
        try:
            found = json.loads(header) if header.startswith(_MAGIC) else None
        except ValueError:
            found = None
        if found is None:
            raise InputError(self.path, None, "this is no journal of foon-asp batch", _AFRESH)
        differing = [name for name, value in fingerprint.items() if found.get(name) != value]
        if differing:
            problem = f"this is the journal of another run: not the same {', '.join(differing)}"
            raise InputError(self.path, None, problem, f"finish that run, or {_AFRESH}")

    def _note(self, row: bytes, offset: int, *, move: bool = False) -> bool:
        """Note where a row stands; false if it is none, or is there already."""
        start = row_start(row)
        if start is None or not 0 < start[0] < len(self._offsets) or start[0] in self:
            return False
        self._offsets[start[0]] = offset
        self.statuses[start[1]] += 1
        if move:
            self._end += len(row) + 1
        return True

    def _sync(self) -> None:
        self._file.flush()
        os.fsync(self._file.fileno())
        self._synced = time.monotonic()


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Raise what the system has against writing a file as `InputError`."""
    try:
        yield
    except OSError as error:
        raise InputError(path, None, f"cannot be written ({error.strerror})") from None


def _write(out: Path, journal: Journal) -> None:
    """Write the results so that the file is there whole, or as it was before."""
    unfinished = out.with_name(f".{out.name}.part")
    try:
        with _told(out):
            with unfinished.open("wb") as file:
                (_write_parquet if _parquet(out) else _write_lines)(file, journal.rows())
                file.flush()
                os.fsync(file.fileno())
            if out.exists():
                shutil.copymode(out, unfinished)
            unfinished.replace(out)
            _sync_folder(out.parent)
    except BaseException:
        with suppress(OSError):
            unfinished.unlink(missing_ok=True)
        raise


def _write_lines(file: BinaryIO, rows: Iterator[bytes]) -> None:
    file.writelines(row + b"\n" for row in rows)


def _write_parquet(file: BinaryIO, rows: Iterator[bytes]) -> None:
    from pyarrow.parquet import ParquetWriter

    with ParquetWriter(file, parquet_schema(), compression="zstd") as writer:
        while group := list(islice(rows, _ROW_GROUP)):
            writer.write_table(parquet_table(group))


def _sync_folder(folder: Path) -> None:
    """See to it that a file that was made or renamed keeps its name if the machine fails."""
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    finally:
        os.close(number)
