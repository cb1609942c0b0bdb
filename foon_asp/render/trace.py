"""The trace of a search as text."""

from __future__ import annotations

from collections.abc import Iterable

from foon_asp.model.world import World
from foon_asp.retrieval.trace import Bound
from foon_asp.words import wrapped


def bound_text(world: World, bound: Bound) -> str:
    """Write what was explored with one limit: `limit 2: A, B, E`, wrapped."""
    names = ", ".join(str(world.node(object_id)) for object_id, _ in bound.explored)
    return "\n".join(wrapped(f"limit {bound.limit}: {names}", "", " " * 4)) + "\n"


def trace_text(world: World, bounds: Iterable[Bound]) -> str:
    """Write the whole trace, one limit after the other, and how it ended."""
    lines: list[str] = []
    last: Bound | None = None
    for last in bounds:
        lines.append(bound_text(world, last))
    if last is not None:
        end = "the goal is reached" if last.reached else "the goal is not reached"
        lines.append(f"{end} with limit {last.limit}\n")
    return "".join(lines)
