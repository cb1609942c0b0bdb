"""Several answers: lists, fronts and menus are exactly those that trying every set of units gives."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from fractions import Fraction

import brute_force
import pytest
from hypothesis import event, given
from hypothesis import strategies as st
from small_foons import domain, many, node, queries
from test_cli import run, run_json

from foon_asp.alternatives import all_optimal_trees, best_trees, diverse_trees, pareto_trees
from foon_asp.constraints import Constraints
from foon_asp.dataset import Dataset
from foon_asp.errors import QueryError
from foon_asp.graph import ObjectNode
from foon_asp.menu import plan_menu
from foon_asp.problem import Domain
from foon_asp.tree import TaskTree

Query = tuple[Domain, ObjectNode]
Key = tuple[int | Fraction, ...]


def key(costs: brute_force.Costs, by: Sequence[str]) -> Key:
    return tuple(-costs[name] if name == "success" else costs[name] for name in by)


def ranked(where: Domain, goal: ObjectNode, by: Sequence[str]) -> list[tuple[Key, frozenset[int]]]:
    """Return all trees by cost, without those that only add units to one before them."""
    found = brute_force.tree_sets(where, [goal])
    kept: list[tuple[Key, frozenset[int]]] = []
    order = sorted(found, key=lambda units: (key(found[units], (*by, "units")), sorted(units)))
    for units in order:
        if not any(known <= units for _, known in kept):
            kept.append((key(found[units], (*by, "units")), units))
    return kept


def sets(trees: Sequence[TaskTree]) -> list[frozenset[int]]:
    return [frozenset(tree.units) for tree in trees]


@pytest.mark.parametrize("by", [("units",), ("success",), ("depth",), ("inputs", "depth")])
@many(100)
@given(query=queries(), count=st.sampled_from([1, 2, 3, 5, 50]))
def test_the_best_few_are_those_of_trying_every_set(by: tuple[str, ...], query: Query, count: int) -> None:
    where, goal = query
    wanted = ranked(where, goal, by)
    result = best_trees(where, goal, count, ",".join(by))
    event(f"{min(len(wanted), 4)} trees")
    costs = {units: cost for cost, units in wanted}
    found = sets(result.trees)
    assert len(set(found)) == len(found) == min(count, len(wanted))
    # Where equal ones are cut off, any of them will do.
    assert [costs[units] for units in found] == [cost for cost, _ in wanted[:count]]
    if len(wanted) != count:
        assert result.complete == (len(wanted) < count)
    assert (result.status == "unreachable") == (not wanted)


@pytest.mark.parametrize("by", ["units", "success", "depth", "inputs"])
@many(100)
@given(query=queries())
def test_all_optimal_trees_are_found(by: str, query: Query) -> None:
    where, goal = query
    wanted = ranked(where, goal, [by])
    result = all_optimal_trees(where, goal, by)
    assert sets(result.trees) == sorted((units for cost, units in wanted if cost == wanted[0][0]), key=sorted)
    assert result.complete


def front(where: Domain, goal: ObjectNode, by: Sequence[str]) -> set[Key]:
    points = {key(costs, by) for costs in brute_force.trees(where, goal)}
    return {
        point
        for point in points
        if not any(
            other != point and all(map(Fraction.__le__, map(Fraction, other), map(Fraction, point)))
            for other in points
        )
    }


@pytest.mark.parametrize(
    "by",
    [
        ("units", "success"),
        ("inputs", "depth"),
        ("depth", "success"),
        ("units", "inputs", "success"),
        ("motions", "depth", "inputs"),
    ],
)
@many(100)
@given(query=queries())
def test_the_pareto_front_is_that_of_trying_every_set(by: tuple[str, ...], query: Query) -> None:
    where, goal = query
    wanted = front(where, goal, by)
    result = pareto_trees(where, goal, by)
    ours = []
    for tree in result.trees:
        costs = brute_force.costs(where, goal, tree.units)
        assert costs is not None
        ours.append(key(costs, by))
    event(f"{min(len(wanted), 3)} points")
    assert len(ours) == len(set(ours))
    assert set(ours) == wanted
    assert ours == sorted(ours)
    assert result.complete or not wanted


@many(100)
@given(query=queries(), count=st.integers(2, 4), factor=st.sampled_from([1.0, 1.5, 3.0]))
def test_each_diverse_tree_shares_the_fewest_units(query: Query, count: int, factor: float) -> None:
    where, goal = query
    result = diverse_trees(where, goal, count, factor=factor)
    found = sets(result.trees)
    all_sets = list(brute_force.tree_sets(where, [goal]))
    if not all_sets:
        assert result.status == "unreachable"
        return
    least = min(map(len, all_sets))
    assert len(found[0]) == least
    for place in range(1, count):
        left = [
            units
            for units in all_sets
            if len(units) <= int(least * factor) and not any(known <= units for known in found[:place])
        ]
        if not left or not found[0]:
            assert len(found) == place
            return
        keys = {units: (max(len(units & known) for known in found[:place]), len(units)) for units in left}
        assert keys[found[place]] == min(keys.values())


@many(100)
@given(query=queries(), other=st.integers(0, 100), third=st.integers(0, 100))
def test_a_menu_is_the_best_tree_for_all_its_dishes(query: Query, other: int, third: int) -> None:
    where, goal = query
    things = list(where.foon.objects)
    goals = list(dict.fromkeys([goal, things[other % len(things)], things[third % len(things)]]))
    found = brute_force.tree_sets(where, goals)
    menu = plan_menu(where, goals, "inputs")
    if not found:
        assert menu.together.status == "unreachable"
        assert menu.together.reason
        return
    tree = menu.together.tree
    assert tree is not None
    best = min(key(costs, ("inputs", "units")) for costs in found.values())
    assert key(found[frozenset(tree.units)], ("inputs", "units")) == best
    for each in menu.apart:
        assert each.tree is not None
    assert sum(each.tree.costs.units for each in menu.apart if each.tree) >= len(tree.units)
    for dishes in menu.dishes.values():
        assert dishes


def test_what_cannot_be_made_may_be_left_out_of_a_menu() -> None:
    where = domain(["egg -boil-> egg[boiled]", "milk -heat-> milk[hot]", "stone -melt-> lava"], "egg + milk")
    goals = [node("egg[boiled]"), node("lava"), node("milk[hot]")]
    assert plan_menu(where, goals).together.status == "unreachable"
    menu = plan_menu(where, goals, leave_out=True)
    assert menu.together.tree is not None
    assert len(menu.together.tree.units) == 2
    assert [each.goal for each in menu.left_out] == [node("lava")]


def test_constraints_hold_for_several_trees(built_in: Dataset) -> None:
    where = built_in.domain()
    goal = built_in.goals[0]
    quiet = Constraints(avoid_motions=("shake",))
    for result in (
        best_trees(where, goal, 3, constraints=quiet),
        diverse_trees(where, goal, 3, constraints=quiet),
        pareto_trees(where, goal, "units,success", constraints=quiet),
    ):
        assert result.trees
        assert all(unit.motion != "shake" for tree in result.trees for unit in tree.steps)
    none = best_trees(where, goal, 2, constraints=Constraints(max_units=1))
    assert none.status == "unreachable"
    assert "at most 1 units" in none.reason or "at most 1 unit" in none.reason


def test_a_time_limit_is_said(built_in: Dataset) -> None:
    result = best_trees(built_in.domain(), built_in.goals[1], 5, time_limit=0)
    assert result.status == "limit"
    assert not result.complete


def test_questions_that_make_no_sense_are_refused(built_in: Dataset) -> None:
    where, goal = built_in.domain(), built_in.goals[0]
    with pytest.raises(QueryError, match="two criteria or more"):
        pareto_trees(where, goal, "units")
    with pytest.raises(QueryError, match="at least 1"):
        diverse_trees(where, goal, 2, factor=0.5)


@pytest.mark.parametrize(
    "flags",
    [
        ("-k", "2", "--method", "greedy"),
        ("--pareto", "units,depth", "--by", "units"),
        ("-k", "0"),
        ("--diverse", "2", "--all-optimal"),
        ("-k", "2", "--format", "foon"),
        ("--pareto", ""),
    ],
)
def test_flags_that_do_not_go_together_are_exit_2(
    capsys: pytest.CaptureFixture[str], flags: tuple[str, ...]
) -> None:
    try:
        status, _, err = run(capsys, "retrieve", "whipped cream", *flags)
    except SystemExit as error:
        status, err = int(error.code or 0), capsys.readouterr().err
    assert status == 2
    assert err.count("\n") == 1


def test_several_trees_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "whipped cream", "-k", "2")
    assert [tree["size"] for tree in value["trees"]] == sorted(tree["size"] for tree in value["trees"])
    assert value["kind"] == "best"
    _, out, _ = run(capsys, "retrieve", "whipped cream", "--pareto", "units,success")
    assert "nothing beats by units,success" in out
    assert "there are no others" in out
    status, out, _ = run(capsys, "menu", "greek salad", "hummus")
    assert status == 0
    assert "sharing saves 1 step" in out
    menu = run_json(capsys, "menu", "whipped cream", "hummus")
    assert menu["together"]["size"] <= sum(each["costs"]["units"] for each in menu["apart"])
    assert run(capsys, "menu")[0] == 2


def test_the_universal_menu_is_proven(universal: Dataset, universal_domain: Domain) -> None:
    menu = plan_menu(universal_domain, universal.goals, leave_out=True)
    assert menu.together.status == "optimal"
    assert len(menu.left_out) == 2
    assert menu.together.tree is not None
    assert len(menu.together.tree.units) < sum(len(each.tree.units) for each in menu.apart if each.tree)
    assert all(map(bool, menu.dishes.values()))
    assert list(itertools.chain.from_iterable(menu.dishes.values()))
