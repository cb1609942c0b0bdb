"""Answers as tables of pandas, which is imported where a table is made."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from foon_asp.model.consumption import Effects
from foon_asp.model.foon import Foon
from foon_asp.model.node import ObjectId
from foon_asp.model.supply import Supply
from foon_asp.planning.plan import Plan
from foon_asp.query.objective import Costs
from foon_asp.retrieval.alternatives import Alternatives
from foon_asp.retrieval.compare import Row
from foon_asp.retrieval.suggest import Suggestions
from foon_asp.retrieval.tree import TaskTree

if TYPE_CHECKING:
    import pandas as pd


def _frame(rows: Iterable[dict[str, Any]], columns: Iterable[str], index: str) -> pd.DataFrame:
    """Return a table with the same columns whether it has rows or not."""
    import pandas as pd

    return pd.DataFrame(list(rows), columns=[index, *columns]).set_index(index)


def tree_frame(tree: TaskTree) -> pd.DataFrame:
    """Return the steps of a task tree, one a row; objects are texts, joined by semicolons."""
    rows = (
        {
            "step": step.place,
            "round": step.round,
            "motion": step.motion,
            "takes": "; ".join(map(str, step.takes)),
            "makes": "; ".join(map(str, step.makes)),
            "unit": step.unit,
            "source": str(step.source),
            "human": step.human,
        }
        for step in tree.steps
    )
    return _frame(rows, ("round", "motion", "takes", "makes", "unit", "source", "human"), "step")


def foon_frame(foon: Foon) -> pd.DataFrame:
    """Return the units of a FOON, one a row; objects are texts, joined by semicolons."""
    objects = foon.objects
    rows = (
        {
            "unit": unit.id,
            "motion": unit.motion,
            "inputs": "; ".join(str(objects[number]) for number in unit.inputs),
            "outputs": "; ".join(str(objects[number]) for number in unit.outputs),
            "start": unit.annotation.start,
            "end": unit.annotation.end,
            "rate": unit.annotation.rate,
            "source": str(unit.source),
            "video": unit.source.video,
        }
        for unit in foon.units
    )
    columns = ("motion", "inputs", "outputs", "start", "end", "rate", "source", "video")
    return _frame(rows, columns, "unit")


def plan_frame(plan: Plan) -> pd.DataFrame:
    """Return the steps of a plan, one a row; objects are texts, joined by semicolons."""
    world = plan.world

    def named(numbers: Iterable[ObjectId]) -> str:
        return "; ".join(str(world.node(number)) for number in numbers)

    supply = Supply(Effects(world, plan.semantics))
    rows = []
    for place, (number, parallel) in enumerate(zip(plan.units, plan.steps, strict=True), 1):
        unit, gone = world.foon.units[number], supply.used_up(number)
        supply.execute(number)
        rows.append(
            {
                "step": place,
                "parallel": parallel,
                "motion": unit.motion,
                "takes": named(unit.inputs),
                "makes": named(world.units.makes[number]),
                "gone": named(gone),
                "unit": number,
                "source": str(unit.source),
            }
        )
    return _frame(rows, ("parallel", "motion", "takes", "makes", "gone", "unit", "source"), "step")


_COSTS = ("units", "inputs", "success", "depth", "tools", "dirty", "motions", "time", "human")


def _costs_frame(index: str, named: Iterable[tuple[str | int, Costs]]) -> pd.DataFrame:
    """Return what some trees cost, one a row; what motions cost only if that is known of one."""
    rows = [{index: name, **asdict(costs)} for name, costs in named]
    costly = any(row["cost"] is not None for row in rows)
    return _frame(rows, (*_COSTS, "cost") if costly else _COSTS, index)


def alternatives_frame(result: Alternatives) -> pd.DataFrame:
    """Return what each of several task trees costs, one a row."""
    return _costs_frame("tree", ((place, tree.costs) for place, tree in enumerate(result.trees, 1)))


def suggestions_frame(result: Suggestions) -> pd.DataFrame:
    """Return the dishes that can be cooked, the best first, and what each costs."""
    return _costs_frame("dish", ((str(each.dish), each.costs) for each in result.dishes))


def comparison_frame(rows: Iterable[Row]) -> pd.DataFrame:
    """Return the functional units of each goal by each method; missing where there is no tree."""
    listed = [
        {"goal": str(row.goal), **{name: cell.units for name, cell in row.cells.items()}} for row in rows
    ]
    columns = dict.fromkeys(name for row in listed for name in row if name != "goal")
    return _frame(listed, columns, "goal").astype("Int64")
