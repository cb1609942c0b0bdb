"""Queries: the questions of docs/querying.md answered twice, what is shown, and what is an error."""

from __future__ import annotations

import json
import re
import shlex
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import cache
from itertools import combinations
from pathlib import Path
from typing import Any

import brute_force
import pytest
from conftest import ROOT
from hypothesis import given
from jsonschema import Draft202012Validator
from small_foons import domain, domains, many, node, with_units

from foon_asp.dataset import Dataset
from foon_asp.errors import InputError, QueryError
from foon_asp.facts import names
from foon_asp.goals import find_goal
from foon_asp.graph import FunctionalUnit, ObjectNode, Source
from foon_asp.problem import Domain, Problem
from foon_asp.query import FOR_RETRIEVE, Function, QueryAnswer, query
from foon_asp.render.query import query_text, query_value
from foon_asp.rules import read_rules

PAGE = (ROOT / "docs" / "querying.md").read_text(encoding="utf-8")
FILES = {name: text for text, name in re.findall(r"```prolog\n(% ([\w.]+): .*?)```", PAGE, re.DOTALL)}
COMMANDS = re.findall(r"```\n\$ foon-asp query (.*?)\n(.*?)```", PAGE, re.DOTALL)
SCHEMA = json.loads((ROOT / "docs" / "schema" / "query.schema.json").read_text(encoding="utf-8"))


def ask(tmp_path: Path, where: Domain, text: str, *goals: ObjectNode, **options: Any) -> QueryAnswer:
    path = tmp_path / "rules.lp"
    path.write_text(text, encoding="utf-8")
    return query(where, path, goals, **options)


Rows = list[tuple[object, ...]]


def tables(answer: QueryAnswer) -> dict[str, Rows]:
    assert answer.tables is not None
    return {f"{each.heading.name}/{each.heading.arity}": list(each.rows) for each in answer.tables}


@pytest.fixture
def kitchen() -> Domain:
    return domain(("onion + (knife) -cut-> onion[chopped]", "onion[chopped] -fry-> soup"), "onion + (knife)")


# --- The page -------------------------------------------------------------------------------------


def test_the_page_has_as_many_questions_as_it_says() -> None:
    assert len(FILES) == 11
    assert "## Eleven questions" in PAGE
    assert {shlex.split(command)[0] for command, _ in COMMANDS} == set(FILES)


