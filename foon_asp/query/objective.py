"""Criteria: what a task tree can cost, and how several costs are weighed against each other."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from fractions import Fraction

from foon_asp.errors import QueryError
from foon_asp.values import a_list, said
from foon_asp.words import closest


@dataclass(frozen=True, slots=True)
class Costs:
    """What a tree costs by each criterion; the less the better, but for `success`.

    `units`: functional units. `inputs`: input objects of all units. `success`: the chance in [0, 1] that all
    steps succeed, None if a rate is unknown. `depth`: rounds of parallel execution, None if the tree cannot
    be executed. `tools`: distinct utensils that are handled. `dirty`: distinct utensils that hold something.
    `motions`: distinct motions. `time`: seconds of annotated video, where they are known. `human`: steps
    that a human does. `cost`: what the motions cost together, None if that of one is unknown.
    """

    units: int
    inputs: int
    success: float | None
    depth: int | None
    tools: int
    dirty: int
    motions: int
    time: int
    human: int
    cost: float | None = None


CRITERIA = tuple(field.name for field in fields(Costs))


_TERM = re.compile(r"\s*(?:(?P<weight>\d+(?:\.\d+)?)\s*\*)?\s*(?P<name>[a-z_]+)\s*")


_DIGITS = 30
"""How many digits a weight has at most."""


_WIDEST = 10**12
"""How many times the smallest weight of a sum the largest may be."""


Payments = Mapping[int, int]
"""What a tree pays at each of clingo's priorities."""


@dataclass(frozen=True, slots=True)
class Criterion:
    """What is minimised at once: one of `CRITERIA`, or a weighted sum of several.

    In a sum, success counts as -ln of the chance.
    """

    terms: tuple[tuple[str, Fraction], ...]

    @classmethod
    def parse(cls, text: str) -> Criterion:
        """Read `a`, `a+b` or `2*a+0.5*b`; raise `QueryError`."""
        terms: dict[str, Fraction] = {}
        for part in text.split("+"):
            match = _TERM.fullmatch(part)
            if match is None:
                raise QueryError(f"{said(text)} is no criterion; write a, or 2*a+b for a weighted sum")
            if len(match["weight"] or "") > _DIGITS:
                raise QueryError(f"the weight in {said(text)} has too many digits")
            name, weight = match["name"], Fraction(match["weight"] or 1)
            if name not in CRITERIA:
                hint = closest(name, CRITERIA, 1)
                raise QueryError(f"there is no criterion {said(name)}{hint}; there are {', '.join(CRITERIA)}")
            if name in terms:
                raise QueryError(f"the criterion {said(name)} is named twice in {said(text)}")
            if weight <= 0:
                raise QueryError(f"weights are above 0, unlike that of {said(name)} in {said(text)}")
            terms[name] = weight
        if max(terms.values()) > _WIDEST * min(terms.values()):
            raise QueryError(f"the weights of {text!r} are too far apart: use less than twelve digits")
        return cls(tuple(terms.items()))

    def __str__(self) -> str:
        return "+".join(name if weight == 1 else f"{_written(weight)}*{name}" for name, weight in self.terms)

    @property
    def names(self) -> tuple[str, ...]:
        """The criteria in the sum."""
        return tuple(name for name, _ in self.terms)

    def cost(self, costs: Costs) -> float:
        """Return what a tree costs by this criterion; infinite if that is unknown or success impossible."""
        total = 0.0
        for name, weight in self.terms:
            value = getattr(costs, name)
            if name == "success":
                value = -math.log(value) if value else math.inf
            total += float(weight) * (math.inf if value is None else value)
        return total

    def bound(self, cost: float) -> float:
        """Return a cost as an answer has what is proven: a chance for success alone."""
        return math.exp(-cost) if self.names == ("success",) else cost

    def cost_of(self, bound: float) -> float:
        """Return the cost that an answer has as a bound."""
        if self.names != ("success",):
            return bound
        return -math.log(bound) if bound > 0 else math.inf


def _written(weight: Fraction) -> str:
    if weight.denominator == 1:
        return str(weight.numerator)
    return f"{float(weight):.12f}".rstrip("0")


@dataclass(frozen=True, slots=True)
class Objective:
    """What a tree should be best by: criteria, the most important first; the later ones break ties.

    An empty objective leaves the choice to the method. `names` are all of `CRITERIA` that occur, alone or in
    a sum.
    """

    criteria: tuple[Criterion, ...] = ()
    names: frozenset[str] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        # Whoever answers a question asks for the names ten times.
        names = frozenset(name for criterion in self.criteria for name in criterion.names)
        object.__setattr__(self, "names", names)

    @classmethod
    def parse(cls, by: str | Iterable[str] | Objective) -> Objective:
        """Read `a,b`, or several such texts, where each of `a` and `b` may be a weighted sum `2*c+d`.

        Raises `QueryError` for an unknown criterion, or one that is named twice.
        """
        if isinstance(by, Objective):
            return by
        listed = [by] if isinstance(by, str) else a_list(by, "by", "criteria")
        for text in listed:
            if not isinstance(text, str):
                raise QueryError(f"a criterion is a text, not {said(text)}; there are {', '.join(CRITERIA)}")
        texts = [part for text in listed for part in text.split(",")]
        found = cls(tuple(Criterion.parse(text) for text in texts if text.strip()))
        names = [name for criterion in found for name in criterion.names]
        if len(set(names)) != len(names):
            raise QueryError(f"a criterion is named twice in {said(str(found))}")
        return found

    def __iter__(self) -> Iterator[Criterion]:
        return iter(self.criteria)

    def __len__(self) -> int:
        return len(self.criteria)

    def __str__(self) -> str:
        return ",".join(self.texts)

    @property
    def texts(self) -> tuple[str, ...]:
        """The criteria as they are written, each by itself."""
        return tuple(map(str, self.criteria))

    @property
    def complete(self) -> Objective:
        """The same, and last of all the fewest units, so that no tree has a superfluous one."""
        return self if "units" in self.names else Objective((*self.criteria, *UNITS.criteria))

    def costs(self, costs: Costs) -> list[float]:
        """Return what a tree costs by each criterion, as `Criterion.cost` does; lists compare as trees do."""
        # Chances are products of floating-point numbers: the last digits depend on the order.
        return [round(criterion.cost(costs), 9) for criterion in self]


UNITS = Objective.parse("units")
"""The fewest functional units."""
SUCCESS = Objective.parse("success")
"""The highest chance that all steps succeed."""
