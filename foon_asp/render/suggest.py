"""Suggestions as text and as JSON."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from foon_asp.criteria import Costs, Level, parse_by
from foon_asp.errors import counted
from foon_asp.render.json import constraint_names
from foon_asp.state_syntax import object_to_json
from foon_asp.suggest import Suggestions


def suggestions_text(result: Suggestions, count: int | None = None) -> str:
    """Write a table of the dishes, all or the best so many: what they cost by what was asked, and steps."""
    levels = parse_by(result.by)
    shown = result.dishes[:count]
    what = " made with " + " and ".join(result.using) if result.using else ""
    total = len(result.dishes)
    if total == 0:
        lines = [f"no dish{what} was found"]
    else:
        lines = [
            f"{total} dish{'' if total == 1 else 'es'}{what}, the best by {', '.join(result.by)} first",
            "",
        ]
        heads = [str(level) for level in levels]
        rows = [[_cost(level, suggestion.costs) for level in levels] for suggestion in shown]
        if "units" not in heads:
            heads.append("units")
            rows = [[*row, str(each.costs.units)] for row, each in zip(rows, shown, strict=True)]
        widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
        table = [[*heads, "dish"], *([*row, str(each.dish)] for row, each in zip(rows, shown, strict=True))]
        for *cells, name in table:
            lines.append("  ".join([*(cell.rjust(w) for cell, w in zip(cells, widths, strict=True)), name]))
        if len(shown) < total:
            lines.append(f"and {total - len(shown)} more")
    if result.skipped:
        lines.append(f"the time ran out: {counted(result.skipped, 'more candidate')} not looked at")
    return "\n".join(lines) + "\n"


def _cost(level: Level, costs: Costs) -> str:
    if level.names == ("success",):
        return "?" if costs.success is None else f"{costs.success:.3g}"
    return f"{level.cost(costs):.6g}"


def suggestions_value(result: Suggestions, count: int | None = None) -> dict[str, Any]:
    """Return the value that `suggest --format json` writes, with all dishes or the best so many."""
    return {
        "by": list(result.by),
        "using": list(result.using),
        "constraints": constraint_names(result.constraints),
        "candidates": result.candidates,
        "found": len(result.dishes),
        "skipped": result.skipped,
        "dishes": [
            {
                "dish": object_to_json(suggestion.dish),
                "costs": asdict(suggestion.costs),
                "units": list(suggestion.tree.units),
            }
            for suggestion in result.dishes[:count]
        ],
        "seconds": round(result.seconds, 6),
    }