@pytest.mark.parametrize(("command", "output"), COMMANDS, ids=[command for command, _ in COMMANDS])
def test_the_page_prints_what_the_program_prints(
    command: str, output: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    line, _, head = command.partition(" | head -")
    name, *words = shlex.split(line)
    if words[-2:] == ["--data", "../shared/foon/universal"]:
        words = words[:-2]
        dataset: Dataset = request.getfixturevalue("universal")
    else:
        dataset = request.getfixturevalue("built_in")
    where = dataset.domain()
    goals = [find_goal(where, word, dataset.goals) for word in words]
    printed = query_text(ask(tmp_path, where, FILES[name], *goals)).splitlines(keepends=True)
    assert "".join(printed[: int(head)] if head else printed) == output


ERRORS = {
    "one.lp": "\nidle(O) :- not input(_,O).",
    "two.lp": '\nbowls(U,O) :- input(U,O), lable(O,"bowl").',
    "three.lp": "\nlonger(L+1) :- label(_,L).",
}


@pytest.mark.parametrize("name", ERRORS)
def test_the_page_says_what_is_said_of_errors(name: str, tmp_path: Path, kitchen: Domain) -> None:
    with pytest.raises((InputError, QueryError)) as error:
        ask(tmp_path, kitchen, ERRORS[name])
    said = str(error.value).replace(str(tmp_path / "rules.lp"), name)
    assert f"    foon-asp: error: {said}\n" in PAGE


def test_the_page_says_what_the_kitchens_have_unused(
    built_in: Dataset, universal: Dataset, tmp_path: Path
) -> None:
    (said,) = re.findall(r"has (\d+) such objects", PAGE)
    for dataset, count in ((built_in, 0), (universal, int(said))):
        rows = tables(ask(tmp_path, dataset.domain(), FILES["seldom.lp"]))["seldom/2"]
        assert sum(row[0] == 0 for row in rows) == count


def test_the_python_of_the_page_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "dirty.lp").write_text(FILES["dirty.lp"], encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    exec(code, {})
    assert capsys.readouterr().out == "add 1\nfill 1\npour 3\nscoop 1\nshape 2\n"


def test_the_page_names_every_predicate_that_rules_may_use(tmp_path: Path, kitchen: Domain) -> None:
    """The helpers of units.lp are there, too, but nobody needs to know them."""
    with pytest.raises(InputError) as error:
        ask(tmp_path, kitchen, "p :- use(1).")
    there = set(re.findall(r"(\w+)/\d", str(error.value).split("there are ")[1]))
    explained = set(re.findall(r"`(\w+)\(", PAGE[: PAGE.index("## What is shown")]))
    assert there - {"stateful", "sole_content", "implied"} == explained


# --- The questions, answered without any solver ----------------------------------------------------


class Plain:
    """A FOON with what follows from it, worked out from the definitions alone."""

    def __init__(self, where: Domain) -> None:
        self.where = where
        self.units = where.foon.units
        self.needs = [brute_force.needs(where, unit) for unit in self.units]
        self.makes = [brute_force.makes(where, unit) for unit in self.units]
        self.stock = set(where.kitchen.objects)
        self.tools = where.kitchen.utensils
        at_hand, self.runs = brute_force.closure(where, range(len(self.units)))
        self.available = set(at_hand)

    def inputs(self, unit: FunctionalUnit) -> list[ObjectNode]:
        return [self.where.foon.objects[number] for number in unit.inputs]

    def listed(self, unit: FunctionalUnit) -> list[ObjectNode]:
        return [self.where.foon.objects[number] for number in (*unit.inputs, *unit.outputs)]

    def makers(self, thing: ObjectNode) -> list[FunctionalUnit]:
        return [self.units[number] for number in sorted(self.runs) if thing in self.makes[number]]

    @property
    def made(self) -> set[ObjectNode]:
        return {thing for number in self.runs for thing in self.makes[number]}

    @property
    def dishes(self) -> set[ObjectNode]:
        taken = {thing for unit in self.units for thing in self.inputs(unit)}
        return {thing for thing in self.made - taken if thing.label not in self.tools}


Answers = dict[str, set[tuple[object, ...]]]


def dirty(plain: Plain, label: str = "bowl", state: str = "dirty") -> Answers:
    def has_dirty_bowl(things: Collection[ObjectNode]) -> bool:
        return any(thing.label == label and state in thing.plain_states for thing in things)

    counts = Counter(
        unit.motion
        for unit in plain.units
        if has_dirty_bowl(plain.makes[unit.id]) and not has_dirty_bowl(plain.inputs(unit))
    )
    return {"makes_dirty/2": {(motion, count) for motion, count in counts.items()}}


def bottleneck(plain: Plain, least: int = 5) -> Answers:
    makers: dict[ObjectNode, list[FunctionalUnit]] = {}
    for number in plain.runs:
        for thing in plain.makes[number]:
            makers.setdefault(thing, []).append(plain.units[number])
    users = Counter(thing for things in plain.needs for thing in things)
    return {
        "bottleneck/3": {
            (users[thing], units[0].motion, str(thing))
            for thing, units in makers.items()
            if len(units) == 1 and thing not in plain.stock and users[thing] >= least
        }
    }


def tools(plain: Plain) -> Answers:
    return {
        "tool/2": {
            (unit.motion, thing.label)
            for unit in plain.units
            for thing in plain.needs[unit.id]
            if not thing.states
        }
    }


def ingredients(plain: Plain, least: int = 10) -> Answers:
    makers: dict[ObjectNode, list[int]] = {}
    for number in plain.runs:
        for thing in plain.makes[number]:
            makers.setdefault(thing, []).append(number)
    counts: Counter[str] = Counter()
    for dish in plain.dishes:
        seen, open_ = {dish}, [dish]
        while open_:
            thing = open_.pop()
            if thing in plain.stock:
                continue
            for number in makers.get(thing, ()):
                open_ += plain.needs[number] - seen
                seen |= plain.needs[number]
        counts.update({o.label for o in seen & plain.stock if o.states and o.label not in plain.tools})
    return {"common/2": {(count, label) for label, count in counts.items() if count >= least}}


def seldom(plain: Plain) -> Answers:
    users = Counter(thing for things in plain.needs for thing in things)
    return {"seldom/2": {(users[thing], str(thing)) for thing in plain.stock if users[thing] <= 1}}


def never(plain: Plain) -> Answers:
    return {
        "never/4": {
            (Path(source.file).name, source.line, unit.motion, str(thing))
            for unit in plain.units
            if unit.id not in plain.runs
            for thing in plain.needs[unit.id] - plain.available
            for source in unit.annotation.sources
        }
    }


def chain(plain: Plain) -> Answers:
    makers = Counter(thing for number in plain.runs for thing in plain.makes[number])
    only = {
        thing: number
        for number in plain.runs
        for thing in plain.makes[number]
        if makers[thing] == 1 and thing not in plain.stock
    }
    before = {u: {only[o] for o in plain.needs[u] if o in only} for u in plain.runs}

    @cache
    def length(number: int) -> int:
        return 1 + max(map(length, before[number]), default=0)

    longest = max(map(length, plain.runs), default=0)
    links = {(number, longest) for number in plain.runs if length(number) == longest}
    for place in range(longest, 1, -1):
        ends = {number for number, at in links if at == place}
        links |= {(u, place - 1) for v in ends for u in before[v] if length(u) == place - 1}
    return {
        "step/3": {
            (place, plain.units[number].motion, source.line)
            for number, place in links
            for source in plain.units[number].annotation.sources
        }
    }


def oven(plain: Plain, broken: str = "oven") -> Answers:
    free = [
        unit.id
        for unit in plain.units
        if not any(
            broken in (thing.label, *(state.relatum for state in thing.states))
            for thing in plain.listed(unit)
        )
    ]
    left, _ = brute_force.closure(plain.where, free)
    return {"lost/1": {(str(dish),) for dish in plain.dishes if dish not in left}}


def rates(plain: Plain, below: float = 0.5) -> Answers:
    counts = Counter(unit.motion for unit in plain.units)
    known = {unit.motion: plain.where.kitchen.known_rate(unit) for unit in plain.units}
    return {
        "unrated/1": {(motion,) for motion, rate in known.items() if rate is None},
        "risky/3": {
            (round(rate * 1000), motion, counts[motion])
            for motion, rate in known.items()
            if rate is not None and rate < below
        },
    }


PLAIN: dict[str, Callable[..., Answers]] = {
    f"{each.__name__}.lp": each
    for each in (dirty, bottleneck, tools, ingredients, seldom, never, chain, oven, rates)
}


@cache
def _plain(where: Domain) -> Plain:
    return Plain(where)


@pytest.fixture(scope="module")
def built_in_domain(built_in: Dataset) -> Domain:
    return built_in.domain()


@pytest.mark.parametrize("name", PLAIN)
@pytest.mark.parametrize("data", ["built_in_domain", "universal_domain"])
def test_plain_python_gives_the_same_answer(
    name: str, data: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    where: Domain = request.getfixturevalue(data)
    found = tables(ask(tmp_path, where, FILES[name]))
    expected = PLAIN[name](_plain(where))
    assert {key: set(rows) for key, rows in found.items()} == expected
    assert all(len(rows) == len(set(rows)) for rows in found.values())
    nothing = {("dirty.lp", "universal_domain"), ("never.lp", "built_in_domain")}
    assert any(expected.values()) == ((name, data) not in nothing)


SMALLER: dict[str, tuple[str, str, dict[str, object]]] = {
    "dirty.lp": (
        'label(O,"bowl"), state(O,"dirty")',
        'label(O,"onion"), state(O,"chopped")',
        {"label": "onion", "state": "chopped"},
    ),
    "bottleneck.lp": (">= 5", ">= 1", {"least": 1}),
    "ingredients.lp": (">= 10", ">= 1", {"least": 1}),
    "oven.lp": ('"oven"', '"cup"', {"broken": "cup"}),
    "rates.lp": ("< 500", "< 900", {"below": 0.9}),
}
"""What to ask instead, so that small FOONs have something to answer."""


@pytest.mark.parametrize("name", PLAIN)
def test_plain_python_gives_the_same_answer_on_random_foons(
    name: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("random")
    old, new, changes = SMALLER.get(name, ("", "", {}))
    assert old in FILES[name]
    text = FILES[name].replace(old, new) if old else FILES[name]
    seen: set[str] = set()

    @many(80)
    @given(domains(strict=False))
    def check(drawn: Domain) -> None:
        where = with_places(drawn)
        expected = PLAIN[name](Plain(where), **changes)
        found = tables(ask(folder, where, text))
        assert {key: set(rows) for key, rows in found.items()} == expected
        seen.add(repr(expected))

    check()
    assert len(seen) > 3, "hardly any FOON had something to answer"


def with_places(where: Domain) -> Domain:
    """Say for each unit that it was read somewhere."""
    units = [
        replace(unit, annotation=replace(unit.annotation, sources=(Source("small.txt", unit.id + 1),)))
        for unit in where.foon.units
    ]
    return Domain(with_units(where.foon, units), where.kitchen, strict=where.strict)


@pytest.mark.parametrize("data", ["built_in", "universal"])
def test_the_ways_to_make_each_goal(data: str, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    dataset: Dataset = request.getfixturevalue(data)
    where = dataset.domain()
    plain = _plain(where)
    several = 0
    for goal in dict.fromkeys(dataset.goals):
        if goal not in plain.available:
            continue
        units = plain.makers(goal)
        expected = {
            (unit.source.line, unit.motion, str(thing)) for unit in units for thing in plain.needs[unit.id]
        }
        (rows,) = tables(ask(tmp_path, where, FILES["ways.lp"], goal)).values()
        assert set(rows) == expected
        several += len(units) > 1
    assert several >= {"built_in": 4, "universal": 1}[data]


Units = Sequence[FunctionalUnit]


@pytest.mark.parametrize("data", ["built_in", "universal"])
def test_no_robot_does_with_fewer_skills(data: str, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    dataset: Dataset = request.getfixturevalue(data)
    where = dataset.domain()
    plain = _plain(where)
    checked: list[tuple[int, bool | None]] = []
    for goal in dict.fromkeys(dataset.goals):
        if goal not in plain.available:
            continue
        answer = ask(tmp_path, where, FILES["skills.lp"], goal)
        assert answer.status == "optimal"
        (rows,) = tables(answer).values()
        skills = {str(motion) for (motion,) in rows}
        assert answer.costs == (len(skills),)
        units = [where.foon.units[number] for number in where.problem([goal]).units]

        def suffices(some: Collection[str], goal: ObjectNode = goal, units: Units = units) -> bool:
            at_hand, _ = brute_force.closure(where, [unit.id for unit in units if unit.motion in some])
            return goal in at_hand

        assert suffices(skills)
        motions = {unit.motion for unit in units}
        if len(skills) <= 5 and len(motions) <= 15:
            smaller = (combinations(motions, size) for size in range(len(skills)))
            assert not any(suffices(some) for sets in smaller for some in sets)
            as_good = [some for some in combinations(motions, len(skills)) if suffices(some)]
            assert answer.more == (len(as_good) > 1)
            checked.append((len(skills), answer.more))
    assert len(checked) >= 4


# --- What is shown --------------------------------------------------------------------------------


def shown(tmp_path: Path, where: Domain, text: str, **options: Any) -> dict[str, Rows]:
    return tables(ask(tmp_path, where, text, **options))


def test_without_show_all_predicates_of_the_file_and_no_others(tmp_path: Path, kitchen: Domain) -> None:
    text = 'b(U) :- unit(U). a(M) :- motion(_,M). kitchen(O) :- label(O,"salt").'
    assert shown(tmp_path, kitchen, text) == {"b/1": [(0,), (1,)], "a/1": [("cut",), ("fry",)]}


def test_show_statements_say_what_is_shown(tmp_path: Path, kitchen: Domain) -> None:
    text = "b(U) :- unit(U). a(M) :- motion(_,M). #show b/1."
    assert shown(tmp_path, kitchen, text) == {"b/1": [(0,), (1,)]}
    assert shown(tmp_path, kitchen, "#show executable/1.") == {"executable/1": [(0,), (1,)]}
    assert shown(tmp_path, kitchen, "b(U) :- unit(U). #show.") == {}
    assert query_text(ask(tmp_path, kitchen, "b(U) :- unit(U). #show.")) == "the rules show nothing\n"


def test_shown_terms_stand_beside_shown_atoms(tmp_path: Path, kitchen: Domain) -> None:
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


def test_a_shown_term_is_no_atom_of_the_encodings(tmp_path: Path, kitchen: Domain) -> None:
    assert shown(tmp_path, kitchen, "#show available(U) : unit(U).") == {"available/1": [(0,), (1,)]}


def test_negated_predicates_are_tables_of_their_own(tmp_path: Path, kitchen: Domain) -> None:
    text = '-good(M) :- motion(_,M). good("x").'
    assert shown(tmp_path, kitchen, text) == {"-good/1": [("cut",), ("fry",)], "good/1": [("x",)]}
    assert shown(tmp_path, kitchen, text + "#show -good/1.") == {"-good/1": [("cut",), ("fry",)]}


def test_rows_are_sorted_as_people_sort(tmp_path: Path, kitchen: Domain) -> None:
    text = 'p(("unit 10";"unit 2";10;9;-1;b;a;f(2);f(10);(2,1);(1,2);"Unit 2")).'
    assert [row[0] for row in shown(tmp_path, kitchen, text)["p/1"]] == [
        *(-1, 9, 10),
        *("Unit 2", "unit 2", "unit 10"),
        *((1, 2), (2, 1)),
        *(Function("a"), Function("b"), Function("f", (2,)), Function("f", (10,))),
    ]


def test_terms_keep_what_they_are(tmp_path: Path, kitchen: Domain) -> None:
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


def test_tables(tmp_path: Path, kitchen: Domain) -> None:
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


def test_columns_are_named_by_the_first_rule_and_only_by_variables(tmp_path: Path, kitchen: Domain) -> None:
    text = "p(A,B) :- input(A,B). p(C,D) :- output(C,D). q(A,1) :- unit(A). r(1). r(A) :- unit(A)."
    found = ask(tmp_path, kitchen, text).tables or ()
    assert [each.heading.columns for each in found] == [("A", "B"), (), ()]


# --- Stable models --------------------------------------------------------------------------------


def test_rules_without_a_stable_model(tmp_path: Path, kitchen: Domain) -> None:
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
    tmp_path: Path, kitchen: Domain, text: str, more: bool
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
    tmp_path: Path, kitchen: Domain, text: str, costs: tuple[int, ...], rows: Rows | None, more: bool
) -> None:
    answer = ask(tmp_path, kitchen, "{ p(U) : unit(U) }. :- not p(_). " + text)
    assert (answer.status, answer.costs, answer.more) == ("optimal", costs, more)
    assert rows is None or tables(answer)["p/1"] == rows
    first = f"cost {', '.join(map(str, costs))} (proven optimal)\n"
    assert query_text(answer).startswith(first)
    checked(answer)


PIGEONS = "{ in(P,H) : H = 1..12 } = 1 :- P = 1..13."
APART = ":- in(P,H), in(Q,H), P < Q."


def test_a_time_limit_without_a_model(tmp_path: Path, kitchen: Domain) -> None:
    answer = ask(tmp_path, kitchen, PIGEONS + APART, time_limit=0.3)
    assert (answer.status, answer.tables, answer.more) == ("limit", None, None)
    assert query_text(answer) == "no stable model was found before the time limit\n"
    checked(answer)


def test_a_time_limit_with_a_model_that_is_not_proven(tmp_path: Path, kitchen: Domain) -> None:
    text = PIGEONS + "#minimize { 1,P,Q : in(P,H), in(Q,H), P < Q }."
    answer = ask(tmp_path, kitchen, text, time_limit=0.3)
    assert (answer.status, answer.more) == ("limit", None)
    assert answer.costs >= (1,)
    assert len(tables(answer)["in/2"]) == 13
    assert query_text(answer).startswith(
        f"cost {answer.costs[0]} (time limit, not proven)\n\nin(P, H): 13 rows\n"
    )
    checked(answer)


def test_a_time_limit_before_it_is_known_whether_there_is_more(tmp_path: Path, kitchen: Domain) -> None:
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


def checked(answer: QueryAnswer) -> dict[str, Any]:
    """Return the JSON value of an answer, as it is read, after checking it against the schema."""
    value: dict[str, Any] = json.loads(json.dumps(query_value(answer)))
    Draft202012Validator(SCHEMA).validate(value)
    return value


def test_the_schema_takes_nothing_else(tmp_path: Path, kitchen: Domain) -> None:
    value = checked(ask(tmp_path, kitchen, "p(U) :- unit(U).", kitchen.node(2)))
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


def test_goals_leave_the_slice_that_matters(tmp_path: Path, kitchen: Domain) -> None:
    text = "u(U) :- unit(U). g(Text) :- goal(O), name(O,Text)."
    assert shown(tmp_path, kitchen, text) == {"u/1": [(0,), (1,)], "g/1": []}
    chopped = tables(ask(tmp_path, kitchen, text, node("onion[chopped]")))
    assert chopped == {"u/1": [(0,)], "g/1": [("onion [chopped]",)]}
    both = tables(ask(tmp_path, kitchen, text, node("onion[chopped]"), node("soup")))
    assert both == {"u/1": [(0,), (1,)], "g/1": [("onion [chopped]",), ("soup [ready]",)]}
    with pytest.raises(QueryError, match="unknown goal"):
        ask(tmp_path, kitchen, text, node("stew"))


def test_names_and_places(kitchen: Domain) -> None:
    places = (Source("a/first.txt", 7), Source('b/"second".txt', 9))
    units = [
        replace(kitchen.foon.units[0], annotation=replace(kitchen.foon.units[0].annotation, sources=places))
    ]
    where = Domain(with_units(kitchen.foon, units), kitchen.kitchen)
    assert names(Problem(where, (), whole=True)).splitlines() == [
        'name(0,"onion [ready]").',
        'name(1,"knife").',
        'name(2,"onion [chopped]").',
        'name(3,"soup [ready]").',
        'source(0,"first.txt",7).',
        'source(0,"\\"second\\".txt",9).',
    ]


def test_rules_may_add_to_the_facts(tmp_path: Path) -> None:
    where = domain(("onion + (knife) -cut-> onion[chopped]",), "onion")
    text = "runs(U) :- executable(U)."
    assert shown(tmp_path, where, text) == {"runs/1": []}
    assert shown(tmp_path, where, text + 'kitchen(O) :- label(O,"knife").') == {"runs/1": [(0,)]}


@pytest.mark.parametrize("level", [1, 2])
def test_queries_on_a_level(built_in: Dataset, tmp_path: Path, level: int) -> None:
    where = built_in.domain(level=level)
    found = shown(tmp_path, where, "r(U) :- executable(U). n(Text) :- name(_,Text). b(O) :- bare(O).")
    assert {row[0] for row in found["r/1"]} == where.closure.executable.keys()
    assert {row[0] for row in found["n/1"]} == {str(thing) for thing in where.foon.objects}
    assert len(found["b/1"]) == sum(thing.bare for thing in where.foon.objects)


def test_strict_reading_needs_every_input(tmp_path: Path) -> None:
    where = domain(("bowl{onion} + onion@bowl -stir-> soup",), "onion@bowl", utensils=["bowl"])
    strictly = Domain(where.foon, where.kitchen, strict=True)
    text = "n(Text) :- needs(_,O), name(O,Text)."
    assert shown(tmp_path, where, text) == {"n/1": [("onion in [bowl]",)]}
    assert shown(tmp_path, strictly, text) == {"n/1": [("bowl {onion}",), ("onion in [bowl]",)]}


NOT_HERE = "is not available in a query, where nothing is decided; there are available/1, bare/1, content/3"


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
def test_errors_are_one_line_with_the_place(tmp_path: Path, kitchen: Domain, text: str, message: str) -> None:
    with pytest.raises((InputError, QueryError), match=r"rules\.lp" + message) as error:
        ask(tmp_path, kitchen, text)
    assert "\n" not in str(error.value)
    assert "<block>" not in str(error.value)


def test_a_file_that_is_not_there(tmp_path: Path, kitchen: Domain) -> None:
    with pytest.raises(InputError, match="no such file"):
        query(kitchen, tmp_path / "none.lp")


def test_predicates_with_other_encodings_names_may_be_ones_own(tmp_path: Path, kitchen: Domain) -> None:
    """Nothing else in a query has these names, so nothing can be mixed up."""
    assert shown(tmp_path, kitchen, "use(U) :- unit(U). missing(1). goal(2).") == {
        "use/1": [(0,), (1,)],
        "missing/1": [(1,)],
    }


def test_parts_of_the_rules_do_not_swallow_the_facts(tmp_path: Path, kitchen: Domain) -> None:
    for text in (
        "u(U) :- unit(U). % the end",
        "#program base. u(U) :- unit(U).",
        "u(U) :- unit(U). %* end *%",
    ):
        assert shown(tmp_path, kitchen, text) == {"u/1": [(0,), (1,)]}


def test_a_script_may_be_allowed(tmp_path: Path, kitchen: Domain) -> None:
    text = """
        #script (python)
        import clingo
        def twice(x):
            return clingo.Number(2 * x.number)
        #end.
        p(@twice(U)) :- unit(U).
    """
    text = "\n".join(line.removeprefix("        ") for line in text.splitlines())
    assert shown(tmp_path, kitchen, text, allow_script=True) == {"p/1": [(0,), (2,)]}
    with pytest.raises(QueryError, match=r"rules\.lp:7:3: operation undefined: function 'thrice' not found"):
        ask(tmp_path, kitchen, text.replace("@twice", "@thrice"), allow_script=True)


def test_rules_of_retrieve_have_no_names(tmp_path: Path) -> None:
    path = tmp_path / "rules.lp"
    path.write_text('violated("far",U) :- use(U), source(U,"a.txt",_).')
    with pytest.raises(InputError, match=r":1:30: source/3 is not available here"):
        read_rules(path)
    path.write_text('ok("cut";"fry"). violated("x",U) :- use(U), motion(U,M), not ok(M).')
    assert "ok(M)" in read_rules(path)
    assert ("violated", 2) in FOR_RETRIEVE
