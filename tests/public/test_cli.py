"""The command line on the public universal FOON."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.cli import check_same_bytes, run


def test_compare_marks_what_cannot_be_executed(capsys: pytest.CaptureFixture[str], public_data: Path) -> None:
    universal = public_data / "universal"
    status, out, _ = run(capsys, "compare", "whipped cream", "macaroni in pot", "--data", universal)
    assert status == 0
    cream, macaroni = out.splitlines()[2:4]
    assert cream.split("|")[1].split() == ["10", "10", "15"]
    assert cream.split("|")[2].split() == ["10!", "10!", "15!"]
    assert set(cream.split("|")[3].split()) == {"-"}
    assert macaroni.split()[-1] == "5*"


def test_same_bytes_whatever_the_hash_seed(public_data: Path, tmp_path: Path) -> None:
    check_same_bytes(["retrieve", "cheese pizza", "--data", public_data / "universal"], tmp_path)
