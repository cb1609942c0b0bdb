"""Reading what stands beside a FOON: objects at hand, goals, success rates, labels. One clear error each."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from foon_asp.characters import is_label
from foon_asp.errors import InputError
from foon_asp.io.document import OBJECTS_ADVICE, Document
from foon_asp.io.files import read_string
from foon_asp.io.objects import object_from_json, refuse_unknown_keys
from foon_asp.model.node import ObjectNode
from foon_asp.numbers import QUANTITY, RATE
from foon_asp.values import said

_LINE_END = re.compile(r"\r\n|\r|\n")


def read_objects(path: Path) -> list[ObjectNode]:
    """Read a JSON list of objects `{label, states, ingredients, container}`, e.g. goals."""
    return [node for node, _ in _read_items(path)]


def read_stock(path: Path) -> dict[ObjectNode, int | None]:
    """Read a kitchen: a list of objects, each with how many there are (`quantity`), or None for plenty.

    The quantities of an object that is listed twice add up; of an object with the quantity 0 there is none.
    """
    stock: dict[ObjectNode, int | None] = {}
    for node, quantity in _read_items(path):
        before = stock.get(node, 0)
        # What is more than the largest quantity is plenty.
        total = None if before is None or quantity is None else before + quantity
        stock[node] = total if total is None or QUANTITY.fits(total) else None
    return {node: quantity for node, quantity in stock.items() if quantity != 0}


def _read_items(path: Path) -> list[tuple[ObjectNode, int | None]]:
    found = []
    for place, item in enumerate(Document(read_string(path), path).read_list(), 1):
        try:
            if item.repeated:
                raise ValueError(f"the key {item.repeated[0]!r} stands twice")
            node = object_from_json(item.value, refuse_unknown_keys, more=("quantity",))
            found.append((node, _quantity(item.value)))
        except ValueError as error:
            raise InputError(path, item.line, f"object {place}: {error}", OBJECTS_ADVICE) from None
    return found


def _quantity(item: dict[str, Any]) -> int | None:
    quantity = item.get("quantity")
    if quantity is not None and not QUANTITY.fits(quantity):
        raise ValueError(f"'quantity' is {QUANTITY.words}, not {said(quantity)}")
    return quantity


def read_rates(path: Path) -> dict[str, float]:
    """Read `motion<tab>rate` lines; a rate is a chance in [0, 1], and a motion has one."""
    rates: dict[str, float] = {}
    lines: dict[str, int] = {}
    for line, row in rows(path):
        label, tab, text = row.rpartition("\t")
        motion = label.strip().lower().rstrip("*").rstrip()
        try:
            rate = RATE.read(text)
        except ValueError:
            rate = -1
        if not tab or rate < 0 or not is_label(motion):
            advice = "write motion<tab>rate, the rate between 0 and 1"
            raise InputError(path, line, f"cannot read {said(row)}", advice)
        if rates.setdefault(motion, rate) != rate:
            problem = f"{rate:g} here and {rates[motion]:g} in line {lines[motion]}"
            raise InputError(path, line, f"two rates of {said(motion)}: {problem}", "keep one of the lines")
        lines.setdefault(motion, line)
    return rates


def read_labels(path: Path) -> frozenset[str]:
    """Read labels, one a line: utensils, motions, what a diet forbids."""
    found = set()
    for line, row in rows(path):
        label = row.strip().lower()
        if not is_label(label):
            problem = f"no label: {said(row)} has a character that no label may have"
            raise InputError(path, line, problem, "write a label a line")
        found.add(label)
    return frozenset(found)


def rows(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the lines of a file with their numbers, but for empty ones and those that begin with `#`."""
    for line, row in enumerate(_LINE_END.split(read_string(path)), 1):
        if row.strip() and not row.startswith("#"):
            yield line, row
