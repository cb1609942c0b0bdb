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
    lines = [*_details(problem), *_rates(problem, required=rates_required), *_query(problem, problem.objects)]
    return "\n".join(lines) + "\n"


def read_facts(problem: Problem, *, rates: bool = False, rates_required: bool = False) -> str:
    """Return fewer facts: the `needs/2` and `makes/2` that `units.lp` would derive of the others.

    Nothing is said of labels and states, and of what the kitchen has anyway. Success rates are there if they
    are asked for.
    """
    lines = _readings(problem)
    if rates or rates_required:
        lines += _rates(problem, required=rates_required)
    return "\n".join([*lines, *_query(problem, problem.goals)]) + "\n"


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


def _rates(problem: Problem, *, required: bool) -> Iterator[str]:
    """Yield the success rates of units, and what each rate costs."""
    domain = problem.domain
    rates: set[int] = set()
    for number in problem.units:
        unit = domain.foon.units[number]
        rate = (domain.kitchen.rate if required else domain.kitchen.known_rate)(unit)
        if rate is not None:
            rates.add(per_thousand(rate))
            yield f"success_rate({number},{per_thousand(rate)})."
    for rate in sorted(rates):
        yield f"failure_cost({rate},{failure_cost(rate)})."


def _query(problem: Problem, objects: Iterable[int]) -> Iterator[str]:
    """Yield which of some objects are at hand, what is to be made, and under which constraints."""
    domain = problem.domain
    for number in objects:
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


def _readings(problem: Problem) -> list[str]:
    """Return what the units of a problem need and make besides the kitchen."""
    reading, stock = problem.domain.reading, problem.domain.stock
    lines = []
    for unit in problem.units:
        needs = [f"needs({unit},{thing})." for thing in reading.needs[unit] if thing not in stock]
        makes = [f"makes({unit},{thing})." for thing in reading.makes[unit] if thing not in stock]
        lines.append(" ".join([f"unit({unit}).", *needs, *makes]))
    return lines


def _details(problem: Problem) -> Iterator[str]:
    """Yield all that is known of the objects and units of a problem."""
    domain = problem.domain
    if domain.labels_only:
        yield "#const labels_only = 1. [override]"
    labels: set[str] = set()
    for number in problem.objects:
        node = domain.node(number)
        labels.update(node.named_labels)
        yield _object_facts(number, node)
    for number in problem.units:
        yield _unit_facts(domain.foon.units[number])
    for label in sorted(domain.kitchen.utensils & labels):
        yield f"utensil({quote(label)})."


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
