"""Criteria: what a task tree can cost, and how several costs are weighed against each other."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, fields
from fractions import Fraction

from foon_asp.errors import QueryError, closest
from foon_asp.facts import COST_SCALE, IMPOSSIBLE, success_chance


@dataclass(frozen=True, slots=True)
class Costs:
    """What a tree costs by each criterion; the less the better, but for `success`.

    `units`: functional units. `inputs`: input objects of all units. `success`: the chance in [0, 1] that all
    steps succeed, None if a rate is unknown. `depth`: rounds of parallel execution, None if the tree cannot
    be executed. `tools`: distinct utensils that are handled. `dirty`: distinct utensils that hold something.
    `motions`: distinct motions. `time`: seconds of annotated video, where they are known. `human`: steps
    that a human does.
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


CRITERIA = tuple(field.name for field in fields(Costs))

_TERM = re.compile(r"\s*(?:(?P<weight>\d+(?:\.\d+)?)\s*\*)?\s*(?P<name>[a-z_]+)\s*")
_MOST = 1_000_000
"""The largest weight that clingo is given: payments times weights must stay within 32 bits."""

_LARGEST = 2**31 - 1
"""The largest integer of clingo."""


@dataclass(frozen=True, slots=True)
class Level:
    """Criteria that are minimised together, as a weighted sum; several levels are lexicographic.

    In a sum, success counts as -ln of the chance.
    """

    terms: tuple[tuple[str, Fraction], ...]

    @classmethod
    def parse(cls, text: str) -> Level:
        """Read `a`, `a+b` or `2*a+0.5*b`; raise `QueryError`."""
        terms: dict[str, Fraction] = {}
        for part in text.split("+"):
            match = _TERM.fullmatch(part)
            if match is None:
                raise QueryError(f"{text!r} is no criterion; write a, or 2*a+b for a weighted sum")
            name, weight = match["name"], Fraction(match["weight"] or 1)
            if name not in CRITERIA:
                hint = closest(name, CRITERIA, 1)
                raise QueryError(f"there is no criterion {name!r}{hint}; there are {', '.join(CRITERIA)}")
            if name in terms:
                raise QueryError(f"the criterion {name!r} is named twice in {text!r}")
            if weight <= 0:
                raise QueryError(f"weights are above 0, unlike that of {name!r} in {text!r}")
            terms[name] = weight
        return cls(tuple(terms.items())).checked()

    def checked(self) -> Level:
        """Return this level; raise `QueryError` if clingo's integers cannot hold its weights."""
        if not all(0 < weight <= _MOST for weight in self.weights.values()):
            raise QueryError(f"the weights of {self} are too far apart: use less than six digits")
        return self

    def __str__(self) -> str:
        return "+".join(name if weight == 1 else f"{_written(weight)}*{name}" for name, weight in self.terms)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(name for name, _ in self.terms)

    @property
    def weights(self) -> dict[str, int]:
        """Return the weight of each payment, by criterion, as integers in the right ratio.

        Payments for success are scaled already, so it weighs 1 and the rest is scaled and rounded.
        """
        return {name: 1 if name == "success" else round(weight * self._scale) for name, weight in self.terms}

    @property
    def base(self) -> int:
        """What every tree pays on this level, so that clingo has a place for its costs and bounds."""
        return min(self.weights.values())

    @property
    def _scale(self) -> Fraction:
        """How many of clingo's units make one unit of the weighted sum."""
        weights = dict(self.terms)
        if "success" in weights:
            return COST_SCALE / weights["success"]
        if len(weights) == 1:
            return 1 / next(iter(weights.values()))
        return Fraction(math.lcm(*(weight.denominator for weight in weights.values())))

    def cost(self, costs: Costs) -> float:
        """Return what a tree costs on this level; infinite if that is unknown or success impossible."""
        total = 0.0
        for name, weight in self.terms:
            value = getattr(costs, name)
            if name == "success":
                value = -math.log(value) if value else math.inf
            total += float(weight) * (math.inf if value is None else value)
        return total

    def bound(self, paid: int) -> float:
        """Return what a sum of clingo's payments means: a chance for success alone, else a cost."""
        paid = max(0, paid - self.base)
        if self.names == ("success",):
            return success_chance(paid)
        if "success" in self.names and paid >= IMPOSSIBLE:
            return math.inf
        return float(paid / self._scale)

    def times(self, paid: int, factor: float) -> int:
        """Return the sum of clingo's payments that is a factor dearer; a chance is divided by the factor."""
        if self.names == ("success",):
            most = paid + math.floor(math.log(factor) * COST_SCALE)
        else:
            most = self.base + math.floor((paid - self.base) * factor)
        return min(most, _LARGEST)


def _written(weight: Fraction) -> str:
    if weight.denominator == 1:
        return str(weight.numerator)
    return f"{float(weight):.12f}".rstrip("0")


def parse_by(by: str | Sequence[str]) -> tuple[Level, ...]:
    """Read levels, the most important first: `a,b` or a sequence of such texts; raise `QueryError`."""
    texts = by.split(",") if isinstance(by, str) else [*by]
    levels = tuple(Level.parse(text) for text in texts if text.strip())
    names = [name for level in levels for name in level.names]
    if len(set(names)) != len(names):
        raise QueryError(f"a criterion is named twice in {','.join(map(str, levels))!r}")
    return levels
