"""The journal of a batch: rows are what they were, and a kill at any moment loses none."""

from __future__ import annotations

import pickle
import random
import resource
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

from foon_asp.batch.journal import Journal
from foon_asp.batch.rows import Id, Row, error_row
from foon_asp.errors import InputError

RUN = {"data": "x"}


def rows_of(path: Path, lines: int = 9) -> list[Row]:
    with Journal(path, RUN, lines) as journal:
        return list(journal.rows())


def names_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "o.jsonl.partial"


def test_rows_come_back_as_they_were_and_in_order(path: Path) -> None:
    names: list[Id] = ["text", "\udcff", 3, 10**30, 0.1, -1.0, None]
    rows = [Row(line, name, "found", b'{"\xc3\xbc": "\\n"}') for line, name in enumerate(names, 2)]
    with Journal(path, RUN, 9) as journal:
        assert journal.append(reversed(rows[3:])) == 4
        assert journal.append([rows[0], rows[3], rows[0]]) == 1
        assert journal.append([Row(5, "other", "error", b"{}")]) == 0
        assert [line for line in range(10) if line in journal] == [2, 5, 6, 7, 8]
    with Journal(path, RUN, 9) as journal:
        assert (len(journal), journal.statuses) == (5, {"found": 5})
        assert journal.append(rows) == 2
        again = list(journal.rows())
    assert again == rows
    assert [type(row.id) for row in again] == [type(name) for name in names]


def test_a_row_goes_to_another_process_as_it_is() -> None:
    row = Row(3, "\udcff", "found", b"{}")
    assert pickle.loads(pickle.dumps(row)) == row


def test_nothing_is_left_of_a_journal_that_is_done_or_empty(path: Path) -> None:
    with Journal(path, RUN, 9):
        pass
    assert names_in(path.parent) == []
    with Journal(path, RUN, 9) as journal:
        journal.append([error_row(1, None, "no")])
        assert names_in(path.parent) == [path.name, f"{path.name}-wal"]
    assert names_in(path.parent) == [path.name]
    with Journal(path, RUN, 9) as journal:
        journal.remove()
    assert names_in(path.parent) == []


def test_two_runs_do_not_write_one_journal(path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from foon_asp.batch.journal import Journal\n"
        "from foon_asp.errors import InputError\n"
        "try: Journal(Path(sys.argv[1]), {'data': 'x'}, 9)\n"
        "except InputError as error: print(error)"
    )
    said = f"{path}: another run is writing this; wait for its end"
    with Journal(path, RUN, 9) as journal:
        for rows in ([], [error_row(1, None, "no")], [error_row(2, None, "no")]):
            journal.append(rows)
            with pytest.raises(InputError) as refused:
                Journal(path, RUN, 9)
            assert str(refused.value) == said
            other = subprocess.run(
                [sys.executable, "-c", code, path], capture_output=True, text=True, check=True
            )
            assert other.stdout == f"{said}\n"
    assert len(rows_of(path)) == 2


