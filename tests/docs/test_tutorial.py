"""The tutorial is a notebook whose cells put out what is in its file."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.notebooks import executed, opened, shown
from support.paths import ROOT


# What Jupyter warns of is not ours to mend.
@pytest.mark.filterwarnings("default")
def test_the_tutorial_shows_what_happens(tmp_path: Path) -> None:
    """`python tests/docs/rewrite.py docs/tutorial.ipynb` writes into it what its cells put out now."""
    path = ROOT / "docs" / "tutorial.ipynb"
    assert shown(executed(path, tmp_path)) == shown(opened(path))
