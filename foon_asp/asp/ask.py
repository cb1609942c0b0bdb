"""A researcher's own rules, run over the facts of a FOON, and the atoms that they show."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from foon_asp import limits
from foon_asp.asp.complaints import RulesProgram
from foon_asp.asp.control import Look, Shown
from foon_asp.asp.derived import grounded
from foon_asp.asp.facts import facts, names
from foon_asp.asp.model import ProgramError
from foon_asp.asp.rules import Heading, Rules, RuleText, check_rules
from foon_asp.asp.terms import Function, Row, Term
from foon_asp.asp.vocabulary import Signature
from foon_asp.errors import QueryError
from foon_asp.io.files import read_string
from foon_asp.limits import Limit, LimitReachedError
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.status import Status


@dataclass(frozen=True, slots=True)
class Table:
    """The shown atoms of one predicate, numbers by size and texts in natural order."""

    heading: Heading
    rows: tuple[Row, ...]


@dataclass(frozen=True, slots=True)
class RulesAnswer:
    """What some rules show; it is true if they have a stable model.

    `query` is the question, its goals as object nodes. `status` is `FOUND` (a stable model of rules that
    optimise nothing), `OPTIMAL` (a proven best one), `NONE` (the rules have no stable model) or `LIMIT` (the
    time ran out; the tables are those of the best model so far, if `tables` is not None). `costs`: what the
    model pays by each priority, the highest first; empty if nothing is optimised. `more` says whether another
    model that is as good shows something else; it is None if the time ran out before that was known.
    `limit` is what ended the search, if a limit did. `seconds` is wall time.
    """

    query: Query
    status: Status
    tables: tuple[Table, ...] | None
    costs: tuple[int, ...]
    more: bool | None
    seconds: float
    limit: Limit | None = None

    def __bool__(self) -> bool:
        return self.tables is not None

    @property
    def goals(self) -> tuple[ObjectNode, ...]:
        """The goals, as object nodes; without any the rules were run over the whole FOON."""
        return self.query.nodes


def ask(world: World, query: Query, path: Path) -> RulesAnswer:
    """Run a rule file over the facts of the whole FOON, or of the slice that can matter for some goals.

    Raises `InputError` for rules that cannot be meant, before they run, and `QueryError`, with file and line,
    for whatever clingo complains of.
    """
    started = time.perf_counter()
    plain = Query(
        *query.goals,
        time_limit=query.time_limit,
        memory_limit=query.memory_limit,
        kitchen=query.kitchen,
    )
    if query != plain:
        raise QueryError(
            "rules of one's own say themselves what they choose; ask with goals and a limit alone"
        )
    rules = read_rules_to_ask(path)
    world = query.seen_in(world)
    query = query.checked(world)
    problem = Problem(world, Problem.posed(world, query).goals, whole=not query.goals)
    show = "\n".join(f"#show {heading.name}/{heading.arity}." for heading in rules.atoms)
    program = RulesProgram.of(facts(problem) + names(problem) + show, [rules])
    seen = Look(None, (), False, False, False)
    with limits.limited(query.time_limit, query.memory_limit):
        try:
            solver = grounded(program, ["ask.lp"], {"strict": int(world.strict)})
            # What the encodings show depends on the rules alone, or nearly so: there are few models too many.
            seen = solver.look([(heading.name, heading.arity) for heading in rules.atoms])
        except ProgramError as error:
            raise QueryError(program.complaint(str(error))) from None
        except LimitReachedError as error:
            seen = replace(seen, limit=error.limit)
    tables = None if seen.shown is None else tuple(_tables(rules, seen.shown))
    more = True if seen.others else False if seen.exhausted else None
    seconds = time.perf_counter() - started
    return RulesAnswer(query, _status(seen), tables, seen.costs, more, seconds, seen.limit)


def read_rules_to_ask(path: Path) -> Rules:
    """Return rules of the user's own, checked. Raises `InputError`."""
    return check_rules(RuleText.of(read_string(path), path), "queries")


def _status(seen: Look) -> Status:
    """Return how it ended."""
    if seen.shown is None:
        return Status.NONE if seen.exhausted else Status.LIMIT
    if not seen.best:
        return Status.LIMIT
    return Status.OPTIMAL if seen.costs else Status.FOUND


def _tables(rules: Rules, shown: Shown) -> Iterator[Table]:
    """Yield a table for each heading, even if it is empty, and for the terms that none announces."""
    headings: dict[Signature, Heading] = {}
    rows: dict[Signature, set[Row]] = {}
    for heading in (*rules.atoms, *rules.terms):
        headings.setdefault((heading.name, heading.arity), heading)
    for heading, table in zip(rules.atoms, shown.tables, strict=True):
        rows[heading.name, heading.arity] = set(table)
    for term in shown.terms:
        if isinstance(term, Function) and term.arguments:
            name, row = term.name, term.arguments
        else:
            name, row = "", term if isinstance(term, tuple) and term else (term,)
        rows.setdefault((name, len(row)), set()).add(row)
    for signature in (*headings, *sorted(rows.keys() - headings.keys())):
        heading = headings.get(signature) or Heading(*signature)
        yield Table(heading, tuple(sorted(rows.get(signature, ()), key=_row_key)))


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
