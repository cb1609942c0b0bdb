"""What can go wrong, said in one line: where, what is wrong, what to do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from pathlib import Path


class FoonError(Exception):
    """Something the caller can mend: the message says where, what is wrong and what to do."""


class InputError(FoonError):
    """A file cannot be read as what it should be."""

    def __init__(self, path: str | Path, line: int | None, problem: str, advice: str = "") -> None:
        place = str(path) if line is None else f"{path}:{line}"
        super().__init__(f"{place}: {problem}" + (f"; {advice}" if advice else ""))
        self.path = str(path)
        self.line = line


class QueryError(FoonError):
    """The question does not fit the data: an unknown goal, an ambiguous one, a missing rate."""


class InternalError(Exception):
    """An answer failed its own check: a fault of this program, never of the caller."""


def counted(number: int, word: str) -> str:
    """Return `1 step`, `2 steps`."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def shortened(names: Sequence[object], shown: int = 3) -> str:
    """Return `a, b, c and 4 more`."""
    more = f" and {len(names) - shown} more" if len(names) > shown else ""
    return ", ".join(map(str, names[:shown])) + more


def closest(word: str, known: Iterable[str], count: int = 3) -> str:
    """Return `; closest: a, b, c`, or nothing when no known word is near."""
    matches = get_close_matches(word, sorted(set(known)), n=count, cutoff=0.6)
    return "; closest: " + ", ".join(matches) if matches else ""
