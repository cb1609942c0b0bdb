"""Rules of the user's own: checked before clingo runs them, so that a typo is an error and no silence."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from clingo import MessageCode
from clingo.ast import AST, ASTType, Transformer, parse_string

from foon_asp.asp.heads import ANOTHER_NAME, CRITERIA_OF_ONES_OWN, INSTEAD, PURPOSES, Head, Purpose
from foon_asp.asp.refusals import Refusals, functions_of, in_pool, literal_text
from foon_asp.asp.scan import scanned, without_repeated_facts
from foon_asp.asp.vocabulary import Signature, vocabulary
from foon_asp.errors import InputError
from foon_asp.io.files import read_string
from foon_asp.words import closest

_MOST = 100_000
"""How many characters of rules are read: clingo's syntax tree takes up to 2 s for so many in Python."""

_PLACE = re.compile(r"<string>:(\d+):(\d+)(?:-[\d:]+)?: (?:error|info): (.*)", re.DOTALL)


class RuleText(str):
    """The text of rules that were read from a file, and which."""

    path: str = "rules"

    @classmethod
    def of(cls, text: str, path: Path) -> RuleText:
        """Return a text with the name of its file."""
        found = cls(text)
        found.path = str(path)
        return found


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
class Derived:
    """A head of a rule: its predicate, its first argument if that is a text, and the line."""

    signature: Signature
    name: str | None
    line: int


@dataclass(frozen=True, slots=True)
class Rules:
    """A rule file that was checked.

    `text` is what clingo is given: lines stand where they stood. `atoms`: the predicates that its `#show`
    statements name, or else those that it derives and the vocabulary does not have. `terms`: the shown terms
    whose form tells a name or a number of columns. Both are in the order of the file, and so is what is
    `derived`. `spoken` are the criteria of the user's own that bodies speak of. `heads` are those of the
    encodings that such rules may have.
    """

    path: str
    text: str
    atoms: tuple[Heading, ...]
    terms: tuple[Heading, ...]
    derived: tuple[Derived, ...]
    spoken: frozenset[str]
    heads: tuple[Head, ...]


def read_rules(path: Path) -> RuleText:
    """Return the text of rules for `retrieve`, checked; raise `InputError`, see `check_rules`."""
    text = RuleText.of(read_string(path), path)
    check_rules(text)
    return text


def check_rules(text: str, purpose: str = "trees") -> Rules:
    """Return an answer-set program, checked for what it is meant for: one of `heads.PURPOSES`.

    Raises `InputError`, with the line, for a syntax error, for statements that run code, redefine something
    or would be passed over, and for a predicate that is neither in the vocabulary nor derived in the text.
    """
    return _checked(str(text), text.path if isinstance(text, RuleText) else RuleText.path, purpose)


@lru_cache(maxsize=256)
def _checked(text: str, path: str, meant_for: str) -> Rules:
    purpose = PURPOSES[meant_for]()
    text = scanned(text, path)
    used = _Predicates()
    refusals = Refusals(text, path, purpose)
    rules = without_repeated_facts(text, {name for name, _ in purpose.heads})
    if len(rules.strip()) - rules.count("\n") > _MOST:
        problem = f"the rules have more than {_MOST:,} characters beside facts of which each fills a line"
        raise InputError(path, None, problem, "say what differs in facts, and once what follows from them")
    try:
        for statement in _parse(rules, path):
            refusals.check(statement)
            used.visit(statement)
    except RecursionError:
        raise InputError(path, None, "the rules are nested too deeply", "say it in several rules") from None
    _refuse_unknown(used, path, purpose)
    _refuse_heads(used, path, purpose)
    atoms = [heading for heading in used.headings.values() if heading.name.lstrip("-") not in purpose.ours]
    if used.selective:
        atoms = [used.headings.get(key, heading) for key, heading in used.shown.items()]
    terms, heads = tuple(used.terms.values()), tuple(purpose.heads.values())
    return Rules(path, text, tuple(atoms), terms, tuple(used.derived), frozenset(used.spoken), heads)


def _parse(text: str, path: str) -> list[AST]:
    statements: list[AST] = []
    messages: list[str] = []

    def log(_: MessageCode, message: str) -> None:
        messages.append(message.strip())

    try:
        parse_string(text, statements.append, logger=log)
    except RuntimeError:
        messages = messages or ["cannot be read as an answer-set program"]
    if messages:
        match = _PLACE.match(messages[0])
        if match is None:
            raise InputError(path, None, " ".join(messages[0].split()))
        problem = " ".join(match[3].split())
        raise InputError(f"{path}:{match[1]}:{match[2]}", None, problem, "see the clingo guide")
    return statements


