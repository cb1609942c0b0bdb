"""The paper's table for any list of goals: how many units each method uses, and whether it works."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from foon_asp.io.wire import dumps
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.retrieval.wire import comparison_json
from foon_asp.words import counted

if TYPE_CHECKING:
    import pandas as pd
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree

COLUMNS = {
    "first_reference": Query(method="first", founded=False),
    "greedy_success_reference": Query(method="greedy", by="success", founded=False),
    "greedy_inputs_reference": Query(method="greedy", by="inputs", founded=False),
    "first": Query(method="first"),
    "ids": Query(method="ids"),
    "greedy_success": Query(method="greedy", by="success"),
    "greedy_inputs": Query(method="greedy", by="inputs"),
    "optimal": Query(by="units"),
}
"""Column name: what is asked of each goal."""

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
    world: World, goals: Iterable[ObjectNode], *, most: int | None = None, time_limit: float | None = None
) -> list[HumanTable]:
    """Return for each goal the trees and splits with the highest success, the more a human may do.

    It goes on until nothing can fail, or until `most` human steps; `time_limit` (seconds) is for each tree.
    """
    return [_human_table(world, goal, most, time_limit) for goal in goals]


def _human_table(world: World, goal: ObjectNode, most: int | None, time_limit: float | None) -> HumanTable:
    trees: list[tuple[TaskTree | None, bool]] = []
    while most is None or len(trees) <= most:
        query = Query(goal, by="success", time_limit=time_limit, human_steps=len(trees))
        result = retrieve(world, query)
        if result.status == Status.UNREACHABLE:
            return HumanTable(goal, (), result.reason)
        trees.append((result.tree, result.status == Status.OPTIMAL))
        if result.tree is None or result.tree.costs.success == 1:
            break
    return HumanTable(goal, tuple(trees), "")


@dataclass(frozen=True, slots=True, repr=False)
class Comparison:
    """A row for each goal: how many units each method needs."""

    rows: tuple[Row, ...]

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<Comparison: {counted(len(self.rows), 'goal')}, {self.status}>"

    def __str__(self) -> str:
        from foon_asp.render.compare import comparison_text

        return comparison_text(self.rows).rstrip()

    @property
    def status(self) -> Status:
        """`LIMIT` if some optimum was not proven in time."""
        proven = all(row.cells["optimal"].proven for row in self.rows)
        return Status.FOUND if proven else Status.LIMIT

    def to_json(self) -> str:
        """Return the rows as `foon-asp compare --format json` writes them."""
        return dumps(comparison_json(self.rows))

    def to_frame(self) -> pd.DataFrame:
        """Return a row for each goal, a column for each method: functional units, missing without a tree."""
        from foon_asp.render.frames import comparison_frame

        return comparison_frame(self.rows)

    def _repr_html_(self) -> str:
        return str(self.to_frame().to_html())


def compare(world: World, goals: Iterable[ObjectNode], *, time_limit: float | None = None) -> Comparison:
    """Retrieve every goal by every method; `time_limit` (seconds) holds for each of them alone.

    Columns that need success rates are left out if the kitchen has none.
    """
    return Comparison(tuple(_row(world, goal, time_limit) for goal in goals))


def _row(world: World, goal: ObjectNode, time_limit: float | None) -> Row:
    # A table does not say why there is no tree, which may take long to find out.
    locked = world.id_of(goal) not in world.closure.available
    has_rates = bool(world.kitchen.rates) or world.kitchen.default_rate is not None
    cells: dict[str, Cell] = {}
    if len(world.foon.units) == _PAPER_UNITS and goal.label in _PAPER_TABLE:
        for name, units in zip(PAPER_COLUMNS, _PAPER_TABLE[goal.label], strict=True):
            cells[name] = Cell(units, None, False)
    for name, query in COLUMNS.items():
        if "success" in query.objective.names and not has_rates:
            continue
        if locked and query.founded:
            cells[name] = Cell(None, False, True)
        else:
            cells[name] = _cell(retrieve(world, query.replace(goals=[goal], time_limit=time_limit)))
    return Row(goal, cells)


def _cell(result: Answer) -> Cell:
    if result.tree is None:
        return Cell(None, False, result.status == Status.UNREACHABLE)
    return Cell(len(result.tree.units), result.tree.executable, result.status == Status.OPTIMAL)
