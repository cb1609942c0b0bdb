"""Fixtures of several layers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings
from selenium.webdriver import Chrome

from foon_asp.io.folder import Dataset, load
from foon_asp.io.open import open_files
from foon_asp.io.store import write_store
from foon_asp.model.world import World
from support import examples
from support.browser import start
from support.paths import BUILT_IN
from support.small_foons import world

settings.register_profile("tests", examples.profile())
settings.load_profile("tests")


@pytest.fixture(scope="session")
def built_in() -> Dataset:
    return load()


@pytest.fixture(scope="session")
def browser() -> Iterator[Chrome]:
    """A browser; it takes a second to start, so all tests of a process share it."""
    yield from start()


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """Return a store of the built-in FOON."""
    folder = tmp_path / "kb.foon"
    write_store(open_files(BUILT_IN), folder, [BUILT_IN])
    return folder


@pytest.fixture
def kitchen() -> World:
    return world(("onion + (knife) -cut-> onion[chopped]", "onion[chopped] -fry-> soup"), "onion + (knife)")
