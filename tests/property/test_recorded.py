"""Answers read back from JSON: the same text again, and a tree that says the same."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.retrieve import retrieve
from support.examples import many
from support.small_foons import queries


@many(60)
@given(queries(), st.sampled_from(["optimal", "greedy", "ids", "first"]), st.booleans())
def test_what_is_written_reads_back(drawn: tuple[World, ObjectNode], method: str, founded: bool) -> None:
    where, goal = drawn
    answer = retrieve(where, Query(goal, method=method, founded=founded or method == "ids"))
    again = Answer.from_json(answer.to_json())
    assert json.loads(again.to_json()) == json.loads(answer.to_json())
    assert (again.status, again.reason, again.goals, bool(again)) == (
        answer.status,
        answer.reason,
        answer.goals,
        bool(answer),
    )
    if answer.tree is None:
        assert again.tree is None
        return
    assert again.tree is not None
    assert again.tree.executable == answer.tree.executable
    assert again.costs == answer.costs
    for mine, theirs in zip(again.tree.steps, answer.tree.steps, strict=True):
        assert (mine.unit, mine.motion, mine.takes) == (theirs.unit, theirs.motion, theirs.takes)
        assert (mine.makes, mine.outputs, mine.human) == (theirs.makes, theirs.outputs, theirs.human)


def test_what_is_no_answer_is_refused(built_in: Dataset) -> None:
    answer = retrieve(built_in.world(), Query("hummus", avoid_motions=["shake"]))
    text = answer.to_json()
    assert Answer.from_json(text).recorded is not None
    value = json.loads(text)
    assert value["constraints"] == json.loads(Answer.from_json(text).to_json())["constraints"]
    for wrong in ("", "[]", "{}", json.dumps(value | {"status": "good"}), json.dumps(value | {"extra": 1})):
        with pytest.raises(QueryError, match="this is no answer of foon-asp retrieve"):
            Answer.from_json(wrong)
    with pytest.raises(QueryError, match="the units of this answer do not make hummus"):
        Answer.from_json(json.dumps(value | {"units": value["units"][:-1]}))
    with pytest.raises(QueryError, match="twice"):
        Answer.from_json(json.dumps(value | {"units": [*value["units"], value["units"][0]]}))
