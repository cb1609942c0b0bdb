"""What is refused of a question about plans before any data are opened."""

from __future__ import annotations

from typing import Any

import pytest

from foon_asp.errors import QueryError
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query


@pytest.mark.parametrize(
    ("asked", "how", "complaint"),
    [
        ({"by": "units,inputs"}, {}, "one level"),
        ({"by": "units,inputs"}, {"engine": "pyperplan"}, "one level"),
        ({"method": "greedy"}, {}, "not chosen by the method 'greedy'"),
        ({"founded": False}, {}, "can be executed"),
        ({"max_depth": 3}, {}, "no constraints"),
        ({}, {"semantics": "eat"}, "unknown semantics 'eat'; there are add, transform, consume"),
        ({}, {"engine": "pyperplan", "max_steps": 3}, "for the engine clingo"),
    ],
)
def test_what_a_plan_cannot_do_is_refused(asked: dict[str, Any], how: dict[str, Any], complaint: str) -> None:
    query = Query("soup", **asked)
    with pytest.raises(QueryError, match=complaint):
        PlanQuery(query, **how)


def test_a_plan_goes_by_units_if_nothing_is_said() -> None:
    assert str(PlanQuery(Query("soup")).criterion) == "units"
    assert str(PlanQuery(Query("soup", by="units+2*tools")).criterion) == "units+2*tools"
