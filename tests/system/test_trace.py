"""The trace of the built-in goals against the method `ids`."""

from __future__ import annotations

from foon_asp.io.folder import Dataset
from support.trace_checks import check_all

# --- Real data ------------------------------------------------------------------------------------


def test_built_in_goals(built_in: Dataset) -> None:
    assert check_all(built_in, built_in.world()) > 0
