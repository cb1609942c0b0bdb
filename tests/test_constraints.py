"""Constraints: every flag equals its spelling as a rule, and the best tree under it is the best there is."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

import brute_force
import pytest
from hypothesis import event, given
from hypothesis import strategies as st
from small_foons import domain, many, node, queries
from test_cli import run, run_json

from foon_asp import resources
from foon_asp.constraints import Constraints
from foon_asp.dataset import Dataset
from foon_asp.errors import InputError, QueryError
from foon_asp.graph import FunctionalUnit, ObjectNode
from foon_asp.problem import Domain
from foon_asp.retrieve import check_constraints, retrieve
from foon_asp.rules import read_rules

FLAGS: dict[str, tuple[Constraints, str]] = {
    "without": (
        Constraints(without=("garlic",)),
        'violated("without garlic",U) :- use(U), touches(U,"garlic").',
    ),
    "without tool": (
        Constraints(without_tools=("food processor",)),
        'violated("without tool food processor",U) :- use(U), handles(U,"food processor").',
    ),
    "avoid motion": (
        Constraints(avoid_motions=("pour",)),
        'violated("avoid motion pour",U) :- use(U), motion(U,"pour").',
    ),
    "only motions": (
        Constraints(only_motions=("pour", "add", "close", "shake", "scrape out")),
        'ok("pour";"add";"close";"shake";"scrape out"). violated("x",U) :- use(U), motion(U,M), not ok(M).',
    ),
    "use unit": (Constraints(use_units=(3,)), 'violated("x",3) :- not use(3), unit(3).'),
    "avoid unit": (Constraints(avoid_units=(4,)), 'violated("x",4) :- use(4).'),
    "max units": (Constraints(max_units=12), 'violated("x",0) :- 13 { use(U) }.'),
    "min success": (
        Constraints(min_success=0.2),
        'violated("x",0) :- #sum { C,U : use(U), success_rate(U,R), failure_cost(R,C) } > 160945.',
    ),
    "diet": (
        Constraints(diets=(("d", ("egg", "butter", "unicorn")),)),
        'bad("egg";"butter";"unicorn"). violated("d",U) :- use(U), touches(U,L), bad(L).',
    ),
}


@pytest.mark.parametrize("name", FLAGS)
@pytest.mark.parametrize("by", ["units", "success"])
def test_a_flag_equals_its_rule(built_in: Dataset, name: str, by: str) -> None:
    flag, rule = FLAGS[name]
    where = built_in.domain()
    if name == "avoid unit":
        first = retrieve(where, built_in.goals[0], "optimal", by).tree
        assert first is not None
        unit = first.units[0]
        flag, rule = Constraints(avoid_units=(unit,)), f'violated("x",{unit}) :- use({unit}).'
    if name == "use unit":
        # A unit that does not lie on the way is only sliced in for the flag, which knows it.
        flag, rule = Constraints(use_units=(0,)), 'violated("x",0) :- not use(0), unit(0).'
    differs = 0
    for goal in built_in.goals[::3]:
        free = retrieve(where, goal, "optimal", by)
        ours = retrieve(where, goal, "optimal", by, constraints=flag)
        theirs = retrieve(where, goal, "optimal", by, constraints=Constraints(rules=(rule,)))
        if name == "use unit" and 0 not in where.reading.backward([where.id_of(goal)], where.stock):
            continue
        assert ours.status == theirs.status
        if ours.tree and theirs.tree and free.tree:
            assert ours.tree.costs.units == theirs.tree.costs.units or by == "success"
            assert ours.tree.costs.success == pytest.approx(theirs.tree.costs.success)
        differs += ours.tree is None or ours.tree.units != (free.tree.units if free.tree else ())
    assert differs, "the flag changed nothing, so it was not tested"


OBJECTIVES = {
    "units": 'penalty("mine",U,1) :- use(U).',
    "inputs": 'penalty("mine",(U,O),1) :- use(U), input(U,O).',
    "success": 'penalty("mine",U,C) :- use(U), success_rate(U,R), failure_cost(R,C).',
    "tools": 'penalty("mine",L,1) :- use(U), handles(U,L), utensil(L).',
    "dirty": 'penalty("mine",L,1) :- use(U), lists(U,O), label(O,L), content(O,"contains",_), utensil(L).'
    'penalty("mine",L,1) :- use(U), lists(U,O), relation(O,"in",L), utensil(L).',
    "motions": 'penalty("mine",M,1) :- use(U), motion(U,M).',
}


@pytest.mark.parametrize("name", OBJECTIVES)
def test_a_criterion_equals_its_rules(built_in: Dataset, name: str) -> None:
    where = built_in.domain()
    mine = Constraints(rules=('criterion("mine",9). ' + OBJECTIVES[name],))
    differs = 0
    for goal in built_in.goals[::3]:
        ours = retrieve(where, goal, by=name).tree
        theirs = retrieve(where, goal, constraints=mine).tree
        assert (ours is None) == (theirs is None)
        if ours and theirs:
            assert getattr(ours.costs, name) == pytest.approx(getattr(theirs.costs, name))
            differs += getattr(ours.costs, name) != 1
    assert differs


def test_a_depth_equals_its_rule(built_in: Dataset) -> None:
    where = built_in.domain()
    for goal in built_in.goals[::3]:
        for depth in (3, 6, 9):
            rule = Constraints(rules=(f'violated("x",{depth}) :- late({depth}).',), max_depth=99)
            ours = retrieve(where, goal, constraints=Constraints(max_depth=depth)).tree
            theirs = retrieve(where, goal, constraints=rule).tree
            assert (ours is None) == (theirs is None)
            assert ours is None or theirs is None or len(ours.units) == len(theirs.units)


def test_human_steps_equal_their_rules() -> None:
    units = ["egg -crack-> yolk", "yolk -beat-> foam", "foam -fry-> dish", "egg -boil-> dish"]
    where = domain(units, "egg", rates={"crack": 0.9, "beat": 0.5, "fry": 0.8, "boil": 0.41})
    for most, chance in ((0, 0.41), (1, 1.0)):
        rule = f"{{ human(U) }} :- use(U). #show human/1. :- {most + 1} {{ human(U) }}."
        for each in (Constraints(human_steps=most), Constraints(rules=(rule,))):
            tree = retrieve(where, node("dish"), by="success", constraints=each).tree
            assert tree is not None
            assert tree.costs.success == pytest.approx(chance)
            assert len(tree.human) == most


Check = Callable[[Domain, Collection[int], brute_force.Costs], bool]


def touched(where: Domain, unit: FunctionalUnit) -> set[str]:
    return handled(where, unit) | {c for o in listed(where, unit) for s in o.states for c in s.contents or ()}


def handled(where: Domain, unit: FunctionalUnit) -> set[str]:
    things = listed(where, unit)
    return {o.label for o in things} | {s.relatum for o in things for s in o.states if s.relatum}


def listed(where: Domain, unit: FunctionalUnit) -> list[ObjectNode]:
    return [where.foon.objects[number] for number in (*unit.inputs, *unit.outputs)]


@st.composite
def constrained(draw: st.DrawFn) -> tuple[Domain, ObjectNode, Constraints]:
    where, goal = draw(queries())
    labels = sorted({label for o in where.foon.objects for label in o.named_labels})
    units = range(len(where.foon.units))
    motions = where.foon.motions
    some_labels = st.lists(st.sampled_from(labels), max_size=2, unique=True).map(tuple)
    return (
        where,
        goal,
        Constraints(
            without=draw(st.sampled_from([(), ()]) | some_labels),
            without_tools=draw(st.just(()) | some_labels),
            avoid_motions=draw(
                st.just(()) | st.lists(st.sampled_from(motions), max_size=2, unique=True).map(tuple)
            ),
            only_motions=draw(
                st.none() | st.lists(st.sampled_from(motions), min_size=1, unique=True).map(tuple)
            ),
            use_units=draw(st.just(()) | st.lists(st.sampled_from(list(units)), max_size=1).map(tuple)),
            max_units=draw(st.none() | st.integers(0, 5)),
            max_depth=draw(st.none() | st.integers(0, 4)),
            min_success=draw(st.none() | st.sampled_from([0.05, 0.3, 0.6, 0.9])),
        ),
    )


def allowed(where: Domain, units: Collection[int], costs: brute_force.Costs, c: Constraints) -> bool:
    used = [where.foon.units[number] for number in units]
    return (
        not any(set(c.without) & touched(where, unit) for unit in used)
        and not any(set(c.without_tools) & handled(where, unit) for unit in used)
        and not any(unit.motion in c.avoid_motions for unit in used)
        and (c.only_motions is None or all(unit.motion in c.only_motions for unit in used))
        and set(c.use_units) <= set(units)
        and (c.max_units is None or len(used) <= c.max_units)
        and (c.max_depth is None or costs["depth"] <= c.max_depth)
        and (c.min_success is None or costs["success"] >= c.min_success)
    )


@pytest.mark.parametrize("by", [("units",), ("success",), ("depth", "inputs"), ("inputs", "depth")])
@many(120)
@given(query=constrained())
def test_the_best_tree_under_constraints_is_found(
    by: tuple[str, ...], query: tuple[Domain, ObjectNode, Constraints]
) -> None:
    where, goal, constraints = query
    numbers = range(len(where.foon.units))
    possible = []
    for size in range(len(numbers) + 1):
        for units in itertools.combinations(numbers, size):
            costs = brute_force.costs(where, goal, units)
            if costs is not None and allowed(where, units, costs, constraints):
                possible.append(costs)
    result = retrieve(where, goal, "optimal", by, constraints=constraints)
    event(result.status)
    assert (result.status == "optimal") == bool(possible), result.reason
    if result.tree is not None:
        found = brute_force.costs(where, goal, result.tree.units)
        assert found is not None
        assert allowed(where, result.tree.units, found, constraints)
        best = brute_force.best(possible, by)
        for name in by:
            assert float(found[name]) == pytest.approx(float(best[name]), rel=1e-4)


@many(150)
@given(query=constrained())
def test_the_constraints_that_must_give_way_are_the_fewest(
    query: tuple[Domain, ObjectNode, Constraints],
) -> None:
    where, goal, constraints = query
    result = retrieve(where, goal, constraints=constraints)
    prefix = "the constraints leave no task tree; one exists without: "
    if not result.reason.startswith(prefix):
        return
    named = set(result.reason.removeprefix(prefix).split("; "))
    kept = {name for _, name, _ in constraints.named()}
    assert named <= kept
    assert retrieve(where, goal, constraints=_without(constraints, named)).tree is not None
    for fewer in itertools.combinations(sorted(kept), len(named) - 1):
        assert retrieve(where, goal, constraints=_without(constraints, set(fewer))).tree is None


def _without(constraints: Constraints, names: set[str]) -> Constraints:
    """Drop constraints by name."""

    def keep(pattern: str, items: tuple[object, ...]) -> tuple[object, ...]:
        return tuple(item for item in items if pattern.format(item) not in names)

    def unless(name: str, value: object) -> object:
        return None if name in names else value

    return Constraints(
        without=keep("without {}", constraints.without),  # type: ignore[arg-type]
        without_tools=keep("without tool {}", constraints.without_tools),  # type: ignore[arg-type]
        avoid_motions=keep("avoid motion {}", constraints.avoid_motions),  # type: ignore[arg-type]
        only_motions=unless("only these motions", constraints.only_motions),  # type: ignore[arg-type]
        use_units=keep("use unit {}", constraints.use_units),  # type: ignore[arg-type]
        max_units=unless(f"at most {constraints.max_units} units", constraints.max_units),  # type: ignore[arg-type]
        max_depth=unless(f"at most {constraints.max_depth} rounds", constraints.max_depth),  # type: ignore[arg-type]
        min_success=unless(f"success at least {constraints.min_success}", constraints.min_success),  # type: ignore[arg-type]
    )


@pytest.mark.parametrize("method", ["optimal", "greedy", "first"])
def test_no_tree_is_no_tree_however_short_the_time(built_in: Dataset, method: str) -> None:
    impossible = Constraints(avoid_motions=("shake",), max_units=5)
    result = retrieve(built_in.domain(), built_in.goals[0], method, time_limit=0, constraints=impossible)
    assert (result.status, result.tree) == ("unreachable", None)
    assert "avoid motion shake" in result.reason


def test_an_objective_may_lead_deeper_than_the_flattest_tree() -> None:
    where = domain(["a -fry-> goal", "a -wash-> b", "b -cut-> c", "c -boil-> goal"], "a")
    for priority, units in ((9, 3), (1, 1)):
        rule = f'criterion("f",{priority}). penalty("f",U,9) :- use(U), motion(U,"fry").'
        result = retrieve(where, node("goal"), by="depth", constraints=Constraints(rules=(rule,)))
        assert result.tree is not None
        assert len(result.tree.units) == units


def test_greedy_and_first_obey_constraints_too() -> None:
    where = domain(["a -fry-> goal", "a -wash-> b", "b -boil-> goal"], "a", rates={"fry": 1.0})
    for method in ("first", "greedy"):
        free = retrieve(where, node("goal"), method, "inputs" if method == "greedy" else ())
        held = retrieve(
            where,
            node("goal"),
            method,
            "inputs" if method == "greedy" else (),
            constraints=Constraints(avoid_motions=("fry",)),
        )
        assert free.tree is not None
        assert held.tree is not None
        assert (len(free.tree.units), len(held.tree.units)) == (1, 2)


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
        (Constraints(use_units=(9999,)), "optimal", "there is no unit 9999; ids go from 0 to 661"),
        (Constraints(min_success=0.0), "optimal", "above 0 and at most 1, not 0"),
        (Constraints(max_units=3), "ids", "'ids' takes no constraints"),
    ],
)
def test_constraints_that_make_no_sense_are_errors(
    built_in: Dataset, constraints: Constraints, method: str, message: str
) -> None:
    with pytest.raises(QueryError, match=message):
        check_constraints(built_in.domain(), method, constraints)


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


def test_a_script_may_be_allowed(tmp_path: Path) -> None:
    path = tmp_path / "rules.lp"
    path.write_text("#script (python)\n#end.\n")
    assert "#script" in read_rules(path, allow_script=True)


def test_an_unsafe_rule_is_one_line_and_exit_2(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "rules.lp"
    path.write_text('violated("x",U) :- not use(U).')
    status, _, err = run(capsys, "retrieve", "hummus", "--constraint", path)
    assert status == 2
    assert "unsafe" in err
    assert err.count("\n") == 1


def test_an_objective_of_ones_own_comes_first(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "quiet.lp"
    path.write_text('criterion("shaking",9).\npenalty("shaking",U,1) :- use(U), motion(U,"shake").\n')

    def motions(value: Any) -> list[str]:
        return [unit["motion"] for unit in value["units"]]

    assert "shake" in motions(run_json(capsys, "retrieve", "whipped cream"))
    held = run_json(capsys, "retrieve", "whipped cream", "--objective", path)
    assert "shake" not in motions(held)
    assert held["size"] == 6


def test_flags_of_the_command_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    value = run_json(
        capsys, "retrieve", "whipped cream", "--avoid-motion", "shake", "--without-tool", "whisk"
    )
    assert value["size"] == 7
    status, out, _ = run(capsys, "retrieve", "whipped cream", "--avoid-motion", "shake", "--max-units", "5")
    assert status == 1
    assert "the constraints leave no task tree; one exists without: avoid motion shake" in out
    motions = tmp_path / "motions.txt"
    motions.write_text("pour\nadd\nclose\nshake\nscrape out\n")
    assert run_json(capsys, "retrieve", "whipped cream", "--only-motions", motions)["size"] == 5
    assert run(capsys, "retrieve", "whipped cream", "--max-units", "-1")[0] == 2
    assert run(capsys, "retrieve", "whipped cream", "--diet", "carnivore")[0] == 2


def test_no_diet_names_a_label_twice_or_in_another_spelling(built_in: Dataset) -> None:
    known = {label for o in built_in.foon.objects for label in o.named_labels}
    for name, path in resources.diets().items():
        rows = [row for row in path.read_text().splitlines() if not row.startswith("#")]
        assert rows == sorted(set(rows)), name
        assert len(known & set(rows)) >= 3, name


def test_a_vegan_meal_has_no_animal_in_it(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "ratatouille", "--diet", "vegan")
    text = str(value["units"])
    assert not any(f"'{word}'" in text for word in ("butter", "milk", "egg", "cheese", "chicken"))
    status, out, _ = run(capsys, "retrieve", "omelette", "--diet", "vegan")
    assert status == 1
    assert "one exists without: diet vegan" in out
