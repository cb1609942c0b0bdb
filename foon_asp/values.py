"""Values that Python code gives: how messages show them, and lists that are none."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from foon_asp.errors import QueryError
from foon_asp.words import cut

_LONGEST = 80


def said(value: object) -> str:
    """Return what was given as a message can hold it, whatever it is."""
    try:
        text = repr(value)
    except ValueError:
        # Python does not write it.
        text = "a number of thousands of digits"
    return cut(text, _LONGEST)


def a_list(values: Any, name: str, what: str) -> list[Any]:
    """Return values as a list; raise `QueryError` for no list, and for a text, whose letters nobody means."""
    if isinstance(values, str | bytes | Mapping) or not isinstance(values, Iterable):
        advice = f"; write [{said(values)}]" if isinstance(values, str) else ""
        raise QueryError(f"{name!r} is a list of {what}, not {said(values)}{advice}")
    return list(values)
