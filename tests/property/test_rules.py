"""Rules of the user's own, drawn at random: answered or refused in one line, and never obeyed to the letter
where they would redefine what a task tree is."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.asp.ask import ask
from foon_asp.asp.heads import PURPOSES, QUERY_HEADS, TREE_HEADS
from foon_asp.asp.rules import check_rules
from foon_asp.asp.scan import scanned
from foon_asp.errors import FoonError, InputError
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.retrieval.explain import explain
from foon_asp.retrieval.retrieve import retrieve
from support import brute_force
from support.examples import many
from support.small_foons import node, queries, world

# --- A grammar of rules -----------------------------------------------------------------------------

NAMES = sorted(
    {name for name, _ in (*TREE_HEADS, *QUERY_HEADS, *PURPOSES["trees"]().known)}
    | {"own", "other", "available", "executable", "foremost", "waived", "weight", "standing"}
)
TERMS = (
    *('"mine"', '"units"', '"overlap"', '"fry"', '""', '"a\\nb"', '"é"', "x", "0", "1", "7", "-1", "99999"),
    *("2147483647", "2147483648", "(1,2)", "f(x)", "#inf", "#sup", "U", "U", "O", "X", "_", "1..3", "(1;2)"),
    *("@f(1)", "U+1", "-x", "|U|", "horizon"),
)
BODIES = (
    *("use(U)", "unit(U)", "object(O)", 'motion(U,"fry")', "needs(U,O)", "not use(U)", "X = 1..2", "-own(U)"),
    *("own(U)", "not own(1)", "human(U)", "kitchen(O)", 'penalty("mine",O,X)', 'penalty("units",O,X)'),
    *("penalty(O,U,X)", "#count { U : use(U) } > 1", 'X = #sum { V,K : penalty("mine",K,V) }', "goal(O)"),
    *(
        "criterion(_,X)",
        "late(X)",
        "violated(_,X)",
        "waived(_)",
        "&sum { x } > 1",
        "own(U) : unit(U)",
        "#true",
    ),
)
WHOLE = (
    *(
        "#show 7.",
        "#show use(-1).",
        "#show.",
        "#show own/1.",
        "#show own(X) : own(X).",
        "#minimize { 1,U : use(U) }.",
    ),
    *("#maximize { U,U : unit(U) }.", ":~ unit(U). [1@2,U]", "#external own(1..3).", "#external use(7)."),
    *("#const horizon = 9.", "#const n = 3.", "#program base.", "#program step(t).", "#defined own/1."),
    *("#defined use/1.", "#heuristic own(U) : unit(U). [1@1,true]", "#edge (U,V) : needs(U,V)."),
    *(
        "#project own/1.",
        "#project own(1).",
        '#include "units.lp".',
        "#include <incmode>.",
        "#script (lua) #end.",
    ),
    *(
        "#theory t { x { }; &a/0 : x, any }.",
        "% comment",
        "%* block *%",
        "#minimize { 2147483647@3,U : unit(U) }.",
    ),
)


@st.composite
def atoms(draw: st.DrawFn) -> str:
    terms = draw(st.lists(st.sampled_from(TERMS), max_size=3))
    return (
        draw(st.sampled_from(["", "", "", "-"]))
        + draw(st.sampled_from(NAMES))
        + (f"({','.join(terms)})" if terms else "")
    )


@st.composite
def likely_atoms(draw: st.DrawFn) -> str:
    """Draw a head that rules may have, mostly with what is wanted there."""
    term = st.sampled_from(TERMS)
    forms: tuple[Callable[[], str], ...] = (
        lambda: f'violated("mine",{draw(term)})',
        lambda: f"violated({draw(term)},U)",
        lambda: f'criterion("mine",{draw(term)})',
        lambda: f'penalty("mine",{draw(term)},{draw(term)})',
        lambda: f'factor("mine",{draw(term)})',
        lambda: f"human({draw(term)})",
        lambda: f"own({draw(term)})",
        lambda: f"kitchen({draw(term)})",
        lambda: f"at_first({draw(term)},{draw(term)})",
    )
    return draw(st.sampled_from(forms))()


FINE = (
    *(
        'violated("mine",U) :- use(U), motion(U,"fry").',
        ":- use(1).",
        "{ own(U) } :- use(U).",
        "{ human(U) } :- use(U).",
    ),
    *(
        "violated(M,U) :- use(U), motion(U,M), own(U).",
        'criterion("mine",9).',
        'penalty("mine",U,2) :- use(U).',
    ),
    *(
        'penalty("mine",O,1) :- own(O).',
        'violated("all",0) :- #sum { V,K : penalty("mine",K,V) } > 3.',
        ":- not use(0).",
    ),
    *(
        "own(U) ; other(U) :- unit(U).",
        "1 { own(U) : use(U) } 1.",
        'factor("mine",3).',
        "violated(x,1) :- use(0).",
    ),
    *(
        'criterion("mine",-9).',
        "human(3).",
        "human(U) :- unit(U).",
        'violated("late",0) :- late(1).',
        "own(U-5) :- use(U).",
    ),
)


@st.composite
def statements(draw: st.DrawFn) -> str:
    choice = draw(st.integers(0, 9))
    if choice == 0:
        return draw(st.sampled_from(WHOLE))
    if choice < 7:
        return draw(st.sampled_from(FINE))
    atom = likely_atoms() | atoms()
    one, two = draw(atom), draw(atom)
    head = draw(
        st.sampled_from(
            (
                *(one, one, one, one, f"{{ {one} }}", f"{one} ; {two}", f"1 {{ {one} : unit(U) ; {two} }} 1"),
                *(
                    f"{one} : unit(U)",
                    f"#sum {{ 1 : {one} : unit(U) }} > 0",
                    f"not {one}",
                    "",
                    "1 < 2",
                    "&a { x }",
                ),
                *(one.replace(",", ";", 1), f"not not {one}", "#false", f"#min {{ 1,2 : {one} }} = 1"),
            )
        )
    )
    body = draw(st.lists(st.sampled_from(BODIES), max_size=3))
    return f"{head}{' :- ' + '; '.join(body) if body else ''}."


rule_texts = st.lists(statements(), min_size=1, max_size=4).map("\n".join)

SMALL = world(
    ["a -fry-> goal", "a -wash-> b", "b -boil-> goal", "z -fry-> y"],
    "a",
    rates={"fry": 0.5, "wash": 1.0, "boil": 0.9},
)


def refusal(answer: Callable[[], object]) -> str:
    """Return how an answer is refused, "" if it is not; anything but one clear line fails the test."""
    try:
        answer()
    except FoonError as error:
        said = str(error)
    else:
        return ""
    assert not re.search(r"\n|<block>|<string>", said), said
    return said


@many(400)
@given(text=rule_texts, question=st.sampled_from(["units", "success", "depth", "human,success", "greedy"]))
def test_trees_are_trees_whatever_the_rules(text: str, question: str) -> None:
    method, by = ("greedy", "success") if question == "greedy" else ("optimal", question)
    query = Query(node("goal"), by=by, method=method, rules=[text], max_depth=4)

    def answer() -> None:
        found = retrieve(SMALL, query)
        event(found.status)
        if found.tree is not None:
            units = set(found.tree.units)
            assert found.tree.executable
            assert units <= set(brute_force.every_unit(SMALL))
            assert found.tree.human <= units
            assert set(found.own) & set(range(1, 1 + len(query.objective.complete))) == set()
        explain(SMALL, query)

    event("refused" if refusal(answer) else "answered")


@many(300)
@given(text=rule_texts)
def test_queries_are_answered_or_refused(text: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "rules.lp"
    path.write_text(text, encoding="utf-8")
    said = refusal(lambda: ask(SMALL, Query(), path))
    event("refused" if said else "answered")
    assert not said or said.startswith(f"{path}:")


# --- Any text at all --------------------------------------------------------------------------------

PIECES = st.sampled_from(
    (
        *(
            "p(X) :- q(X). ",
            '"text"',
            '"',
            "%",
            "%*",
            "*%",
            "\n",
            "\r",
            "\r\n",
            "#include",
            '#include "a".',
            "#script",
        ),
        *(
            "#script (lua) x #end. ",
            "(",
            ")",
            "{",
            "}",
            "é",
            "\0",
            "\ud800",
            "\u00a0",
            "\u2028",
            "\x0b",
            "@f(",
            "-",
            "'",
        ),
        *(
            "_",
            "#",
            ". ",
            "2147483648",
            "0xffffffffff",
            "&a",
            "\\",
            "not ",
            ":",
            ";",
            "x",
            "1",
            "..",
            "|",
            "\ufeff",
            "%!",
        ),
    )
)


@many(3000)
@given(pieces=st.lists(PIECES | st.text(max_size=3), max_size=12))
def test_any_text_is_read_or_refused(pieces: list[str]) -> None:
    """What clingo's parser is given names no file and no code, and does not end clingo."""
    text = "".join(pieces)
    for purpose in PURPOSES:
        refusal(lambda purpose=purpose: check_rules(text, purpose))  # type: ignore[misc]
    try:
        given_to_clingo = scanned(text, "rules")
    except InputError:
        return
    assert not re.search("#include|#script|[\0\r]", given_to_clingo)
    assert given_to_clingo.count("\n") == text.count("\n")


