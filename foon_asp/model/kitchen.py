"""The kitchen: what is at hand, which labels are utensils, how likely motions succeed, what they cost."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

from foon_asp.errors import QueryError
from foon_asp.model.node import FunctionalUnit, ObjectNode, check_label
from foon_asp.numbers import COST, QUANTITY, RATE
from foon_asp.values import a_list, said
from foon_asp.words import closest


@dataclass(frozen=True, slots=True)
class Kitchen:
    """Objects at hand, in file order; utensil labels; success rates by motion label, in [0, 1].

    `quantities`: how many there are of those objects of which there are not plenty, from 1. They matter
    where objects are used up; retrieval takes no notice of them. `stated`: the data say what is at hand, and
    be it nothing; else a world has what no unit of its FOON makes. `costs`: what motions cost, by label, for
    the criterion of that name; `default_cost` is that of all others. `labels`: of each of these all objects
    are at hand that no unit makes; a world lists them.
    """

    objects: tuple[ObjectNode, ...]
    utensils: frozenset[str] = frozenset()
    rates: Mapping[str, float] = field(default_factory=dict)
    default_rate: float | None = None
    quantities: Mapping[ObjectNode, int] = field(default_factory=dict)
    stated: bool = True
    costs: Mapping[str, float] = field(default_factory=dict)
    default_cost: float | None = None
    labels: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Raise `QueryError` for a value that says something else than the fields say, with what to pass."""
        objects = tuple(a_list(self.objects, "objects", "object nodes"))
        for node in objects:
            _check_node(node)
        utensils = frozenset(a_list(self.utensils, "utensils", "labels"))
        for label in utensils:
            check_label(label, "a utensil")
        rates = _mapping(self.rates, "rates", "motions with their chances")
        for motion in rates:
            check_label(motion, "a motion")
        costs = _mapping(self.costs, "costs", "motions with what they cost")
        for motion in costs:
            check_label(motion, "a motion")
        labels = tuple(a_list(self.labels, "labels", "labels"))
        for label in labels:
            check_label(label, "an object")
        counts = _mapping(self.quantities, "quantities", "object nodes with their numbers")
        for node in counts:
            _check_node(node)
        values: dict[str, object] = {
            "objects": objects,
            "utensils": utensils,
            "labels": labels,
            "rates": {motion: RATE.checked(rate, f"rates[{motion!r}]") for motion, rate in rates.items()},
            "costs": {motion: COST.checked(cost, f"costs[{motion!r}]") for motion, cost in costs.items()},
            "quantities": {
                node: QUANTITY.checked(count, f"quantities[{node}]") for node, count in counts.items()
            },
        }
        if self.default_rate is not None:
            values["default_rate"] = RATE.checked(self.default_rate, "default_rate")
        if self.default_cost is not None:
            values["default_cost"] = COST.checked(self.default_cost, "default_cost")
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def known_rate(self, unit: FunctionalUnit) -> float | None:
        """Return the chance that a unit succeeds: its own, its motion's, the default, or None."""
        own = unit.annotation.rate
        return self.motion_rate(unit.motion) if own is None else own

    def motion_rate(self, motion: str) -> float | None:
        """Return the chance that a motion succeeds, else the default, or None.

        A trailing `*` (a composite motion) does not matter to the look-up.
        """
        return self.rates.get(_simple(motion), self.default_rate)

    def known_cost(self, unit: FunctionalUnit) -> Fraction | None:
        """Return what the motion of a unit costs, exactly as it was written; None if nothing says it."""
        cost = self.costs.get(_simple(unit.motion), self.default_cost)
        return None if cost is None else exact(cost)

    def cost(self, unit: FunctionalUnit) -> Fraction:
        """Return what the motion of a unit costs; raise `QueryError` if nothing says it."""
        cost = self.known_cost(unit)
        if cost is None:
            source = f"{unit.source}: " if unit.source.file else ""
            hint = closest(unit.motion, self.costs)
            raise QueryError(
                f"{source}nothing says what the motion {unit.motion!r} costs{hint}; name it in a file with"
                " --costs, or give --default-cost"
            )
        return cost

    def rate(self, unit: FunctionalUnit) -> float:
        """Return the chance that a unit succeeds; raise `QueryError` if nothing says it."""
        rate = self.known_rate(unit)
        if rate is None:
            source = f"{unit.source}: " if unit.source.file else ""
            raise QueryError(
                f"{source}the motion {unit.motion!r} has no success rate"
                + closest(unit.motion, self.rates)
                + "; add it to motion.txt, or give --default-rate"
            )
        return rate


def seen_as(kitchen: Kitchen, image: Callable[[ObjectNode], ObjectNode]) -> Kitchen:
    """Return a kitchen with the images of its objects, each once.

    There is plenty of an image if there is of one of its originals.
    """
    stock: dict[ObjectNode, int | None] = {}
    for node in dict.fromkeys(kitchen.objects):
        quantity, seen = kitchen.quantities.get(node), image(node)
        before = stock.get(seen, 0)
        stock[seen] = None if before is None or quantity is None else before + quantity
    quantities = {node: quantity for node, quantity in stock.items() if quantity is not None}
    return replace(kitchen, objects=tuple(stock), quantities=quantities)


def _simple(motion: str) -> str:
    """Return a motion without the mark of a composite one."""
    return motion.rstrip("*").rstrip()


@lru_cache(maxsize=1 << 12)
def exact(rate: float) -> Fraction:
    """Return a rate as it was written: 0.7 means seven tenths, not the number that a computer has for it."""
    return Fraction(repr(float(rate)))


def chance_of(rates: Iterable[float]) -> Fraction:
    """Return the chance that all steps with these rates succeed, exactly."""
    known = [exact(rate) for rate in rates]
    # A product of fractions would be reduced at each step.
    above = math.prod(rate.numerator for rate in known)
    below = math.prod(rate.denominator for rate in known)
    return Fraction(above, below)


def _mapping(values: object, name: str, what: str) -> Mapping[Any, object]:
    if not isinstance(values, Mapping):
        raise QueryError(f"{name!r} is a dictionary of {what}, not {said(values)}")
    return values


def _check_node(node: object) -> None:
    if not isinstance(node, ObjectNode):
        advice = f"write ObjectNode({said(node)}), or give texts to World" if isinstance(node, str) else ""
        raise QueryError(
            f"an object of a kitchen is an ObjectNode, not {said(node)}" + (advice and f"; {advice}")
        )
