"""Each fault is found where it is, and only there."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.audit.audit import Audit, audit
from foon_asp.io.findings import Severity
from foon_asp.io.folder import Dataset
from foon_asp.io.text import TextReader
from foon_asp.limits import Limit
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectNode, State
from foon_asp.render.audit import audit_text
from support.cli import run_json


def read(text: str) -> Foon:
    builder = FoonBuilder()
    TextReader(builder).read(text, "x.txt")
    return builder.build()


def unit(inputs: str, motion: str, outputs: str) -> str:
    """Write a unit from objects like `bowl/contains {a}/hot + knife`."""

    def block(side: str) -> str:
        lines = []
        for thing in side.split(" + "):
            label, *states = thing.split("/")
            lines.append(f"O\t{label}\n")
            lines += ["S\t" + state.replace(" {", "\t{").replace(" [", "\t[") + "\n" for state in states]
        return "".join(lines)

    return f"{block(inputs)}M\t{motion}\n{block(outputs)}//\n"


def codes(report: Audit) -> set[str]:
    return {finding.code for finding in report.findings}


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (unit("a/raw", "look", "a/raw"), "does-nothing"),
        (unit("a/raw + b/x", "cut", "a/raw + b/y"), "output-is-input"),
        (unit("a/raw", "fill", "cup/empty/contains {a}"), "empty-but-contains"),
        (unit("a/raw", "put", "a/in [a]"), "holds-itself"),
        (unit("a/raw", "put", "a/contains {a}"), "holds-itself"),
        (unit("a/raw + cup/empty", "put", "a/in [cup] + cup/contains {b}"), "not-in-container"),
        (unit("a/raw + cup/empty", "put", "a/in [cup] + cup/empty"), "not-in-container"),
        (unit("cup/contains {a}", "wait", "cup/contains {a,b}"), "content-appears"),
        (unit("cup/contains {a,b}", "wait", "cup/contains {a}"), "content-vanishes"),
        (unit("a/raw", "put", "a/in [kup]"), "unknown-label"),
        (unit("a/raw", "cut", "a/cut"), "nowhere-from"),
        (unit("a/raw", "cut", "a/cut"), "never-runs"),
        (unit("a/raw", "slise", "a/cut"), "motion-without-rate"),
    ],
)
def test_each_fault_is_found(text: str, code: str) -> None:
    kitchen = Kitchen((ObjectNode("water"),), rates={"slice": 0.5})
    assert code in codes(audit(read(text), kitchen))


@pytest.mark.parametrize(
    "text",
    [
        unit("a/raw + cup/empty", "put", "a/in [cup] + cup/contains {a}"),
        unit("cup/contains {a} + b/in [spoon] + spoon/contains {b}", "add", "cup/contains {a,b}"),
        unit("cup/contains {a,b} + jar/empty", "pour", "cup/contains {a} + jar/contains {b} + b/raw"),
        unit("cup/contains {a,b} + c/x", "mix", "cup/contains {c}"),
    ],
)
def test_sound_units_have_no_fault(text: str) -> None:
    report = audit(read(text))
    assert [f for f in report.findings if f.severity > Severity.NOTE and f.code != "unknown-label"] == []


def test_times_that_overlap_or_run_backwards() -> None:
    text = "".join(
        unit(f"a/s{n}", f"cut\t{start}\t{end}", f"a/s{n + 1}")
        for n, (start, end) in enumerate([("0:10", "0:20"), ("0:15", "0:30"), ("0:05", "0:06")])
    )
    found = [(f.code, f.line) for f in audit(read(text)).findings if f.code.startswith("times")]
    assert found == [("times-overlap", 7), ("times-out-of-order", 13)]


def test_a_circle_of_two_units_is_named_whole() -> None:
    text = unit("a/1", "x", "b/1") + unit("b/1", "y", "a/1") + unit("a/1", "z", "c/1")
    report = audit(read(text), Kitchen((ObjectNode("k"),)))
    [lock] = report.locks
    assert {each.id for each in lock.circle} == {0, 1}
    assert len(lock.opens) == 3
    assert [str(node) for node in lock.unlocks] == ["c [1]"]


def test_an_empty_kitchen_is_one_where_nothing_is_at_hand(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "foon.txt").write_text(unit("a/raw", "cut", "a/cut") + unit("a/cut", "fry", "a/fried"))
    (tmp_path / "goal_nodes.json").write_text('[{"label": "a", "states": ["fried"]}]')
    locked = {"never-runs", "nowhere-from", "locked", "goal-locked"}
    for kitchen, found in ((None, set()), ("[]", locked), ('[{"label": "a", "states": ["raw"]}]', set())):
        if kitchen is not None:
            (tmp_path / "kitchen.json").write_text(kitchen)
        report = run_json(capsys, "audit", str(tmp_path / "foon.txt"))
        assert {each["code"] for each in report["findings"]} & locked == found
        assert bool(report["locks"]) == bool(report["locked_goals"]) == bool(found)


def test_what_was_probably_meant_is_proposed() -> None:
    text = unit("p/contains {y} + bowl/contains {x,y}", "pour", "bowl/contains {x,y}")
    text += unit("bowl/contains {x,y}", "stir", "dish/ready")
    kitchen = Kitchen(tuple(read(unit("p/contains {y}", "m", "bowl/contains {x}")).objects))
    [lock] = audit(read(text + unit("bowl/contains {x}", "see", "bowl/seen")), kitchen).locks
    assert str(lock.replacement) == "bowl {x}"


def test_built_in_data_has_no_error_and_no_warning(built_in: Dataset) -> None:
    report = audit(built_in.foon, built_in.kitchen, built_in.goals, built_in.findings)
    assert [str(f) for f in report.findings if f.severity > Severity.NOTE] == []


def test_at_a_limit_there_is_what_was_found_before() -> None:
    text = unit("a/raw", "cut", "a/cut") + unit("a/raw", "put", "a/in [a]")
    goal = ObjectNode("a", (State("cut"),))
    whole = audit(read(text), Kitchen(()), [goal])
    assert whole.limit is None
    assert [each.goal for each in whole.locked_goals] == [goal]
    cut = audit(read(text), Kitchen(()), [goal], time_limit=1e-9)
    assert (cut.limit, cut.status.exit_code, cut.locked_goals) == (Limit.TIME, 3, ())
    assert set(cut.findings) < set(whole.findings)
    assert audit_text(cut, Severity.NOTE).endswith("the time ran out: there may be more to find\n")
