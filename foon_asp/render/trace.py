"""The trace of a search as text and as JSON."""

from __future__ import annotations

from collections.abc import Iterable
from textwrap import wrap
from typing import Any

from foon_asp.problem import Domain
from foon_asp.state_syntax import object_to_json
from foon_asp.trace import Bound

_WIDTH = 100


def bound_text(domain: Domain, bound: Bound) -> str:
    """Write what was explored with one limit: `limit 2: A, B, E`, wrapped."""
    names = ", ".join(str(domain.node(thing)) for thing, _ in bound.explored)
    lines = wrap(
        f"limit {bound.limit}: {names}",
        _WIDTH,
        subsequent_indent=" " * 4,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return "\n".join(lines) + "\n"


def trace_text(domain: Domain, bounds: Iterable[Bound]) -> str:
    """Write the whole trace, one limit after the other, and how it ended."""
    lines: list[str] = []
    last: Bound | None = None
    for last in bounds:
        lines.append(bound_text(domain, last))
    if last is not None:
        end = "the goal is reached" if last.reached else "the goal is not reached"
        lines.append(f"{end} with limit {last.limit}\n")
    return "".join(lines)


def trace_value(domain: Domain, bounds: Iterable[Bound]) -> list[dict[str, Any]]:
    """Return the trace as a JSON value, one member for each limit."""
    return [
        {
            "limit": bound.limit,
            "explored": [object_to_json(domain.node(thing)) for thing, _ in bound.explored],
            "reached": bound.reached,
        }
        for bound in bounds
    ]
