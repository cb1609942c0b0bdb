"""The tests lie in layers, and no test module imports another one."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from support.paths import ROOT

TESTS = ROOT / "tests"
MODULES = sorted(path for path in TESTS.rglob("*.py") if path.name != "__init__.py")


def imported(path: Path) -> set[str]:
    """Return the parts of the names of all modules that a module imports."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {part for name in node.names for part in name.name.split(".")}
        elif isinstance(node, ast.ImportFrom):
            found |= {*(node.module or "").split("."), *(name.name for name in node.names)}
    return found


def skips(path: Path) -> bool:
    """Say whether a module may skip tests for what is missing."""
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    return any(isinstance(node, ast.Attribute) and node.attr in ("skip", "importorskip") for node in nodes)


def test_every_test_lies_in_a_layer() -> None:
    layers = {path.relative_to(TESTS).parts[0] for path in MODULES if path.name.startswith("test_")}
    assert layers <= {"unit", "encodings", "property", "system", "docs", "public"}


@pytest.mark.parametrize("path", MODULES, ids=[path.relative_to(TESTS).as_posix() for path in MODULES])
def test_no_test_module_is_imported(path: Path) -> None:
    assert not imported(path) & {
        "conftest",
        *(each.stem for each in MODULES if each.stem.startswith("test_")),
    }


def test_only_what_needs_the_public_data_or_a_browser_is_skipped() -> None:
    assert [path.relative_to(TESTS).as_posix() for path in MODULES if skips(path)] == [
        "public/conftest.py",
        "support/browser.py",
    ]


def test_only_the_public_layer_knows_where_the_public_data_lie() -> None:
    knowing = {path.relative_to(TESTS).parts[0] for path in MODULES if "PUBLIC_DATA" in imported(path)}
    assert knowing == {"public"}
