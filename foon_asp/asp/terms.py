"""Terms of clingo as plain values, and how they are written."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Union

from foon_asp.errors import QueryError

Term = Union[int, str, "tuple[Term, ...]", "Function"]
"""A number, a text, a tuple or a function."""

Row = tuple[Term, ...]
"""The arguments of an atom."""

_UNFIT = re.compile("[\0\ud800-\udfff]")


@dataclass(frozen=True, slots=True)
class Function:
    """A term with a name: a constant like `oven`, or a function like `step(3)`; `-` stands in the name."""

    name: str
    arguments: tuple[Term, ...] = ()

    def __str__(self) -> str:
        return self.name + (f"({_written(self.arguments)})" if self.arguments else "")


def quote(text: str) -> str:
    """Write a text as a clingo string; raise `QueryError` for one that clingo cannot hold."""
    if found := _UNFIT.search(text):
        raise QueryError(f"{text[:40]!a}: clingo has no place for the character {found[0]!a}")
    return '"' + text.replace("\\", "\\\\").replace("\n", "\\n").replace('"', '\\"') + '"'


def written(term: Term) -> str:
    """Write a term as clingo does, but a text without its quotes."""
    return term if isinstance(term, str) else _written((term,))


def literal(term: Term) -> str:
    """Write a term as clingo does."""
    return _written((term,))


def _written(terms: Iterable[Term]) -> str:
    parts = []
    for term in terms:
        if isinstance(term, str):
            parts.append(quote(term))
        elif isinstance(term, tuple):
            parts.append(f"({_written(term)}{',' if len(term) == 1 else ''})")
        else:
            parts.append(str(term))
    return ",".join(parts)
