"""The files of the encodings, as clingo parses them."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from clingo.ast import AST, ASTType, parse_files

from foon_asp.asp.encodings import encoding_path

FOLDER = encoding_path("")
FILES = sorted(FOLDER.rglob("*.lp"))
NAMES = [path.relative_to(FOLDER).as_posix() for path in FILES]

Signature = tuple[str, int]


@cache
def all_statements(path: Path) -> list[AST]:
    """Parse a file and all that it includes."""
    found: list[AST] = []
    parse_files([str(path)], found.append)
    return found


def file_of(statement: AST) -> str:
    """Return the name of the file that a statement stands in."""
    return Path(statement.location.begin.filename).resolve().relative_to(FOLDER.resolve()).as_posix()


def of_type(path: Path, *types: ASTType) -> list[AST]:
    """Return the statements of some types that stand in a file itself, not in those that it includes."""
    own = path.relative_to(FOLDER).as_posix()
    return [each for each in all_statements(path) if each.ast_type in types and file_of(each) == own]


def heads(rule: AST) -> set[Signature]:
    """Return the predicates that a rule derives."""
    found: set[Signature] = set()
    open_ = [rule.head]
    while open_:
        part = open_.pop()
        if part.ast_type == ASTType.SymbolicAtom:
            found.add((part.symbol.name, len(part.symbol.arguments)))
        elif part.ast_type == ASTType.Literal:
            open_.append(part.atom)
        elif part.ast_type == ASTType.ConditionalLiteral:
            open_.append(part.literal)
        elif part.ast_type in (ASTType.Aggregate, ASTType.Disjunction):
            open_ += part.elements
    return found - {("", 0)}


def shown(path: Path) -> set[Signature]:
    """Return what the `#show` statements of a file name, predicates and terms."""
    predicates = {(each.name, each.arity) for each in of_type(path, ASTType.ShowSignature)}
    terms = (each.term for each in of_type(path, ASTType.ShowTerm))
    return predicates | {(term.name, len(term.arguments)) for term in terms}
