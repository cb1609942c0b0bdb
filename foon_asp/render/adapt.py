"""A dish adapted as text: its tree, what was changed, and the dishes that were looked at."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from foon_asp.render.proof import limit_text
from foon_asp.render.table import table
from foon_asp.render.tree import retrieval_lines
from foon_asp.retrieval.adapt import Adaptation, Candidate
from foon_asp.words import wrapped

_SHOWN = 10
"""How many dishes are listed."""


def adaptation_text(found: Adaptation) -> str:
    """Write the tree with what was changed, or why there is none; then the dishes, the nearest first."""
    lines = retrieval_lines(found.answer, _changes(found))
    if len(found.candidates) > 1:
        shown = found.candidates[:_SHOWN]
        lines += ["", *(_distances(found, shown) if found else _reasons(shown))]
        if len(found.candidates) > _SHOWN:
            lines.append(f"and {len(found.candidates) - _SHOWN} more dishes")
    return "\n".join(lines) + "\n"


def _distances(found: Adaptation, dishes: Iterable[Candidate]) -> Iterator[str]:
    rows = [(_far(found, each), str(each.dish)) for each in dishes]
    yield from (line.rstrip() for line in table([("distance", "dish"), *rows], ">", "<"))


def _reasons(dishes: Iterable[Candidate]) -> Iterator[str]:
    for each in dishes:
        yield from wrapped(f"{each.dish}: {each.reason or 'no tree in time'}", "  ", "      ")


def _changes(found: Adaptation) -> Iterator[str]:
    yield f"{found.distance:.3f} from what was asked"
    yield from map(str, found.replaced)
    for row in found.additions:
        yield f"{row.by} beside {row.label} ({row.likeness:.3g}: {row.why})"
    for label in found.missing:
        yield f"{label} could not be added: nothing that goes into the dish is known to be like it"
    for node in found.brought:
        yield f"{node} is taken to be at hand; the kitchen lacks it"


def _far(found: Adaptation, each: Candidate) -> str:
    if each.distance is not None:
        return f"{each.distance:.3f}" + " at most" * (each.status == "limit")
    return limit_text(found.answer.limit) if each.status == "limit" else "not made"
