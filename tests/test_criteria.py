"""Criteria: each is what it says, sums are sums, and a human takes over what is likeliest to fail."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import brute_force
import pytest
from hypothesis import event, given
from small_foons import domain, many, node, queries
from test_cli import run, run_json

from foon_asp.builder import FoonBuilder
from foon_asp.compare import compare_human
from foon_asp.constraints import Constraints
from foon_asp.criteria import CRITERIA, Level, parse_by
from foon_asp.dataset import Dataset
from foon_asp.errors import QueryError
from foon_asp.graph import Annotation, ObjectNode
from foon_asp.problem import Domain
from foon_asp.retrieve import retrieve

Query = tuple[Domain, ObjectNode]


def paid(costs: brute_force.Costs, terms: dict[str, float]) -> float:
    """Return a weighted sum, in which success counts as -ln of the chance."""
    return sum(
        weight * (-math.log(costs[name]) if name == "success" else float(costs[name]))
        for name, weight in terms.items()
    )


LISTS: dict[str, list[dict[str, float]]] = {
    "tools": [{"tools": 1}],
    "dirty": [{"dirty": 1}],
    "motions,tools": [{"motions": 1}, {"tools": 1}],
    "2*units+inputs": [{"units": 2, "inputs": 1}],
    "0.5*dirty+3*motions,inputs": [{"dirty": 0.5, "motions": 3}, {"inputs": 1}],
    "success+0.3*units": [{"success": 1, "units": 0.3}],
    "2*success+inputs": [{"success": 2, "inputs": 1}],
    "motions,2*depth+units": [{"motions": 1}, {"depth": 2, "units": 1}],
    "tools+depth": [{"tools": 1, "depth": 1}],
    "inputs,depth": [{"inputs": 1}, {"depth": 1}],
}


@pytest.mark.parametrize("by", LISTS)
@many(100)
@given(query=queries())
def test_the_optimum_is_that_of_trying_every_set_of_units(by: str, query: Query) -> None:
    where, goal = query
    if not where.kitchen.utensils:
        where = Domain(
            where.foon,
            where.kitchen.__class__(where.kitchen.objects, frozenset({"jar"}), where.kitchen.rates),
            strict=where.strict,
        )
    found = brute_force.trees(where, goal)
    result = retrieve(where, goal, by=by)
    event(f"{len(found)} trees" if len(found) < 3 else "many trees")
    if not found:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    best = min([paid(each, terms) for terms in LISTS[by]] for each in found)
    ours = brute_force.costs(where, goal, result.tree.units)
    assert ours is not None
    # Costs of success are rounded to five digits each.
    assert [paid(ours, terms) for terms in LISTS[by]] == pytest.approx(best, abs=1e-3)
    shown = result.tree.costs
    assert {name: getattr(shown, name) for name in ours if name != "success"} == {
        name: value for name, value in ours.items() if name != "success"
    }
    assert shown.success == pytest.approx(float(ours["success"]))


def timed(*seconds: tuple[str, str, str, float | None, float | None]) -> Domain:
    builder = FoonBuilder()
    for motion, before, behind, start, end in seconds:
        builder.unit(
            motion,
            [builder.object(node(before))],
            [builder.object(node(behind))],
            Annotation(start=start, end=end),
        )
    where = domain([], "egg")
    return Domain(builder.build(), where.kitchen)


def test_time_is_the_sum_of_what_the_videos_show() -> None:
    where = timed(
        ("boil", "egg", "egg[hot]", 0.0, 300.0),
        ("fry", "egg", "egg[hot]", 10.0, 70.4),
        ("peel", "egg[hot]", "dish", 300.0, 305.0),
        ("serve", "dish", "meal", None, 400.0),
    )
    fast = retrieve(where, node("meal"), by="time").tree
    assert fast is not None
    assert [unit.motion for unit in fast.steps] == ["fry", "peel", "serve"]
    assert fast.costs.time == 65
    assert retrieve(where, node("meal"), by="time", constraints=Constraints(avoid_motions=("fry",))).tree


def test_criteria_that_the_data_know_nothing_of_are_refused() -> None:
    where = domain(["egg -cut-> dish"], "egg")
    with pytest.raises(QueryError, match="no unit that can matter for this goal has a time"):
        retrieve(where, node("dish"), by="time")
    with pytest.raises(QueryError, match="do not say what is a utensil"):
        retrieve(where, node("dish"), by="units,tools")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("unit", r"no criterion 'unit'; closest: units"),
        ("units,2*units+inputs", r"named twice"),
        ("units+units", r"named twice"),
        ("0*units", r"above 0"),
        ("-1*units", r"write a, or 2\*a\+b"),
        ("1000000*units+0.0001*inputs", r"too far apart"),
        ("units*2", r"write a, or 2\*a\+b"),
    ],
)
def test_sums_that_make_no_sense_are_refused(text: str, message: str) -> None:
    with pytest.raises(QueryError, match=message):
        parse_by(text)


@pytest.mark.parametrize("text", ["units", "2*units+inputs", "success+0.5*units", "depth,tools,human"])
def test_a_list_of_criteria_is_written_as_it_was_read(text: str) -> None:
    assert ",".join(map(str, parse_by(text))) == text


def test_weights_keep_their_ratios() -> None:
    assert Level.parse("0.25*units+2*inputs").weights == {"units": 1, "inputs": 8}
    assert Level.parse("2*success+units").weights == {"success": 1, "units": 50_000}
    assert {name for level in parse_by(",".join(CRITERIA)) for name in level.names} == set(CRITERIA)


def best_with_human(where: Domain, goal: ObjectNode, most: int) -> Fraction | None:
    """Return the highest chance if a human may do so many steps, by trying every tree and every split."""
    chances = []
    for units in brute_force.tree_sets(where, [goal]):
        rates = sorted(
            Fraction(round(where.kitchen.rates[where.foon.units[u].motion] * 1000), 1000) for u in units
        )
        chances.append(math.prod(rates[most:], start=Fraction(1)))
    return max(chances, default=None)


@pytest.mark.parametrize("most", [0, 1, 2, 3])
@many(100)
@given(query=queries())
def test_the_split_between_robot_and_human_is_the_best_one(most: int, query: Query) -> None:
    where, goal = query
    best = best_with_human(where, goal, most)
    result = retrieve(where, goal, constraints=Constraints(human_steps=most))
    assert result.by == ("success",)
    if best is None:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    assert result.tree.costs.success == pytest.approx(float(best), rel=1e-4)
    assert len(result.tree.human) <= most
    assert result.tree.human <= set(result.tree.units)


@many(80)
@given(query=queries())
def test_the_fewest_human_steps_for_a_chance_are_found(query: Query) -> None:
    where, goal = query
    counts = [most for most in range(9) if (best_with_human(where, goal, most) or 0) >= Fraction(4, 5)]
    result = retrieve(where, goal, by="human", constraints=Constraints(min_success=0.8))
    if not counts:
        assert result.status == "unreachable"
        return
    assert result.tree is not None
    assert result.tree.costs.human == counts[0]
    assert (result.tree.costs.success or 0) >= 0.8 - 1e-4


@many(60)
@given(query=queries())
def test_a_chance_and_a_number_of_human_steps_hold_together(query: Query) -> None:
    where, goal = query
    both = Constraints(human_steps=1, min_success=0.7)
    best = best_with_human(where, goal, 1)
    result = retrieve(where, goal, constraints=both)
    assert (result.tree is not None) == (best is not None and best >= Fraction(7, 10))
    if result.tree is None and best is not None:
        assert "at most 1 human step" in result.reason or "success at least 0.7" in result.reason


def test_the_table_of_human_steps_ends_when_nothing_can_fail(built_in: Dataset) -> None:
    where = built_in.domain()
    [table] = compare_human(where, [built_in.goals[0]])
    chances = [tree.costs.success if tree else None for tree, _ in table.trees]
    assert chances == sorted(chances, key=lambda chance: chance or 0)
    assert chances[-1] == 1
    assert all(proven for _, proven in table.trees)
    [short] = compare_human(where, [built_in.goals[0]], most=1)
    assert short.trees == table.trees[:2]


def test_human_steps_are_marked(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "whipped cream", "--human-steps", "2")
    assert [unit["agent"] for unit in value["units"]].count("human") == 2
    assert value["constraints"] == ["at most 2 human steps"]
    assert value["costs"]["human"] == 2
    _, out, _ = run(capsys, "retrieve", "whipped cream", "--human-steps", "2")
    assert out.count("(human)") == 2
    assert run(capsys, "retrieve", "whipped cream", "--method", "greedy", "--human-steps", "2")[0] == 2
    status, out, _ = run(capsys, "compare", "--human", "--human-steps", "3", "whipped cream", "ice")
    assert status == 0
    assert len(out.splitlines()[0].split()) == 5


Values = Callable[[Any], list[Any]]


def test_the_command_line_knows_all_criteria(capsys: pytest.CaptureFixture[str]) -> None:
    for name in CRITERIA:
        status, out, err = run(capsys, "retrieve", "whipped cream", "--by", name)
        assert status == 0 or (name == "time" and "has a time" in err), name
        assert name == "time" or f"optimal by {name}, proven optimal" in out
    status, _, err = run(capsys, "retrieve", "whipped cream", "--by", "unit")
    assert status == 2
    assert "closest: units" in err
