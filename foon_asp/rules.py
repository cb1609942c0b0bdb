"""Rules of the user's own: checked before clingo runs them, so that a typo is an error and no silence."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from clingo import MessageCode
from clingo.ast import AST, ASTType, Transformer, parse_string
from clingo.script import enable_python

from foon_asp import resources
from foon_asp.errors import InputError, closest
from foon_asp.files import read_string

Signature = tuple[str, int]

_DOCUMENTED = re.compile(r"^%\*! ([a-z_]+)\(([^)]*)\)$", re.MULTILINE)
_NO_CODE = re.compile(r'"(?:\\.|[^"\\])*"|%\*.*?\*%|%[^\n]*', re.DOTALL)
_INCLUDE = re.compile(r"#include\b")
_CONSTANT = re.compile(r"^#const (\w+) *=", re.MULTILINE)
_INCLUDED = re.compile(r'^#include "([^"]+)"\.', re.MULTILINE)
_PLACE = re.compile(r"<string>:(\d+):(\d+)(?:-[\d:]+)?: (?:error|info): (.*)", re.DOTALL)


ONLY_IN_QUERIES: Set[Signature] = frozenset({("name", 2), ("source", 3)})
"""Input predicates that only a query is given."""


@dataclass(frozen=True, slots=True)
class Heading:
    """A predicate as it is shown: its name, `-` before it if negated, and what its columns are called.

    A shown term that is a tuple or has no arguments has the name "". `columns` is empty if the rules do not
    name every column by a variable.
    """

    name: str
    arity: int
    columns: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Rules:
    """A rule file that was checked.

    `atoms`: the predicates that its `#show` statements name, or else those that it derives and the vocabulary
    does not have. `terms`: the shown terms whose form tells a name or a number of columns. Both are in the
    order of the file.
    """

    path: Path
    text: str
    atoms: tuple[Heading, ...]
    terms: tuple[Heading, ...]


def read_rules(path: Path, *, allow_script: bool = False) -> str:
    """Return the text of rules for `retrieve`, checked as in `check_rules` against all encodings."""
    return check_rules(
        path,
        refused=ONLY_IN_QUERIES,
        advice="is not available here; see encodings/",
        allow_script=allow_script,
    ).text


def check_rules(
    path: Path,
    root: str | None = None,
    *,
    refused: Set[Signature],
    advice: str,
    allow_script: bool = False,
) -> Rules:
    """Return an answer-set program over the vocabulary of an encoding (of all, without one), checked.

    Raises `InputError`, with line and column, for a syntax error, `#include`, `#program`, `#script` (unless
    it is allowed), a constant of the encodings, and for a predicate that is neither in the vocabulary nor
    derived in the file. Predicates that are refused, or that only other encodings have, are reported with the
    advice.
    """
    text = read_string(path)
    include = _INCLUDE.search(_NO_CODE.sub(_blank, text))
    if include:
        line = text.count("\n", 0, include.start()) + 1
        raise InputError(path, line, "#include is not allowed", "give each file on the command line")
    used = _Predicates()
    if allow_script:
        enable_python()
    for statement in _parse(text, path):
        _refuse_statement(statement, path, _constants(root), allow_script)
        used.visit(statement)
    known = vocabulary(root) - refused
    _refuse_unknown(used, path, known, refused, advice)
    names = {name for name, _ in known}
    atoms = [heading for heading in used.headings.values() if heading.name.lstrip("-") not in names]
    if used.selective:
        atoms = [used.headings.get(key, heading) for key, heading in used.shown.items()]
    return Rules(path, text, tuple(atoms), tuple(used.terms.values()))


def _refuse_statement(statement: AST, path: Path, constants: Set[str], allow_script: bool) -> None:
    """Raise `InputError` for what must not stand in a rule file, or would be passed over."""
    line = statement.location.begin.line
    if statement.ast_type == ASTType.Script and not allow_script:
        raise InputError(path, line, "#script runs any code", "leave it out, or pass --allow-script")
    if statement.ast_type == ASTType.Program and (statement.name != "base" or len(statement.parameters)):
        raise InputError(
            path, line, f"the part #program {statement.name} is never run", "leave this line out"
        )
    if statement.ast_type == ASTType.Definition and statement.name in constants:
        problem = f"the constant {statement.name} belongs to the encodings"
        raise InputError(path, line, problem, "take another name, or use the option for it")


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
    """Collects the predicates of a program: where each is first used, which are derived and shown."""

    def __init__(self) -> None:
        self.used: dict[Signature, tuple[int, int]] = {}
        self.derived: set[Signature] = set()
        self.headings: dict[Signature, Heading] = {}
        self.shown: dict[Signature, Heading] = {}
        self.terms: dict[Signature, Heading] = {}
        self.selective = False
        self._in_head = False

    def visit_Rule(self, rule: AST) -> AST:  # noqa: N802 - the name is clingo's
        self._visit_head(rule.head)
        self.visit_sequence(rule.body)
        return rule

    def visit_External(self, external: AST) -> AST:  # noqa: N802 - the name is clingo's
        self._visit_head(external.atom)
        self.visit_sequence(external.body)
        return external

    def _visit_head(self, head: AST) -> None:
        self._in_head = True
        self.visit(head)
        self._in_head = False

    def visit_ConditionalLiteral(self, conditional: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.visit(conditional.literal)
        in_head, self._in_head = self._in_head, False
        self.visit_sequence(conditional.condition)
        self._in_head = in_head
        return conditional

    def visit_Defined(self, defined: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.derived.add((defined.name, defined.arity))
        return defined

    def visit_ShowSignature(self, show: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.selective = True
        if show.name:
            begin = show.location.begin
            self.used.setdefault((show.name, show.arity), (begin.line, begin.column))
            name = show.name if show.positive else "-" + show.name
            self.shown[name, show.arity] = Heading(name, show.arity)
        return show

    def visit_ShowTerm(self, show: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.selective = True
        for function in _functions(show.term):
            if function.ast_type == ASTType.Function and function.arguments:
                heading = _heading(function.name, function.arguments)
                self.terms.setdefault((heading.name, heading.arity), heading)
            elif function.ast_type == ASTType.Variable:
                self.terms.setdefault(("", 1), _heading("", [function]))
        self.visit_sequence(show.body)
        return show

    def visit_SymbolicAtom(self, atom: AST) -> AST:  # noqa: N802 - the name is clingo's
        sign, symbol = "", atom.symbol
        while symbol.ast_type == ASTType.UnaryOperation:
            sign, symbol = "" if sign else "-", symbol.argument
        for function in _functions(symbol):
            signature = (function.name, len(function.arguments))
            begin = function.location.begin
            self.used.setdefault(signature, (begin.line, begin.column))
            if self._in_head:
                self.derived.add(signature)
                heading = _heading(sign + function.name, function.arguments)
                self.headings.setdefault((heading.name, heading.arity), heading)
        return atom


def _functions(term: AST) -> Iterator[AST]:
    """Yield what a pool like `p(1;2,3)` stands for; anything else is itself."""
    if term.ast_type == ASTType.Pool:
        for argument in term.arguments:
            yield from _functions(argument)
    else:
        yield term


def _heading(name: str, arguments: Sequence[AST]) -> Heading:
    """Take the names of the columns from the variables, if all arguments are variables with names."""
    names = tuple(str(argument) for argument in arguments if argument.ast_type == ASTType.Variable)
    named = len(names) == len(arguments) and "_" not in names
    return Heading(name, len(arguments), names if named else ())


def vocabulary(root: str | None = None) -> set[Signature]:
    """Return the predicates that an encoding and all that it includes document; of all, without one."""
    found: set[Signature] = set()
    for text in _encodings(root):
        found |= {(name, len(arguments.split(","))) for name, arguments in _DOCUMENTED.findall(text)}
    return found


def _constants(root: str | None) -> set[str]:
    return {name for text in _encodings(root) for name in _CONSTANT.findall(text)}


@cache
def _encodings(root: str | None) -> list[str]:
    """Return the texts of an encoding and all that it includes, or of all encodings."""
    folder = resources.encoding("vocabulary.lp").parent
    paths = sorted(folder.rglob("*.lp")) if root is None else [folder / root]
    texts: list[str] = []
    for path in paths:
        texts.append(path.read_text(encoding="utf-8"))
        if root is not None:
            included = (path.parent / name for name in _INCLUDED.findall(texts[-1]))
            paths += [each for each in included if each not in paths]
    return texts


def _refuse_unknown(
    predicates: _Predicates, path: Path, ours: Set[Signature], refused: Set[Signature], advice: str
) -> None:
    names = {name for name, _ in ours}
    # A predicate of one's own is fine, but not one that looks like ours and is another.
    own = {signature for signature in predicates.derived if signature[0] not in names}
    known = (ours | own) - refused
    for (name, arity), (line, column) in predicates.used.items():
        if (name, arity) in known:
            continue
        place = f"{path}:{line}:{column}"
        if (name, arity) in refused | vocabulary():
            raise InputError(place, None, f"{name}/{arity} {advice}")
        hint = _closest(name, arity, known)
        raise InputError(place, None, f"unknown predicate {name}/{arity}{hint}", "see encodings/")


def _closest(name: str, arity: int, known: Iterable[Signature]) -> str:
    same_name = sorted(f"{other}/{count}" for other, count in known if other == name)
    if same_name:
        return f"; there is {', '.join(same_name)}"
    return closest(f"{name}/{arity}", (f"{other}/{count}" for other, count in known))
