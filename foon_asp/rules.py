"""Rules of the user's own: checked before clingo runs them, so that a typo is an error and no silence."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from clingo import MessageCode
from clingo.ast import AST, ASTType, Transformer, parse_string

from foon_asp import resources
from foon_asp.errors import InputError, closest
from foon_asp.files import read_string

Signature = tuple[str, int]

_DOCUMENTED = re.compile(r"^%\*! ([a-z_]+)\(([^)]*)\)$", re.MULTILINE)
_NO_CODE = re.compile(r'"(?:\\.|[^"\\])*"|%\*.*?\*%|%[^\n]*', re.DOTALL)
_INCLUDE = re.compile(r"#include\b")
_PLACE = re.compile(r"<string>:(\d+):(\d+)(?:-[\d:]+)?: (?:error|info): (.*)", re.DOTALL)


def read_rules(path: Path, *, allow_script: bool = False) -> str:
    """Return the text of an answer-set program over the vocabulary, after checking it.

    Raises `InputError`, with line and column, for a syntax error, `#include`, `#script` (unless it is
    allowed) and for a predicate that is neither in the vocabulary nor derived in the file.
    """
    text = read_string(path)
    include = _INCLUDE.search(_NO_CODE.sub(_blank, text))
    if include:
        line = text.count("\n", 0, include.start()) + 1
        raise InputError(path, line, "#include is not allowed", "give each file on the command line")
    statements = _parse(text, path)
    used = _Predicates()
    for statement in statements:
        if statement.ast_type == ASTType.Script and not allow_script:
            line = statement.location.begin.line
            raise InputError(path, line, "#script runs any code", "leave it out, or pass --allow-script")
        used.visit(statement)
    _refuse_unknown(used, path)
    return text


def _blank(match: re.Match[str]) -> str:
    """Keep line ends, so that places stay what they are."""
    return re.sub(r"[^\n]", " ", match[0])


def _parse(text: str, path: Path) -> list[AST]:
    statements: list[AST] = []
    messages: list[str] = []

    def log(_: MessageCode, message: str) -> None:
        messages.append(message.strip())

    try:
        parse_string(text, statements.append, logger=log)
    except RuntimeError:
        match = _PLACE.match(messages[0]) if messages else None
        if match is None:
            raise InputError(path, None, "cannot be read as an answer-set program") from None
        problem = " ".join(match[3].split())
        raise InputError(f"{path}:{match[1]}:{match[2]}", None, problem, "see the clingo guide") from None
    return statements


class _Predicates(Transformer):
    """Collects the predicates of a program: where each is first used, and which are derived."""

    def __init__(self) -> None:
        self.used: dict[Signature, tuple[int, int]] = {}
        self.derived: set[Signature] = set()
        self._in_head = False

    def visit_Rule(self, rule: AST) -> AST:  # noqa: N802 - the name is clingo's
        self._in_head = True
        self.visit(rule.head)
        self._in_head = False
        self.visit_sequence(rule.body)
        return rule

    def visit_Defined(self, defined: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.derived.add((defined.name, defined.arity))
        return defined

    def visit_SymbolicAtom(self, atom: AST) -> AST:  # noqa: N802 - the name is clingo's
        symbol = atom.symbol
        while symbol.ast_type == ASTType.UnaryOperation:
            symbol = symbol.argument
        if symbol.ast_type == ASTType.Function:
            signature = (symbol.name, len(symbol.arguments))
            place = symbol.location.begin
            self.used.setdefault(signature, (place.line, place.column))
            if self._in_head:
                self.derived.add(signature)
        return atom


def vocabulary() -> set[Signature]:
    """Return the predicates that the encodings document."""
    found: set[Signature] = set()
    for path in sorted(resources.encoding("vocabulary.lp").parent.rglob("*.lp")):
        for name, arguments in _DOCUMENTED.findall(path.read_text(encoding="utf-8")):
            found.add((name, len(arguments.split(","))))
    return found


def _refuse_unknown(predicates: _Predicates, path: Path) -> None:
    ours = vocabulary()
    names = {name for name, _ in ours}
    # A predicate of one's own is fine, but not one that looks like ours and is another.
    known = ours | {signature for signature in predicates.derived if signature[0] not in names}
    for (name, arity), (line, column) in predicates.used.items():
        if (name, arity) not in known:
            hint = _closest(name, arity, known)
            raise InputError(
                f"{path}:{line}:{column}", None, f"unknown predicate {name}/{arity}{hint}", "see encodings/"
            )


def _closest(name: str, arity: int, known: Iterable[Signature]) -> str:
    same_name = sorted(f"{other}/{count}" for other, count in known if other == name)
    if same_name:
        return f"; there is {', '.join(same_name)}"
    return closest(f"{name}/{arity}", (f"{other}/{count}" for other, count in known))
