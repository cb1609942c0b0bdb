"""Queries: a researcher's own rules over the facts of a FOON, and the atoms that they show."""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

import clingo

from foon_asp.errors import QueryError
from foon_asp.facts import facts, names, quote
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.rules import Heading, Rules, Signature, check_rules, vocabulary
from foon_asp.solve import ProgramError, Solver

ROOT = "query.lp"
"""The encoding that queries are run with."""

FOR_RETRIEVE: frozenset[Signature] = frozenset(
    {("criterion", 2), ("factor", 2), ("penalty", 3), ("violated", 2)}
)
"""What the rule files of `retrieve` derive. A query would pass over it in silence."""

Term = Union[int, str, "tuple[Term, ...]", "Function"]


@dataclass(frozen=True, slots=True)
class Function:
    """A term with a name: a constant like `oven`, or a function like `step(3)`; `-` stands in the name."""

    name: str
    arguments: tuple[Term, ...] = ()

    def __str__(self) -> str:
        return self.name + (f"({_written(self.arguments)})" if self.arguments else "")


Row = tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class Table:
    """The shown atoms of one predicate, numbers by size and texts in natural order."""

    heading: Heading
    rows: tuple[Row, ...]


@dataclass(frozen=True, slots=True)
class QueryAnswer:
    """What some rules show.

    `status` is `found` (a stable model of rules that optimise nothing), `optimal` (a proven best one), `none`
    (the rules have no stable model) or `limit` (the time ran out; the tables are those of the best model so
    far, if `tables` is not None). `costs`: what the model pays by each priority, the highest first; empty if
    nothing is optimised. `more` says whether another model that is as good shows something else; it is None
    if the time ran out before that was known. `seconds` is wall time.
    """

    goals: tuple[ObjectNode, ...]
    status: str
    tables: tuple[Table, ...] | None
    costs: tuple[int, ...]
    more: bool | None
    seconds: float


def query(
    domain: Domain,
    path: Path,
    goals: Sequence[ObjectNode] = (),
    *,
    time_limit: float | None = None,
    allow_script: bool = False,
) -> QueryAnswer:
    """Run a rule file over the facts of the whole FOON, or of the slice that can matter for some goals.

    `time_limit` is in seconds and limits solving, not grounding. Raises `InputError` for rules that cannot be
    meant, before they run, and `QueryError`, with file and line, for whatever clingo complains of.
    """
    started = time.perf_counter()
    rules = read_query(path, allow_script=allow_script)
    problem = Problem(domain, tuple(domain.id_of(goal) for goal in goals), whole=not goals)
    # The rules come first, so that the lines that clingo names are those of the file.
    show = "\n".join(f"#show {heading.name}/{heading.arity}." for heading in rules.atoms)
    program = f"{rules.text}\n#program base.\n{facts(problem)}{names(problem)}{show}"
    try:
        asker = _Asker([ROOT], program, {"strict": int(domain.strict)})
    except ProgramError as error:
        raise QueryError(_complaint(str(error), path)) from None
    deadline = None if time_limit is None else time.monotonic() + time_limit
    status, tables, costs, more = asker.ask(rules, deadline)
    return QueryAnswer(tuple(goals), status, tables, costs, more, time.perf_counter() - started)


def read_query(path: Path, *, allow_script: bool = False) -> Rules:
    """Return the rules of a query, checked. Raises `InputError`."""
    known = sorted(vocabulary(ROOT) - FOR_RETRIEVE)
    there = ", ".join(f"{name}/{arity}" for name, arity in known)
    advice = f"is not available in a query, where nothing is decided; there are {there}"
    return check_rules(path, ROOT, refused=FOR_RETRIEVE, advice=advice, allow_script=allow_script)


@dataclass(frozen=True, slots=True)
class _Shown:
    """What a model shows: the atoms of each heading, and the terms of `#show` statements."""

    atoms: tuple[tuple[clingo.Symbol, ...], ...]
    terms: tuple[clingo.Symbol, ...]


