"""Queries: the questions of docs/querying.md answered twice, what is shown, and what is an error."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from foon_asp.asp.facts import names
from foon_asp.asp.heads import for_queries
from foon_asp.asp.rules import read_rules
from foon_asp.errors import InputError
from foon_asp.model.node import Source, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from support.small_foons import with_units

# --- Facts and errors -----------------------------------------------------------------------------


def test_names_and_places(kitchen: World) -> None:
    places = (Source("a/first.txt", 7), Source('b/"second".txt', 9))
    units = [
        replace(
            kitchen.foon.units[UnitId(0)],
            annotation=replace(kitchen.foon.units[UnitId(0)].annotation, sources=places),
        )
    ]
    where = World.of(with_units(kitchen.foon, units), kitchen.kitchen)
    assert names(Problem(where, (), whole=True)).splitlines() == [
        'name(0,"onion [ready]").',
        'name(1,"knife").',
        'name(2,"onion [chopped]").',
        'name(3,"soup [ready]").',
        'source(0,"first.txt",7).',
        'source(0,"\\"second\\".txt",9).',
    ]


def test_rules_of_retrieve_have_no_names(tmp_path: Path) -> None:
    path = tmp_path / "rules.lp"
    path.write_text('violated("far",U) :- use(U), source(U,"a.txt",_).')
    with pytest.raises(InputError, match=r":1:30: source/3 is not available here"):
        read_rules(path)
    path.write_text('ok("cut";"fry"). violated("x",U) :- use(U), motion(U,M), not ok(M).')
    assert "ok(M)" in read_rules(path)
    assert ("violated", 2) in for_queries().refused
