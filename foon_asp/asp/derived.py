"""What rules of the user's own have derived, once it is grounded: atoms that mean what they say."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from foon_asp.asp.complaints import RulesProgram
from foon_asp.asp.heads import Argument, Head
from foon_asp.asp.model import ProgramError
from foon_asp.asp.rules import Derived, Rules
from foon_asp.asp.solver import Solver, open_solver
from foon_asp.asp.terms import Function, Row, Term, literal
from foon_asp.asp.vocabulary import Signature
from foon_asp.errors import InputError, QueryError
from foon_asp.query.objective import CRITERIA, Objective
from foon_asp.words import cut


def grounded(
    program: RulesProgram,
    encodings: Sequence[str],
    constants: Mapping[str, str | int],
    options: Sequence[str] = (),
) -> Solver:
    """Return a solver for encodings, facts and rules of the user's own.

    Raises `InputError` for an atom of the encodings' own that the rules derive and that says nothing, with
    the line if it is certain, `QueryError` for whatever else clingo complains of, and `LimitReachedError`.
    """
    try:
        made = open_solver(encodings, program.text, constants, options, guarded=True)
        _check_atoms(made, program.rules)
    except ProgramError as error:
        raise QueryError(program.complaint(str(error))) from None
    return made


def _check_atoms(solver: Solver, rules: Sequence[Rules]) -> None:
    """Only heads that the rules have are looked at, for atoms of the others are right."""
    derived = {each.signature for part in rules for each in part.derived}
    heads = {head.signature: head for part in rules for head in part.heads if head.signature in derived}
    if not heads:
        return
    units, objects, *tables = solver.derived([("unit", 1), ("object", 1), *heads])
    ids = {Argument.UNIT: {unit for (unit,) in units}, Argument.OBJECT: {each for (each,) in objects}}
    for head, rows in zip(heads.values(), tables, strict=True):
        for row in rows:
            _check_row(row, head, ids, rules)


_Ids = Mapping[Argument, Collection[Term]]
"""The ids of units and objects that are there."""


def check_priorities(solver: Solver, rules: Sequence[Rules], objective: Objective) -> None:
    """Raise `InputError` for a criterion of the user's own that would be added to one of the objective."""
    (criteria,) = solver.derived([("criterion", 2)])
    for row in criteria:
        name, priority = row
        if name not in CRITERIA and isinstance(priority, int) and 1 <= priority <= len(objective):
            taken = objective.criteria[len(objective) - priority]
            problem = f"the priority {priority} of {literal(name)} is that of {taken}"
            advice = f"take {len(objective) + 1} or more to come before {objective}, 0 or less to come after"
            raise InputError(*_place(row, ("criterion", 2), rules), problem, advice)


def _check_row(row: Row, head: Head, ids: _Ids, rules: Sequence[Rules]) -> None:
    for argument, kind in zip(row, head.arguments, strict=True):
        if not _FITS[kind](argument, ids):
            atom = cut(str(Function(head.signature[0], row)), 80)
            problem = f"{cut(literal(argument), 40)} in {atom!r} is not {kind.value}"
            raise InputError(*_place(row, head.signature, rules), problem, f"write {head.written}")


def _place(row: Row, signature: Signature, rules: Sequence[Rules]) -> tuple[str, int | None]:
    """Return the file and line of the only head that can have derived an atom, or the first file that may."""
    found = [
        (part.path, each.line) for part in rules for each in part.derived if _may_derive(each, row, signature)
    ]
    return found[0] if len(found) == 1 else (found[0][0], None)


def _may_derive(head: Derived, row: Row, signature: Signature) -> bool:
    return head.signature == signature and head.name in (None, row[0])


def _is_text(term: Term, _: _Ids) -> bool:
    return isinstance(term, str) and bool(term) and term.isprintable()


def _is_integer(least: int) -> Callable[[Term, _Ids], bool]:
    return lambda term, _: isinstance(term, int) and term >= least


_FITS: dict[Argument, Callable[[Term, _Ids], bool]] = {
    Argument.TEXT: _is_text,
    Argument.KEY: lambda *_: True,
    Argument.INTEGER: _is_integer(-(2**31)),
    Argument.PAYMENT: _is_integer(0),
    Argument.FACTOR: _is_integer(1),
    Argument.UNIT: lambda term, ids: term in ids[Argument.UNIT],
    Argument.OBJECT: lambda term, ids: term in ids[Argument.OBJECT],
}
