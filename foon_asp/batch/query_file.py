"""The query file of a batch: JSON lines, read in chunks; what one query line may say."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from foon_asp.errors import InputError

Line = tuple[int, bytes]
"""The number of a line, from 1, and what it says."""
Chunk = tuple[Line, ...]

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class QueryFile:
    """A file with one query a line; blank lines do not count.

    `lines` is the number of its last line, `queries` how many lines say something, `digest` the SHA-256 of
    its bytes.
    """

    path: Path
    lines: int
    queries: int
    digest: str

    @classmethod
    def scan(cls, path: Path) -> QueryFile:
        """Read a file from end to end; raise `InputError` if it cannot be read twice, or asks nothing."""
        if os.path.exists(path) and not os.path.isfile(path):  # noqa: PTH110, PTH113 - Path's raise on long names
            raise InputError(path, None, "this is no regular file", "save the queries in one")
        digest = hashlib.sha256()
        lines = queries = 0
        for line in _raw_lines(path):
            digest.update(line)
            lines += 1
            queries += bool(_said(lines, line))
        if not queries:
            advice = 'write one query a line, like {"goal": "whipped cream"}'
            raise InputError(path, None, "there is no query in this file", advice)
        return cls(path, lines, queries, digest.hexdigest())

    def chunks(self, size: int, done: Callable[[int], bool]) -> Iterator[Chunk]:
        """Yield the queries that are not done, in order, at most `size` at a time.

        Raises `InputError` if the file is not what it was when it was scanned.
        """
        digest = hashlib.sha256()
        chunk: list[Line] = []
        number = 0
        for number, line in enumerate(_raw_lines(self.path), 1):
            if number > self.lines:
                break
            digest.update(line)
            text = _said(number, line)
            if text and not done(number):
                chunk.append((number, text))
                if len(chunk) == size:
                    yield tuple(chunk)
                    chunk = []
        if number != self.lines or digest.hexdigest() != self.digest:
            advice = "remove the journal of the run, and run the command again"
            raise InputError(self.path, None, "the query file was changed during the run", advice)
        if chunk:
            yield tuple(chunk)


def _raw_lines(path: Path) -> Iterator[bytes]:
    """Yield the lines of a file as they are, with their ends."""
    try:
        with path.open("rb") as file:
            yield from file
    except FileNotFoundError:
        raise InputError(path, None, "no such file", "check the path") from None
    except OSError as error:
        raise InputError(path, None, f"cannot be read ({error.strerror})") from None


def _said(number: int, line: bytes) -> bytes:
    return (line.removeprefix(_BYTE_ORDER_MARK) if number == 1 else line).strip()
