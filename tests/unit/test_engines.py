"""An engine that is not installed."""

from __future__ import annotations

import pytest

from foon_asp.errors import QueryError
from foon_asp.planning.engines import find_engine


def test_an_engine_that_is_not_installed_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foon_asp.planning.engines.find_spec", lambda _: None)
    with pytest.raises(QueryError, match="pip install up-symk"):
        find_engine("symk")
