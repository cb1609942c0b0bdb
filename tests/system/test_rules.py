"""Rules of the user's own, run: what they derive is checked, and complaints name the line of the file."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from foon_asp.asp.rules import read_rules
from foon_asp.errors import FoonError, InputError, QueryError
from foon_asp.model.world import World
from foon_asp.query.method import Method
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import pareto_trees
from foon_asp.retrieval.conflict import conflict
from foon_asp.retrieval.retrieve import retrieve
from support.cli import run, run_json
from support.small_foons import node, world

SMALL = world(["a -fry-> goal", "a -wash-> b", "b -boil-> goal"], "a")

ATOMS_THAT_SAY_NOTHING = {
    "violated(x,1).": r"rules:2: x in 'violated\(x,1\)' is not a text in.*; write violated\(Name,Key\)",
    'violated("",1).': r"rules:2: \"\" in .* is not a text in quotes",
    'violated("a\\nb",1).': r"rules:2: .* is not a text in quotes, on one line",
    "violated(M,U) :- use(U), own(M).": r"rules:2: 1 in 'violated\(1,\d\)' is not a text",
    'criterion("p",x). penalty("p",1,1).': "rules: a Priority of criterion/2 is not an integer",
    'criterion("p",9). penalty("p",U,-5) :- use(U).': "rules:2: -5 in .* is not a whole number from 0",
    'criterion("p",9). penalty("p",U,"dear") :- use(U).': 'rules:2:33: "dear" in .* is not an integer',
    'criterion("p",9). penalty("p",U,2147483647+U) :- use(U).': "rules:2: -2147483648 in .* is not a whole",
    'criterion("p",9). penalty("p",U,f(U)) :- use(U).': "rules: a Value of penalty/3 or a Factor",
    'criterion("p",9). penalty("p",1,1). factor("p",0).': "rules:2: 0 in .* is not a whole number from 1",
    "human(99).": r"rules:2: 99 in 'human\(99\)' is not the id of a unit",
    'criterion("p",1). penalty("p",1,1).': 'rules:2: the priority 1 of "p" is that of units; take 2 or more',
}


@pytest.mark.parametrize("text", ATOMS_THAT_SAY_NOTHING)
def test_atoms_that_say_nothing_are_refused_with_their_line(text: str) -> None:
    with pytest.raises(FoonError, match=f"^{ATOMS_THAT_SAY_NOTHING[text]}") as error:
        retrieve(SMALL, Query(node("goal"), rules=[f"own(1).\n{text}"]))
    assert "\n" not in str(error.value)


VOID = {
    'penalty("mine",U,1) :- use(U).': r'rules:2: penalty\("mine",…\) is void: there is no criterion\("mine"',
    'factor("mine",2).': "rules:2: factor.* is void: there is no criterion",
    'criterion("mine",9).': "rules:2: criterion.* is void: there is no penalty",
    'criterion("mine",9). factor("mine",2).': "rules:2: criterion.* is void: there is no penalty",
    'criterion("mine",9). penalty("mien",U,1) :- use(U).': "rules:2: criterion.*; closest: mien",
    '{ penalty("mine",U,1) : use(U) }.': "rules:2: penalty.* is void",
    'criterion("a",9). penalty("a",U,1) :- use(U). penalty("b",U,1) :- use(U).': r'rules:2: penalty\("b",…\)',
}


@pytest.mark.parametrize("text", VOID)
def test_no_part_of_a_criterion_stands_without_the_other(text: str) -> None:
    with pytest.raises(InputError, match=f"^{VOID[text]}") as error:
        retrieve(SMALL, Query(node("goal"), rules=[f"own(1).\n{text}"]))
    assert "\n" not in str(error.value)


def test_the_parts_of_a_criterion_may_stand_in_two_files(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    switch, pays = tmp_path / "switch.lp", tmp_path / "pays.lp"
    switch.write_text('criterion("mine",9).', encoding="utf-8")
    pays.write_text('penalty("mine",U,1) :- use(U).', encoding="utf-8")
    value = run_json(capsys, "retrieve", "whipped cream", "--objective", switch, "--objective", pays)
    assert value["own"] == {"9": len(value["units"])}
    status, _, err = run(capsys, "retrieve", "whipped cream", "--constraint", pays)
    assert (status, err.count("\n")) == (2, 1)
    assert "pays.lp:1: penalty" in err


def test_payments_may_be_for_a_constraint_alone() -> None:
    rules = 'penalty("mine",U,1) :- use(U). violated("dear",0) :- #sum { V,K : penalty("mine",K,V) } > 1.'
    assert retrieve(SMALL, Query(node("goal"), rules=[rules])).tree is not None


MINE = 'criterion("mine",9). penalty("mine",U,1) :- use(U).'


@pytest.mark.parametrize("method", [each for each in Method if each != Method.OPTIMAL])
@pytest.mark.parametrize("goal", ["goal", "out of reach"])
def test_no_method_passes_over_criteria_in_silence(method: Method, goal: str) -> None:
    known = world(["a -fry-> goal", "x -wash-> out of reach"], "a")
    with pytest.raises(FoonError, match=r"void: the method|takes no constraints"):
        retrieve(known, Query(node(goal), method=method, rules=[MINE]))


def test_trade_offs_are_not_bent_by_criteria_of_ones_own() -> None:
    with pytest.raises(InputError, match="void: trade-offs are between built-in criteria"):
        pareto_trees(SMALL, Query(node("goal"), by="units,inputs", rules=[MINE]))


def test_clingo_names_the_line_of_the_file_that_it_complains_of(tmp_path: Path) -> None:
    first, second = tmp_path / "first.lp", tmp_path / "second.lp"
    first.write_text('own(1).\nviolated("x",U) :- use(U), own(U).', encoding="utf-8")
    second.write_text('% two\n\nviolated("y",U+"a") :- use(U).', encoding="utf-8")
    with pytest.raises(QueryError, match=r"second\.lp:3:14: operation undefined"):
        retrieve(SMALL, Query(node("goal"), rules=[read_rules(first), read_rules(second)]))


# --- Conflicts ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rules", "names"),
    [
        (
            'criterion("p",9). penalty("p",U,1) :- use(U). '
            'violated("dear",0) :- #sum { V,K : penalty("p",K,V) } > 0.',
            ("dear",),
        ),
        ('criterion("p",9). violated("a",U) :- use(U), not penalty("p",U,1).', ("a",)),
        ('factor("p",2). violated("a",U) :- use(U), factor("p",2), criterion("q",_).', ()),
        (":- use(_).", ()),
    ],
)
def test_criteria_in_bodies_do_not_break_the_search_for_conflicts(
    kitchen: World, rules: str, names: tuple[str, ...]
) -> None:
    query = Query("soup", rules=[rules]).checked(kitchen)
    assert conflict(Problem.posed(kitchen, query)) == names
    found = retrieve(kitchen, query)
    assert (found.tree is None) == (bool(names) or rules.startswith(":-"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('kitchen("salt").', r"rules\.lp:1: .salt. in .* is not the id of an object; write kitchen\(O\)"),
        ("may(w,99).", r"rules\.lp:1: 99 in .* is not the id of a unit; write may\(W,U\)"),
    ],
)
def test_queries_add_objects_and_units_that_there_are(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, text: str, said: str
) -> None:
    path = tmp_path / "rules.lp"
    path.write_text(text.replace("99", "99999"), encoding="utf-8")
    status, _, err = run(capsys, "query", path)
    assert status == 2
    assert re.search(said.replace("99", "99999"), err)
    assert err.count("\n") == 1


def test_a_criterion_of_ones_own_that_costs_nothing_is_told(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "mine.lp"
    path.write_text('criterion("mine",9). penalty("mine",U,0) :- use(U).', encoding="utf-8")
    value = run_json(capsys, "retrieve", "whipped cream", "--objective", path)
    assert value["own"] == {"9": 0}


def test_motions_in_a_file_that_no_solver_can_be_given(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "motions.txt"
    path.write_bytes(b"pour\nch\0op\n")
    status, _, err = run(capsys, "retrieve", "whipped cream", "--only-motions", path)
    assert status == 2
    assert err.count("\n") == 1
    assert "motions.txt:2: no label" in err
