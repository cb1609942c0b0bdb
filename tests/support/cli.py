"""Run the command line in this process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from foon_asp.cli.main import main


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, str, str]:
    try:
        status = main([str(argument) for argument in arguments])
    except SystemExit as stop:
        status = int(stop.code or 0)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def run_json(capsys: pytest.CaptureFixture[str], *arguments: object) -> Any:
    status, out, _ = run(capsys, *arguments, "--format", "json")
    assert status == 0
    return json.loads(out)


def check_same_bytes(command: Sequence[object], folder: Path) -> None:
    """Run a command under several hash seeds; it must print the same each time."""
    outputs = {
        subprocess.run(
            [sys.executable, "-m", "foon_asp", *map(str, command)],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
            cwd=folder,
        ).stdout
        for seed in ("0", "1", "4711")
    }
    assert len(outputs) == 1, command
