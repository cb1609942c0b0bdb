"""What can be cooked, as a table."""

from __future__ import annotations

import math

from foon_asp.limits import ended
from foon_asp.query.objective import Costs, Criterion
from foon_asp.render.table import table
from foon_asp.retrieval.suggest import Suggestions
from foon_asp.words import chance_text, counted


def suggestions_text(result: Suggestions, count: int | None = None) -> str:
    """Write a table of the dishes, all or the best so many: what they cost by what was asked, and steps."""
    objective = result.query.objective
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
        heads = [str(criterion) for criterion in objective]
        rows = [[_cost(criterion, each.costs) for criterion in objective] for each in shown]
        if "units" not in heads:
            heads.append("units")
            rows = [[*row, str(each.costs.units)] for row, each in zip(rows, shown, strict=True)]
        rows = [[*heads, "dish"], *([*row, str(each.dish)] for row, each in zip(rows, shown, strict=True))]
        lines += table(rows, *[">"] * len(heads))
        if len(shown) < total:
            lines.append(f"and {total - len(shown)} more")
    if result.skipped:
        lines.append(f"{ended(result.limit)}: {counted(result.skipped, 'more candidate')} not looked at")
    return "\n".join(lines) + "\n"


def _cost(criterion: Criterion, costs: Costs) -> str:
    if criterion.names == ("success",):
        return "?" if costs.success is None else chance_text(costs.success)
    cost = criterion.cost(costs)
    return "never" if cost == math.inf else f"{cost:.6g}"
