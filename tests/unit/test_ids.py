"""Numbers of units and of objects have types of their own in every signature."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from support.paths import ROOT

MODULES = sorted((ROOT / "foon_asp").rglob("*.py"))
NAMELESS = re.compile(r"\b(dict|Mapping|MutableMapping)\[int, int\]")


def signatures(path: Path) -> Iterator[str]:
    """Yield what the functions of a module take and return, and the fields of its classes."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef):
            given = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
            parts = [*(each.annotation for each in given), node.returns]
        elif isinstance(node, ast.ClassDef):
            parts = [each.annotation for each in node.body if isinstance(each, ast.AnnAssign)]
        else:
            continue
        yield from (ast.unparse(part) for part in parts if part is not None)


@pytest.mark.parametrize("path", MODULES, ids=[path.relative_to(ROOT).as_posix() for path in MODULES])
def test_no_signature_maps_numbers_to_numbers(path: Path) -> None:
    assert [text for text in signatures(path) if NAMELESS.search(text)] == []
