"""A planning problem as PlanSys2 takes it: what its parser reads otherwise, or does not know, is avoided.

docs/robots.md says what that is, and where it stands in the source of PlanSys2.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from foon_asp.errors import QueryError
from foon_asp.planning.pddl.styles import Atom, Document, Predicate, Typed
from foon_asp.values import said

_CHANGES = re.compile("assign|increase|decrease")
"""What PlanSys2 takes for a change of a number wherever it stands in a predicate or its arguments."""


def for_plansys2(document: Document) -> Document:
    """Return a document in which names have `_` for `-`.

    names.json is the same: its names have `-`, and `pddl decode` takes either. Raises `QueryError` for costs,
    for predicates without arguments, and for names that PlanSys2 misreads.
    """
    if document.task.criterion is not None:
        raise QueryError("PlanSys2 reads no costs; export for it without --by")
    if not all(predicate.parameters for predicate in document.predicates):
        raise QueryError("PlanSys2 misreads predicates without arguments; export for it with --style lifted")
    named = (*document.constants, *document.objects)
    for name in (*(predicate.name for predicate in document.predicates), *(name for name, _ in named)):
        if found := _CHANGES.search(name):
            problem = f"PlanSys2 reads {said(name)} as a change of a number, as it holds {found[0]!r}"
            raise QueryError(f"{problem}; call it otherwise")
    return replace(
        document,
        problem_name=_name(document.problem_name),
        types=_typed(document.types),
        constants=_typed(document.constants),
        objects=_typed(document.objects),
        predicates=tuple(
            Predicate(_name(each.name), _typed(each.parameters), each.words) for each in document.predicates
        ),
        actions=tuple(
            replace(
                each,
                name=_name(each.name),
                parameters=_typed(each.parameters),
                conditions=_atoms(each.conditions),
                lasting=_atoms(each.lasting),
                adds=_atoms(each.adds),
                deletes=_atoms(each.deletes),
            )
            for each in document.actions
        ),
        facts={fact: _atom(atom) for fact, atom in document.facts.items()},
        initially=_atoms(document.initially),
        wanted=_atoms(document.wanted),
    )


def _name(name: str) -> str:
    return name.replace("-", "_")


def _typed(names: Typed) -> Typed:
    return tuple((_name(name), _name(kind)) for name, kind in names)


def _atom(atom: Atom) -> Atom:
    return tuple(map(_name, atom))


def _atoms(atoms: Iterable[Atom]) -> tuple[Atom, ...]:
    return tuple(map(_atom, atoms))
