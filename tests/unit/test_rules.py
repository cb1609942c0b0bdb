"""What rules of the user's own may say: every form of a head is seen, and refusals say what to write."""

from __future__ import annotations

import pickle
import re
from pathlib import Path

import clingo
import pytest

from foon_asp.asp.heads import PURPOSES, QUERY_HEADS, TREE_HEADS, Head
from foon_asp.asp.rules import RuleText, check_rules
from foon_asp.asp.terms import quote
from foon_asp.errors import InputError, QueryError
from foon_asp.io.kitchen import read_labels
from foon_asp.query.constraints import Constraints
from support.paths import ROOT

HEADS = (
    "{}.",
    "{} :- unit(1).",
    "{{ {} }}.",
    "1 {{ {} ; own }} 1.",
    "{{ own : unit(1) ; {} : unit(1) }}.",
    "{} ; own.",
    "own ; {} : unit(1).",
    "{} : unit(1).",
    "#sum {{ 1 : {} }} = 1.",
    "#count {{ 1 : own ; 2 : {} : unit(1) }} > 1.",
    "not {} :- unit(1).",
    "not not {} :- unit(1).",
)
"""All forms of a head that clingo has."""

ATOMS = {
    "trees": (
        "use(99999)",
        "use(1..3)",
        "use(1;2)",
        "unit(7)",
        "kitchen(O)",
        "makes(1,2)",
        "goal(3)",
        "split(1)",
        "late(1)",
    ),
    "queries": (
        "unit(7)",
        "unit(1;2)",
        "makes(1,2)",
        "available(3)",
        "executable(w,1)",
        'label(1,"a")',
        "bare(1)",
    ),
}


@pytest.mark.parametrize("form", HEADS)
@pytest.mark.parametrize(
    ("purpose", "atom"), [(purpose, atom) for purpose in ATOMS for atom in ATOMS[purpose]]
)
def test_no_form_of_a_head_redefines_what_belongs_to_the_encodings(
    form: str, purpose: str, atom: str
) -> None:
    name = atom.partition("(")[0]
    with pytest.raises(InputError, match=rf"^rules:2: {name}/\d belongs to the encodings; rules may derive "):
        check_rules("% first\n" + form.format(atom), purpose)


@pytest.mark.parametrize("form", HEADS)
@pytest.mark.parametrize("purpose", ATOMS)
def test_predicates_of_ones_own_may_stand_in_every_form_of_a_head(form: str, purpose: str) -> None:
    assert check_rules(form.format("mine(1)"), purpose).derived


@pytest.mark.parametrize("purpose", PURPOSES)
@pytest.mark.parametrize("form", [*HEADS, "own :- {}.", "own :- not {}.", ":- own : {}."])
def test_what_belongs_to_the_encodings_has_no_negation(purpose: str, form: str) -> None:
    with pytest.raises(InputError, match=r"rules:1:\d+: there is no -unit/1; write not unit"):
        check_rules("{ own }. " + form.format("-unit(1)"), purpose)


NOWHERE = {
    "#external own(1).": "atoms of #external are false.*; write a choice",
    "#heuristic own(1). [1,true]": "#heuristic has no effect",
    "#project own/1.": "#project would change",
    "#project own(1).": "#project would change",
    "#theory t { x { }; &a/0 : x, any }.": "#theory is for other solvers",
    "&a { x }.": "theory atoms are for other solvers",
    "own(2) :- &a { x }.": "theory atoms are for other solvers",
    "#program step(t).": "#program step is never run",
    "#program base(t).": "#program base is never run",
    "#const strict = 1.": "the constant strict belongs to the encodings",
    "#const strict = 1. [override]": "the constant strict belongs to the encodings",
    "own(@f(1)).": "@f runs any code",
    "own(2) :- own(X), X = @f(1).": "@f runs any code",
    "#const n = @f(1).": "@f runs any code",
    "own(2) :- #sum { @f(1) : own(1) } > 1.": "@f runs any code",
    '#include "units.lp".': "#include is not allowed",
    "#include <incmode>.": "#include is not allowed",
    "#script (python) #end.": "#script runs any code; leave it out",
    "#script\u00a0(python) #end.": "#script runs any code",
    '"#include': "this text does not end",
    'own(2). %* %* *% " *% #script (lua) #end.': "#script runs any code",
    'own("\0"). #script (lua) #end.': r"the character '\\x00' cannot be in rules; delete it",
    "own(2). % note\r#script (lua) #end.": "a carriage return without a newline",
    "own(\u00e9).": r"the character '\\xe9' outside of texts",
    'own("\ud800").': r"the character '\\ud800' cannot be in rules",
    "own(2147483648).": "2147483648 is too large for clingo",
    "own(0x100000000).": "0x100000000 is too large for clingo",
    "own(" + "9" * 5000 + ").": "99999999999999999999… is too large",
    "own(2) own(3).": "syntax error",
}


