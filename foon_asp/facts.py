"""From a problem to clingo facts: the only place where input predicates are spelled."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import PurePath

from foon_asp.graph import FunctionalUnit, ObjectNode
from foon_asp.problem import Problem

COST_SCALE = 100_000
"""How many cost units make one unit of natural logarithm."""

IMPOSSIBLE = 1_000_000_000
"""The cost of a unit that never succeeds: more than any sensible tree, less than clingo's 2^31."""


def failure_cost(rate: int) -> int:
    """Return -ln(rate/1000), scaled and rounded, for a rate in parts per thousand."""
    return round(-math.log(rate / 1000) * COST_SCALE) if rate > 0 else IMPOSSIBLE


def success_chance(cost: float) -> float:
    """Return the chance of success that a sum of failure costs stands for."""
    return math.exp(-cost / COST_SCALE) if cost < IMPOSSIBLE else 0.0


def per_thousand(rate: float) -> int:
    """Round a chance in [0, 1] to parts per thousand; what can succeed stays above zero."""
    return max(1, round(rate * 1000)) if rate > 0 else 0


def quote(text: str) -> str:
    """Write a text as a clingo string."""
    return '"' + text.replace("\\", "\\\\").replace("\n", "\\n").replace('"', '\\"') + '"'


def facts(problem: Problem, *, rates_required: bool = False) -> str:
    """Return the facts of a problem, one statement a line, in the order of the FOON file.

    With `rates_required` every unit must have a success rate, else `QueryError`. On level 1 the facts set
    the constant `labels_only` of `units.lp`, so that no caller can forget it.
    """
    return "\n".join(_lines(problem, rates_required)) + "\n"


def names(problem: Problem) -> str:
    """Return two facts more, for queries: objects as people write them, and where each unit was read.

    A file is named without its folders; a unit that was read in several places has a fact for each.
    """
    domain = problem.domain
    lines = [f"name({number},{quote(str(domain.node(number)))})." for number in problem.objects]
    for number in problem.units:
        for source in domain.foon.units[number].annotation.sources:
            lines.append(f"source({number},{quote(PurePath(source.file).name)},{source.line}).")
    return "\n".join(lines) + "\n"


def price_facts(
    per_unit: Mapping[int, int], fees: Mapping[str, int], once: Mapping[int, Iterable[str]]
) -> str:
    """Return what units cost in a plan: prices paid each time, and fees that are paid once for a key."""
    lines = [f"price({number},{cost})." for number, cost in per_unit.items()]
    lines += [f"fee({quote(key)},{cost})." for key, cost in fees.items()]
    lines += [f"once({number},{quote(key)})." for number, keys in once.items() for key in keys]
    return "\n".join(lines) + "\n"


def _lines(problem: Problem, rates_required: bool) -> Iterator[str]:
    domain = problem.domain
    if domain.labels_only:
        yield "#const labels_only = 1. [override]"
    labels: set[str] = set()
    for number in problem.objects:
        node = domain.node(number)
        labels.update(node.named_labels)
        yield _object_facts(number, node)
    rates: set[int] = set()
    for number in problem.units:
        unit = domain.foon.units[number]
        yield _unit_facts(unit)
        rate = (domain.kitchen.rate if rates_required else domain.kitchen.known_rate)(unit)
        if rate is not None:
            rates.add(per_thousand(rate))
            yield f"success_rate({number},{per_thousand(rate)})."
    for rate in sorted(rates):
        yield f"failure_cost({rate},{failure_cost(rate)})."
    for label in sorted(domain.kitchen.utensils & labels):
        yield f"utensil({quote(label)})."
    for number in problem.objects:
        if number in domain.stock:
            yield f"kitchen({number})."
            if number in domain.quantities:
                yield f"quantity({number},{domain.quantities[number]})."
    for number in problem.goals:
        yield f"goal({number})."
    for kind, name, values in problem.constraints.named():
        for value in values:
            yield f"{kind}({quote(name)},{_constraint_value(kind, value)})."
        if not values:
            yield f'{kind}({quote(name)},"").'


def _constraint_value(kind: str, value: str | float) -> str:
    if isinstance(value, str):
        return quote(value)
    if kind == "max_failure":
        # Each rate of a tree was rounded, too: a tree that just succeeds often enough must not fail here.
        return str(math.ceil(-math.log(value) * COST_SCALE) + 2)
    return str(value)


@lru_cache(maxsize=1 << 16)
def _object_facts(number: int, node: ObjectNode) -> str:
    parts = [f"object({number}). label({number},{quote(node.label)})."]
    for state in node.states:
        name = quote(state.name)
        if state.relatum is not None:
            parts.append(f"relation({number},{name},{quote(state.relatum)}).")
        for content in dict.fromkeys(state.contents or ()):
            parts.append(f"content({number},{name},{quote(content)}).")
        if state.relatum is None and not state.contents:
            parts.append(f"state({number},{name}).")
    return " ".join(parts)


def _unit_facts(unit: FunctionalUnit) -> str:
    number = unit.id
    parts = [f"unit({number}). motion({number},{quote(unit.motion)})."]
    parts += [f"input({number},{thing})." for thing in unit.inputs]
    parts += [f"output({number},{thing})." for thing in unit.outputs]
    if unit.annotation.start is not None:
        parts.append(f"start({number},{round(unit.annotation.start)}).")
    if unit.annotation.end is not None:
        parts.append(f"end({number},{round(unit.annotation.end)}).")
    return " ".join(parts)
