"""All models of an encoding on a few facts, as a person can check them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import clingo
from clingo.ast import ProgramBuilder, parse_files
from clingodl import ClingoDLTheory

from foon_asp.asp.encodings import encoding_path


@dataclass(frozen=True)
class Case:
    """Facts, and the models that an encoding has on them: all of them, or all best ones if it minimises.

    `facts` are clingo's, after `recipes` like `bake: flour, water -> bread`, of which there may be several,
    with `;` between them. `models` have a line each, its atoms in order, of the predicates in `asked` alone.
    `beside` are further encodings. `parts` are grounded in their order, after the base; `on` are external
    atoms that are set.
    """

    encoding: str
    says: str
    facts: str
    asked: str
    models: tuple[str, ...]
    recipes: str = ""
    beside: tuple[str, ...] = ()
    constants: str = ""
    parts: tuple[tuple[str, int], ...] = ()
    on: str = ""


def recipe_facts(recipes: str) -> str:
    """Write `unit/1`, `needs/2` and `makes/2` of recipes; units and objects are named by single words."""
    facts = []
    for recipe in filter(str.strip, recipes.split(";")):
        unit, rest = recipe.split(":")
        needs, makes = rest.split("->")
        unit = unit.strip()
        facts.append(f"unit({unit}).")
        facts += [f"needs({unit},{thing.strip()})." for thing in needs.split(",") if thing.strip()]
        facts += [f"makes({unit},{thing.strip()})." for thing in makes.split(",") if thing.strip()]
    return " ".join(facts)


def load(control: clingo.Control, names: Iterable[str]) -> Any:
    """Load encodings, some of which may have difference constraints; return the theory of these."""
    unknown: Any = ClingoDLTheory
    theory = unknown()
    theory.register(control)
    with ProgramBuilder(control) as builder:
        for name in names:
            parse_files([str(encoding_path(name))], lambda each: theory.rewrite_ast(each, builder.add))
    return theory


def models(case: Case) -> list[str]:
    """Return the models of a case, each once, sorted."""
    constants = [f"-c{constant}" for constant in case.constants.split()]
    control = clingo.Control(["--warn=no-file-included", *constants])
    theory = load(control, (case.encoding, *case.beside))
    control.add("base", [], recipe_facts(case.recipes) + " " + case.facts)
    control.ground([("base", [])])
    for part, number in case.parts:
        control.ground([(part, [clingo.Number(number)])])
    if case.on:
        control.assign_external(clingo.parse_term(case.on), True)
    configuration: Any = control.configuration
    configuration.solve.models, configuration.solve.opt_mode = 0, "optN"
    theory.prepare(control)
    asked = {(name, int(arity)) for name, arity in (each.split("/") for each in case.asked.split())}
    found: set[str] = set()
    with control.solve(yield_=True) as handle:
        for model in handle:
            if model.cost and not model.optimality_proven:
                continue
            # Terms that a `#show` statement names are no atoms.
            symbols = {*model.symbols(atoms=True), *model.symbols(terms=True)}
            shown = [each for each in symbols if (each.name, len(each.arguments)) in asked]
            found.add(" ".join(map(str, sorted(shown))))
    return sorted(found)