class _Asker(Solver):
    """A solver that keeps terms as they are, and shows what the rules name, not what the encodings do."""

    def ask(
        self, rules: Rules, deadline: float | None
    ) -> tuple[str, tuple[Table, ...] | None, tuple[int, ...], bool | None]:
        """Return status, tables, costs and whether there is more, as in `QueryAnswer`."""
        atoms = [self._atoms_of(heading) for heading in rules.atoms]
        found: list[tuple[_Shown, tuple[int, ...], bool]] = []
        others: list[_Shown] = []

        def on_model(model: clingo.Model) -> bool:
            shown = _Shown(
                tuple(
                    tuple(symbol for symbol, literal in pairs if model.is_true(literal)) for pairs in atoms
                ),
                tuple(sorted(model.symbols(terms=True))),
            )
            best = model.optimality_proven or not model.cost
            if not (found and found[0][2]):
                found[:] = [(shown, tuple(model.cost), best)]
            elif best and shown != found[0][0]:
                others.append(shown)
            return not others

        in_time = deadline is None or time.monotonic() < deadline
        # What the encodings show depends on the rules alone, or nearly so: there are few models too many.
        exhausted = in_time and self._enumerate(on_model, deadline)
        if not found:
            return ("none" if exhausted else "limit"), None, (), False if exhausted else None
        shown, costs, best = found[0]
        status = "limit" if not best else "optimal" if costs else "found"
        more = True if others else False if exhausted else None
        return status, tuple(_tables(rules, shown)), costs, more

    def _atoms_of(self, heading: Heading) -> list[tuple[clingo.Symbol, int]]:
        """Return the atoms of a predicate that can be true, with their literals."""
        name, positive = heading.name.lstrip("-"), not heading.name.startswith("-")
        found = self._control.symbolic_atoms.by_signature(name, heading.arity, positive)
        return [(atom.symbol, atom.literal) for atom in found]


def _tables(rules: Rules, shown: _Shown) -> Iterator[Table]:
    """Yield a table for each heading, even if it is empty, and for the terms that none announces."""
    headings: dict[Signature, Heading] = {}
    rows: dict[Signature, set[Row]] = {}
    for heading in (*rules.atoms, *rules.terms):
        headings.setdefault((heading.name, heading.arity), heading)
    for heading, symbols in zip(rules.atoms, shown.atoms, strict=True):
        rows[heading.name, heading.arity] = {tuple(map(_term, symbol.arguments)) for symbol in symbols}
    for term in map(_term, shown.terms):
        if isinstance(term, Function) and term.arguments:
            name, row = term.name, term.arguments
        else:
            name, row = "", term if isinstance(term, tuple) and term else (term,)
        rows.setdefault((name, len(row)), set()).add(row)
    for signature in (*headings, *sorted(rows.keys() - headings.keys())):
        heading = headings.get(signature) or Heading(*signature)
        yield Table(heading, tuple(sorted(rows.get(signature, ()), key=_row_key)))


def _term(symbol: clingo.Symbol) -> Term:
    if symbol.type is clingo.SymbolType.Number:
        return symbol.number
    if symbol.type is clingo.SymbolType.String:
        return symbol.string
    if symbol.type is not clingo.SymbolType.Function:
        return Function(str(symbol))
    arguments = tuple(map(_term, symbol.arguments))
    if not symbol.name:
        return arguments
    return Function(("" if symbol.positive else "-") + symbol.name, arguments)


def written(term: Term) -> str:
    """Write a term as clingo does, but a text without its quotes."""
    return term if isinstance(term, str) else _written((term,))


def _written(terms: Iterable[Term]) -> str:
    parts = []
    for term in terms:
        if isinstance(term, str):
            parts.append(quote(term))
        elif isinstance(term, tuple):
            parts.append(f"({_written(term)}{',' if len(term) == 1 else ''})")
        else:
            parts.append(str(term))
    return ",".join(parts)


Key = tuple[Any, ...]


def _row_key(row: Row) -> Key:
    return tuple(map(_key, row))


def _key(term: Term) -> Key:
    """Order numbers before texts, before tuples, before functions."""
    if isinstance(term, int):
        return (0, term)
    if isinstance(term, str):
        return (1, *_natural(term))
    if isinstance(term, tuple):
        return (2, len(term), _row_key(term))
    return (3, term.name, len(term.arguments), _row_key(term.arguments))


def _natural(text: str) -> Iterator[Any]:
    """Yield what sorts `unit 2` before `unit 10`: text and numbers by turns, and the text itself."""
    parts = re.split(r"([0-9]+)", text)
    yield tuple(int(part) if place % 2 else part for place, part in enumerate(parts))
    yield text


_PLACE = re.compile(r"<block>:(\d+):(\d+)(?:-[\d:]+)?: ")
_UNSAFE = re.compile(r"<block>:(\d+):(\d+)(?:-[\d:]+)?: note: '(\w+)' is unsafe")


def _complaint(messages: str, path: Path) -> str:
    """Return what clingo complains of first in one line, with the place in the file of the rules."""
    complaints = messages.split(" / ")
    complaint = next((each for each in complaints if ": error: " in each), complaints[0])
    if unsafe := _UNSAFE.search(complaint):
        # clingo would quote the rule as it has rewritten it.
        line, column, variable = unsafe.groups()
        why = "no positive literal of the body says what it can be"
        return f"{path}:{line}:{column}: the variable {variable} is unsafe; {why}"
    place = _PLACE.search(complaint)
    text = re.sub(r"\S+:\d+:\d+(?:-[\d:]+)?: (?:error|info|note): ", "", " ".join(complaint.split()))
    return f"{path}:{place[1]}:{place[2]}: {text}" if place else f"{path}: the rules do not work: {text}"