class _Predicates(Transformer):
    """Collects the predicates of a program: where each is first used, which are derived and shown."""

    def __init__(self) -> None:
        self.used: dict[Signature, tuple[int, int]] = {}
        self.derived: list[Derived] = []
        self.spoken: set[str] = set()
        self.own: set[Signature] = set()
        self.negated: dict[Signature, tuple[int, int]] = {}
        self.headings: dict[Signature, Heading] = {}
        self.shown: dict[Signature, Heading] = {}
        self.terms: dict[Signature, Heading] = {}
        self.selective = False
        self._in_head = False

    def visit_Rule(self, rule: AST) -> AST:  # noqa: N802 - the name is clingo's
        self._in_head = True
        self.visit(rule.head)
        self._in_head = False
        self.visit_sequence(rule.body)
        return rule

    def visit_ConditionalLiteral(self, conditional: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.visit(conditional.literal)
        in_head, self._in_head = self._in_head, False
        self.visit_sequence(conditional.condition)
        self._in_head = in_head
        return conditional

    def visit_Defined(self, defined: AST) -> AST:  # noqa: N802 - the name is clingo's
        self.own.add((defined.name, defined.arity))
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
        for function in in_pool(show.term):
            if function.ast_type == ASTType.Function and function.arguments:
                heading = _heading(function.name, function.arguments)
                self.terms.setdefault((heading.name, heading.arity), heading)
            elif function.ast_type == ASTType.Variable:
                self.terms.setdefault(("", 1), _heading("", [function]))
        self.visit_sequence(show.body)
        return show

    def visit_SymbolicAtom(self, atom: AST) -> AST:  # noqa: N802 - the name is clingo's
        negated, symbol = False, atom.symbol
        while symbol.ast_type == ASTType.UnaryOperation:
            negated, symbol = not negated, symbol.argument
        for function in functions_of(atom):
            # Each look at an attribute is a call of clingo's library, and atoms may be many.
            name, arguments = function.name, list(function.arguments)
            signature = (name, len(arguments))
            if self._in_head or signature not in self.used or negated:
                begin = function.location.begin
                place = (begin.line, begin.column)
                self.used.setdefault(signature, place)
                if negated:
                    self.negated.setdefault(signature, place)
                if self._in_head:
                    self._derive("-" + name if negated else name, signature, arguments, begin.line)
            if not self._in_head and signature in CRITERIA_OF_ONES_OWN:
                spoken = literal_text(arguments[0])
                if spoken:
                    self.spoken.add(spoken)
        return atom

    def _derive(self, shown: str, signature: Signature, arguments: Sequence[AST], line: int) -> None:
        self.own.add(signature)
        name = literal_text(arguments[0]) if arguments else None
        self.derived.append(Derived(signature, name, line))
        if (shown, len(arguments)) not in self.headings:
            self.headings[shown, len(arguments)] = _heading(shown, arguments)


def _heading(name: str, arguments: Sequence[AST]) -> Heading:
    """Take the names of the columns from the variables, if all arguments are variables with names."""
    names = tuple(str(argument) for argument in arguments if argument.ast_type == ASTType.Variable)
    named = len(names) == len(arguments) and "_" not in names
    return Heading(name, len(arguments), names if named else ())


def _refuse_unknown(predicates: _Predicates, path: str, purpose: Purpose) -> None:
    # A predicate of one's own is fine, but not one that looks like ours and is another.
    own = {signature for signature in predicates.own if signature[0] not in purpose.ours}
    known = (purpose.known | own) - purpose.refused
    for (name, arity), (line, column) in predicates.used.items():
        if (name, arity) in known:
            continue
        place = f"{path}:{line}:{column}"
        if (name, arity) in purpose.refused | vocabulary():
            raise InputError(place, None, f"{name}/{arity} {purpose.advice}")
        hint = _closest(name, arity, known)
        raise InputError(place, None, f"unknown predicate {name}/{arity}{hint}", "see encodings/")


def _refuse_heads(predicates: _Predicates, path: str, purpose: Purpose) -> None:
    """Raise `InputError` for what is derived of the encodings' own, and for its negation."""
    for (name, arity), (line, column) in predicates.negated.items():
        if name in purpose.ours:
            problem = f"there is no -{name}/{arity}"
            raise InputError(f"{path}:{line}:{column}", None, problem, f"write not {name}(…)")
    for each in predicates.derived:
        name, arity = each.signature
        if name in purpose.ours and each.signature not in purpose.heads:
            problem = f"{name}/{arity} belongs to the encodings; rules may derive {purpose.may_derive}"
            raise InputError(path, each.line, problem, INSTEAD.get(name, ANOTHER_NAME))


def _closest(name: str, arity: int, known: Iterable[Signature]) -> str:
    same_name = sorted(f"{other}/{count}" for other, count in known if other == name)
    if same_name:
        return f"; there is {', '.join(same_name)}"
    return closest(f"{name}/{arity}", (f"{other}/{count}" for other, count in known))
