"""The audit: every kind of fault is found, and the mends it proposes really help."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from conftest import ROOT
from small_foons import with_units

from foon_asp.audit import Audit, audit
from foon_asp.builder import FoonBuilder
from foon_asp.dataset import Dataset
from foon_asp.findings import Severity
from foon_asp.graph import Foon, ObjectNode
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain
from foon_asp.retrieve import retrieve
from foon_asp.spelling import misspellings
from foon_asp.text import TextReader


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


def test_misspellings_are_rare_words_near_known_or_common_ones() -> None:
    labels = {"glas": 1, "drinking glass": 3, "choocolate": 2, "raman": 9, "batter": 2, "butter": 90}
    labels |= {"flibber": 10, "fliber": 1, "egg": 4, "eggs": 1}
    assert dict(misspellings(labels, {"glass", "chocolate", "ramen", "batter", "butter"})) == {
        "glas": "glass",
        "choocolate": "chocolate",
        "raman": "ramen",
        "fliber": "flibber",
    }


def test_a_circle_of_two_units_is_named_whole() -> None:
    text = unit("a/1", "x", "b/1") + unit("b/1", "y", "a/1") + unit("a/1", "z", "c/1")
    report = audit(read(text), Kitchen((ObjectNode("k"),)))
    [lock] = report.locks
    assert {each.id for each in lock.circle} == {0, 1}
    assert len(lock.opens) == 3
    assert [str(node) for node in lock.unlocks] == ["c [1]"]


def test_what_was_probably_meant_is_proposed() -> None:
    text = unit("p/contains {y} + bowl/contains {x,y}", "pour", "bowl/contains {x,y}")
    text += unit("bowl/contains {x,y}", "stir", "dish/ready")
    kitchen = Kitchen(tuple(read(unit("p/contains {y}", "m", "bowl/contains {x}")).objects))
    [lock] = audit(read(text + unit("bowl/contains {x}", "see", "bowl/seen")), kitchen).locks
    assert str(lock.replacement) == "bowl {x}"


def test_built_in_data_has_no_error_and_no_warning(built_in: Dataset) -> None:
    report = audit(built_in.foon, built_in.kitchen, built_in.goals, built_in.findings)
    assert [str(f) for f in report.findings if f.severity > Severity.NOTE] == []


@pytest.fixture(scope="module")
def universal_audit(universal: Dataset) -> Audit:
    return audit(universal.foon, universal.kitchen, universal.goals, universal.findings)


def test_the_audit_names_what_locks_whipped_cream_and_its_mend_works(
    universal: Dataset, universal_audit: Audit
) -> None:
    goal = universal.goals[0]
    [lock] = [lock for lock in universal_audit.locks if goal in lock.unlocks]
    assert lock.unit.source.line == 4827
    assert lock.circle == (lock.unit,)
    assert len(lock.opens) == 12
    assert str(lock.replacement) == "mixing bowl {condensed milk, cream cheese} in [mixer]"
    result = retrieve(Domain(_edited(universal.foon, lock.unit.id, lock), universal.kitchen), goal)
    assert result.status == "optimal"
    assert result.tree is not None
    assert result.tree.executable


def _edited(foon: Foon, number: int, lock: object) -> Foon:
    """Apply the edit of a lock: one input of one unit becomes another object."""
    need, replacement = lock.need, lock.replacement  # type: ignore[attr-defined]
    units = list(foon.units)
    unit = units[number]
    old, new = foon.id_of(need), foon.id_of(replacement)
    assert old in unit.inputs
    assert new is not None
    units[number] = replace(unit, inputs=tuple(new if i == old else i for i in unit.inputs))
    return with_units(foon, units)


def test_the_audit_lists_the_smallest_set_that_unlocks_fried_rice(
    universal: Dataset, universal_audit: Audit
) -> None:
    [locked] = [each for each in universal_audit.locked_goals if each.goal.label == "fried rice"]
    assert locked.missing is not None
    assert [str(node) for node in locked.missing] == [
        "bottle {water}",
        "packet {carrot, corn, green pea}",
    ]
    assert not any("fried rice" in str(node) for node in locked.missing)
    kitchen = replace(universal.kitchen, objects=universal.kitchen.objects + locked.missing)
    result = retrieve(Domain(universal.foon, kitchen), locked.goal)
    assert result.tree is not None
    assert result.tree.executable
    for one in locked.missing:
        kitchen = replace(universal.kitchen, objects=(*universal.kitchen.objects, one))
        assert retrieve(Domain(universal.foon, kitchen), locked.goal).status == "unreachable"


def test_locks_account_for_every_unit_that_never_runs(universal: Dataset, universal_audit: Audit) -> None:
    opened = [unit.id for lock in universal_audit.locks for unit in lock.opens]
    closed = set(range(len(universal.foon.units))) - universal.domain().closure.executable.keys()
    assert len(opened) == len(set(opened)) == 70
    assert set(opened) == closed


def test_findings_point_at_lines_of_the_file(public_data: Path, universal_audit: Audit) -> None:
    lines = (public_data / "universal" / "FOON.txt").read_text().count("\n")
    assert all(1 <= finding.line <= lines for finding in universal_audit.findings)


def test_docs_list_every_code_of_the_audit() -> None:
    text = (ROOT / "docs" / "audit.md").read_text()
    documented = set(re.findall(r"^\| `([a-z-]+)` \|", text, re.MULTILINE))
    sources = [ROOT / "foon_asp" / "audit.py", ROOT / "encodings" / "audit.lp"]
    used = set()
    for path in sources:
        used |= set(
            re.findall(
                r'(?:warning\(|_finding\(\s*|Finding\(|yield _finding\(\s*)"([a-z-]+)"', path.read_text()
            )
        )
    assert documented == used
