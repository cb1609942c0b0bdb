"""What several tests share: the built-in data, and the public data where it is there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import foon_asp
from foon_asp.dataset import Dataset
from foon_asp.problem import Domain

ROOT = Path(__file__).parent.parent
PUBLIC_DATA = Path(os.environ.get("FOON_PUBLIC_DATA", ROOT.parent / "shared" / "foon"))


@pytest.fixture(scope="session")
def built_in() -> Dataset:
    return foon_asp.load()


@pytest.fixture(scope="session")
def public_data() -> Path:
    """The folder of the public FOON data; tests that need it skip where it is absent."""
    if not (PUBLIC_DATA / "universal" / "FOON.txt").exists():
        pytest.skip(f"no public FOON data in {PUBLIC_DATA}; set FOON_PUBLIC_DATA")
    return PUBLIC_DATA


@pytest.fixture(scope="session")
def universal(public_data: Path) -> Dataset:
    return foon_asp.load(public_data / "universal")


@pytest.fixture(scope="session")
def universal_domain(universal: Dataset) -> Domain:
    return universal.domain()
