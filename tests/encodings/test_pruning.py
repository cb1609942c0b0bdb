"""plan_pruning.lp leaves out plans, but never all of the best ones."""

from __future__ import annotations

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.asp.facts import facts, price_facts
from foon_asp.asp.solver import open_solver
from foon_asp.model.node import ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from support import brute_force
from support.examples import many
from support.small_foons import node, queries, world

MOST = 4
"""How many steps are tried."""


def best(
    encoding: str, where: World, goal: ObjectId, semantics: str, costs: list[int], counts: list[int]
) -> tuple[int, int] | None:
    """Return the fewest steps of a plan, and what the cheapest plan of so many costs; none within `MOST`.

    `costs` are the prices of units, `counts` how many of each thing the kitchen holds; 0 is plenty.
    """
    units = brute_force.every_unit(where)
    per_unit = {unit: costs[unit % len(costs)] for unit in units}
    prices = price_facts(per_unit, {"bowl": 2}, {unit: ["bowl"] for unit in units if unit % 2})
    stock = zip(sorted(where.stock), counts * len(where.stock), strict=False)
    prices += "".join(f"quantity({thing},{count})." for thing, count in stock if count)
    constants: dict[str, str | int] = {"semantics": semantics, "strict": int(where.strict)}
    control = open_solver([encoding], facts(Problem(where, (goal,), whole=True)) + prices, constants)
    for steps in range(MOST + 1):
        if steps > 0:
            control.ground("step", steps)
        control.ground("check", steps)
        control.switch("last", steps, True)
        if control.best().atoms is not None:
            control.ground("cheapest", steps)
            answer = control.best()
            assert answer.proven
            return steps, dict(zip(answer.priorities, answer.costs, strict=True)).get(2, 0)
        control.switch("last", steps, False)
    return None


@given(
    queries(),
    st.sampled_from(["add", "transform", "consume"]),
    st.lists(st.integers(0, 3), min_size=1, max_size=3),
    st.lists(st.integers(0, 2), min_size=1, max_size=3),
)
@many(150)
def test_pruning_loses_no_fewest_steps_and_no_cheapest_cost(
    asked: tuple[World, ObjectNode], semantics: str, costs: list[int], counts: list[int]
) -> None:
    where, goal = asked[0], asked[0].id_of(asked[1])
    whole = best("planning/plan.lp", where, goal, semantics, costs, counts)
    assert best("planning/plan_pruning.lp", where, goal, semantics, costs, counts) == whole
    event(f"steps: {whole and whole[0]}")


@pytest.mark.parametrize("encoding", ["planning/plan.lp", "planning/plan_pruning.lp"])
def test_a_plan_that_needs_the_same_unit_twice(encoding: str) -> None:
    """The bread takes the dough, so it must be kneaded again for the filling."""
    where = world(["flour -knead-> dough", "dough -bake-> bread", "dough + bread -fill-> pie"], "flour")
    goal = where.id_of(node("pie"))
    assert best(encoding, where, goal, "consume", [1], [0]) == (4, 4 + 2)
