"""What several tests share: the built-in data, and the public data where it is there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import foon_asp
from foon_asp.dataset import Dataset
from foon_asp.problem import Domain

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="session")
def built_in() -> Dataset:
    return foon_asp.load()


@pytest.fixture(scope="session")
def public_data() -> Path:
    """The folder of the public FOON data; tests that need it skip where it is absent."""
    folder = Path(os.environ.get("FOON_PUBLIC_DATA", ROOT.parent / "shared" / "foon"))
    if not (folder / "universal" / "FOON.txt").exists():
        pytest.skip(f"no public FOON data in {folder}; set FOON_PUBLIC_DATA")
    return folder


@pytest.fixture(scope="session")
def universal(public_data: Path) -> Dataset:
    return foon_asp.load(public_data / "universal")


@pytest.fixture(scope="session")
def universal_domain(universal: Dataset) -> Domain:
    return universal.domain()
