"""Explanations as JSON that was checked, and what buying the missing things must do."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

from jsonschema import Draft202012Validator
from msgspec import to_builtins

from foon_asp.io.folder import Dataset
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.render.explain import explanation_text
from foon_asp.retrieval.explain import Explanation, explain
from foon_asp.retrieval.explain_wire import explanation_json
from foon_asp.retrieval.retrieve import retrieve
from support.paths import ROOT

# --- The least that is missing, by trying every set -----------------------------------------------

# Written from docs/explain.md alone; shares nothing with missing.lp or foon_asp.reasons.


def stocked(where: World, things: tuple[ObjectNode, ...]) -> World:
    kitchen = replace(where.kitchen, objects=(*where.kitchen.objects, *things))
    return World.of(where.foon, kitchen, strict=where.strict, level=where.level)


def as_nodes(where: World, numbers: tuple[ObjectId, ...]) -> tuple[ObjectNode, ...]:
    return tuple(where.node(number) for number in numbers)


# --- Text -----------------------------------------------------------------------------------------


def kitchen_without(dataset: Dataset, *labels: str) -> World:
    objects = tuple(thing for thing in dataset.kitchen.objects if thing.label not in labels)
    return World.of(dataset.foon, replace(dataset.kitchen, objects=objects), goals=dataset.goals)


# --- JSON -----------------------------------------------------------------------------------------

SCHEMA = json.loads((ROOT / "docs" / "schema" / "explain.schema.json").read_text(encoding="utf-8"))


def value(explanation: Explanation) -> dict[str, Any]:
    """Return an explanation as JSON, checked against its schema."""
    found: dict[str, Any] = to_builtins(explanation_json(explanation))
    Draft202012Validator(SCHEMA).validate(found)
    assert json.loads(json.dumps(found)) == found
    return found


# --- All goals, from poor kitchens and on each level ----------------------------------------------


def poorer(dataset: Dataset, kind: str) -> Kitchen:
    objects = dataset.kitchen.objects
    kept = {"empty": (), "half": objects[::2], "tools": tuple(thing for thing in objects if thing.bare)}
    return replace(dataset.kitchen, objects=kept[kind])


def check_every_goal(dataset: Dataset, where: World) -> int:
    """Explain every goal and buy what is missing; return how many cannot be made."""
    lacking = 0
    for goal in dict.fromkeys(map(where.project, dataset.goals)):
        found = explain(where, Query(goal))
        value(found)
        assert explanation_text(found)
        if found.status != "unreachable":
            assert found.steps or where.id_of(goal) in where.stock
            continue
        lacking += 1
        assert found.reason
        assert found.missing is not None
        assert found.missing.proven
        [things] = found.missing.sets or [()]
        bought = as_nodes(where, things)
        assert goal not in bought
        if bought:
            result = retrieve(stocked(where, bought), Query(goal))
            assert result.tree is not None
            assert result.tree.executable
        else:
            assert found.deadlocks
    return lacking
