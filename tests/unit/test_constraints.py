"""Constraints and rule files that are refused before anything runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp import resources
from foon_asp.asp.rules import read_rules
from foon_asp.errors import InputError, QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.node import UnitId
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query


@pytest.mark.parametrize(
    ("constraints", "method", "message"),
    [
        (
            Constraints(without=("onoin",)),
            "optimal",
            "nothing in this FOON is called 'onoin'; closest: onion",
        ),
        (
            Constraints(avoid_motions=("shaek",)),
            "optimal",
            "no unit has the motion 'shaek'; closest: .*shake",
        ),
        (Constraints(use_units=(UnitId(9999),)), "optimal", "there is no unit 9999; ids go from 0 to 661"),
        (Constraints(min_success=0.0), "optimal", "above 0 and at most 1, not 0"),
        (Constraints(max_units=3), "ids", "'ids' takes no constraints"),
    ],
)
def test_constraints_that_make_no_sense_are_errors(
    built_in: Dataset, constraints: Constraints, method: str, message: str
) -> None:
    with pytest.raises(QueryError, match=message):
        Query("greek salad", method=method, constraints=constraints).checked(built_in.world())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            'violated("x",U) :- use(U), motoin(U,"fry").',
            r":1:28: unknown predicate motoin/2; closest: motion/2",
        ),
        ('violated("x") :- use(_).', r":1:1: unknown predicate violated/1; there is violated/2"),
        ('% fine\nviolated("x",U) :- use(U) motion(U,"fry").', r":2:27: syntax error"),
        ("\n#script (python) #end.", r":2: #script runs any code"),
        ('% #include "no".\n#include "units.lp".', r":2: #include is not allowed"),
    ],
)
def test_rules_are_checked_before_they_run(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "rules.lp"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_rules(path)


def test_no_diet_names_a_label_twice_or_in_another_spelling(built_in: Dataset) -> None:
    known = {label for o in built_in.foon.objects for label in o.named_labels}
    for name, path in resources.diets().items():
        rows = [row for row in path.read_text().splitlines() if not row.startswith("#")]
        assert rows == sorted(set(rows)), name
        assert len(known & set(rows)) >= 3, name
