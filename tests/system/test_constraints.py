"""Constraints: every flag equals its spelling as a rule, and the best tree under it is the best there is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from foon_asp.asp.rules import read_rules
from foon_asp.errors import InputError
from foon_asp.io.folder import Dataset
from foon_asp.model.node import UnitId
from foon_asp.model.reachability import backward
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import diverse_trees
from foon_asp.retrieval.retrieve import retrieve
from support.cli import run, run_json
from support.small_foons import motions, node, world

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
    "use unit": (Constraints(use_units=(UnitId(3),)), 'violated("x",3) :- not use(3), unit(3).'),
    "avoid unit": (Constraints(avoid_units=(UnitId(4),)), 'violated("x",4) :- use(4).'),
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
    where = built_in.world()
    if name == "avoid unit":
        first = retrieve(where, Query(built_in.goals[0], method="optimal", by=by)).tree
        assert first is not None
        unit = first.units[0]
        flag, rule = Constraints(avoid_units=(unit,)), f'violated("x",{unit}) :- use({unit}).'
    if name == "use unit":
        # A unit that does not lie on the way is only sliced in for the flag, which knows it.
        flag, rule = Constraints(use_units=(UnitId(0),)), 'violated("x",0) :- not use(0), unit(0).'
    differs = 0
    for goal in built_in.goals[::3]:
        free = retrieve(where, Query(goal, method="optimal", by=by))
        ours = retrieve(where, Query(goal, method="optimal", by=by, constraints=flag))
        theirs = retrieve(where, Query(goal, method="optimal", by=by, constraints=Constraints(rules=(rule,))))
        if name == "use unit" and 0 not in backward(where.units, [where.id_of(goal)], where.stock):
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
    where = built_in.world()
    mine = Constraints(rules=('criterion("mine",9). ' + OBJECTIVES[name],))
    differs = 0
    for goal in built_in.goals[::3]:
        ours = retrieve(where, Query(goal, by=name)).tree
        theirs = retrieve(where, Query(goal, constraints=mine)).tree
        assert (ours is None) == (theirs is None)
        if ours and theirs:
            assert getattr(ours.costs, name) == pytest.approx(getattr(theirs.costs, name))
            differs += getattr(ours.costs, name) != 1
    assert differs


def test_a_depth_equals_its_rule(built_in: Dataset) -> None:
    where = built_in.world()
    for goal in built_in.goals[::3]:
        for depth in (3, 6, 9):
            rule = Constraints(rules=(f'violated("x",{depth}) :- late({depth}).',), max_depth=99)
            ours = retrieve(where, Query(goal, constraints=Constraints(max_depth=depth))).tree
            theirs = retrieve(where, Query(goal, constraints=rule)).tree
            assert (ours is None) == (theirs is None)
            assert ours is None or theirs is None or len(ours.units) == len(theirs.units)


def test_the_rounds_are_those_of_the_whole_tree() -> None:
    units = ["a -chop-> dish", "b -wash-> c", "c -peel-> d", "d -cut-> e", "a + e -mash-> dish"]
    where, side = world(units, "a + b"), UnitId(3)
    for most, possible in ((1, False), (2, False), (3, True), (100_000, True)):
        answer = retrieve(where, Query(node("dish"), by="units,depth", use_units=[side], max_depth=most))
        assert (answer.tree is not None) == possible
        assert possible or "use unit 3" in answer.reason or "rounds" in answer.reason
        assert answer.tree is None or (answer.tree.depth, max(answer.tree.rounds)) == (3, 3)
    for objective in ("depth", "depth,units", "units,depth"):
        tree = retrieve(where, Query(node("dish"), by=objective, use_units=[side])).tree
        assert tree is not None
        assert tree.depth == 3
    # The kitchen has the goal, and still a unit is executed.
    tree = retrieve(where, Query(node("b"), by="depth", use_units=[UnitId(0)])).tree
    assert tree is not None
    assert (len(tree), tree.depth) == (1, 1)


def test_a_circle_takes_more_rounds_than_any_limit() -> None:
    where = world(["a + dish -mix-> b", "b -bake-> dish"], "a")
    query = Query(node("dish"), method="greedy", by="inputs", founded=False)
    assert retrieve(where, query).tree is not None
    for most in (1, 2, 3, 1000):
        named = f"at most {most} round{'s' if most > 1 else ''}"
        assert named in retrieve(where, query.replace(max_depth=most)).reason


def test_human_steps_equal_their_rules() -> None:
    units = ["egg -crack-> yolk", "yolk -beat-> foam", "foam -fry-> dish", "egg -boil-> dish"]
    where = world(units, "egg", rates={"crack": 0.9, "beat": 0.5, "fry": 0.8, "boil": 0.41})
    for most, chance in ((0, 0.41), (1, 1.0)):
        rule = f"{{ human(U) }} :- use(U). :- {most + 1} {{ human(U) }}."
        for each in (Constraints(human_steps=most), Constraints(rules=(rule,))):
            tree = retrieve(where, Query(node("dish"), by="success", constraints=each)).tree
            assert tree is not None
            assert tree.costs.success == pytest.approx(chance)
            assert len(tree.human) == most


@pytest.mark.parametrize("method", ["optimal", "greedy", "first"])
def test_no_tree_is_no_tree_however_short_the_time(built_in: Dataset, method: str) -> None:
    impossible = Constraints(avoid_motions=("shake",), max_units=5)
    result = retrieve(
        built_in.world(), Query(built_in.goals[0], method=method, time_limit=0, constraints=impossible)
    )
    assert (result.status, result.tree) == ("unreachable", None)
    assert "avoid motion shake" in result.reason


def test_an_objective_may_lead_deeper_than_the_flattest_tree() -> None:
    where = world(["a -fry-> goal", "a -wash-> b", "b -cut-> c", "c -boil-> goal"], "a")
    for priority, units in ((9, 3), (0, 1)):
        rule = f'criterion("f",{priority}). penalty("f",U,9) :- use(U), motion(U,"fry").'
        result = retrieve(where, Query(node("goal"), by="depth", constraints=Constraints(rules=(rule,))))
        assert result.tree is not None
        assert len(result.tree.units) == units


def test_greedy_and_first_obey_constraints_too() -> None:
    where = world(["a -fry-> goal", "a -wash-> b", "b -boil-> goal"], "a", rates={"fry": 1.0})
    for method in ("first", "greedy"):
        free = retrieve(where, Query(node("goal"), method=method, by="inputs" if method == "greedy" else ()))
        held = retrieve(
            where,
            Query(
                node("goal"),
                method=method,
                by="inputs" if method == "greedy" else (),
                constraints=Constraints(avoid_motions=("fry",)),
            ),
        )
        assert free.tree is not None
        assert held.tree is not None
        assert (len(free.tree.units), len(held.tree.units)) == (1, 2)


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


def test_a_vegan_meal_has_no_animal_in_it(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "ratatouille", "--diet", "vegan")
    text = str(value["units"])
    assert not any(f"'{word}'" in text for word in ("butter", "milk", "egg", "cheese", "chicken"))
    status, out, _ = run(capsys, "retrieve", "omelette", "--diet", "vegan")
    assert status == 1
    assert "one exists without: diet vegan" in out


TWO_WAYS_OUT = ("a -short-> goal", "a -one-> b", "b -two-> c", "c -three-> goal")
"""Without `short` the goal takes three rounds; within one round there is only `short`."""

AIMS = {
    "a criterion": 'criterion("mine",{}). penalty("mine",U,1) :- use(U), motion(U,"short").',
    "a criterion that counts": 'criterion("mine",{}). penalty("mine",U,1) :- use(U), motion(U,"short"). '
    'factor("mine",5). {{ more }}. penalty("mine",more,1) :- more.',
    "a criterion in a body": 'criterion("mine",{}). penalty("mine",U,1) :- use(U), motion(U,"short"). '
    'violated("dear",0) :- #sum {{ V,K : penalty("mine",K,V) }} > 5.',
    "a criterion that nothing pays by": 'criterion("mine",{}). '
    'violated("dear",0) :- #sum {{ V,K : penalty("mine",K,V) }} > 5.',
}
TOP = 2**31 - 1


@pytest.mark.parametrize("priority", [-TOP, -1, 1000, 1001, TOP])
@pytest.mark.parametrize("aim", AIMS)
@pytest.mark.parametrize("limit", ["rounds", "human steps"])
def test_no_priority_of_the_users_own_makes_more_constraints_give_way(
    aim: str, priority: int, limit: str
) -> None:
    """It costs one constraint to take `short`, which the aim would rather not, and two to leave it."""
    where = world(TWO_WAYS_OUT, "a", rates={"short": 1.0, "one": 0.5, "two": 0.5, "three": 0.5})
    rules = (
        AIMS[aim].format(priority),
        'violated("no short",0) :- use(U), motion(U,"short").',
        'violated("no b",0) :- use(U), motion(U,"one").',
        'violated("no c",0) :- use(U), motion(U,"two").',
    )
    if limit == "rounds":
        constraints = Constraints(rules=rules, max_depth=1)
    else:
        constraints = Constraints(rules=rules, human_steps=0)
    result = retrieve(where, Query(node("goal"), constraints=constraints))
    assert result.reason == "the constraints leave no task tree; one exists without: no short"


@pytest.mark.parametrize("priority", [-1, 1001, TOP])
def test_being_unlike_the_others_comes_before_criteria_of_the_users_own(priority: int) -> None:
    """The tree that shares nothing with the best one has more of what the user would rather not have."""
    units = ("a -one-> b", "b -two-> goal", "b -three-> c", "c -four-> goal", "a -fry-> d", "d -fry-> goal")
    where = world(units, "a")
    rules = (f'criterion("mine",{priority}). penalty("mine",U,1) :- use(U), motion(U,"fry").',)
    found = diverse_trees(where, Query(node("goal"), constraints=Constraints(rules=rules)), 2, factor=9)
    assert [motions(where, tree.units) for tree in found.trees] == [{"one", "two"}, {"fry"}]


@pytest.mark.parametrize("constraints", [Constraints(max_depth=3), Constraints(max_depth=3, max_units=3)])
def test_a_limit_of_rounds_costs_nothing(
    constraints: Constraints, capsys: pytest.CaptureFixture[str]
) -> None:
    where = world(TWO_WAYS_OUT, "a")
    result = retrieve(where, Query(node("goal"), constraints=constraints))
    assert result.status == "optimal"
    assert result.own == {}
    status, out, _ = run(capsys, "retrieve", "whipped cream", "--max-depth", "30")
    assert status == 0
    assert "by your rules" not in out


def test_a_rule_may_not_say_that_its_criterion_is_foremost(tmp_path: Path) -> None:
    path = tmp_path / "rules.lp"
    path.write_text('foremost("mine").\npenalty("mine",U,1) :- use(U).', encoding="utf-8")
    with pytest.raises(InputError, match=r":1:1: foremost/1 is not available here"):
        read_rules(path)
