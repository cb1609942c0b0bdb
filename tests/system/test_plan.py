"""Planning with consumption: effects, replay, orderings, and plans held against a search by brute force."""

from __future__ import annotations

from dataclasses import replace

import pytest

from foon_asp.errors import QueryError
from foon_asp.model.consumption import SEMANTICS
from foon_asp.model.world import World
from support.plan_worlds import plan, with_quantities
from support.small_foons import motions, node, world

# --- Plans ------------------------------------------------------------------------------------------

TWO_CAKES = (
    "egg -beat-> batter",
    "batter -bake-> cake",
    "batter -fry-> waffle",
    "cake + waffle -serve-> feast",
)


def test_what_is_used_up_is_made_again() -> None:
    where = world(TWO_CAKES, "egg")
    fewest = {semantics: plan(where, node("feast"), semantics) for semantics in SEMANTICS}
    done = {name: len(each.plan.units) if each.plan else None for name, each in fewest.items()}
    assert done == {"add": 4, "transform": 4, "consume": 5}
    assert fewest["add"].steps == 3
    # Batter is made, and used up, and made again.
    assert fewest["consume"].steps == 5


@pytest.mark.parametrize(("eggs", "status"), [(1, "unsolvable"), (2, "optimal")])
def test_what_is_counted_runs_out(eggs: int, status: str) -> None:
    result = plan(with_quantities(TWO_CAKES, "egg", egg=eggs), node("feast"), "consume")
    assert result.status == status
    assert ("too much is used up" in result.reason) == (eggs == 1)


def test_what_is_counted_can_be_made_once_it_ran_out() -> None:
    """The kitchen has one egg, and a hen: its unit matters though the egg is at hand."""
    where = with_quantities([*TWO_CAKES, "hen -lay-> egg + hen"], "egg + hen", egg=1)
    result = plan(where, node("feast"), "consume")
    assert result.plan is not None
    assert motions(where, result.plan.units) == {"beat", "bake", "fry", "serve", "lay"}


def test_a_fee_is_paid_once() -> None:
    units = ("a -cut-> b", "b -cut-> goal", "a -fry-> c", "c -boil-> goal")
    where = world(units, "a")
    result = plan(where, node("goal"), "consume", "motions")
    assert result.plan is not None
    assert motions(where, result.plan.units) == {"cut"}
    assert result.cost == 1


@pytest.mark.parametrize("by", ["cost", "2*cost+0.1*units"])
def test_what_motions_cost_is_paid_each_time(by: str) -> None:
    """As many steps either way: 0.35 for each cut is less than what frying and boiling cost together."""
    units = ("a -cut-> b", "b -cut-> goal", "a -fry-> c", "c -boil-> goal")
    bare = world(units, "a")
    costs = {"cut": 0.35, "fry": 0.1, "boil": 0.601}
    where = World.of(bare.foon, replace(bare.kitchen, costs=costs))
    result = plan(where, node("goal"), "consume", by)
    assert result.plan is not None
    assert motions(where, result.plan.units) == {"cut"}
    assert result.cost == pytest.approx(0.7 if by == "cost" else 1.6)
    with pytest.raises(QueryError, match="nothing says what the motion 'cut' costs"):
        plan(bare, node("goal"), "consume", by)


def test_a_goal_at_hand_takes_no_step() -> None:
    result = plan(world(TWO_CAKES, "cake"), node("cake"))
    assert (result.status, result.steps, result.cost) == ("optimal", 0, 0)
    assert result.plan is not None
    assert result.plan.units == ()


def test_several_goals_must_be_there_together() -> None:
    where = with_quantities(TWO_CAKES, "egg", egg=1)
    assert plan(where, node("cake")).status == plan(where, node("waffle")).status == "optimal"
    assert plan(where, [node("cake"), node("waffle")]).status == "unsolvable"


def test_limits_are_said() -> None:
    where = world(TWO_CAKES, "egg")
    few = plan(where, node("feast"), max_steps=3)
    assert (few.status, few.plan, few.steps) == ("limit", None, 4)
    late = plan(where, node("feast"), time_limit=0)
    assert (late.status, late.plan, late.steps) == ("limit", None, 3)


def test_only_one_level_is_minimised() -> None:
    where = world(TWO_CAKES, "egg")
    with pytest.raises(QueryError, match="one level"):
        plan(where, node("feast"), by="units,inputs")


def test_what_no_unit_makes_is_unreachable_at_once() -> None:
    result = plan(world(TWO_CAKES, ""), node("feast"))
    assert result.status == "unsolvable"
    assert "the kitchen lacks" in result.reason
