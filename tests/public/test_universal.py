"""What must hold on the public universal FOON."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from foon_asp.io.folder import Dataset
from foon_asp.io.objects import object_from_json
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.compare import PAPER_COLUMNS, compare
from foon_asp.retrieval.methods.greedy import settled
from foon_asp.retrieval.reach import reach
from foon_asp.retrieval.retrieve import retrieve
from support import paper_pseudocode

METHODS = {
    "first": ("first", ()),
    "greedy_success": ("greedy", ("success",)),
    "greedy_inputs": ("greedy", ("inputs",)),
}
LOCKED = {"whipped cream", "fried rice"}


def test_counts(universal: Dataset) -> None:
    foon = universal.foon
    assert (len(foon.units), len(foon.objects), len(foon.motions)) == (2376, 4305, 129)
    assert len(universal.kitchen.objects) == 1174


@pytest.mark.parametrize(("strict", "units", "objects"), [(False, 2306, 4192), (True, 2092, 3873)])
def test_reach(universal: Dataset, strict: bool, units: int, objects: int) -> None:
    world = universal.world(strict=strict)
    available, executable = reach(world)
    assert (len(executable), len(available)) == (units, objects)
    assert [str(node) for node in world.strangers] == ["ranch dressing [creamy]"]


@pytest.mark.parametrize("method", METHODS)
def test_reference_trees_are_the_published_ones(
    public_data: Path, universal_world: World, method: str
) -> None:
    counts = json.loads((public_data / "reference_counts.json").read_text())
    name, by = METHODS[method]
    assert len(counts["goals"]) == 25
    for entry in counts["goals"]:
        goal = object_from_json(entry["goal"])
        result = retrieve(universal_world, Query(goal, method=name, by=by, founded=False))
        assert result.tree is not None
        assert len(result.tree.units) == entry[method], goal
        literal = paper_pseudocode.retrieve(universal_world, goal, method.removeprefix("greedy_"))
        assert set(result.tree.units) == set(literal), goal


@pytest.mark.parametrize(
    ("method", "by"),
    [
        ("first", ""),
        ("ids", ""),
        ("greedy", "success"),
        ("greedy", "inputs"),
        ("optimal", "units"),
        ("optimal", "success"),
        ("optimal", "inputs"),
        ("optimal", "depth"),
        ("optimal", "success,depth"),
    ],
)
def test_founded_trees_for_23_of_25_goals(
    universal: Dataset, universal_world: World, method: str, by: str
) -> None:
    locked = set()
    for goal in universal.goals:
        result = retrieve(universal_world, Query(goal, method=method, by=by or ()))
        if result.tree is None:
            locked.add(goal.label)
            assert result.status == "unreachable"
            assert "locked in a circle" in result.reason
            assert "FOON.txt:" in result.reason
        else:
            assert result.tree.executable
            assert result.status == ("optimal" if method == "optimal" else "found")
    assert locked == LOCKED


@pytest.mark.parametrize("heuristic", ["first", "success", "inputs"])
def test_no_greedy_tree_takes_a_search(universal_world: World, heuristic: str) -> None:
    goals = [goal for goal in universal_world.closure.available if goal not in universal_world.stock]
    assert len(goals) == 3018
    for goal in goals:
        found = settled(Problem(universal_world, (goal,)), heuristic)
        assert found is not None
        assert found.tree is not None
        assert found.tree.executable


def test_no_method_beats_the_optimum(universal: Dataset, universal_world: World) -> None:
    for row in compare(universal_world, universal.goals):
        best = row.cells["optimal"]
        if row.goal.label in LOCKED:
            assert best.units is None
            continue
        assert best.proven
        assert best.units is not None
        for name, cell in row.cells.items():
            if cell.executable and cell.units is not None:
                assert cell.units >= best.units, (row.goal, name)


def test_13_of_the_15_cells_of_the_papers_table_agree(universal: Dataset, universal_world: World) -> None:
    rows = compare(universal_world, universal.goals[:5]).rows
    ours = ("first_reference", "greedy_success_reference", "greedy_inputs_reference")
    pairs = [
        (row.cells[paper].units, row.cells[mine].units)
        for row in rows
        for paper, mine in zip(PAPER_COLUMNS, ours, strict=True)
    ]
    assert sum(theirs == mine for theirs, mine in pairs) == 13
    assert len(pairs) == 15


def test_depth_first_is_the_round_of_the_closure(universal: Dataset, universal_world: World) -> None:
    closure = universal_world.closure.available
    for goal in universal.goals:
        if goal.label in LOCKED:
            continue
        number = universal_world.id_of(goal)
        for method, by in (("ids", ()), ("optimal", ("depth",))):
            tree = retrieve(universal_world, Query(goal, method=method, by=by)).tree
            assert tree is not None
            assert tree.depth == closure[number]
