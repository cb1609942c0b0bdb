"""The explorer answers as Python does: what it says again of graphs and loops is equal on random FOONs."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from selenium.webdriver import Chrome

from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import best_trees, pareto_trees
from foon_asp.retrieval.missing import missing_sets
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree
from support.browser import FREE, Explorer, question
from support.examples import many
from support.small_foons import queries, world

OPTIMA = ("units", "success", "motions", "depth", "inputs", "tools", "dirty")
METHODS: tuple[dict[str, Any], ...] = (
    {"method": "greedy", "by": ["success"]},
    {"method": "greedy", "by": ["inputs"]},
    {"method": "first", "by": []},
    {"method": "ids", "by": []},
)


@pytest.fixture(scope="module")
def explorer(browser: Chrome, tmp_path_factory: pytest.TempPathFactory) -> Explorer:
    where = world(["onion -cut-> onion[chopped]"], "onion")
    return Explorer(browser, where, tmp_path_factory.mktemp("page"))


def costs_agree(tree: TaskTree, said: dict[str, Any]) -> None:
    """Check what the page says of a tree: costs and replay."""
    assert said["executable"] == tree.executable
    for name, cost in said["costs"].items():
        ours = getattr(tree.costs, name)
        assert cost == ours or math.isclose(cost, ours, rel_tol=1e-9), name


def replayed(where: World, goal: ObjectNode, said: dict[str, Any]) -> TaskTree:
    """Replay here what the page has found, and check what it says of it."""
    tree = TaskTree.of(where, [where.id_of(goal)], said["units"])
    costs_agree(tree, said)
    return tree


# Each example asks some thirty questions, and takes about half a second: to make one smaller takes minutes.
few = settings(many(40), phases=(Phase.explicit, Phase.generate))


@few
@given(queries(), st.integers(0, 3))
def test_the_page_answers_as_python_does(
    explorer: Explorer, posed: tuple[World, ObjectNode], count: int
) -> None:
    where, goal = posed
    labels = sorted(where.foon.named_labels)
    limits = {"avoid_motions": [where.foon.units[UnitId(0)].motion], "max_units": count}
    # Without utensils nobody knows what is one.
    criteria = OPTIMA if where.kitchen.utensils else OPTIMA[:5]
    asked: list[dict[str, Any]] = [
        *({"by": [name]} for name in criteria),
        {"by": ["depth", "success"]},
        *METHODS,
        *({**method, "founded": False} for method in METHODS if method["method"] != "ids"),
        {"constraints": limits},
        {"by": ["success"], "constraints": {"max_depth": count}},
        {"constraints": {"without": labels[:1], "without_tools": labels[-1:]}},
    ]
    questions = [
        question(goal, **{**each, "constraints": {**FREE, **each.get("constraints", {})}}) for each in asked
    ]
    several = question(goal, count=3, by=["success"])
    trade_off = question(goal, kind="pareto", by=["units", "success"])
    *answers, best, front = explorer.ask_all(where, [*questions, several, trade_off])
    for each, answer in zip(asked, answers, strict=True):
        query = Query(
            goal,
            by=each.get("by", ["units"]),
            method=each.get("method", "optimal"),
            founded=each.get("founded", True),
            **each.get("constraints", {}),
        )
        expected = retrieve(where, query)
        assert answer.get("status") == expected.status, (each, answer)
        if expected.tree is not None:
            [said] = answer["trees"]
            tree = replayed(where, goal, said)
            if query.method == "optimal":
                assert query.objective.costs(tree.costs) == query.objective.costs(expected.tree.costs)
            else:
                assert sorted(said["units"]) == sorted(expected.tree.units)
        elif answer["reason"]["kind"] == "lacking":
            [*sets] = missing_sets(where, where.id_of(goal)).sets
            assert len(answer["reason"]["add"] or ()) == len(sets[0] if sets else ())
    ours = best_trees(where, Query(goal, by="success"), 3)
    assert [tree["costs"]["success"] for tree in best["trees"]] == pytest.approx(
        [tree.costs.success for tree in ours.trees]
    )
    theirs = {(tree["costs"]["units"], round(tree["costs"]["success"], 9)) for tree in front}
    assert theirs == {
        (tree.costs.units, round(tree.costs.success or 0, 9))
        for tree in pareto_trees(where, Query(goal, by="units,success")).trees
    }


@few
@given(queries(), st.sampled_from([1, 2, 3]), st.booleans())
def test_the_page_reads_units_as_python_does(
    explorer: Explorer, posed: tuple[World, ObjectNode], level: int, loose: bool
) -> None:
    full, goal = posed
    where = World.of(
        full.foon,
        full.kitchen,
        strict=full.strict,
        level=level,
        match_relations="loose" if loose else "strict",
    )
    [said] = explorer.reach([where])
    assert said["needs"] == [list(where.units.needs[unit]) for unit in where.foon.units.ids]
    assert said["makes"] == [list(where.units.makes[unit]) for unit in where.foon.units.ids]
    assert dict(said["executable"]) == dict(where.closure.executable)
    reached = dict(said["available"])
    assert {n: depth for n, depth in reached.items() if depth} == {
        n: depth for n, depth in where.closure.available.items() if depth
    }
    seen = where.project(goal)
    [answer] = explorer.ask_all(where, [question(seen)])
    expected = retrieve(where, Query(seen))
    assert answer.get("status") == expected.status, answer
    if expected.tree is not None:
        assert answer["trees"][0]["costs"]["units"] == len(expected.tree)
        assert answer["trees"][0]["executable"]
