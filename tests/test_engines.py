"""Real engines: their optima equal ours, and every way to fail is told apart."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from conftest import ROOT
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator, ValidationError
from small_foons import domain, many, node, queries
from test_cli import run, run_json

from foon_asp.dataset import Dataset
from foon_asp.effects import SEMANTICS, Effects
from foon_asp.engines import ENGINES, Engine, check_by_val, find_engine, find_val, run_engine
from foon_asp.errors import InternalError, QueryError
from foon_asp.graph import ObjectNode
from foon_asp.pddl_document import document
from foon_asp.pddl_task import planning_task
from foon_asp.pddl_text import domain_text, problem_text
from foon_asp.planning import plan
from foon_asp.problem import Domain
from foon_asp.retrieve import retrieve

INSTALLED = [engine.name for engine in ENGINES if engine.installed]


def need(name: str) -> None:
    if name not in INSTALLED:
        pytest.skip(f"the engine {name} is not installed; pip install 'foon-asp[planners]'")


@pytest.mark.parametrize("by", ["units", "success", "2*units+inputs", "units+tools"])
@many(8)
@given(query=queries())
def test_the_optimum_of_fast_downward_is_ours(by: str, query: tuple[Domain, ObjectNode]) -> None:
    need("fast-downward-opt")
    where, goal = query
    if not where.kitchen.utensils:
        by = "units"
    ours = retrieve(where, goal, by=by).tree
    theirs = plan(where, [goal], "fast-downward-opt", "add", by)
    assert (theirs.status == "unsolvable") == (ours is None)
    if ours is not None:
        mine = plan(where, [goal], "clingo", "add", by)
        assert theirs.status == "optimal"
        costs = {"units": ours.costs.units, "success": ours.costs.success}
        costs["2*units+inputs"] = 2 * ours.costs.units + ours.costs.inputs
        costs["units+tools"] = ours.costs.units + ours.costs.tools
        assert theirs.cost == pytest.approx(costs[by], rel=1e-4)
        # The fewest parallel steps come first for clingo.
        assert mine.plan is not None
        assert theirs.plan is not None
        assert mine.plan.makespan <= theirs.plan.makespan


@pytest.mark.parametrize("semantics", SEMANTICS[1:])
@many(10)
@given(query=queries())
def test_no_plan_is_cheaper_than_the_proven_one(semantics: str, query: tuple[Domain, ObjectNode]) -> None:
    need("fast-downward-opt")
    where, goal = query
    theirs = plan(where, [goal], "fast-downward-opt", semantics)
    ours = plan(where, [goal], "clingo", semantics)
    assert theirs.status in ("optimal", "unsolvable")
    assert (theirs.plan is None) == (ours.plan is None)
    if theirs.plan is not None and ours.plan is not None:
        # One is cheapest, the other takes the fewest parallel steps.
        assert len(theirs.plan.units) <= len(ours.plan.units)
        assert ours.plan.makespan <= theirs.plan.makespan


@pytest.mark.parametrize("semantics", SEMANTICS)
@pytest.mark.parametrize("name", ["fast-downward", "pyperplan"])
def test_plans_for_the_built_in_goals_are_found(built_in: Dataset, name: str, semantics: str) -> None:
    need(name)
    where = built_in.domain()
    for goal in built_in.goals[:6]:
        theirs = plan(where, [goal], name, semantics, time_limit=60)
        ours = plan(where, [goal], "clingo", semantics, time_limit=60)
        assert theirs.plan is not None
        assert theirs.plan.executable
        assert ours.plan is not None
        assert ours.plan.makespan <= theirs.plan.makespan


def test_a_unit_may_come_again() -> None:
    where = domain(
        ["onion -chop-> onion[chopped]", "onion[chopped] -fry-> dish", "onion[chopped] + dish -top-> meal"],
        "onion",
    )
    for name in ("clingo", "fast-downward", "pyperplan"):
        if name in INSTALLED:
            answer = plan(where, [node("meal")], name, "consume")
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
            if name in INSTALLED:
                flags = ("--foon", foon, "--kitchen", kitchen, "--default-rate", "1", "--engine", name)
                assert run(capsys, "plan", "plate", *flags, "--semantics", "consume")[0] == status, name
                assert run(capsys, "plan", "plate", *flags, "--semantics", "add")[0] == 0


def test_ways_to_fail_are_told_apart(built_in: Dataset) -> None:
    need("pyperplan")
    where = domain(["egg -boil-> dish", "dish -age-> dish + stone"], "egg")
    assert plan(where, [node("stone")], "pyperplan", "consume").plan is not None
    locked = domain(["stone -melt-> lava", "lava -cool-> stone"], "egg")
    assert plan(locked, [node("lava")], "pyperplan", "add").status in ("unsolvable", "gave up")
    slow = plan(built_in.domain(), [built_in.goals[1]], "pyperplan", "consume", time_limit=0)
    assert slow.status == "limit"
    assert "no plan within 0 s" in slow.reason
    missing = Engine("ghost", "up-ghost", "?", "?", "", "ghost")
    problem = where.problem([node("dish")])
    answer = run_engine(problem, Effects(where, "add"), None, missing)
    assert answer.status == "failed"
    assert "NoRequestedEngine" in answer.message
    with pytest.raises(QueryError, match="unknown engine 'fast-downwards'; closest: fast-downward"):
        find_engine("fast-downwards")


def test_an_engine_that_is_not_installed_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foon_asp.engines.find_spec", lambda _: None)
    with pytest.raises(QueryError, match="pip install up-symk"):
        find_engine("symk")


@given(st.sampled_from(["time:", "(", "(x", "fry", "()"]))
def test_lines_that_are_no_steps_are_refused(text: str) -> None:
    from foon_asp.plan_file import _LINE

    match = _LINE.fullmatch(text)
    assert match is None or not match["words"].split()


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


def test_val_accepts_plans_and_refuses_others() -> None:
    val = find_val()
    if val is None:
        pytest.skip("VAL is not installed")
    where = domain(["egg -boil-> egg[hot]", "egg[hot] -peel-> dish"], "egg")
    task = planning_task(where.problem([node("dish")]), Effects(where, "consume"))
    written = document(task)
    actions = [step.name for step in task.steps if step.unit is not None]
    check_by_val(val, domain_text(written), problem_text(written), actions)
    with pytest.raises(InternalError, match="VAL does not accept"):
        check_by_val(val, domain_text(written), problem_text(written), actions[::-1])


def test_the_engines_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "engines")
    assert status == 0
    assert all(engine.name in out for engine in ENGINES)
    assert next(each["name"] for each in run_json(capsys, "engines")) == "clingo"
