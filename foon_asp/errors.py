"""What can go wrong, said in one line: where, what is wrong, what to do."""

from __future__ import annotations

from pathlib import Path


class FoonError(Exception):
    """Something the caller can mend: the message says where, what is wrong and what to do."""


class InputError(FoonError):
    """A file cannot be read as what it should be."""

    def __init__(self, path: str | Path, line: int | None, problem: str, advice: str = "") -> None:
        # A name of several lines is told in one.
        name = "\\n".join(str(path).splitlines())
        place = name if line is None else f"{name}:{line}"
        super().__init__(f"{place}: {problem}" + (f"; {advice}" if advice else ""))
        self.path = str(path)
        self.line = line


class QueryError(FoonError):
    """The question does not fit the data: an unknown goal, an ambiguous one, a missing rate."""


class FoonWarning(UserWarning):
    """Something in a file is lost, as it cannot be read; the rest is there."""


class InternalError(Exception):
    """An answer failed its own check: a fault of this program, never of the caller."""
