"""The explorer answers every public goal as Python does, by every method, and replays every tree."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from selenium.webdriver import Chrome

from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.retrieve import retrieve
from support.browser import Explorer, question

ASKED: tuple[dict[str, Any], ...] = (
    {"by": ["units"]},
    {"by": ["success"]},
    {"by": ["depth", "tools"]},
    {"method": "greedy", "by": ["success"]},
    {"method": "greedy", "by": ["inputs"]},
    {"method": "greedy", "by": ["inputs"], "founded": False},
    {"method": "first", "by": []},
    {"method": "ids", "by": []},
)


def test_the_page_answers_all_public_goals_as_python_does(
    universal_world: World, browser: Chrome, tmp_path: Path
) -> None:
    explorer = Explorer(browser, universal_world, tmp_path)
    known = [goal for goal in universal_world.goals if universal_world.foon.id_of(goal) is not None]
    posed = [(goal, each) for goal in known for each in ASKED]
    answers = explorer.ask_all(None, [question(goal, **each) for goal, each in posed])
    trees = []
    for (goal, each), answer in zip(posed, answers, strict=True):
        expected = retrieve(universal_world, Query(goal, **each))
        assert answer.get("status") == expected.status, (goal, each, answer)
        if expected.tree is None:
            assert answer["reason"] is not None
            continue
        [said] = answer["trees"]
        assert said["executable"] == expected.tree.executable
        if expected.status == Status.OPTIMAL:
            objective = expected.query.objective
            costs = type(expected.tree.costs)(**{"human": 0, **said["costs"]})
            assert objective.costs(costs) == objective.costs(expected.tree.costs), (goal, each)
        else:
            assert sorted(said["units"]) == sorted(expected.tree.units), (goal, each)
        trees.append((goal, each, said))
    assert len(known) == 25
    assert len(trees) > 180
    assert not explorer.complaints()


def test_a_slice_answers_as_the_whole_does(universal_world: World, browser: Chrome, tmp_path: Path) -> None:
    named = [goal for goal in universal_world.goals if goal.label in ("macaroni", "ice")]
    explorer = Explorer(browser, universal_world, tmp_path, goals=named)
    answers = explorer.ask_all(None, [question(goal, by=["success"]) for goal in named])
    for goal, answer in zip(named, answers, strict=True):
        expected = retrieve(universal_world, Query(goal, by="success"))
        assert expected.tree is not None
        # Units have the numbers that they have in the whole FOON.
        assert sorted(answer["trees"][0]["units"]) == sorted(expected.tree.units)
    assert "units: those that can matter for" in explorer.script("return document.body.innerText")
