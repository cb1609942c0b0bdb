"""Queries: the questions of docs/querying.md answered twice, what is shown, and what is an error."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from foon_asp.asp.ask import ask as ask_rules
from foon_asp.asp.terms import Function
from foon_asp.errors import InputError, QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.node import ObjectId
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.render.ask import query_text
from support.questions import SCHEMA, Rows, ask, checked, tables
from support.small_foons import node, world

# --- What is shown --------------------------------------------------------------------------------


def shown(tmp_path: Path, where: World, text: str, **options: Any) -> dict[str, Rows]:
    return tables(ask(tmp_path, where, text, **options))


def test_without_show_all_predicates_of_the_file_and_no_others(tmp_path: Path, kitchen: World) -> None:
    text = 'b(U) :- unit(U). a(M) :- motion(_,M). kitchen(O) :- label(O,"salt").'
    assert shown(tmp_path, kitchen, text) == {"b/1": [(0,), (1,)], "a/1": [("cut",), ("fry",)]}


def test_show_statements_say_what_is_shown(tmp_path: Path, kitchen: World) -> None:
    text = "b(U) :- unit(U). a(M) :- motion(_,M). #show b/1."
    assert shown(tmp_path, kitchen, text) == {"b/1": [(0,), (1,)]}
    assert shown(tmp_path, kitchen, "#show executable/1.") == {"executable/1": [(0,), (1,)]}
    assert shown(tmp_path, kitchen, "b(U) :- unit(U). #show.") == {}
    assert query_text(ask(tmp_path, kitchen, "b(U) :- unit(U). #show.")) == "the rules show nothing\n"


def test_shown_terms_stand_beside_shown_atoms(tmp_path: Path, kitchen: World) -> None:
    text = """
        p(1).
        #show (U,M) : motion(U,M).
        #show U : unit(U).
        #show did(M) : motion(_,M).
        #show -did(M) : motion(_,M).
        #show done : p(1).
        #show p/1.
    """
    assert shown(tmp_path, kitchen, text) == {
        "/2": [(0, "cut"), (1, "fry")],
        "/1": [(0,), (1,), (Function("done"),)],
        "did/1": [("cut",), ("fry",)],
        "p/1": [(1,)],
        "-did/1": [("cut",), ("fry",)],
    }


def test_a_shown_term_is_no_atom_of_the_encodings(tmp_path: Path, kitchen: World) -> None:
    assert shown(tmp_path, kitchen, "#show available(U) : unit(U).") == {"available/1": [(0,), (1,)]}


def test_negated_predicates_are_tables_of_their_own(tmp_path: Path, kitchen: World) -> None:
    text = '-good(M) :- motion(_,M). good("x").'
    assert shown(tmp_path, kitchen, text) == {"-good/1": [("cut",), ("fry",)], "good/1": [("x",)]}
    assert shown(tmp_path, kitchen, text + "#show -good/1.") == {"-good/1": [("cut",), ("fry",)]}


def test_rows_are_sorted_as_people_sort(tmp_path: Path, kitchen: World) -> None:
    text = 'p(("unit 10";"unit 2";10;9;-1;b;a;f(2);f(10);(2,1);(1,2);"Unit 2")).'
    assert [row[0] for row in shown(tmp_path, kitchen, text)["p/1"]] == [
        *(-1, 9, 10),
        *("Unit 2", "unit 2", "unit 10"),
        *((1, 2), (2, 1)),
        *(Function("a"), Function("b"), Function("f", (2,)), Function("f", (10,))),
    ]


def test_terms_keep_what_they_are(tmp_path: Path, kitchen: World) -> None:
    text = 'p(1,"a \\"b\\"",oven,f("x y",-2),-f(oven),(1,"a"),(1,),(),#inf).'
    answer = ask(tmp_path, kitchen, text)
    printed = 'p/9: 1 row\n1  a "b"  oven  f("x y",-2)  -f(oven)  (1,"a")  (1,)  ()  #inf\n'
    assert query_text(answer) == printed
    (row,) = checked(answer)["predicates"][0]["rows"]
    oven = {"name": "oven", "arguments": []}
    assert row == [
        *(1, 'a "b"', oven),
        {"name": "f", "arguments": ["x y", -2]},
        {"name": "-f", "arguments": [oven]},
        *([1, "a"], [1], []),
        {"name": "#inf", "arguments": []},
    ]


def test_tables(tmp_path: Path, kitchen: World) -> None:
    text = """
        wide(M,N) :- motion(U,M), N = U * 100 + 5.
        #show wide/2. #show none/1. #show yes/0. #show no/0. #show mixed/2.
        none(X) :- unit(X), X > 9. yes. no :- none(_).
        mixed("a\\nb",2). mixed(1,20).
    """
    assert query_text(ask(tmp_path, kitchen, text)) == (
        "wide(M, N): 2 rows\ncut    5\nfry  105\n\n"
        "none(X): none\n\n"
        "yes: yes\n\n"
        "no: no\n\n"
        "mixed/2: 2 rows\n   1  20\na\\nb   2\n"
    )


def test_columns_are_named_by_the_first_rule_and_only_by_variables(tmp_path: Path, kitchen: World) -> None:
    text = "p(A,B) :- input(A,B). p(C,D) :- output(C,D). q(A,1) :- unit(A). r(1). r(A) :- unit(A)."
    found = ask(tmp_path, kitchen, text).tables or ()
    assert [each.heading.columns for each in found] == [("A", "B"), (), ()]


# --- Stable models --------------------------------------------------------------------------------


def test_rules_without_a_stable_model(tmp_path: Path, kitchen: World) -> None:
    answer = ask(tmp_path, kitchen, ":- unit(_).")
    assert (answer.status, answer.tables, answer.more) == ("none", None, False)
    assert query_text(answer) == "the rules have no stable model\n"
    assert checked(answer)["predicates"] is None


@pytest.mark.parametrize(
    ("text", "more"),
    [
        ("p(U) :- unit(U).", False),
        ("{ p(U) : unit(U) } = 1.", True),
        ("{ p(U) : unit(U) } = 2.", False),
        ("{ p(U) : unit(U) } = 1. #show q/0. q :- p(_).", False),
        ("{ p(U) : unit(U) } = 1. #show q/0. q :- p(0).", True),
        ("{ p(U) : unit(U) } = 1. #show a : p(0).", True),
        ("{ p(U) : unit(U) } = 1. #show a : p(_).", False),
        # What the encodings show varies here, but not what the file shows.
        ("{ kitchen(O) : object(O) }. q. #show q/0.", False),
    ],
)
def test_other_stable_models_count_if_they_show_something_else(
    tmp_path: Path, kitchen: World, text: str, more: bool
) -> None:
    answer = ask(tmp_path, kitchen, text)
    assert (answer.status, answer.costs, answer.more) == ("found", (), more)
    several = "one answer of several: other stable models show something else\n\n"
    assert query_text(answer).startswith(several) == more
    checked(answer)


@pytest.mark.parametrize(
    ("text", "costs", "rows", "more"),
    [
        ("#minimize { 1,U : p(U) }.", (1,), None, True),
        ("#minimize { U+1,U : p(U) }.", (1,), [(0,)], False),
        ("#maximize { 1,U : p(U) }.", (-2,), [(0,), (1,)], False),
        (":~ p(0). [1@1] :~ p(1). [5@2]", (0, 1), [(0,)], False),
        ("#minimize { 0,U : p(U) }.", (0,), None, True),
    ],
)
def test_the_best_stable_model_is_shown(
    tmp_path: Path, kitchen: World, text: str, costs: tuple[int, ...], rows: Rows | None, more: bool
) -> None:
    answer = ask(tmp_path, kitchen, "{ p(U) : unit(U) }. :- not p(_). " + text)
    assert (answer.status, answer.costs, answer.more) == ("optimal", costs, more)
    assert rows is None or tables(answer)["p/1"] == rows
    first = f"cost {', '.join(map(str, costs))} (proven optimal)\n"
    assert query_text(answer).startswith(first)
    checked(answer)


PIGEONS = "{ in(P,H) : H = 1..12 } = 1 :- P = 1..13."
APART = ":- in(P,H), in(Q,H), P < Q."


def test_a_time_limit_without_a_model(tmp_path: Path, kitchen: World) -> None:
    answer = ask(tmp_path, kitchen, PIGEONS + APART, time_limit=0.3)
    assert (answer.status, answer.tables, answer.more) == ("limit", None, None)
    assert query_text(answer) == "no stable model was found before the time limit\n"
    checked(answer)


def test_a_time_limit_with_a_model_that_is_not_proven(tmp_path: Path, kitchen: World) -> None:
    text = PIGEONS + "#minimize { 1,P,Q : in(P,H), in(Q,H), P < Q }."
    answer = ask(tmp_path, kitchen, text, time_limit=0.3)
    assert (answer.status, answer.more) == ("limit", None)
    assert answer.costs >= (1,)
    assert len(tables(answer)["in/2"]) == 13
    assert query_text(answer).startswith(
        f"cost {answer.costs[0]} (time limit, not proven)\n\nin(P, H): 13 rows\n"
    )
    checked(answer)


def test_a_time_limit_before_it_is_known_whether_there_is_more(tmp_path: Path, kitchen: World) -> None:
    """Only with the key the pigeons find room; whether they do without it takes long to find out."""
    text = PIGEONS + "{ key }. :- not key, in(P,H), in(Q,H), P < Q. #show key/0."
    answer = ask(tmp_path, kitchen, text, time_limit=1)
    assert (answer.status, answer.more) == ("found", None)
    assert tables(answer) == {"key/0": [()]}
    said = (
        "the time ran out before it was known whether other stable models show something else\n\nkey: yes\n"
    )
    assert query_text(answer) == said
    checked(answer)


# --- Facts and errors -----------------------------------------------------------------------------


def test_the_schema_takes_nothing_else(tmp_path: Path, kitchen: World) -> None:
    value = checked(ask(tmp_path, kitchen, "p(U) :- unit(U).", kitchen.node(ObjectId(2))))
    assert value["goals"] == [{"label": "onion", "states": ["chopped"], "ingredients": [], "container": None}]
    assert value["predicates"] == [
        {"name": "p", "arity": 1, "columns": ["U"], "count": 1, "rows": [[0]]},
    ]
    validator = Draft202012Validator(SCHEMA)
    for change in (
        {"status": "maybe"},
        {"more": 1},
        {"else": 1},
        {"predicates": [{**value["predicates"][0], "rows": [[1.5]]}]},
        {"predicates": [{**value["predicates"][0], "rows": [[{"name": "f"}]]}]},
    ):
        assert not validator.is_valid({**value, **change})


def test_goals_leave_the_slice_that_matters(tmp_path: Path, kitchen: World) -> None:
    text = "u(U) :- unit(U). g(Text) :- goal(O), name(O,Text)."
    assert shown(tmp_path, kitchen, text) == {"u/1": [(0,), (1,)], "g/1": []}
    chopped = tables(ask(tmp_path, kitchen, text, node("onion[chopped]")))
    assert chopped == {"u/1": [(0,)], "g/1": [("onion [chopped]",)]}
    both = tables(ask(tmp_path, kitchen, text, node("onion[chopped]"), node("soup")))
    assert both == {"u/1": [(0,), (1,)], "g/1": [("onion [chopped]",), ("soup [ready]",)]}
    with pytest.raises(QueryError, match="unknown goal"):
        ask(tmp_path, kitchen, text, node("stew"))


def test_rules_may_add_to_the_facts(tmp_path: Path) -> None:
    where = world(("onion + (knife) -cut-> onion[chopped]",), "onion")
    text = "runs(U) :- executable(U)."
    assert shown(tmp_path, where, text) == {"runs/1": []}
    assert shown(tmp_path, where, text + 'kitchen(O) :- label(O,"knife").') == {"runs/1": [(0,)]}


@pytest.mark.parametrize("level", [1, 2])
def test_queries_on_a_level(built_in: Dataset, tmp_path: Path, level: int) -> None:
    where = built_in.world(level=level)
    found = shown(tmp_path, where, "r(U) :- executable(U). n(Text) :- name(_,Text). b(O) :- bare(O).")
    assert {row[0] for row in found["r/1"]} == where.closure.executable.keys()
    assert {row[0] for row in found["n/1"]} == {str(thing) for thing in where.foon.objects}
    assert len(found["b/1"]) == sum(thing.bare for thing in where.foon.objects)


def test_strict_reading_needs_every_input(tmp_path: Path) -> None:
    where = world(("bowl{onion} + onion@bowl -stir-> soup",), "onion@bowl", utensils=["bowl"])
    strictly = World.of(where.foon, where.kitchen, strict=True)
    text = "n(Text) :- needs(_,O), name(O,Text)."
    assert shown(tmp_path, where, text) == {"n/1": [("onion in [bowl]",)]}
    assert shown(tmp_path, strictly, text) == {"n/1": [("bowl {onion}",), ("onion in [bowl]",)]}


NOT_HERE = (
    "is not available in a query, where nothing is decided; there are at_first/2, available/1, available/2"
)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('\np(O) :- labl(O,"bowl").', r":2:9: unknown predicate labl/2; closest: label/2"),
        ("p(U) :- makes(U).", r":1:9: unknown predicate makes/1; there is makes/2"),
        ("{ p(U) : unti(U) }.", r":1:10: unknown predicate unti/1; closest: unit/1"),
        ("#show good/1.", r":1:1: unknown predicate good/1"),
        ("p(U) :- use(U).", rf":1:9: use/1 {NOT_HERE}"),
        ('p(1). penalty("x",U,1) :- unit(U).', rf":1:7: penalty/3 {NOT_HERE}"),
        ('criterion("x",9).', rf":1:1: criterion/2 {NOT_HERE}"),
        ('violated("x",U) :- unit(U).', rf":1:1: violated/2 {NOT_HERE}"),
        ("p(U) :- unit(U)\nq.", r":2:1: syntax error"),
        ("p.\n#program step(t).", r":2: the part #program step is never run"),
        ("p.\n#const strict = 1.", r":2: the constant strict belongs to the encodings"),
        ('#include "units.lp".', r":1: #include is not allowed"),
        ("\n#script (python) #end.", r":2: #script runs any code"),
        ("p.\n\np(X,Y) :- unit(X).", r":3:5: the variable Y is unsafe"),
        ("p.\np(X) :- not unit(X), X = Y.", r":2:3: the variable X is unsafe"),
        ("p.\np(N) :- N = #sum { L : label(_,L) }.", r":2:20: tuple ignored: \"onion\""),
        ("#const n = 1.\n#const n = 2.", r":2:1: redefinition of constant: #const n=2\."),
    ],
)
def test_errors_are_one_line_with_the_place(tmp_path: Path, kitchen: World, text: str, message: str) -> None:
    with pytest.raises((InputError, QueryError), match=r"rules\.lp" + message) as error:
        ask(tmp_path, kitchen, text)
    assert "\n" not in str(error.value)
    assert "<block>" not in str(error.value)


def test_a_file_that_is_not_there(tmp_path: Path, kitchen: World) -> None:
    with pytest.raises(InputError, match="no such file"):
        ask_rules(kitchen, Query(), tmp_path / "none.lp")


def test_predicates_with_other_encodings_names_may_be_ones_own(tmp_path: Path, kitchen: World) -> None:
    """Nothing else in a query has these names, so nothing can be mixed up."""
    assert shown(tmp_path, kitchen, "use(U) :- unit(U). missing(1). goal(2).") == {
        "use/1": [(0,), (1,)],
        "missing/1": [(1,)],
    }


def test_parts_of_the_rules_do_not_swallow_the_facts(tmp_path: Path, kitchen: World) -> None:
    for text in (
        "u(U) :- unit(U). % the end",
        "#program base. u(U) :- unit(U).",
        "u(U) :- unit(U). %* end *%",
    ):
        assert shown(tmp_path, kitchen, text) == {"u/1": [(0,), (1,)]}


def test_a_world_of_ones_own_is_asked_what_it_can_make(tmp_path: Path, kitchen: World) -> None:
    text = """
        at_first(all,O) :- kitchen(O). at_first(cook,O) :- label(O,"onion"). may((all;cook),U) :- unit(U).
        runs(W,U) :- executable(W,U).
    """
    # The world of the kitchen is there, too.
    rows = [(str(world), unit) for world, unit in shown(tmp_path, kitchen, text)["runs/2"]]
    assert rows == [("all", 0), ("all", 1), ("cook", 1), ("kitchen", 0), ("kitchen", 1)]


def test_rules_choose_for_themselves(tmp_path: Path, kitchen: World) -> None:
    with pytest.raises(QueryError, match="with goals and a limit alone"):
        ask(tmp_path, kitchen, "b(U) :- unit(U).", by="success")