@pytest.mark.parametrize("purpose", PURPOSES)
@pytest.mark.parametrize("text", NOWHERE, ids=range(len(NOWHERE)))
def test_what_is_refused_everywhere(purpose: str, text: str) -> None:
    with pytest.raises(InputError, match=rf"^rules:2\D.*{NOWHERE[text]}") as error:
        check_rules(f"own(1).\n{text}", purpose)
    assert "\n" not in str(error.value)


FOR_TREES = {
    "#minimize { 1,U : use(U) }.": r'aims of their own .*; write criterion\("mine",9\)',
    "#maximize { 1,U : use(U) }.": r'aims of their own .*; write criterion\("mine",9\)',
    ":~ use(1). [1@2]": r'aims of their own .*; write criterion\("mine",9\)',
    "#show 7.": "#show shows nothing of a task tree; leave it out",
    "#show use(-1).": "#show shows nothing of a task tree",
    "#show.": "#show shows nothing of a task tree",
    "#show use/1.": "#show shows nothing of a task tree",
    'criterion("units",9).': 'the criterion "units" belongs to the encodings; take another name',
    'penalty("overlap",U,1) :- use(U).': 'the criterion "overlap" belongs to the encodings',
    'factor("success",3).': 'the criterion "success" belongs to the encodings',
    "penalty(N,U,1) :- use(U), criterion(N,_).": "penalty needs the name of a criterion itself, in quotes",
    "criterion(mine,1).": "criterion needs the name of a criterion itself, in quotes",
    'own(2) :- #sum { V,K : penalty("units",K,V) } > 3.': 'the criterion "units" belongs to the encodings',
    'own(2) :- criterion(N,_), N != "units".': "criterion needs the name of a criterion itself",
    'own(2) :- waived("x").': "waived/1 is not available here",
    "own(2) :- available(1).": "available/1 is not available here",
    "#const horizon = 3.": "the constant horizon belongs to the encodings",
}


@pytest.mark.parametrize("text", FOR_TREES)
def test_what_is_refused_beside_a_task_tree(text: str) -> None:
    with pytest.raises(InputError, match=rf"^rules:2\D.*{FOR_TREES[text]}"):
        check_rules(f"own(1).\n{text}")


def test_comments_may_speak_of_what_is_refused() -> None:
    text = '% #include "a".\n%* #script (lua) %* nested *% #end *%\nown(1).\r\nown("% #show").'
    assert check_rules(text).text == text.replace("#in", "_in").replace("#sc", "_sc").replace("\r", "")


def test_rules_know_their_file_in_another_process(tmp_path: Path) -> None:
    text = RuleText.of("own(1).", tmp_path / "mine.lp")
    again = pickle.loads(pickle.dumps(text))
    assert (again, again.path) == (text, text.path)


# --- Texts --------------------------------------------------------------------------------------------


def test_every_text_is_quoted_as_it_is_or_refused() -> None:
    for code in [*range(0x3000), *range(0x3000, 0x110000, 251), 0xD800, 0xDFFF, 0xFEFF, 0xFFFF]:
        text = f'a{chr(code)}\\"b'
        try:
            quoted = quote(text)
        except QueryError:
            assert code == 0 or 0xD800 <= code <= 0xDFFF, hex(code)
        else:
            assert clingo.parse_term(quoted).string == text


@pytest.mark.parametrize("text", ["ch\0op", "ch\ud800op"])
def test_labels_and_motions_that_no_solver_can_be_given_are_refused(text: str) -> None:
    for key in ("without", "without_tools", "avoid_motions", "only_motions"):
        with pytest.raises(QueryError, match="is a text in one line, without control characters"):
            Constraints.of({key: [text]})  # type: ignore[misc]


def test_files_of_labels_are_refused_with_the_line(tmp_path: Path) -> None:
    path = tmp_path / "motions.txt"
    path.write_bytes(b"pour\n\nch\0op\n")
    with pytest.raises(InputError, match=r"motions\.txt:3: no label: "):
        read_labels(path)


# --- Pages --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("page", "heads"), [("constraints.md", TREE_HEADS), ("querying.md", QUERY_HEADS)])
def test_a_page_lists_what_rules_may_derive(page: str, heads: dict[tuple[str, int], Head]) -> None:
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    table = text.partition("| head | what it says |\n|---|---|\n")[2].partition("\n\n")[0]
    rows = re.findall(r"^\| `(.*)` \| (.*) \|$", table, re.MULTILINE)
    assert rows == [(head.written, head.meaning) for head in heads.values()]
    for head in heads.values():
        assert head.written.count(",") + 1 == len(head.arguments)
