"""What `--format json` writes of the public data is what docs/schema/ says."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.schemas import output


def test_compare_with_the_papers_figures(public_data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (row,) = output(capsys, "compare", "ice", "--data", str(public_data / "universal"))
    assert row["paper_ids"] == {"units": 1, "executable": None, "proven": False}


def test_stats_of_public_files(public_data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "stats", "--data", str(public_data / "subgraphs"), "--centrality")
    assert value["findings"]["duplicate-unit"] == value["duplicates"]


def test_audit_of_public_data(public_data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "audit", "--data", str(public_data / "universal"))
    assert len(value["locks"]) == 8
    assert [locked["goal"]["label"] for locked in value["locked_goals"]] == ["whipped cream", "fried rice"]
    codes = {finding["code"] for finding in value["findings"]}
    assert {"empty-unit", "locked", "goal-locked"} <= codes
