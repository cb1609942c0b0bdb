"""The question that the options ask."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from foon_asp.characters import one_line
from foon_asp.cli.inputs import named_goals
from foon_asp.cli.messages import note
from foon_asp.errors import InputError, QueryError
from foon_asp.io.files import exists
from foon_asp.io.kitchen import read_labels
from foon_asp.model.world import World
from foon_asp.query.constraints import KINDS, Constraints, Form, read_diet
from foon_asp.query.goals import Named
from foon_asp.query.query import Query
from foon_asp.query.substitution import SOURCES, Given, read_substitutes
from foon_asp.resources import diets
from foon_asp.values import said
from foon_asp.words import shortened


def asked_goals(options: argparse.Namespace, world: World, advice: str) -> list[Named]:
    """Return the goals that are named, or else those that the FOON marks.

    Raises `QueryError` with an advice if there are none.
    """
    if named := named_goals(options):
        return named
    marked: list[Named] = [*world.foon.marked_goals()]
    if not marked:
        raise QueryError(f"{advice}; no object of the FOON is marked as its goal")
    note(options, f"asked for what the FOON marks: {shortened(list(map(str, marked)))}")
    return marked


def question(options: argparse.Namespace, *goals: Named) -> Query:
    """Return the question that the options ask, of goals."""
    return Query(
        *goals,
        by=getattr(options, "pareto", None) or options.by,
        method=getattr(options, "method", "optimal"),
        founded=not getattr(options, "reference", False),
        constraints=_constraints(options),
        time_limit=options.time_limit,
        memory_limit=options.memory_limit,
        substitute=_substitution(options),
    )


def _substitution(options: argparse.Namespace) -> list[Given] | None:
    """Return what `--substitute` names, if anything."""
    return likenesses(getattr(options, "substitute", [])) or None


def likenesses(named: Iterable[str]) -> list[Given]:
    """Return the sources of likenesses that are named, and the rows of the tables."""
    named = list(named)
    given: dict[Given, None] = dict.fromkeys(each for each in named if each in SOURCES)
    for path in dict.fromkeys(each for each in named if each not in SOURCES):
        given.update(dict.fromkeys(read_substitutes(Path(path))))
    return list(given)


def _constraints(options: argparse.Namespace) -> Constraints:
    """Return the constraints that the flags name."""
    given: Any = {kind.name: getattr(options, kind.name) for kind in KINDS if kind.form is not Form.DIETS}
    if options.only_motions is not None:
        # All files hold, so what is in each of them is allowed.
        allowed = [read_labels(Path(path)) for path in options.only_motions]
        given["only_motions"] = sorted(frozenset.intersection(*allowed))
    given["rules"] = _rules(options)
    return replace(Constraints.of(given), diets=tuple(map(_diet, options.diets)))


def _diet(name: str) -> tuple[str, tuple[str, ...]]:
    """Return a diet that comes with the program, or that a file lists."""
    if name in diets():
        return read_diet(name)
    path = Path(name)
    if not exists(path):
        raise QueryError(f"no diet {said(name)}; there are {', '.join(diets())}, or name a file of labels")
    # A file may have a name that is no UTF-8, or more than a line of it.
    return read_diet(one_line(path.stem), path)


def _rules(options: argparse.Namespace) -> tuple[str, ...]:
    paths = [*options.constraint, *options.objective]
    if not paths:
        return ()
    # What looks at rules takes a while to load, and most questions have none.
    from foon_asp.asp.aims import check_aims, has_aims
    from foon_asp.asp.rules import check_rules, read_rules

    texts = [read_rules(Path(path)) for path in paths]
    rules = [check_rules(text) for text in texts]
    for each in rules[len(options.constraint) :]:
        if not has_aims(each):
            problem = "this objective has no criterion(…) and no penalty(…)"
            raise InputError(each.path, None, problem, "see docs/objectives.md for the two lines")
    check_aims(rules)
    return tuple(texts)
