"""Fixtures of several layers."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from foon_asp.io.folder import Dataset, load
from foon_asp.io.open import open_files
from foon_asp.io.store import write_store
from foon_asp.model.world import World
from support.paths import BUILT_IN
from support.small_foons import world

# The same examples in each run, however slow the machine is: chance belongs to the drill.
settings.register_profile(
    "same", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow], print_blob=True
)
settings.load_profile("same")


@pytest.fixture(scope="session")
def built_in() -> Dataset:
    return load()


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """Return a store of the built-in FOON."""
    folder = tmp_path / "kb.foon"
    write_store(open_files(BUILT_IN), folder, [BUILT_IN])
    return folder


@pytest.fixture
def kitchen() -> World:
    return world(("onion + (knife) -cut-> onion[chopped]", "onion[chopped] -fry-> soup"), "onion + (knife)")
