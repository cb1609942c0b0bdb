"""Properties that hold of every small FOON: encodings, plain search and brute force agree."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import isclose
from typing import cast

import clingo
import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.asp.encodings import encoding_path
from foon_asp.asp.facts import facts, read_facts
from foon_asp.asp.model import Model
from foon_asp.asp.solver import open_solver
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.reach import reach
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree
from support import brute_force, paper_pseudocode
from support.examples import many
from support.small_foons import domains, node, queries, world

Drawn = tuple[World, ObjectNode]


def own_costs(world: World, goal: ObjectNode, tree: TaskTree) -> brute_force.Costs:
    """Return what brute force says that a tree costs; it must be one."""
    assert brute_force.replays(world, goal, tree.units)
    found = brute_force.costs(world, goal, tree.units)
    assert found is not None
    return found


def same(name: str, one: brute_force.Costs, other: brute_force.Costs) -> bool:
    """Compare by a criterion; chances only as exactly as their rounded logarithms are."""
    return one[name] == other[name] or (
        name == "success" and isclose(float(one[name]), float(other[name]), rel_tol=1e-4)
    )


@many(150)
@given(domains())
def test_units_lp_reads_units_as_the_plain_reading_and_the_definition_do(world: World) -> None:
    constants: dict[str, str | int] = {"strict": int(world.strict)}
    text = facts(Problem(world, (), whole=True)) + "#show needs/2. #show makes/2."
    answer = open_solver(["units.lp"], text, constants).best()
    pairs = [(name, cast(tuple[UnitId, ObjectId], arguments)) for name, arguments in answer.atoms or ()]
    for unit in world.foon.units:
        needs, makes = (
            {thing for each, (number, thing) in pairs if each == name and number == unit.id}
            for name in ("needs", "makes")
        )
        assert needs == set(world.units.needs[unit.id])
        assert makes == set(world.units.makes[unit.id])
        assert {world.node(thing) for thing in needs} == brute_force.needs(world, unit)
        assert {world.node(thing) for thing in makes} == brute_force.makes(world, unit)


@many(150)
@given(domains())
def test_reachability_is_the_plain_closure(world: World) -> None:
    available, executable = reach(world)
    at_hand, done = brute_force.closure(world, brute_force.every_unit(world))
    assert set(available) == world.closure.available.keys()
    assert set(executable) == world.closure.executable.keys()
    assert dict(world.closure.executable) == done
    rounds = {world.node(thing): turn for thing, turn in world.closure.available.items()}
    assert rounds == at_hand


@many(150)
@given(queries(), st.booleans(), st.booleans())
def test_fewer_facts_have_the_same_stable_models(query: Drawn, founded: bool, success: bool) -> None:
    """The trees, and what each pays, are the same whether clingo reads the units or is told the readings."""
    world, goal = query
    problem = Problem.of(world, [goal], founded=founded)
    criteria = ["units", "depth", *(["success"] if success else [])]
    asked = "".join(f'criterion("{name}",{place}).' for place, name in enumerate(criteria))
    constants = {"founded": int(founded), "strict": int(world.strict), "horizon": len(world.foon.units)}
    given_all, given_less = (
        stable_models(criteria, constants, text + asked)
        for text in (facts(problem), read_facts(problem, rates=success))
    )
    assert given_all == given_less
    event("some models" if given_all else "none")


def stable_models(criteria: Sequence[str], constants: dict[str, int], text: str) -> set[frozenset[str]]:
    """Return what all stable models say of use/1 and penalty/3."""
    given_constants = [part for name, value in constants.items() for part in ("-c", f"{name}={value}")]
    control = clingo.Control(["0", "--opt-mode=ignore", "--warn=no-file-included", *given_constants])
    for name in ("retrieval/task_tree.lp", *(f"criteria/{name}.lp" for name in criteria)):
        control.load(str(encoding_path(name)))
    control.add("base", [], text + "#show penalty/3.")
    control.ground([("base", [])])
    found: set[frozenset[str]] = set()
    control.solve(on_model=lambda model: found.add(frozenset(map(str, model.symbols(shown=True)))))
    return found


def solve_optimally(problem: Problem, by: Sequence[str]) -> Model:
    asked = "".join(f'criterion("{name}",{-place}).' for place, name in enumerate(by))
    constants: dict[str, str | int] = {
        "founded": int(problem.founded),
        "strict": int(problem.world.strict),
        "horizon": len(problem.world.foon.units),
    }
    encodings = ["retrieval/task_tree.lp", *(f"criteria/{name}.lp" for name in by)]
    if "depth" not in by:
        del constants["horizon"]
    return open_solver(encodings, facts(problem) + asked, constants).best()


@pytest.mark.parametrize(
    ("founded", "by"),
    [
        (True, ("units",)),
        (True, ("success", "inputs")),
        (True, ("depth", "units")),
        (False, ("units",)),
        (False, ("inputs", "success")),
    ],
)
@many(60)
@given(query=queries())
def test_slicing_does_not_change_the_optimum(founded: bool, by: tuple[str, ...], query: Drawn) -> None:
    world, goal = query
    goals = (world.id_of(goal),)
    whole, sliced = (
        solve_optimally(Problem(world, goals, founded=founded, whole=whole), by) for whole in (True, False)
    )
    assert (whole.atoms is None) == (sliced.atoms is None)
    assert whole.proven
    assert sliced.proven
    if whole.atoms is None or sliced.atoms is None:
        return
    one, other = (list(map(UnitId, answer.column("use"))) for answer in (whole, sliced))
    # A tree in a circle has no depth, so it is not asked for one.
    costs = partial(brute_force.costs, world, goal) if founded else partial(brute_force.sums, world)
    paid, paid_in_slice = costs(one), costs(other)
    assert paid is not None
    assert paid_in_slice is not None
    assert all(same(name, paid, paid_in_slice) for name in by)


LEXICOGRAPHIC = [
    ("units",),
    ("success",),
    ("inputs",),
    ("depth",),
    ("units", "success"),
    ("success", "units"),
    ("inputs", "depth"),
    ("depth", "inputs"),
    ("units", "depth"),
    ("success", "depth", "inputs"),
    ("depth", "units", "inputs", "success"),
    ("inputs", "success", "units", "depth"),
]


@pytest.mark.parametrize("by", LEXICOGRAPHIC, ids=",".join)
@many(60)
@given(query=queries())
def test_the_optimum_is_that_of_brute_force(by: tuple[str, ...], query: Drawn) -> None:
    world, goal = query
    result = retrieve(world, Query(goal, method="optimal", by=by))
    trees = brute_force.trees(world, goal)
    if not trees:
        assert result.status == "unreachable"
        assert result.tree is None
        assert result.reason
        return
    assert result.status == "optimal"
    assert result.tree is not None
    found = own_costs(world, goal, result.tree)
    # What is left open by the criteria goes to the fewest units.
    criteria = (*by, "units")
    expected = brute_force.best(trees, criteria)
    event(f"{expected['units']} units")
    for name in criteria:
        assert same(name, found, expected), (name, found, expected)


@pytest.mark.parametrize("by", LEXICOGRAPHIC, ids=",".join)
@many(30)
@given(query=queries(), milliseconds=st.integers(0, 8))
def test_a_time_limit_never_makes_a_claim_false(by: tuple[str, ...], query: Drawn, milliseconds: int) -> None:
    world, goal = query
    result = retrieve(world, Query(goal, method="optimal", by=by, time_limit=milliseconds / 1000))
    trees = brute_force.trees(world, goal)
    event(result.status)
    assert (result.status == "unreachable") == (not trees)
    if result.tree is None:
        return
    found = own_costs(world, goal, result.tree)
    if result.status == "optimal":
        expected = brute_force.best(trees, by)
        assert all(same(name, found, expected) for name in by)
    else:
        assert result.status == "limit"
        assert bounds_hold(result, trees)


def bounds_hold(result: Answer, trees: Sequence[brute_force.Costs], tolerance: float = 1e-4) -> bool:
    """Say whether no tree beats a bound, of those that are best by the criteria before it."""
    left = list(trees)
    for name in result.by:
        best = brute_force.best(left, (name,))
        if name in result.bound:
            bound, reached = result.bound[name], float(best[name])
            if bound < reached * (1 - tolerance) if name == "success" else bound > reached:
                return False
        left = [tree for tree in left if tree[name] == best[name]]
    return True


WIDE_OR_DEEP = (
    "a -s1-> p",
    "a -s2-> q",
    "a -s3-> r",
    "p + q + r -join-> goal",
    "a -l1-> u",
    "u -l2-> v",
    "v -l3-> goal",
)
SHORT_OR_SURE = ("a -s1-> goal", "a -l1-> u", "u -l2-> goal")
SURE = dict.fromkeys(("s1", "s2", "s3", "join", "l1", "l2", "l3"), 1.0)


@pytest.mark.parametrize(
    ("units", "rates", "by"),
    [
        (SHORT_OR_SURE, {**SURE, "s1": 0.5}, ("success", "depth")),
        (WIDE_OR_DEEP, SURE, ("success", "inputs")),
        (WIDE_OR_DEEP, SURE, ("units", "depth")),
        (WIDE_OR_DEEP, SURE, ("depth", "units")),
    ],
)
def test_nothing_false_is_claimed_wherever_the_time_runs_out(
    units: tuple[str, ...], rates: dict[str, float], by: tuple[str, ...]
) -> None:
    """The time runs out at another point of the search in each of many tries."""
    where, goal = world(units, "a", rates=rates), node("goal")
    trees = brute_force.trees(where, goal)
    expected = brute_force.best(trees, by)
    for attempt in range(150):
        result = retrieve(where, Query(goal, method="optimal", by=by, time_limit=attempt * 6e-5))
        assert result.tree is not None
        found = own_costs(where, goal, result.tree)
        assert result.status == "limit" or all(same(name, found, expected) for name in by)
        assert bounds_hold(result, trees, 6e-6), result.bound


@many(60)
@given(queries(rates=(0.0, 0.5, 0.001)))
def test_the_most_likely_tree_is_found_though_some_motions_never_succeed(query: Drawn) -> None:
    world, goal = query
    result = retrieve(world, Query(goal, method="optimal", by=("success",)))
    trees = brute_force.trees(world, goal)
    assert result.status == ("optimal" if trees else "unreachable")
    if result.tree is not None:
        expected = brute_force.best(trees, ("success",))
        assert same("success", own_costs(world, goal, result.tree), expected)


METHODS = [
    ("first", ()),
    ("ids", ()),
    ("greedy", ("success",)),
    ("greedy", ("inputs",)),
    ("optimal", ("units",)),
]


@pytest.mark.parametrize(("method", "by"), METHODS, ids=lambda part: part if part else "-")
@many(60)
@given(query=queries())
def test_every_founded_tree_replays_and_knows_its_costs(
    method: str, by: tuple[str, ...], query: Drawn
) -> None:
    world, goal = query
    result = retrieve(world, Query(goal, method=method, by=by))
    at_hand, _ = brute_force.closure(world, brute_force.every_unit(world))
    if goal not in at_hand:
        assert result.status == "unreachable"
        assert result.tree is None
        return
    assert result.status == ("optimal" if method == "optimal" else "found")
    assert result.tree is not None
    assert result.tree.executable
    said, found = result.tree.costs, own_costs(world, goal, result.tree)
    assert (said.units, said.inputs, said.depth) == (found["units"], found["inputs"], found["depth"])
    assert said.success is not None
    assert isclose(said.success, float(found["success"]))


@many(100)
@given(queries())
def test_ids_stops_at_the_least_depth(query: Drawn) -> None:
    world, goal = query
    tree = retrieve(world, Query(goal, method="ids")).tree
    trees = brute_force.trees(world, goal)
    assert (tree is None) == (not trees)
    if tree is not None:
        assert tree.depth == own_costs(world, goal, tree)["depth"] == min(each["depth"] for each in trees)


@pytest.mark.parametrize("heuristic", ["first", "success", "inputs"])
@many(150)
@given(query=queries(strict=False))
def test_without_foundedness_the_units_are_those_of_the_published_program(
    heuristic: str, query: Drawn
) -> None:
    world, goal = query
    method, by = ("first", ()) if heuristic == "first" else ("greedy", (heuristic,))
    result = retrieve(world, Query(goal, method=method, by=by, founded=False))
    expected = paper_pseudocode.retrieve(world, goal, heuristic)
    event(f"{len(expected)} units")
    if result.tree is None:
        assert result.status == "unreachable"
        assert not expected
        return
    assert result.status == "found"
    assert set(result.tree.units) == set(expected)
    assert len(expected) == len(set(expected))