def test_a_run_that_ended_meanwhile(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The other run removes the journal just before it is locked here."""
    path.touch()
    lock = Journal._lock

    def remove_and_lock(journal: Journal) -> None:
        path.unlink()
        lock(journal)

    monkeypatch.setattr(Journal, "_lock", remove_and_lock)
    with pytest.raises(InputError, match="another run has just ended; start again"):
        Journal(path, RUN, 9)


def test_a_journal_of_another_run_is_refused(path: Path) -> None:
    with Journal(path, {"data": "x", "options": "y"}, 9) as journal:
        journal.append([error_row(1, None, "no")])
    for other, what in (
        ({"data": "z", "options": "y"}, "data"),
        ({"data": "z", "options": "z"}, "data, options"),
        ({"data": "x", "options": "y", "more": ""}, "more"),
    ):
        with pytest.raises(InputError, match=f"another run: not the same {what}; finish that run, or remove"):
            Journal(path, other, 9)
    with Journal(path, {"data": "x", "options": "y"}, 9) as journal:
        assert len(journal) == 1


@pytest.mark.parametrize("statement", ["CREATE TABLE mine (x)", "PRAGMA application_id = 7"])
def test_the_database_of_another_program_is_left_alone(statement: str, path: Path) -> None:
    with closing(sqlite3.connect(path)) as database, database:
        database.execute(statement)
    before = path.read_bytes()
    with pytest.raises(
        InputError, match="this is no journal of foon-asp batch; remove the file to start afresh"
    ):
        Journal(path, RUN, 9)
    assert path.read_bytes() == before
    assert names_in(path.parent) == [path.name]


def test_a_damaged_journal_is_one_clear_error(path: Path) -> None:
    with Journal(path, RUN, 2000) as journal:
        journal.append(error_row(line, None, "no" * 100) for line in range(1, 2000))
    whole = path.read_bytes()
    for damaged in (whole[: len(whole) // 2], whole[:4096] + bytes(len(whole) - 4096)):
        path.write_bytes(damaged)
        with pytest.raises(InputError, match=r"a damaged journal \(.*\); remove the file to start afresh"):
            rows_of(path, 2000)
    path.write_bytes(whole)
    assert len(rows_of(path, 2000)) == 1999


def test_removing_the_file_starts_afresh(path: Path) -> None:
    """What SQLite has beside it is then of no journal any more."""
    write_until_killed(path, lines=50)
    assert names_in(path.parent) == [path.name, f"{path.name}-wal"]
    path.unlink()
    assert rows_of(path) == []
    assert names_in(path.parent) == []


WRITER = """
import sys
from pathlib import Path
from foon_asp.batch.journal import Journal
from foon_asp.batch.rows import Row

with Journal(Path(sys.argv[1]), {"data": "x"}, 1_000_000) as journal:
    line = len(journal)
    while True:
        rows = [Row(line + place, None, "found", b"x" * 300) for place in range(1, 17)]
        line += journal.append(rows)
        print(line, flush=True)
"""


def write_until_killed(path: Path, lines: int) -> int:
    """Have a process write rows, kill it once it wrote so many more, and return how many it said it wrote."""
    said = 0
    with subprocess.Popen([sys.executable, "-c", WRITER, path], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        first = int(process.stdout.readline())
        for text in process.stdout:
            said = int(text)
            if said > first + lines:
                break
        time.sleep(random.random() / 100)
        process.send_signal(signal.SIGKILL)
        # Of the last line it may have written only a part.
        rest = process.stdout.read().splitlines(keepends=True)
    return max([said, *(int(text) for text in rest if text.endswith("\n"))])


def test_a_kill_at_any_moment_loses_no_row(path: Path) -> None:
    said = 0
    for lines in (1, 1, 50, 500, 5_000, 20_000):
        said = write_until_killed(path, lines)
        with Journal(path, RUN, 1_000_000) as journal:
            found = [row.line for row in journal.rows()]
            assert found == list(range(1, len(found) + 1))
            assert len(found) == len(journal)
            # What was written and not yet said is there wholly or not at all.
            assert 0 <= len(found) - said <= 16
            assert len(found) % 16 == 0


def test_a_full_disk_keeps_what_is_done(path: Path) -> None:
    """A limit on the size of files plays the disk."""
    rows = [Row(line, None, "found", b"x" * 1000) for line in range(1, 1001)]
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    with Journal(path, RUN, 1000) as journal:
        journal.append(rows[:100])
        resource.setrlimit(resource.RLIMIT_FSIZE, (400_000, before[1]))
        try:
            with pytest.raises(InputError, match="cannot be written"):
                journal.append(rows[100:])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
    with Journal(path, RUN, 1000) as journal:
        assert list(journal.rows()) == rows[:100]
        assert journal.append(rows) == 900
