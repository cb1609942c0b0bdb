"""The paper's table for any list of goals: how many units each method uses, and whether it works."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from foon_asp.constraints import Constraints
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval, retrieve
from foon_asp.tree import TaskTree

COLUMNS: dict[str, tuple[str, tuple[str, ...], bool]] = {
    "first_reference": ("first", (), False),
    "greedy_success_reference": ("greedy", ("success",), False),
    "greedy_inputs_reference": ("greedy", ("inputs",), False),
    "first": ("first", (), True),
    "ids": ("ids", (), True),
    "greedy_success": ("greedy", ("success",), True),
    "greedy_inputs": ("greedy", ("inputs",), True),
    "optimal": ("optimal", ("units",), True),
}
"""Column name: method, criteria, founded."""

PAPER_COLUMNS = ("paper_ids", "paper_success", "paper_inputs")
_PAPER_UNITS = 2376
_PAPER_TABLE = {
    "greek salad": (31, 32, 28),
    "ice": (1, 1, 1),
    "macaroni": (7, 7, 8),
    "sweet potato": (3, 3, 3),
    "whipped cream": (10, 10, 15),
}
"""Functional units by iterative deepening and by the two heuristics, as the paper prints them.

They belong to the universal FOON of October 2021 and say nothing about any other.
"""


@dataclass(frozen=True, slots=True)
class Cell:
    """Units in the tree (None: there is no tree), whether it can be executed, whether it is optimal."""

    units: int | None
    executable: bool | None
    proven: bool


@dataclass(frozen=True, slots=True)
class Row:
    """One goal, and a cell for each column."""

    goal: ObjectNode
    cells: dict[str, Cell]


@dataclass(frozen=True, slots=True)
class HumanTable:
    """The likeliest tree for 0, 1, 2, … human steps, each with whether it is proven; or why there is none."""

    goal: ObjectNode
    trees: tuple[tuple[TaskTree | None, bool], ...]
    reason: str


def compare_human(
    domain: Domain, goals: Iterable[ObjectNode], *, most: int | None = None, time_limit: float | None = None
) -> list[HumanTable]:
    """Return for each goal the trees and splits with the highest success, the more a human may do.

    It goes on until nothing can fail, or until `most` human steps; `time_limit` (seconds) is for each tree.
    """
    return [_human_table(domain, goal, most, time_limit) for goal in goals]


def _human_table(domain: Domain, goal: ObjectNode, most: int | None, time_limit: float | None) -> HumanTable:
    trees: list[tuple[TaskTree | None, bool]] = []
    while most is None or len(trees) <= most:
        constraints = Constraints(human_steps=len(trees))
        result = retrieve(domain, goal, by="success", time_limit=time_limit, constraints=constraints)
        if result.status == "unreachable":
            return HumanTable(goal, (), result.reason)
        trees.append((result.tree, result.status == "optimal"))
        if result.tree is None or result.tree.costs.success == 1:
            break
    return HumanTable(goal, tuple(trees), "")


def compare(domain: Domain, goals: Iterable[ObjectNode], *, time_limit: float | None = None) -> list[Row]:
    """Retrieve every goal by every method; `time_limit` (seconds) holds for each of them alone.

    Columns that need success rates are left out if the kitchen has none.
    """
    return [_row(domain, goal, time_limit) for goal in goals]


def _row(domain: Domain, goal: ObjectNode, time_limit: float | None) -> Row:
    has_rates = bool(domain.kitchen.rates) or domain.kitchen.default_rate is not None
    cells: dict[str, Cell] = {}
    if len(domain.foon.units) == _PAPER_UNITS and goal.label in _PAPER_TABLE:
        for name, units in zip(PAPER_COLUMNS, _PAPER_TABLE[goal.label], strict=True):
            cells[name] = Cell(units, None, False)
    for name, (method, by, founded) in COLUMNS.items():
        if "success" in by and not has_rates:
            continue
        result = retrieve(domain, goal, method, by, founded=founded, time_limit=time_limit)
        cells[name] = _cell(result)
    return Row(goal, cells)


def _cell(result: Retrieval) -> Cell:
    if result.tree is None:
        return Cell(None, False, result.status == "unreachable")
    return Cell(len(result.tree.units), result.tree.executable, result.status == "optimal")
