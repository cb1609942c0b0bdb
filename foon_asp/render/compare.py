"""All methods side by side, and what human steps are worth, as tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from foon_asp.model.node import ObjectNode
from foon_asp.render.table import table
from foon_asp.retrieval.compare import COLUMNS, PAPER_COLUMNS, HumanTable, Row
from foon_asp.retrieval.tree import TaskTree
from foon_asp.words import chance_text, cut

_WIDEST = 44
"""How many characters of a goal are shown."""


_HEADS = {
    "paper_ids": "IDS",
    "paper_success": "h1",
    "paper_inputs": "h2",
    "first_reference": "first",
    "greedy_success_reference": "success",
    "greedy_inputs_reference": "inputs",
    "first": "first",
    "ids": "ids",
    "greedy_success": "success",
    "greedy_inputs": "inputs",
    "optimal": "optimal",
}
_GROUPS = (
    ("paper", PAPER_COLUMNS),
    ("reference", tuple(name for name, column in COLUMNS.items() if not column.founded)),
    ("founded", tuple(name for name, column in COLUMNS.items() if column.founded)),
)


def comparison_text(rows: Sequence[Row]) -> str:
    """Write the table of units per method: `!` cannot be executed, `*` is proven, `-` no tree."""
    present = {name for row in rows for name in row.cells}
    groups = [(title, [name for name in columns if name in present]) for title, columns in _GROUPS]
    groups = [(title, columns) for title, columns in groups if columns]
    cells = [["", *(title for title, _ in groups)]]
    cells.append(["goal", *(" ".join(f"{_HEADS[name]:>8}" for name in columns) for _, columns in groups)])
    for name, row in zip(_names(row.goal for row in rows), rows, strict=True):
        cells.append([name, *(" ".join(_cell(row, column) for column in columns) for _, columns in groups)])
    first, *lines = table(cells, *["<"] * (1 + len(groups)), gap=" | ")
    lines = [first.rstrip(), *lines, ""]
    lines.append(
        "functional units in the tree; ! cannot be executed, * proven optimal, - no tree exists, ? time limit"
    )
    if any(title == "paper" for title, _ in groups):
        lines.append("paper: as published (IDS, heuristic 1: success rate, heuristic 2: fewest inputs)")
    return "\n".join(lines) + "\n"


def _cell(row: Row, name: str) -> str:
    cell = row.cells.get(name)
    if cell is None:
        return " " * 8
    if cell.units is None:
        return f"{'-' if cell.proven else '?':>8}"
    mark = "!" if cell.executable is False else "*" if cell.proven else " "
    return f"{cell.units:>7}{mark}"


def human_text(tables: Sequence[HumanTable]) -> str:
    """Write for each goal the chance of success, the more steps a human does."""
    columns = max((len(each.trees) for each in tables), default=0)
    rows = [["goal", *(f"{count:>9}" for count in range(columns))]]
    for name, each in zip(_names(each.goal for each in tables), tables, strict=True):
        cells = [f"{_chance(tree, proven):>9}" for tree, proven in each.trees]
        rows.append([name, *(cells or [f"  -  {each.reason}"])])
    first, *lines = table(rows, "<", gap="")
    lines = [first.rstrip(), *lines, ""]
    lines.append("highest chance of success with at most so many steps done by a human; ? not proven")
    return "\n".join(lines) + "\n"


def _chance(tree: TaskTree | None, proven: bool) -> str:
    if tree is None or tree.costs.success is None:
        return "?"
    return f"{chance_text(tree.costs.success, 2)}{'' if proven else '?'}"


def _names(goals: Iterable[ObjectNode]) -> list[str]:
    names = map(str, goals)
    return [cut(name, _WIDEST) for name in names]
