"""Runs of `foon-asp batch`: queries, the processes that answer them, and how far these are."""

from __future__ import annotations

import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any

import psutil
from jsonschema import Draft202012Validator

from support.paths import SCHEMAS

Drawn = dict[str, Any] | str


def write_queries(path: Path, queries: Sequence[Drawn]) -> Path:
    lines = [query if isinstance(query, str) else json.dumps(query) for query in queries]
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    return path


def read_rows(path: Path) -> list[dict[str, Any]]:
    return read_rows_of(path.read_bytes())


def read_rows_of(data: bytes) -> list[dict[str, Any]]:
    validator = Draft202012Validator(json.loads((SCHEMAS / "batch-result.schema.json").read_text()))
    rows = [json.loads(line) for line in data.decode("utf-8").splitlines()]
    for row in rows:
        validator.validate(row)
    return rows


def program(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "foon_asp", *map(str, arguments)]


GOALS = ("whipped cream", "greek salad", "hummus", "pesto pasta", "ice")


def many(count: int) -> list[Drawn]:
    """Return queries that take some milliseconds each, from a few kitchens."""
    return [
        {
            "id": place,
            "goal": GOALS[place % len(GOALS)],
            "by": "units,success",
            "remove": removed(place // 40),
        }
        for place in range(count)
    ]


def removed(kitchen: int) -> list[str]:
    return [[], ["oregano"], ["cumin"], ["powdered sugar"]][kitchen % 4]


@contextmanager
def started(*arguments: object) -> Iterator[subprocess.Popen[str]]:
    """Start the program in a group of its own, and leave nothing of it behind."""
    process = subprocess.Popen(program(*arguments), stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=30)


def until(condition: Callable[[], object], seconds: float = 30) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this takes too long"
        time.sleep(0.02)


def rows_in(journal: Path) -> int:
    """Count the rows of a journal, be it in use: then nobody else may open it, but it can be copied."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "copy")
        for end in ("-wal", ""):
            with suppress(FileNotFoundError):
                shutil.copy(f"{journal}{end}", f"{copy}{end}")
        with suppress(sqlite3.Error), closing(sqlite3.connect(copy)) as database:
            return int(database.execute("SELECT count(*) FROM rows").fetchone()[0])
    return 0


def workers_of(process: subprocess.Popen[str]) -> list[psutil.Process]:
    found = []
    for child in psutil.Process(process.pid).children():
        with suppress(psutil.NoSuchProcess):
            if any("spawn_main" in part for part in child.cmdline()):
                found.append(child)
    return found


def gone(processes: Sequence[psutil.Process]) -> bool:
    return not any(each.is_running() and each.status() != psutil.STATUS_ZOMBIE for each in processes)


def busy(process: psutil.Process) -> bool:
    """Whether a worker is at something that takes long: opening the data takes it about a second."""
    with suppress(psutil.NoSuchProcess):
        return sum(process.cpu_times()[:2]) > 2.5
    return False