@pytest.mark.parametrize(
    "text",
    [
        "p(" + "f(" * 50_000 + "1" + ")" * 50_000 + ").",
        "p(" + "-" * 50_000 + "1).",
        "p(X) :- X = " + "1+" * 50_000 + "1.",
        "p(X) :- X = " + "(1+" * 50_000 + "1" + ")" * 50_000 + ".",
        "p(X) :- X = 2" + "**2" * 50_000 + ".",
        "p(" + "(" * 50_000 + ",".join("1" * 9) + ")" * 50_000 + ").",
        "p(X) :- X = " + "|" * 50_000 + ".",
        "-" * 50_000 + "p.",
    ],
)
def test_what_would_end_clingo_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="more than 64 brackets and operators in one another"):
        check_rules(text)


def test_long_rules_are_not_deep_ones() -> None:
    text = (
        "p("
        + ";".join(map(str, range(2_000)))
        + "). q(X) :- "
        + ", ".join("p(X-1+2)" for _ in range(200))
        + "."
    )
    assert check_rules(text).text == text


# --- An independent judge ---------------------------------------------------------------------------


@st.composite
def paid(draw: st.DrawFn) -> tuple[World, ObjectNode, dict[UnitId, int], int]:
    where, goal = draw(queries())
    units = list(brute_force.every_unit(where))
    prices = draw(st.fixed_dictionaries({unit: st.integers(0, 3) for unit in units}))
    return where, goal, prices, draw(st.integers(1, 3))


@many(150)
@given(query=paid())
def test_a_criterion_of_ones_own_is_minimised_first_and_told_even_if_it_is_nothing(
    query: tuple[World, ObjectNode, dict[UnitId, int], int],
) -> None:
    where, goal, prices, factor = query
    rules = 'criterion("mine",9). penalty("mine",U,V) :- use(U), price(U,V).' + "".join(
        f" price({unit},{price})." for unit, price in prices.items()
    )
    rules += f' factor("mine",{factor}).'
    numbers = brute_force.every_unit(where)
    sets = [units for size in range(len(numbers) + 1) for units in itertools.combinations(numbers, size)]
    trees = [units for units in sets if brute_force.costs(where, goal, units) is not None]
    found = retrieve(where, Query(goal, constraints=Constraints(rules=(rules,))))
    assert (found.tree is not None) == bool(trees)
    if found.tree is not None:
        least = min((factor * sum(prices[unit] for unit in units), len(units)) for units in trees)
        event(f"pays {min(least[0], 3)}")
        assert found.own == {9: least[0]}
        assert len(found.tree.units) == least[1]
