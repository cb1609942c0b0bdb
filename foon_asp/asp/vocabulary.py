"""What encodings document and define, as clingo parses them: what rules of the user's own build upon."""

from __future__ import annotations

import re
from collections.abc import Set
from dataclasses import dataclass
from functools import cache

from clingo.ast import AST, ASTType, parse_string

from foon_asp.asp.encodings import encoding_files, encoding_names, encoding_text

Signature = tuple[str, int]
"""A predicate: its name and how many arguments it has."""

_DOCUMENTED = re.compile(r"%\*! ([a-z_]+)\(([^)]*)\)\n")


@dataclass(frozen=True, slots=True)
class _Said:
    """The predicates that have a doc comment, and the names of `#const`s."""

    documented: frozenset[Signature]
    constants: frozenset[str]


@cache
def _parsed(file: str) -> _Said:
    """Parse a single file; encodings share most of theirs."""
    documented: set[Signature] = set()
    constants: set[str] = set()

    def visit(statement: AST) -> None:
        if statement.ast_type == ASTType.Comment:
            for predicate, arguments in _DOCUMENTED.findall(statement.value + "\n"):
                documented.add((predicate, len(arguments.split(","))))
        elif statement.ast_type == ASTType.Definition:
            constants.add(statement.name)

    parse_string(encoding_text(file), visit)
    return _Said(frozenset(documented), frozenset(constants))


def _files(root: str | None) -> list[str]:
    return encoding_files(encoding_names() if root is None else [root])


def vocabulary(root: str | None = None) -> Set[Signature]:
    """Return the predicates that an encoding and all that it includes document; of all, without one."""
    return frozenset().union(*(_parsed(file).documented for file in _files(root)))


def constants(root: str | None = None) -> Set[str]:
    """Return the constants of an encoding and all that it includes; of all, without one."""
    return frozenset().union(*(_parsed(file).constants for file in _files(root)))
