"""What is given out to workers: chunks, and the single queries of a chunk at which a worker died."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass

from foon_asp.batch.query_file import Chunk, Line
from foon_asp.batch.rows import Row, error_row
from foon_asp.errors import FoonError
from foon_asp.query.wire import parse_line, query_id

DIED = "the process that answered this query died"


@dataclass(frozen=True, slots=True)
class Task:
    """A chunk to answer. `retried` tells a single query of a chunk at which a worker died before."""

    chunk: Chunk
    retried: bool = False


class TaskQueue:
    """Chunks that are not given out yet; queries that are tried again come first."""

    def __init__(self, chunks: Iterable[Chunk]) -> None:
        self._chunks = iter(chunks)
        self._retries: deque[Task] = deque()

    @property
    def has_retries(self) -> bool:
        """Whether a query waits that is tried again."""
        return bool(self._retries)

    def next(self) -> Task | None:
        """Return a task, or None if there is none."""
        if self._retries:
            return self._retries.popleft()
        chunk = next(self._chunks, None)
        return None if chunk is None else Task(chunk)

    def failed(self, task: Task) -> list[Row]:
        """Have the queries of a task at which a worker died tried again, one by one.

        Return the row of a query at which one died for the second time.
        """
        if task.retried:
            return [_died_row(line) for line in task.chunk]
        self._retries.extend(Task((line,), retried=True) for line in task.chunk)
        return []


def _died_row(line: Line) -> Row:
    number, text = line
    name = None
    with suppress(FoonError):
        name = query_id(parse_line(text))
    return error_row(number, name, DIED)
