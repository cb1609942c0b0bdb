"""Numbers beyond 32 bits: what cannot bind is no limit, what cannot be meant is refused."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, Interval
from foon_asp.model.world import World
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.cli import run, run_json
from support.small_foons import node, world

HUGE = "99999999999"


@pytest.mark.parametrize(
    "flags",
    [
        ["--max-units", "2147483648"],
        ["--max-depth", HUGE],
        ["--max-depth", "100000"],
        ["--max-depth", HUGE, "--by", "depth"],
        ["--human-steps", HUGE, "--by", "units"],
        ["--time-limit", "1e10"],
    ],
)
def test_a_limit_that_cannot_bind_is_none(flags: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    free = run_json(capsys, "retrieve", "whipped cream", "--by", "units")
    bound = run_json(capsys, "retrieve", "whipped cream", *flags)
    assert (bound["status"], bound["size"]) == ("optimal", free["size"])


def test_a_human_may_be_allowed_more_steps_than_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "retrieve", "whipped cream", "--human-steps", HUGE)
    assert value["costs"]["success"] == 1
    assert value["constraints"] == [f"at most {HUGE} human steps"]


def test_lines_of_a_batch_have_such_numbers_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    limits = ({"max_depth": 10**11}, {"max_units": 2**31}, {"human_steps": 10**15}, {"max_depth": 10**12})
    lines: list[dict[str, object]] = [{"goal": "ice", "constraints": each} for each in limits]
    lines.append({"goal": "ice", "time_limit": 1e10})
    queries = tmp_path / "queries.jsonl"
    queries.write_text("".join(json.dumps(line) + "\n" for line in lines), "utf-8")
    out = tmp_path / "out.jsonl"
    status, _, err = run(capsys, "batch", "--queries", str(queries), "-o", str(out), "--jobs", "1")
    assert status == 0, err
    assert [json.loads(line)["status"] for line in out.read_text("utf-8").splitlines()] == ["optimal"] * 5


def test_as_much_as_a_kitchen_counts_is_plenty() -> None:
    where = world(["egg -cut-> dish", "egg + dish -mix-> meal"], "egg")
    stock = where.kitchen.objects
    for count in (2, 10**6):
        kitchen = Kitchen(stock, rates=where.kitchen.rates, default_rate=1.0, quantities={node("egg"): count})
        answer = plan(World.of(where.foon, kitchen), PlanQuery(Query(node("meal"))))
        assert (answer.status, len(answer.plan.units if answer.plan else ())) == ("optimal", 2)


def test_quantities_of_many_lines_add_up_to_plenty(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    foon, kitchen = tmp_path / "foon.txt", tmp_path / "kitchen.json"
    foon.write_text("O\ta\nS\tx\nM\tcut\nO\tb\nS\ty\n//\n", "utf-8")
    many = [{"label": "a", "states": ["x"], "quantity": 1_000_000}] * 2200
    kitchen.write_text(json.dumps(many), "utf-8")
    data = ["--foon", str(foon), "--kitchen", str(kitchen)]
    assert run_json(capsys, "plan", "b", *data)["status"] == "optimal"


def timed(*rows: tuple[str, str, str, float]) -> World:
    builder = FoonBuilder()
    for motion, before, behind, seconds in rows:
        inputs, outputs = ([builder.object(node(text))] for text in (before, behind))
        builder.unit(motion, inputs, outputs, Annotation(times=(Interval(3e9, 3e9 + seconds),)))
    return World.of(builder.build(), Kitchen((node("egg"),), default_rate=0.9))


def test_times_are_differences_wherever_in_the_video_they_are() -> None:
    where = timed(("boil", "egg", "dish", 700.0), ("fry", "egg", "dish", 70.0))
    tree = retrieve(where, Query(node("dish"), by="time")).tree
    assert tree is not None
    assert (tree.costs.time, [step.motion for step in tree]) == (70, ["fry"])


@pytest.mark.parametrize("by", ["time", "time+units", "3*time+units"])
def test_sums_beyond_32_bits_are_refused(by: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two of three units make all that is wanted, which takes a search."""
    foon, kitchen = tmp_path / "foon.txt", tmp_path / "kitchen.json"
    pairs = ("b", "c"), ("c", "d"), ("b", "d")
    made = ("".join(f"O\t{name}\nS\ty\n" for name in pair) for pair in pairs)
    units = (f"O\ta\nS\tx\nM\tcut\t0:00\t400000:00:00\n{each}//\n" for each in made)
    foon.write_text("".join(units), "utf-8")
    kitchen.write_text(json.dumps([{"label": "a", "states": ["x"]}]), "utf-8")
    status, out, err = run(
        capsys, "menu", "b", "c", "d", "--by", by, "--foon", f"{foon}", "--kitchen", f"{kitchen}"
    )
    assert (status, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert "2,147,483,644" in err or "can weigh at most" in err


def test_a_plan_of_hours_costs_what_its_steps_cost() -> None:
    where = timed(("boil", "egg", "dish", 7200.0), ("fry", "dish", "meal", 3600.0))
    answer = plan(where, PlanQuery(Query(node("meal"), by="time+success")))
    assert answer.cost == answer.bound == pytest.approx(10800 - 2 * math.log(0.9))


def test_payments_that_add_up_to_more_than_fits_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rules = tmp_path / "rules.lp"
    rules.write_text('criterion("mine",9). penalty("mine",U,2000000000) :- use(U).\n', "utf-8")
    status, out, err = run(capsys, "retrieve", "whipped cream", "--objective", str(rules))
    assert (status, out, len(err.splitlines())) == (2, "", 1)
    assert "adds up to" in err


def test_greedy_compares_the_rates_themselves() -> None:
    rates = {"cut": 0.9996, "fry": 0.99961, "mix": 0.0001, "pour": 0.0004}
    where = world(
        ["egg -cut-> dish", "egg -fry-> dish", "egg -mix-> meal", "egg -pour-> meal"], "egg", rates=rates
    )
    for goal, motion in (("dish", "fry"), ("meal", "pour")):
        for method in ("greedy", "optimal"):
            answer = retrieve(where, Query(node(goal), by="success", method=method))
            assert [step.motion for step in answer] == [motion]
            assert answer.costs is not None
            assert answer.costs.success == rates[motion]
    assert "success 0.9996 " in str(retrieve(where, Query(node("dish"), by="success"))).replace(",", " ")
