"""No test of this layer runs the solver or another process."""

from __future__ import annotations

import subprocess
from typing import NoReturn

import clingo
import pytest


@pytest.fixture(autouse=True)
def no_solver_and_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> NoReturn:
        pytest.fail("a test in tests/unit runs no solver and no process; move it to another layer")

    monkeypatch.setattr(clingo.Control, "__init__", refuse)
    monkeypatch.setattr(subprocess.Popen, "__init__", refuse)
