"""What the audit finds in the public universal FOON."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from foon_asp.audit.audit import Audit, audit
from foon_asp.io.folder import Dataset
from foon_asp.model.foon import Foon
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.small_foons import with_units


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
    result = retrieve(World.of(_edited(universal.foon, lock.unit.id, lock), universal.kitchen), Query(goal))
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
    result = retrieve(World.of(universal.foon, kitchen), Query(locked.goal))
    assert result.tree is not None
    assert result.tree.executable
    for one in locked.missing:
        kitchen = replace(universal.kitchen, objects=(*universal.kitchen.objects, one))
        assert retrieve(World.of(universal.foon, kitchen), Query(locked.goal)).status == "unreachable"


def test_locks_account_for_every_unit_that_never_runs(universal: Dataset, universal_audit: Audit) -> None:
    opened = [unit.id for lock in universal_audit.locks for unit in lock.opens]
    closed = set(range(len(universal.foon.units))) - universal.world().closure.executable.keys()
    assert len(opened) == len(set(opened)) == 70
    assert set(opened) == closed


def test_findings_point_at_lines_of_the_file(public_data: Path, universal_audit: Audit) -> None:
    lines = (public_data / "universal" / "FOON.txt").read_text().count("\n")
    assert all(1 <= finding.line <= lines for finding in universal_audit.findings)
