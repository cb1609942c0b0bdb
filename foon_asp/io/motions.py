"""Tables of a motion with a number, as people keep them: what motions cost, how likely they succeed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from foon_asp.characters import is_label
from foon_asp.errors import InputError
from foon_asp.io.document import Document, is_json
from foon_asp.io.files import read_string, rows
from foon_asp.numbers import COST, DURATION, RATE, Number
from foon_asp.values import said


def read_rates(path: Path) -> dict[str, float]:
    """Read how likely motions succeed: a JSON object, or lines `motion<tab>rate`; raise `InputError`.

    Motions are in lower case; one that is named twice must have the same rate.
    """
    return _read(path, "rate", RATE, "the rate between 0 and 1")


def read_costs(path: Path) -> dict[str, float]:
    """Read what motions cost: a JSON object, or lines `motion<tab>cost`; raise `InputError`.

    Motions are in lower case; one that is named twice must cost the same.
    """
    return _read(path, "cost", COST, "costs are from 0 to 1000000")


def read_durations(path: Path) -> dict[str, float]:
    """Read how many seconds motions take, written likewise; raise `InputError`."""
    return _read(path, "second", DURATION, "seconds are above 0 and at most 1000000")


def _read(path: Path, name: str, kind: Number, which: str) -> dict[str, float]:
    text = read_string(path)
    advice = f'write motion<tab>{name} lines, or {{"pour": 0.1, …}}, {which}'
    found: dict[str, float] = {}
    lines: dict[str, int] = {}
    for line, motion, value, shown in _json_rows(text, path) if is_json(text) else _rows(text, kind):
        if not is_label(motion) or not kind.fits(value):
            raise InputError(path, line, f"cannot read {shown}", advice)
        motion = motion.strip().lower().rstrip("*").rstrip()
        if not motion:
            raise InputError(path, line, f"cannot read {shown}", advice)
        if found.setdefault(motion, float(value)) != value:
            problem = f"{value:g} here and {found[motion]:g} in line {lines[motion]}"
            raise InputError(path, line, f"two {name}s of {said(motion)}: {problem}", "keep one of them")
        lines.setdefault(motion, line)
    return found


_Row = tuple[int, Any, Any, str]
"""A line, a motion, its number, and what a message says was there."""


def _json_rows(text: str, path: Path) -> Iterator[_Row]:
    for line, motion, value in Document(text, path).read_table():
        yield line, motion, value, f"{said(motion)}, {said(value)}"


def _rows(text: str, kind: Number) -> Iterable[_Row]:
    for line, row in rows(text):
        motion, _, written = row.rpartition("\t")
        try:
            value: object = kind.read(written)
        except ValueError:
            value = None
        yield line, motion, value, said(row)
