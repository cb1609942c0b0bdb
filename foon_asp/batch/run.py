"""A run: every query is answered once, and the results stand in the order of the query file."""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from dataclasses import dataclass
from io import RawIOBase
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NoReturn, TextIO, cast

from tqdm import tqdm

from foon_asp.batch.journal import Journal, journal_files
from foon_asp.batch.query_file import Chunk, QueryFile
from foon_asp.batch.rows import Row, Rows, parquet_schema, parquet_table
from foon_asp.errors import InputError
from foon_asp.io import atomic
from foon_asp.io.files import exists
from foon_asp.io.overwriting import refuse_inputs
from foon_asp.resources import program_version

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer as Buffer

CHUNK = 16
"""How many queries a worker is given at a time, if there are many."""

_SHARES = 4
"""Into how many chunks the queries of each process are split at least, so that all end together."""

_ROW_GROUP = 5_000
"""How many rows of a Parquet file are held in memory."""

AnswerChunks = Callable[[Iterator[Chunk]], Generator[Rows, None, None]]
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


@dataclass(frozen=True, slots=True)
class RunOptions:
    """How a run is done.

    `fingerprint` names what answers depend on beside the queries and the version of the program: the data
    and the settings. `chunk` is how many queries a worker is given at a time, `overwrite` whether the output
    may replace a file, `progress` where a bar is shown.
    """

    fingerprint: dict[str, str]
    chunk: int = CHUNK
    overwrite: bool = False
    progress: TextIO | None = None


def run_batch(queries: QueryFile, out: Path, answer: AnswerChunks, options: RunOptions) -> Summary:
    """Answer all queries of a file, and write a row for each to `out`: JSON lines, or Parquet by its suffix.

    Rows go to `OUT.partial` first; if that is there, of a run with the same fingerprint, the run goes on
    where it stopped. Raises `InputError` if the output cannot be written or belongs to something else.
    """
    started = time.monotonic()
    own = {"version of foon-asp": program_version(), "query file": queries.digest}
    refuse_inputs(files_of(out), [queries.path])
    out, path = _checked(out, overwrite=options.overwrite)
    with Journal(path, own | options.fingerprint, queries.lines) as journal:
        resumed = len(journal)
        complete = resumed == queries.queries
        if exists(out) and not (options.overwrite or (complete and _holds(out, journal))):
            raise _there_already(out)
        if not complete:
            chunks = queries.chunks(options.chunk, journal.__contains__)
            bar = _bar(queries.queries, resumed, options.progress)
            with bar, closing(answer(chunks)) as answers:
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


def files_of(out: Path) -> list[Path]:
    """Return all files that a run writes: the output, links followed, and those of its journal."""
    target = Path(os.path.realpath(out))
    return [target, *journal_files(target.with_name(target.name + ".partial"))]


def _checked(out: Path, *, overwrite: bool) -> tuple[Path, Path]:
    """Return the file that the results go to, and the journal; raise `InputError` if they cannot."""
    target, journal, *_ = files_of(out)
    if exists(target):
        if not os.path.isfile(target):  # noqa: PTH113 - Path.is_file raises on long names
            raise InputError(out, None, "this is no regular file", "name a file")
        if not overwrite and not exists(journal):
            raise _there_already(out)
    return target, journal


def _there_already(out: Path) -> InputError:
    return InputError(out, None, "this file is there already", "name another one, or add --overwrite")


class _Digest(RawIOBase):
    """A file that keeps nothing but a hash of what is written to it."""

    def __init__(self) -> None:
        super().__init__()
        self.sha256 = hashlib.sha256()
        self._size = 0

    def writable(self) -> bool:
        return True

    def tell(self) -> int:
        return self._size

    def write(self, data: Buffer) -> int:
        self.sha256.update(data)
        size = memoryview(data).nbytes
        self._size += size
        return size


def _holds(out: Path, journal: Journal) -> bool:
    """Tell whether a file is what would be written: an earlier run was killed when it had just done so."""
    digest = _Digest()
    _fill(cast(BinaryIO, digest), out, journal)
    try:
        with out.open("rb") as file:
            return hashlib.file_digest(file, "sha256").digest() == digest.sha256.digest()
    except OSError:
        return False


def _parquet(path: Path) -> bool:
    return path.suffix.lower() == ".parquet"


def _write(out: Path, journal: Journal) -> None:
    with atomic.writing(out) as file:
        _fill(file, out, journal)


def _fill(file: BinaryIO, out: Path, journal: Journal) -> None:
    """Write the rows of a journal in the format that the name of the output says."""
    (_write_parquet if _parquet(out) else _write_lines)(file, journal.rows())


def _write_lines(file: BinaryIO, rows: Iterator[Row]) -> None:
    file.writelines(row.json + b"\n" for row in rows)


def _write_parquet(file: BinaryIO, rows: Iterator[Row]) -> None:
    from pyarrow.parquet import ParquetWriter

    with ParquetWriter(file, parquet_schema(), compression="zstd") as writer:
        while group := list(islice(rows, _ROW_GROUP)):
            writer.write_table(parquet_table(group))
