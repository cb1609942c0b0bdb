"""The dialect for PlanSys2: the same problem, in names that its parser does not take for something else."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from foon_asp.errors import QueryError
from foon_asp.model.consumption import SEMANTICS
from foon_asp.planning.pddl.plansys2 import for_plansys2
from foon_asp.planning.pddl.write import domain_text, problem_text, written_names
from support import small_foons
from support.cli import run, run_json
from support.pddl_by_others import check_up
from support.pddl_exports import exported, soup

KEYWORDS = re.compile(r":durative-actions?|total-time| - ")


@pytest.mark.parametrize("semantics", SEMANTICS)
def test_it_is_the_same_problem_without_hyphens(semantics: str) -> None:
    plain = exported(soup(), [small_foons.node("soup")], semantics, style="lifted", durative=True)
    written = for_plansys2(plain)
    for text in (domain_text, problem_text):
        assert text(written).replace("_", "-") == text(plain).replace("_", "-")
        code = re.sub(r";.*", "", text(written))
        assert "-" not in KEYWORDS.sub("", code)
    assert written_names(written) == written_names(plain)
    assert "(:requirements :strips :typing :durative-actions)" in domain_text(written)
    if semantics == "consume":
        # Reading a problem takes unified_planning seconds.
        check_up(written)


@pytest.mark.parametrize(
    ("unit", "style", "by", "complaint"),
    [
        ("a -mix-> b", "lifted", "units", "reads no costs"),
        ("a -mix-> b", "objects", None, "predicates without arguments; export for it with --style lifted"),
        ("a -mix-> assigned", "lifted", None, "'assigned-ready' as a change of a number"),
        ("a -mix-> b[decreased]", "lifted", None, "'decreased' as a change of a number"),
    ],
)
def test_what_it_reads_otherwise_is_refused(unit: str, style: str, by: str | None, complaint: str) -> None:
    where = small_foons.world([unit], "a")
    with pytest.raises(QueryError, match=complaint):
        for_plansys2(exported(where, list(where.foon.objects)[1:], criterion=by, style=style, durative=True))


def test_the_command_writes_it_and_plans_come_back(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    asked = ("whipped cream", "--semantics", "transform")
    assert run(capsys, "pddl", "export", *asked, "--dialect", "plansys2", "-o", tmp_path / "out")[0] == 0
    assert "(:durative-action pour_45" in (tmp_path / "out" / "domain.pddl").read_text()
    plan = run(capsys, "plan", *asked, "--format", "ipc", "--style", "lifted", "--durative")[1]
    (tmp_path / "plan").write_text(plan.replace("-", "_"))
    names = ("--names", tmp_path / "out" / "names.json")
    assert run_json(capsys, "pddl", "decode", tmp_path / "plan", *names)["executable"]
    status, _, err = run(
        capsys, "pddl", "export", "ice", "--dialect", "plansys2", "--style", "objects", "-o", tmp_path / "no"
    )
    assert (status, "--style lifted" in err) == (2, True)
