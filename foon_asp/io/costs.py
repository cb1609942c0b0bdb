"""What motions cost, and other tables of a motion with a number, as people keep them: JSON, or lines."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from foon_asp.characters import is_label
from foon_asp.errors import InputError
from foon_asp.io.files import parse_json, read_string
from foon_asp.numbers import COST
from foon_asp.values import said

_ADVICE = 'write {"pour": 0.1, …}, or a line motion<tab>cost for each; costs are from 0 to 1000000'


def read_costs(path: Path) -> dict[str, float]:
    """Read what motions cost: a JSON object, or lines `motion<tab>cost`; raise `InputError`.

    Motions are in lower case; one that is named twice must cost the same.
    """
    text = read_string(path)
    costs: dict[str, float] = {}
    for line, motion, value in _object(text, path) if text.lstrip().startswith("{") else _lines(text):
        if not is_label(motion) or not COST.fits(value):
            raise InputError(path, line, f"cannot read {said(motion)}, {said(value)}", _ADVICE)
        motion = motion.strip().lower().rstrip("*").rstrip()
        if costs.setdefault(motion, float(value)) != value:
            problem = f"two costs of {said(motion)}: {costs[motion]:g} and {value:g}"
            raise InputError(path, line, problem, "keep one of them")
    return costs


def _object(text: str, path: Path) -> list[tuple[int | None, Any, Any]]:
    parse_json(text, path)
    # Keys that stand twice would be lost in a dictionary.
    pairs: list[tuple[str, Any]] = json.loads(text, object_pairs_hook=list)
    return [(None, motion, value) for motion, value in pairs]


def _lines(text: str) -> list[tuple[int | None, Any, Any]]:
    rows = [(line, row) for line, row in enumerate(text.splitlines(), 1) if row.strip() and row[0] != "#"]
    found: list[tuple[int | None, Any, Any]] = []
    for line, row in rows:
        motion, _, written = row.rpartition("\t")
        try:
            found.append((line, motion, COST.read(written)))
        except ValueError:
            found.append((line, motion or row, written))
    return found
