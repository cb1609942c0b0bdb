"""The encodings: how they are written, and what their models are on small named graphs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import clingo
import pytest
from clingo.ast import AST, ASTType, parse_files
from small_foons import domain, motions, node, written

from foon_asp import resources
from foon_asp.facts import facts
from foon_asp.problem import Domain, Problem
from foon_asp.retrieve import retrieve
from foon_asp.solve import Solver

# --- How they are written -------------------------------------------------------------------------

FOLDER = resources.encoding("")
FILES = sorted(FOLDER.rglob("*.lp"))
NAMES = [path.relative_to(FOLDER).as_posix() for path in FILES]
ROOTS = [name for name in NAMES if not name.startswith("criteria/")]
Constants = Mapping[str, str | int]

DOCUMENTED = re.compile(r"^%\*! (\w+)\(([^)]*)\)$", re.MULTILINE)
SHOWN = re.compile(r"^#show (\w+)/(\d+)\.", re.MULTILINE)
DEFINED = re.compile(r"^#defined (\w+)/(\d+)\.", re.MULTILINE)
Signature = tuple[str, int]


@cache
def statements(path: Path) -> list[AST]:
    """Parse a file and return its own statements, without those of the files it includes."""
    found: list[AST] = []
    parse_files([str(path)], found.append)
    return [each for each in found if Path(each.location.begin.filename).samefile(path)]


def of_type(path: Path, *types: ASTType) -> list[AST]:
    return [each for each in statements(path) if each.ast_type in types]


def signatures(pattern: re.Pattern[str], text: str) -> list[Signature]:
    return [(name, int(arity)) for name, arity in pattern.findall(text)]


def documented(paths: Iterable[Path]) -> set[Signature]:
    comments = (match for path in paths for match in DOCUMENTED.findall(path.read_text("utf-8")))
    return {(name, len(arguments.split(","))) for name, arguments in comments}


def heads(rule: AST) -> set[Signature]:
    """Return the predicates that a rule derives."""
    found: set[Signature] = set()
    open_ = [rule.head]
    while open_:
        part = open_.pop()
        if part.ast_type == ASTType.SymbolicAtom:
            found.add((part.symbol.name, len(part.symbol.arguments)))
        elif part.ast_type == ASTType.Literal:
            open_.append(part.atom)
        elif part.ast_type == ASTType.ConditionalLiteral:
            open_.append(part.literal)
        elif part.ast_type in (ASTType.Aggregate, ASTType.Disjunction):
            open_ += part.elements
    return found - {("", 0)}


def sentence_above(lines: list[str], line: int) -> str:
    """Return the block of plain comment lines right above a line (counted from 1), joined."""
    block: list[str] = []
    for text in reversed(lines[: line - 1]):
        if not text.startswith("% "):
            break
        block.append(text[2:].strip())
    return " ".join(reversed(block))


def test_the_folder_of_encodings_is_found() -> None:
    assert {"vocabulary.lp", "units.lp", "task_tree.lp", "criteria/units.lp"} <= set(NAMES)


@pytest.mark.parametrize("path", FILES, ids=NAMES)
class TestStyle:
    def test_the_header_says_purpose_input_output_and_constants(self, path: Path) -> None:
        header = path.read_text("utf-8").split("\n\n")[0].splitlines()
        assert all(line.startswith("%") for line in header)
        fields = [match[1] for line in header if (match := re.match(r"% ([A-Z][a-z]+): +\S", line))]
        constants = ["Const"] if of_type(path, ASTType.Definition) else []
        assert fields == ["Purpose", "Input", "Output", *constants]

    def test_the_header_names_every_constant(self, path: Path) -> None:
        header = path.read_text("utf-8").split("\n\n")[0]
        for constant in of_type(path, ASTType.Definition):
            assert re.search(rf"^%(?: Const:)? +{constant.name} +- ", header, re.MULTILINE)

    def test_a_sentence_stands_above_every_rule(self, path: Path) -> None:
        """Rules for the same predicate that stand together may share one; aims may go on in a list."""
        lines = path.read_text("utf-8").splitlines()
        previous: AST | None = None
        for rule in of_type(path, ASTType.Rule, ASTType.Minimize):
            line = rule.location.begin.line
            together = (
                previous is not None
                and previous.location.end.line == line - 1
                and previous.ast_type == rule.ast_type == ASTType.Rule
                and bool(heads(rule))
                and heads(previous) == heads(rule)
            )
            sentence = sentence_above(lines, line)
            pattern = r".+[.,]" if rule.ast_type == ASTType.Minimize else r"[A-Z“\"].*\."
            assert together or re.fullmatch(pattern, sentence), f"{path.name}:{line}: {rule}"
            previous = rule

    def test_what_a_constraint_forbids_is_said(self, path: Path) -> None:
        lines = path.read_text("utf-8").splitlines()
        for rule in of_type(path, ASTType.Rule):
            if str(rule.head) == "#false":
                assert sentence_above(lines, rule.location.begin.line).startswith("Forbidden")

    def test_derived_and_shown_predicates_are_documented(self, path: Path) -> None:
        derived = {head for rule in of_type(path, ASTType.Rule) for head in heads(rule)}
        shown = set(signatures(SHOWN, path.read_text("utf-8")))
        assert derived | shown <= documented(FILES)

    def test_lines_are_short_and_there_are_no_scripts(self, path: Path) -> None:
        text = path.read_text("utf-8")
        assert max(map(len, text.splitlines())) <= 110
        assert not of_type(path, ASTType.Script)
        assert "#script" not in text


def test_every_input_predicate_is_documented_in_the_vocabulary() -> None:
    vocabulary = resources.encoding("vocabulary.lp")
    inputs = signatures(DEFINED, vocabulary.read_text("utf-8"))
    assert len(inputs) == len(set(inputs)) == 20
    assert set(inputs) == documented([vocabulary])


def test_every_fact_that_is_written_belongs_to_the_vocabulary() -> None:
    where = domain(
        ["onion + (knife) + bowl{onion} -cut-> onion[chopped]@bowl"],
        "onion + (knife) + bowl{onion}",
        utensils=["bowl"],
    )
    text = facts(Problem(where, (0,), whole=True))
    found = {(atom, 1 + arguments.count(",")) for atom, arguments in re.findall(r"(\w+)\(([^)]*)\)\.", text)}
    vocabulary = resources.encoding("vocabulary.lp").read_text("utf-8")
    assert len(found) >= 11
    assert found <= set(signatures(DEFINED, vocabulary))


PARTS = {
    "ids.lp": (("check", 0), ("step", 1), ("check", 1), ("choose", 1)),
    "plan.lp": (("check", 0), ("step", 1), ("check", 1), ("cheapest", 1)),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("full", [False, True], ids=["no facts", "facts"])
def test_clingo_has_nothing_to_warn_of(name: str, full: bool) -> None:
    said: list[str] = []
    control = clingo.Control(
        ["--warn=all", "--warn=no-file-included"], lambda _, message: said.append(message)
    )
    for each in [name] if name in ROOTS else ["task_tree.lp", name]:
        control.load(str(resources.encoding(each)))
    if full:
        where = domain(["onion + (knife) -cut-> soup"], "onion + (knife)")
        criterion = f'criterion("{Path(name).stem}",1).'
        control.add("base", [], facts(where.problem([node("soup")])) + criterion)
    control.ground([("base", [])])
    for part, number in PARTS.get(name, ()):
        control.ground([(part, [clingo.Number(number)])])
    assert said == []


# --- What their models are ------------------------------------------------------------------------

KINDS = {
    "needs": "UO",
    "makes": "UO",
    "bare": "O",
    "available": "O",
    "executable": "U",
    "use": "U",
    "pick": "OU",
}
"""What the arguments of a predicate are, units or objects."""


@dataclass(frozen=True)
class Case:
    """A named graph and all models of an encoding, each a line of its atoms.

    Units are named by their motions. Models are compared on the predicates that are asked.
    """

    name: str
    encoding: str
    units: tuple[str, ...]
    kitchen: str
    models: tuple[str, ...]
    goal: str = ""
    asked: str = "use"
    utensils: tuple[str, ...] = ("bowl",)
    constants: Constants = field(default_factory=dict)


def all_models(case: Case) -> list[str]:
    where = domain(case.units, case.kitchen, utensils=case.utensils)
    goals = (where.id_of(node(case.goal)),) if case.goal else ()
    arguments = ["0", *(f"-c{name}={value}" for name, value in case.constants.items())]
    control = clingo.Control(arguments)
    control.load(str(resources.encoding(case.encoding)))
    control.add("base", [], facts(Problem(where, goals, whole=True)))
    control.ground([("base", [])])
    found: list[str] = []
    with control.solve(yield_=True) as handle:
        for model in handle:
            atoms = [atom for atom in model.symbols(atoms=True) if atom.name in case.asked.split()]
            found.append(" ".join(sorted(name_atom(where, atom) for atom in atoms)))
    return sorted(found)


def name_atom(where: Domain, atom: clingo.Symbol) -> str:
    arguments = [
        where.foon.units[each.number].motion if kind == "U" else written(where.node(each.number))
        for kind, each in zip(KINDS[atom.name], atom.arguments, strict=True)
    ]
    return f"{atom.name}({','.join(arguments)})"


VIEW = ("bowl{onion} + onion@bowl + (spoon) -stir-> onion[stirred]@bowl + (spoon)",)
CIRCLE = ("a -go-> b", "b -back-> a", "b -end-> goal")
TWO_WAYS = ("flour -bake-> bread", "salt -fry-> bread", "bread -toast-> toast")

CASES = (
    Case(
        "an implied view is not needed, a bare output is not made",
        "units.lp",
        VIEW,
        "",
        ("makes(stir,onion[stirred]@bowl) needs(stir,(spoon)) needs(stir,onion@bowl)",),
        asked="needs makes",
    ),
    Case(
        "every input is needed if reading is strict",
        "units.lp",
        VIEW,
        "",
        ("needs(stir,(spoon)) needs(stir,bowl{onion}) needs(stir,onion@bowl)",),
        asked="needs",
        constants={"strict": 1},
    ),
    Case(
        "what is no utensil is never an implied view",
        "units.lp",
        ("bowl{onion} + onion@bowl -stir-> soup",),
        "",
        ("needs(stir,bowl{onion}) needs(stir,onion@bowl)",),
        asked="needs",
        utensils=("cup",),
    ),
    Case(
        "a vessel with two things in it is needed",
        "units.lp",
        ("bowl{onion,salt} + onion@bowl + salt@bowl -stir-> soup",),
        "",
        ("needs(stir,bowl{onion,salt}) needs(stir,onion@bowl) needs(stir,salt@bowl)",),
        asked="needs",
    ),
    Case(
        "one thing that is named twice is one thing",
        "units.lp",
        ("bowl{onion,onion} + onion@bowl -stir-> soup",),
        "",
        ("needs(stir,onion@bowl)",),
        asked="needs",
    ),
    Case(
        "a view is only implied by its thing in that very vessel",
        "units.lp",
        (
            "bowl{onion} + onion@cup -stir-> soup",
            "bowl{onion} + salt@bowl -salt-> soup",
            "bowl{onion} + onion -add-> soup",
        ),
        "",
        (
            "needs(add,bowl{onion}) needs(add,onion) needs(salt,bowl{onion}) needs(salt,salt@bowl)"
            " needs(stir,bowl{onion}) needs(stir,onion@cup)",
        ),
        asked="needs",
    ),
    Case(
        "an object with any kind of state is not bare",
        "units.lp",
        ("(a) + a + a@x + a{y} + a{} -mix-> b",),
        "",
        ("bare((a))",),
        asked="bare",
    ),
    Case(
        "the closure stops where something is lacking",
        "reachability.lp",
        ("a -one-> b", "b + (knife) -two-> c", "b + (fork) -three-> d"),
        "a + (knife)",
        ("available((knife)) available(a) available(b) available(c) executable(one) executable(two)",),
        asked="available executable",
    ),
    Case(
        "a circle never starts itself, a unit without needs does",
        "reachability.lp",
        ("-rain-> water", *CIRCLE),
        "",
        ("available(water) executable(rain)",),
        asked="available executable",
    ),
    Case(
        "a tool that is listed again is not made",
        "reachability.lp",
        ("a -wash-> (knife)", "(knife) -cut-> b"),
        "a",
        ("available(a) executable(wash)",),
        asked="available executable",
    ),
    Case(
        "a founded tree is never a circle",
        "task_tree.lp",
        CIRCLE,
        "",
        (),
        goal="goal",
    ),
    Case(
        "without foundedness a circle holds itself up",
        "task_tree.lp",
        CIRCLE,
        "",
        ("use(back) use(end) use(go)",),
        goal="goal",
        constants={"founded": 0},
    ),
    Case(
        "a founded tree may use the circle's units from the kitchen",
        "task_tree.lp",
        CIRCLE,
        "a",
        ("use(back) use(end) use(go)", "use(end) use(go)"),
        goal="goal",
    ),
    Case(
        "all sets of units that make the goal are trees",
        "task_tree.lp",
        TWO_WAYS,
        "flour + salt",
        ("use(bake) use(fry) use(toast)", "use(bake) use(toast)", "use(fry) use(toast)"),
        goal="toast",
    ),
    Case(
        "a founded tree has no gap",
        "task_tree.lp",
        ("flour -bake-> bread",),
        "",
        (),
        goal="bread",
    ),
    Case(
        "without foundedness what no unit makes is passed over",
        "task_tree.lp",
        ("flour -bake-> bread",),
        "",
        ("use(bake)",),
        goal="bread",
        constants={"founded": 0},
    ),
    Case(
        "a goal that is at hand needs nothing",
        "task_tree.lp",
        ("flour -bake-> bread",),
        "bread",
        ("",),
        goal="bread",
    ),
    Case(
        "each selection takes one unit for an object",
        "selection.lp",
        TWO_WAYS,
        "flour + salt",
        ("pick(bread,bake) pick(toast,toast)", "pick(bread,fry) pick(toast,toast)"),
        goal="toast",
        asked="pick",
    ),
    Case(
        "a founded selection takes only what hangs on the kitchen",
        "selection.lp",
        TWO_WAYS,
        "salt",
        ("pick(bread,fry) pick(toast,toast)",),
        goal="toast",
        asked="pick",
    ),
    Case(
        "an unfounded selection takes what hangs in the air, too",
        "selection.lp",
        TWO_WAYS,
        "salt",
        ("pick(bread,bake) pick(toast,toast)", "pick(bread,fry) pick(toast,toast)"),
        goal="toast",
        asked="pick",
        constants={"founded": 0},
    ),
    Case("a founded selection is never a circle", "selection.lp", CIRCLE, "", (), goal="goal"),
    Case(
        "an unfounded selection may be a circle",
        "selection.lp",
        CIRCLE,
        "",
        ("pick(a,back) pick(b,go) pick(goal,end)",),
        goal="goal",
        asked="pick",
        constants={"founded": 0},
    ),
    Case(
        "one unit may be picked for two objects",
        "selection.lp",
        ("egg -part-> yolk + white", "yolk + white -beat-> cream"),
        "egg",
        ("pick(cream,beat) pick(white,part) pick(yolk,part)",),
        goal="cream",
        asked="pick",
    ),
)


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.encoding}: {case.name}")
def test_models(case: Case) -> None:
    assert all_models(case) == sorted(case.models)


RATES = {"bake": 0.5, "fry": 0.9, "boil": 0.9, "toast": 1.0}
THREE_WAYS = (
    "flour + water -bake-> bread",
    "salt + oil + water -fry-> bread",
    "water -boil-> bread",
    "bread -toast-> toast",
)


@pytest.mark.parametrize(
    ("method", "by", "expected"),
    [
        ("first", (), {"bake", "toast"}),
        ("greedy", ("success",), {"fry", "toast"}),
        ("greedy", ("inputs",), {"boil", "toast"}),
        ("optimal", ("success", "inputs"), {"boil", "toast"}),
        ("ids", (), {"bake", "toast"}),
    ],
)
@pytest.mark.parametrize("founded", [True, False])
def test_each_method_takes_its_own_unit(
    method: str, by: tuple[str, ...], expected: set[str], founded: bool
) -> None:
    where = domain(THREE_WAYS, "flour + water + salt + oil", rates=RATES)
    result = retrieve(where, node("toast"), method, by, founded=founded or method == "ids")
    assert result.tree is not None
    assert motions(where, result.tree.units) == expected


@pytest.mark.parametrize(
    ("by", "founded", "expected"),
    [
        ("success", True, {"thaw", "serve"}),
        ("success", False, {"melt", "freeze", "serve"}),
        ("inputs", True, {"thaw", "serve"}),
        ("inputs", False, {"melt", "freeze", "serve"}),
    ],
)
def test_greedy_takes_the_best_unit_even_in_a_circle_unless_founded(
    by: str, founded: bool, expected: set[str]
) -> None:
    units = ("ice -melt-> water", "water -freeze-> ice", "snow + salt -thaw-> water", "water -serve-> drink")
    where = domain(units, "snow + salt", rates={"thaw": 0.5})
    tree = retrieve(where, node("drink"), "greedy", (by,), founded=founded).tree
    assert tree is not None
    assert motions(where, tree.units) == expected
    assert tree.executable == founded


def test_greedy_decides_nearer_to_the_goal_first() -> None:
    units = ("x -good-> goal", "y -fair-> goal", "a -poor-> x", "a -best-> y")
    where = domain(units, "a", rates={"good": 0.9, "fair": 0.8, "poor": 0.1, "best": 1.0})
    greedy = retrieve(where, node("goal"), "greedy", ("success",)).tree
    optimal = retrieve(where, node("goal"), "optimal", ("success",)).tree
    assert greedy is not None
    assert optimal is not None
    assert motions(where, greedy.units) == {"good", "poor"}
    assert motions(where, optimal.units) == {"fair", "best"}


@pytest.mark.parametrize("length", [3, 40])
def test_greedy_counts_levels_as_far_as_they_go(length: int) -> None:
    """The closure takes a short cut that the heuristic does not: its levels go beyond its rounds."""
    chain = [f"a{i} -up{i}-> a{i + 1}" for i in range(length)]
    where = domain(
        [*chain, f"a0 + x -jump-> a{length}", "a0 + y -low-> a1"],
        "a0 + x + y",
        rates={"jump": 0.5, "low": 0.6, "up0": 0.7},
    )
    tree = retrieve(where, node(f"a{length}"), "greedy", ("success",)).tree
    assert tree is not None
    assert motions(where, tree.units) == {f"up{i}" for i in range(length)}


@pytest.mark.parametrize(
    ("units", "kitchen", "expected"),
    [
        (("a -one-> goal",), "goal", 0),
        (("a -one-> goal",), "a", 1),
        (("-one-> goal",), "", 1),
        (("a -one-> b", "b -two-> c", "c -three-> goal"), "a", 3),
        (("a -one-> b", "b -two-> c", "c -three-> goal", "b + a -short-> goal"), "a", 2),
        (("a -one-> goal",), "", None),
        (CIRCLE, "", None),
        (CIRCLE, "a", 2),
    ],
)
def test_the_first_bound_that_reaches_the_goal_is_its_least_depth(
    units: tuple[str, ...], kitchen: str, expected: int | None
) -> None:
    where = domain(units, kitchen)
    solver = Solver(["ids.lp"], facts(Problem(where, (where.id_of(node("goal")),), whole=True)))
    reached: list[int] = []
    for bound in range(len(units) + 2):
        if bound > 0:
            solver.ground("step", bound)
        solver.ground("check", bound)
        solver.switch("bound", bound, True)
        if solver.best(None).atoms is not None:
            reached.append(bound)
        solver.switch("bound", bound, False)
    assert reached == ([] if expected is None else list(range(expected, len(units) + 2)))


def test_ids_takes_the_first_unit_that_the_remaining_depth_reaches() -> None:
    """The long way stands first, but only the short one fits into the least depth of the goal."""
    units = ("a -one-> b", "b -two-> c", "c -long-> part", "a -short-> part", "part + b -end-> goal")
    where = domain(units, "a")
    tree = retrieve(where, node("goal"), "ids").tree
    assert tree is not None
    assert tree.depth == 2
    assert motions(where, tree.units) == {"one", "short", "end"}


def test_an_object_that_ids_visits_at_two_depths_is_made_once() -> None:
    """`part` is wanted with one unit of depth left by the goal's own unit and with none too many above."""
    units = (
        "a -slow1-> s",
        "s -slow2-> part",
        "a -quick-> part",
        "part -use-> x",
        "x -lift-> y",
        "y + part -end-> goal",
    )
    where = domain(units, "a")
    tree = retrieve(where, node("goal"), "ids").tree
    assert tree is not None
    assert tree.depth == 4
    assert motions(where, tree.units) == {"quick", "use", "lift", "end"}


def test_a_penalty_of_the_users_own_is_minimised() -> None:
    where = domain(("a -fry-> goal", "a -wash-> b", "b -boil-> goal"), "a")
    problem = where.problem([node("goal")])
    text = facts(problem) + 'criterion("frying",9). penalty("frying",U,1) :- use(U), motion(U,"fry").'
    criteria = ["task_tree.lp", "criteria/units.lp"]
    answer = Solver(criteria, text + 'criterion("units",0).').best(None)
    assert answer.proven
    assert answer.costs == (0, 2)
