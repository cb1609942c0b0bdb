"""Many queries from Python: in processes as one by one, each tree in the kitchen of its own query."""

from __future__ import annotations

import json

import foon_asp as fa


def test_processes_answer_as_one_by_one_does() -> None:
    world = fa.load()
    queries: list[fa.Query | str] = [
        "whipped cream",
        fa.Query("ice", remove=["ice crusher"], method="first"),
        fa.Query("greek salad", kitchen=[]),
        fa.Query("pesto pasta", by="success", human_steps=2),
    ]
    # What a world has learnt of one question does not keep it from going to other processes.
    world._world.ways.to(world._world.closure.available)
    alone = list(world.answer_many(queries))
    together = list(world.answer_many(queries, jobs=2))
    for mine, theirs in zip(together, alone, strict=True):
        assert str(mine) == str(theirs)
        first, second = (json.loads(each.to_json()) | {"seconds": 0} for each in (mine, theirs))
        assert first == second
        if mine.tree is not None and theirs.tree is not None:
            assert mine.tree.world.kitchen.objects == theirs.tree.world.kitchen.objects
            assert mine.tree.steps == theirs.tree.steps
