"""Statements that rules of the user's own may not have, each with what to write instead."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from clingo import SymbolType
from clingo.ast import AST, ASTType, Transformer

from foon_asp.asp.heads import CRITERIA_OF_ONES_OWN, RESERVED, Purpose
from foon_asp.asp.vocabulary import constants
from foon_asp.errors import InputError
from foon_asp.query.objective import CRITERIA

_NOWHERE: Mapping[ASTType, tuple[str, str]] = {
    ASTType.External: ("atoms of #external are false, for nothing sets them", "write a choice, { p(X) }"),
    ASTType.Heuristic: ("#heuristic has no effect here", "leave it out"),
    ASTType.ProjectAtom: ("#project would change which answers are told apart", "leave it out"),
    ASTType.ProjectSignature: ("#project would change which answers are told apart", "leave it out"),
    ASTType.TheoryDefinition: ("#theory is for other solvers", "leave it out"),
}
_AIM = (
    "aims of their own would come between those of --by",
    'write criterion("mine",9). and penalty("mine",Key,Value) :- …, see docs/objectives.md',
)
_SHOW = ("#show shows nothing of a task tree", "leave it out; foon-asp query shows what rules derive")
_FOR_TREES: Mapping[ASTType, tuple[str, str]] = {
    ASTType.Minimize: _AIM,
    ASTType.ShowSignature: _SHOW,
    ASTType.ShowTerm: _SHOW,
}


class Refusals(Transformer):
    """Looks at statements for what must not stand in them, or would be passed over."""

    def __init__(self, text: str, path: str, purpose: Purpose) -> None:
        """Look at the statements of a text; it takes long to look into terms, so it says whether to."""
        self._path = path
        self._purpose = purpose
        self._calls = "@" in text
        self._statements = _NOWHERE if purpose.root is not None else {**_NOWHERE, **_FOR_TREES}
        self._constants = constants(purpose.root)

    def check(self, statement: AST) -> None:
        """Raise `InputError` for a statement that is refused."""
        kind = statement.ast_type
        if kind in self._statements:
            raise InputError(self._path, statement.location.begin.line, *self._statements[kind])
        if kind == ASTType.Program and (statement.name != "base" or len(statement.parameters)):
            problem = f"the part #program {statement.name} is never run"
            raise InputError(self._path, statement.location.begin.line, problem, "leave this line out")
        if kind == ASTType.Definition and statement.name in self._constants:
            problem = f"the constant {statement.name} belongs to the encodings"
            advice = "take another name, or use the option for it"
            raise InputError(self._path, statement.location.begin.line, problem, advice)
        self.visit(statement)

    def visit_TheoryAtom(self, atom: AST) -> AST:  # noqa: N802 - the name is clingo's
        """Refuse what other solvers than clingo understand."""
        raise self._refusal(atom, "theory atoms are for other solvers", "write rules")

    def visit_Function(self, function: AST) -> AST:  # noqa: N802 - the name is clingo's
        """Refuse calls of functions."""
        if function.external:
            raise self._refusal(function, f"@{function.name} runs any code", "say it in rules")
        self.visit_children(function)
        return function

    def visit_SymbolicAtom(self, atom: AST) -> AST:  # noqa: N802 - the name is clingo's
        """Refuse what is said of criteria that are not the user's own."""
        for function in functions_of(atom):
            signature = (function.name, len(function.arguments))
            if self._purpose.root is None and signature in CRITERIA_OF_ONES_OWN:
                self._check_criterion(function)
        if self._calls:
            self.visit_children(atom)
        return atom

    def _check_criterion(self, function: AST) -> None:
        """Refuse a criterion of the encodings; where a rule pays it says by which, so that this is seen."""
        name = literal_text(function.arguments[0])
        written = f'{function.name}("mine",…)'
        if name is None:
            problem = f"{function.name} needs the name of a criterion itself, in quotes"
            raise self._refusal(function, problem, f"write {written}")
        if name in RESERVED or name in CRITERIA:
            problem = f'the criterion "{name}" belongs to the encodings'
            raise self._refusal(function, problem, f"take another name, like {written}")
        last = function.arguments[-1]
        if literal_text(last) is not None:
            raise self._refusal(last, f"{last} in {function} is not an integer", f"write {written}")

    def _refusal(self, node: AST, problem: str, advice: str) -> InputError:
        begin = node.location.begin
        return InputError(f"{self._path}:{begin.line}:{begin.column}", None, problem, advice)


def literal_text(term: AST) -> str | None:
    """Return the text that a term is, if it is one."""
    if term.ast_type == ASTType.SymbolicTerm and term.symbol.type is SymbolType.String:
        return str(term.symbol.string)
    return None


def functions_of(atom: AST) -> Iterator[AST]:
    """Yield what an atom is without its sign; a pool like `p(1;2,3)` is several."""
    symbol = atom.symbol
    while symbol.ast_type == ASTType.UnaryOperation:
        symbol = symbol.argument
    yield from in_pool(symbol)


def in_pool(term: AST) -> Iterator[AST]:
    """Yield what a pool stands for; anything else is itself."""
    if term.ast_type == ASTType.Pool:
        for argument in term.arguments:
            yield from in_pool(argument)
    else:
        yield term
