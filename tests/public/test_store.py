"""Stores of the public files, and the queries of docs/scale.md."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.io.open import open_files
from foon_asp.io.store import open_store, read_manifest, write_store


@pytest.mark.parametrize("name", ["universal/FOON.txt", *(f"subgraphs/00{n}*" for n in (10, 46, 83))])
def test_public_files_survive(name: str, public_data: Path, tmp_path: Path) -> None:
    paths = sorted(public_data.glob(name))
    files = open_files(*paths)
    write_store(files, tmp_path / "kb.foon", paths)
    again = open_store(tmp_path / "kb.foon")
    assert again == files
    assert [unit.annotation for unit in again.foon.units] == [unit.annotation for unit in files.foon.units]


def test_all_subgraphs_survive_together(public_data: Path, tmp_path: Path) -> None:
    paths = sorted((public_data / "subgraphs").glob("*.txt"))
    files = open_files(*paths)
    write_store(files, tmp_path / "kb.foon", paths)
    assert open_store(tmp_path / "kb.foon") == files
    assert len(read_manifest(tmp_path / "kb.foon")["sources"]) == 56
