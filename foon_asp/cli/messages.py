"""What a command says beside its answer, on standard error; `--quiet` leaves it out. Errors are not of it."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from contextlib import suppress

from foon_asp.characters import visible

_SHOWN = 3
"""How many warnings of one kind are written out, unless `--verbose` asks for all."""


def warn(options: argparse.Namespace, message: str) -> None:
    """Write a warning."""
    note(options, f"warning: {message}")


def note(options: argparse.Namespace, message: str) -> None:
    """Write a summary, or whatever else is good to know."""
    if not options.quiet:
        tell(message)


def listing(options: argparse.Namespace, rows: Iterable[str]) -> None:
    """Write rows of a list, each as it is."""
    if not options.quiet:
        _write("".join(f"{row}\n" for row in rows))


def tell(message: str) -> None:
    """Write a line, whether it is quiet or not."""
    _write(f"foon-asp: {message}\n")


def _write(text: str) -> None:
    """Write to standard error; where nobody can be told, what is answered is the same."""
    with suppress(OSError):
        sys.stderr.write(visible(text))
        sys.stderr.flush()


def shown(options: argparse.Namespace, count: int) -> int:
    """Return how many of so many warnings of one kind are written out."""
    return count if options.verbose else min(count, _SHOWN)
