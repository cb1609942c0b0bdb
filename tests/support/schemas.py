"""What `--format json` writes, checked against docs/schema/."""

from __future__ import annotations

import json
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from foon_asp.cli.main import main
from support.paths import SCHEMAS

ALL = sorted(path.name.removesuffix(".schema.json") for path in SCHEMAS.iterdir())


def schema(name: str) -> dict[str, Any]:
    value: dict[str, Any] = json.loads((SCHEMAS / f"{name}.schema.json").read_text(encoding="utf-8"))
    return value


def output(capsys: pytest.CaptureFixture[str], *arguments: str, status: int = 0) -> Any:
    """Run a command, check its output against the schema of that name and return it."""
    assert main([*arguments, "--format", "json"]) == status
    value = json.loads(capsys.readouterr().out)
    Draft202012Validator(schema(arguments[0])).validate(value)
    return value
