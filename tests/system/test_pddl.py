"""PDDL exports read by others, and the plans of planners."""

from __future__ import annotations

from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from unified_planning.plans import TimeTriggeredPlan
from unified_planning.shortcuts import OneshotPlanner, PlanValidator

from foon_asp.errors import QueryError
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.node import UnitId
from foon_asp.planning.pddl.styles import STYLES, document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.unified import from_unified_plan, to_partial_order, to_sequential_plan, unified
from foon_asp.planning.plan import Plan
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from support import small_foons
from support.pddl_by_others import before_pairs, check_readers, up_reading
from support.pddl_exports import counted, exported, soup, whole_task

# The translator of Fast Downward leaves its files open; the others warn of what is theirs alone.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")


# Reading back


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("durative", [False, True])
@pytest.mark.parametrize("criterion", [None, "2*units+tools+motions"])
@pytest.mark.parametrize("semantics", SEMANTICS)
def test_what_is_read_is_the_same_problem(
    style: str, durative: bool, criterion: str | None, semantics: str
) -> None:
    written = exported(soup(), [small_foons.node("soup")], semantics, criterion, style, durative)
    read = up_reading(written)
    assert read == unified(written).problem
    assert read.name == written.problem_name


# Slices


def test_a_goal_at_hand_needs_no_action(tmp_path: Path) -> None:
    where = small_foons.world(["a -mix-> b"], "a")
    for style in STYLES:
        written = exported(where, [small_foons.node("a")], style=style, criterion="units")
        assert written.actions == ()
        check_readers(written, tmp_path)


# Plans there and back


@pytest.mark.parametrize("style", STYLES)
def test_plans_there_and_back(style: str) -> None:
    where = soup()
    effects = Effects(where, "consume")
    problem = Problem.of(where, [small_foons.node("soup")])
    written = document(planning_task(problem, effects, Criterion.parse("units+tools")), style)
    target = unified(written)
    plan = Plan.of(effects, problem.goals, map(UnitId, [0, 1, 2, 3, 0, 1, 2]))
    assert plan.executable
    sequential = to_sequential_plan(plan, target, effects)
    partial = to_partial_order(plan, target, effects)
    names = [instance.action.name for instance in sequential.actions]
    assert len(names) == 7 + 2 + 3, "seven units, two fees, two onions and a bowl taken out"
    assert is_valid(target.problem, sequential)
    for found in (sequential, partial):
        back = from_unified_plan(found, written.task.names, effects, problem.goals)
        assert back.executable
        assert sorted(back.units) == sorted(plan.units)
    for order in islice(partial.all_sequential_plans(), 12):
        assert is_valid(target.problem, order)
    timed = TimeTriggeredPlan([(place, instance, None) for place, instance in enumerate(sequential.actions)])
    assert from_unified_plan(timed, written.task.names, effects, problem.goals).units == plan.units


def is_valid(problem: Any, plan: Any) -> bool:
    with PlanValidator(name="sequential_plan_validator") as validator:
        return bool(validator.validate(problem, plan))


def test_what_is_needed_and_later_taken_away_is_ordered() -> None:
    where = small_foons.world(
        ["clay -form-> bowl[empty]", "bowl[empty] -name-> map", "bowl[empty] -smash-> bowl[broken]"], "clay"
    )
    effects = Effects(where, "transform")
    target = unified(document(whole_task(where, effects)))
    partial = to_partial_order(Plan.of(effects, (), map(UnitId, [0, 1, 2])), target, effects)
    assert (1, 2) in before_pairs(partial, target.document.task.names.units)


def test_plans_of_another_export() -> None:
    where = soup()
    effects = Effects(where, "consume")
    target = unified(exported(where, [small_foons.node("onion[chopped]")]))
    plan = Plan.of(effects, (), map(UnitId, [0, 1]))
    with pytest.raises(QueryError, match="step 2 of the plan"):
        to_sequential_plan(plan, target, effects)


# Invariants would turn the deletion of what need not be there into a conditional effect.
NO_INVARIANTS = {
    "fast_downward_search_config": "astar(lmcut())",
    "fast_downward_translate_options": ["--invariant-generation-max-candidates", "0"],
}


@pytest.mark.parametrize(("engine", "params"), [("fast-downward", NO_INVARIANTS), ("pyperplan-opt", {})])
@pytest.mark.parametrize("style", STYLES)
def test_planners_find_the_plan(engine: str, params: dict[str, Any], style: str) -> None:
    where = soup()
    effects = Effects(where, "consume")
    problem = Problem.of(where, [small_foons.node("soup"), small_foons.node("bowl[empty]")])
    criterion = Criterion.parse("units+2*tools") if engine.startswith("fast") else None
    written = document(planning_task(problem, effects, criterion), style)
    target = unified(written)
    with OneshotPlanner(name=engine, params=params) as planner:
        result = planner.solve(target.problem)
    plan = from_unified_plan(result.plan, written.task.names, effects, problem.goals)
    assert plan.executable
    assert plan.units == (0, 1, 2, 3), "the only bowl is dirty by then"


def test_a_wanted_object_is_taken_out_of_the_kitchen() -> None:
    where = counted(small_foons.world(["a -mix-> b"], "a"), a=2)
    effects = Effects(where, "consume")
    target = unified(exported(where, [small_foons.node(text) for text in ("a", "b")]))
    sequential = to_sequential_plan(Plan.of(effects, (), map(UnitId, [0])), target, effects)
    assert [step.action.name for step in sequential.actions] == ["take-a-ready-2", "mix-0", "take-a-ready-1"]
    assert is_valid(target.problem, sequential)


def test_no_plan_is_an_error() -> None:
    where = soup()
    with pytest.raises(QueryError, match="no plan"):
        from_unified_plan(None, exported(where, []).task.names, Effects(where, "add"), ())
