"""The public data, and their absence: no other layer knows of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.io.folder import Dataset, load
from foon_asp.model.world import World
from support.paths import PUBLIC_DATA


@pytest.fixture(scope="session")
def public_data() -> Path:
    """The folder of the public FOON data; tests that need it skip where it is absent."""
    if not (PUBLIC_DATA / "universal" / "FOON.txt").exists():
        pytest.skip(f"no public FOON data in {PUBLIC_DATA}; set FOON_PUBLIC_DATA")
    return PUBLIC_DATA


@pytest.fixture(scope="session")
def universal(public_data: Path) -> Dataset:
    return load(public_data / "universal")


@pytest.fixture(scope="session")
def universal_world(universal: Dataset) -> World:
    return universal.world()
