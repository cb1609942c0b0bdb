"""The rows that are done, in an SQLite database that survives whatever ends the run."""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from foon_asp.batch.rows import Row
from foon_asp.errors import InputError

_SYNCED = 1.0
"""Seconds after which further rows make sure that all are on the disk, whatever happens to the machine."""

_APPLICATION = int.from_bytes(b"foon", "big")
"""What says in the head of a database whose it is."""

_TABLES = (
    f"PRAGMA application_id = {_APPLICATION}",
    "CREATE TABLE run (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
    # An id is JSON here: SQLite has no integers of any size.
    "CREATE TABLE rows (line INTEGER PRIMARY KEY, id TEXT, status TEXT NOT NULL, json BLOB NOT NULL)",
)

_BESIDE = ("-wal", "-journal", "-shm")
"""What SQLite has beside a database that is in use, or was when the program was killed."""

_AFRESH = "remove the file to start afresh"


def journal_files(path: Path) -> list[Path]:
    """Return the files of a journal: itself, and what SQLite may have beside it."""
    return [path, *(path.with_name(path.name + end) for end in _BESIDE)]


class Journal:
    """The rows that are done, and the fingerprint of the run that they belong to.

    `statuses` counts the rows. One process alone may have a journal open. Raises `InputError` if the file is
    no journal or that of another run.
    """

    def __init__(self, path: Path, fingerprint: dict[str, str], lines: int) -> None:
        self.path = path
        self.statuses: Counter[str] = Counter()
        self._done = bytearray(lines + 1)
        self._synced = time.monotonic()
        with _told(path):
            path.parent.mkdir(parents=True, exist_ok=True)
            _make(path)
            self._database = sqlite3.connect(path, timeout=0, isolation_level=None)
        try:
            with _told(path):
                self._lock()
                self._begin(fingerprint)
        except BaseException:
            self._database.close()
            raise

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_: object) -> None:
        # What cannot be written now, on a full disk, was complained of before.
        with suppress(sqlite3.Error):
            self._database.close()
        if not len(self):
            with suppress(OSError):
                self._unlink()

    def __len__(self) -> int:
        return self.statuses.total()

    def __contains__(self, line: int) -> bool:
        return bool(self._done[line])

    def append(self, rows: Iterable[Row]) -> int:
        """Add rows, and return how many of them are new; those that are there already do not change."""
        new = [row for row in rows if self._note(row.line, row.status)]
        with _told(self.path), self._transaction():
            self._database.executemany("INSERT INTO rows VALUES (?, ?, ?, ?)", map(_values, new))
        if time.monotonic() - self._synced > _SYNCED:
            with _told(self.path):
                # It waits for the disk; SQLite itself only does so now and then.
                self._database.execute("PRAGMA wal_checkpoint")
            self._synced = time.monotonic()
        return len(new)

    def rows(self) -> Iterator[Row]:
        """Yield all rows in the order of the query file."""
        with _told(self.path):
            for line, name, status, text in self._database.execute("SELECT * FROM rows ORDER BY line"):
                yield Row(line, None if name is None else json.loads(name), status, text)

    def remove(self) -> None:
        """Delete the journal, whose rows are elsewhere now."""
        with _told(self.path):
            self._database.close()
            self._unlink()

    def _unlink(self) -> None:
        for path in journal_files(self.path):
            path.unlink(missing_ok=True)

    def _lock(self) -> None:
        """Keep the database for this process until it is closed, or the process ends."""
        self._database.execute("PRAGMA locking_mode = EXCLUSIVE")
        failure: sqlite3.DatabaseError | None = None
        try:
            with self._transaction("EXCLUSIVE"):
                pass
        except sqlite3.DatabaseError as error:
            failure = error
        if "locked" in str(failure):
            raise InputError(self.path, None, "another run is writing this", "wait for its end")
        if not self.path.exists():
            raise InputError(self.path, None, "another run has just ended", "start again")
        if "not a database" in str(failure):
            raise self._foreign()
        if failure is not None:
            raise failure

    def _begin(self, fingerprint: dict[str, str]) -> None:
        """Read what is there already; of an empty database make a journal."""
        (application,) = self._database.execute("PRAGMA application_id").fetchone()
        (tables,) = self._database.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if application != _APPLICATION and (application or tables):
            raise self._foreign()
        # Rows are added to a log of their own, and moved into the tables when that is told to happen.
        self._database.execute("PRAGMA journal_mode = WAL")
        self._database.execute("PRAGMA wal_autocheckpoint = 0")
        self._database.execute("PRAGMA synchronous = NORMAL")
        if not tables:
            with self._transaction():
                for statement in _TABLES:
                    self._database.execute(statement)
                self._database.executemany("INSERT INTO run VALUES (?, ?)", fingerprint.items())
        self._check(fingerprint)
        for line, status in self._database.execute("SELECT line, status FROM rows"):
            self._note(line, status)

    def _check(self, fingerprint: dict[str, str]) -> None:
        found = dict(self._database.execute("SELECT name, value FROM run"))
        differing = [name for name, value in fingerprint.items() if found.get(name) != value]
        if differing:
            problem = f"this is the journal of another run: not the same {', '.join(differing)}"
            raise InputError(self.path, None, problem, f"finish that run, or {_AFRESH}")

    def _foreign(self) -> InputError:
        return InputError(self.path, None, "this is no journal of foon-asp batch", _AFRESH)

    def _note(self, line: int, status: str) -> bool:
        """Note that a row is there; false if it is there already."""
        if self._done[line]:
            return False
        self._done[line] = True
        self.statuses[status] += 1
        return True

    @contextmanager
    def _transaction(self, kind: str = "") -> Iterator[None]:
        """Do what is in the block wholly or not at all."""
        self._database.execute(f"BEGIN {kind}")
        with self._database:
            yield


def _values(row: Row) -> tuple[int, str | None, str, bytes]:
    return row.line, None if row.id is None else json.dumps(row.id), row.status, row.json


def _make(path: Path) -> None:
    """Make an empty file if there is none. What the system has against it, SQLite would not say."""
    with suppress(FileExistsError):
        os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Raise what the system has against writing a file as `InputError`."""
    try:
        yield
    except OSError as error:
        raise InputError(path, None, f"cannot be written ({error.strerror})") from None
    except sqlite3.OperationalError as error:
        raise InputError(path, None, f"cannot be written ({error})") from None
    except sqlite3.DatabaseError as error:
        raise InputError(path, None, f"a damaged journal ({error})", _AFRESH) from None
