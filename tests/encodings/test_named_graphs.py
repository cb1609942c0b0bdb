"""What the models of the encodings are on small named graphs, and which units each method takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import clingo
import pytest

from foon_asp.asp.encodings import encoding_path
from foon_asp.asp.facts import facts
from foon_asp.asp.solver import open_solver
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.small_foons import motions, node, world, written

Constants = Mapping[str, str | int]


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
    where = world(case.units, case.kitchen, utensils=case.utensils)
    goals = (where.id_of(node(case.goal)),) if case.goal else ()
    arguments = ["0", *(f"-c{name}={value}" for name, value in case.constants.items())]
    control = clingo.Control(arguments)
    control.load(str(encoding_path(case.encoding)))
    control.add("base", [], facts(Problem(where, goals, whole=True)))
    control.ground([("base", [])])
    found: list[str] = []
    with control.solve(yield_=True) as handle:
        for model in handle:
            atoms = [
                atom
                for atom in model.symbols(atoms=True)
                if atom.name in case.asked.split() and len(atom.arguments) == len(KINDS[atom.name])
            ]
            found.append(" ".join(sorted(name_atom(where, atom) for atom in atoms)))
    return sorted(found)


def name_atom(where: World, atom: clingo.Symbol) -> str:
    arguments = [
        where.foon.units[UnitId(each.number)].motion
        if kind == "U"
        else written(where.node(ObjectId(each.number)))
        for kind, each in zip(KINDS[atom.name], atom.arguments, strict=True)
    ]
    return f"{atom.name}({','.join(arguments)})"


VIEW = ("bowl{onion} + onion@bowl + (spoon) -stir-> onion[stirred]@bowl + (spoon)",)
CIRCLE = ("a -go-> b", "b -back-> a", "b -end-> goal")
TWO_WAYS = ("flour -bake-> bread", "salt -fry-> bread", "bread -toast-> toast")

CASES = (
    Case(
        "an implied view is not needed, a bare output that an input is, too, is not made",
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
        ("a -wash-> (knife)", "(knife) -cut-> b", "spoon[wet] -dry-> (spoon)", "(spoon) -stir-> b"),
        "a + spoon[wet]",
        ("available(a) available(spoon[wet]) executable(dry) executable(wash)",),
        utensils=("knife",),
        asked="available executable",
    ),
    Case(
        "a product without states is made",
        "reachability.lp",
        ("a -blend-> (smoothie)", "(smoothie) -pour-> b"),
        "a",
        ("available((smoothie)) available(a) available(b) executable(blend) executable(pour)",),
        asked="available executable",
    ),
    Case(
        "a founded tree is never a circle",
        "retrieval/task_tree.lp",
        CIRCLE,
        "",
        (),
        goal="goal",
    ),
    Case(
        "without foundedness a circle holds itself up",
        "retrieval/task_tree.lp",
        CIRCLE,
        "",
        ("use(back) use(end) use(go)",),
        goal="goal",
        constants={"founded": 0},
    ),
    Case(
        "a founded tree may use the circle's units from the kitchen",
        "retrieval/task_tree.lp",
        CIRCLE,
        "a",
        ("use(back) use(end) use(go)", "use(end) use(go)"),
        goal="goal",
    ),
    Case(
        "all sets of units that make the goal are trees",
        "retrieval/task_tree.lp",
        TWO_WAYS,
        "flour + salt",
        ("use(bake) use(fry) use(toast)", "use(bake) use(toast)", "use(fry) use(toast)"),
        goal="toast",
    ),
    Case(
        "a founded tree has no gap",
        "retrieval/task_tree.lp",
        ("flour -bake-> bread",),
        "",
        (),
        goal="bread",
    ),
    Case(
        "without foundedness what no unit makes is passed over",
        "retrieval/task_tree.lp",
        ("flour -bake-> bread",),
        "",
        ("use(bake)",),
        goal="bread",
        constants={"founded": 0},
    ),
    Case(
        "a goal that is at hand needs nothing",
        "retrieval/task_tree.lp",
        ("flour -bake-> bread",),
        "bread",
        ("",),
        goal="bread",
    ),
    Case(
        "each selection takes one unit for an object",
        "retrieval/selection.lp",
        TWO_WAYS,
        "flour + salt",
        ("pick(bread,bake) pick(toast,toast)", "pick(bread,fry) pick(toast,toast)"),
        goal="toast",
        asked="pick",
    ),
    Case(
        "a founded selection takes only what hangs on the kitchen",
        "retrieval/selection.lp",
        TWO_WAYS,
        "salt",
        ("pick(bread,fry) pick(toast,toast)",),
        goal="toast",
        asked="pick",
    ),
    Case(
        "an unfounded selection takes what hangs in the air, too",
        "retrieval/selection.lp",
        TWO_WAYS,
        "salt",
        ("pick(bread,bake) pick(toast,toast)", "pick(bread,fry) pick(toast,toast)"),
        goal="toast",
        asked="pick",
        constants={"founded": 0},
    ),
    Case("a founded selection is never a circle", "retrieval/selection.lp", CIRCLE, "", (), goal="goal"),
    Case(
        "an unfounded selection may be a circle",
        "retrieval/selection.lp",
        CIRCLE,
        "",
        ("pick(a,back) pick(b,go) pick(goal,end)",),
        goal="goal",
        asked="pick",
        constants={"founded": 0},
    ),
    Case(
        "one unit may be picked for two objects",
        "retrieval/selection.lp",
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
    where = world(THREE_WAYS, "flour + water + salt + oil", rates=RATES)
    result = retrieve(where, Query(node("toast"), method=method, by=by, founded=founded or method == "ids"))
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
    where = world(units, "snow + salt", rates={"thaw": 0.5})
    tree = retrieve(where, Query(node("drink"), method="greedy", by=(by,), founded=founded)).tree
    assert tree is not None
    assert motions(where, tree.units) == expected
    assert tree.executable == founded


def test_greedy_decides_nearer_to_the_goal_first() -> None:
    units = ("x -good-> goal", "y -fair-> goal", "a -poor-> x", "a -best-> y")
    where = world(units, "a", rates={"good": 0.9, "fair": 0.8, "poor": 0.1, "best": 1.0})
    greedy = retrieve(where, Query(node("goal"), method="greedy", by=("success",))).tree
    optimal = retrieve(where, Query(node("goal"), method="optimal", by=("success",))).tree
    assert greedy is not None
    assert optimal is not None
    assert motions(where, greedy.units) == {"good", "poor"}
    assert motions(where, optimal.units) == {"fair", "best"}


@pytest.mark.parametrize("length", [3, 40])
def test_greedy_counts_levels_as_far_as_they_go(length: int) -> None:
    """The closure takes a short cut that the heuristic does not: its levels go beyond its rounds."""
    chain = [f"a{i} -up{i}-> a{i + 1}" for i in range(length)]
    where = world(
        [*chain, f"a0 + x -jump-> a{length}", "a0 + y -low-> a1"],
        "a0 + x + y",
        rates={"jump": 0.5, "low": 0.6, "up0": 0.7},
    )
    tree = retrieve(where, Query(node(f"a{length}"), method="greedy", by=("success",))).tree
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
    where = world(units, kitchen)
    solver = open_solver(
        ["retrieval/ids.lp"], facts(Problem(where, (where.id_of(node("goal")),), whole=True))
    )
    reached: list[int] = []
    for bound in range(len(units) + 2):
        if bound > 0:
            solver.ground("step", bound)
        solver.ground("check", bound)
        solver.switch("bound", bound, True)
        if solver.best().atoms is not None:
            reached.append(bound)
        solver.switch("bound", bound, False)
    assert reached == ([] if expected is None else list(range(expected, len(units) + 2)))


def test_ids_takes_the_first_unit_that_the_remaining_depth_reaches() -> None:
    """The long way stands first, but only the short one fits into the least depth of the goal."""
    units = ("a -one-> b", "b -two-> c", "c -long-> part", "a -short-> part", "part + b -end-> goal")
    where = world(units, "a")
    tree = retrieve(where, Query(node("goal"), method="ids")).tree
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
    where = world(units, "a")
    tree = retrieve(where, Query(node("goal"), method="ids")).tree
    assert tree is not None
    assert tree.depth == 4
    assert motions(where, tree.units) == {"quick", "use", "lift", "end"}


def test_a_penalty_of_the_users_own_is_minimised() -> None:
    where = world(("a -fry-> goal", "a -wash-> b", "b -boil-> goal"), "a")
    problem = Problem.of(where, [node("goal")])
    text = facts(problem) + 'criterion("frying",9). penalty("frying",U,1) :- use(U), motion(U,"fry").'
    criteria = ["retrieval/task_tree.lp", "criteria/units.lp"]
    answer = open_solver(criteria, text + 'criterion("units",0).').best()
    assert answer.proven
    assert answer.costs == (0, 2)
