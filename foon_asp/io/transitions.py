"""Models of which transitions there are: lists of states, places or motions in the order they come in."""

from __future__ import annotations

from pathlib import Path

from foon_asp.characters import is_label
from foon_asp.errors import InputError
from foon_asp.io.files import parse_json, read_string
from foon_asp.model.node import check_label
from foon_asp.values import a_list, said

_ADVICE = 'write lists of words in their order: [["whole", "peeled", "diced"], …]'

Orders = tuple[tuple[str, ...], ...]
"""Words in the orders in which they may come: of the states of a thing, its places, or motions with it."""


def stated_orders(value: object, name: str) -> Orders:
    """Return orders that Python gives; raise `QueryError` if they are no lists of lists of words."""
    orders = [a_list(order, name, "words") for order in a_list(value, name, "lists of words")]
    for word in (word for order in orders for word in order):
        check_label(word, f"a word of {name!r}")
    return tuple(map(tuple, orders))


def read_orders(path: Path) -> Orders:
    """Read a JSON list of lists of words, in lower case; raise `InputError`."""
    value = parse_json(read_string(path), path)
    if not isinstance(value, list):
        raise InputError(path, None, f"expected a list of orders, not {said(value)}", _ADVICE)
    for order in value:
        if not isinstance(order, list):
            raise InputError(path, None, f"an order is a list of words, not {said(order)}", _ADVICE)
        for word in order:
            if not isinstance(word, str) or not is_label(word):
                raise InputError(path, None, f"{said(word)} in an order is no word", _ADVICE)
    return tuple(tuple(word.strip().lower() for word in order) for order in value)
