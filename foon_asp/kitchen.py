"""The kitchen: what is at hand, which labels are utensils, how likely motions succeed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from foon_asp.errors import QueryError, closest
from foon_asp.graph import FunctionalUnit, ObjectNode


@dataclass(frozen=True, slots=True)
class Kitchen:
    """Objects at hand, in file order; utensil labels; success rates by motion label, in [0, 1].

    `quantities`: how many there are of those objects of which there are not plenty, from 1. They matter
    where things are used up; retrieval takes no notice of them.
    """

    objects: tuple[ObjectNode, ...]
    utensils: frozenset[str] = frozenset()
    rates: Mapping[str, float] = field(default_factory=dict)
    default_rate: float | None = None
    quantities: Mapping[ObjectNode, int] = field(default_factory=dict)

    def known_rate(self, unit: FunctionalUnit) -> float | None:
        """Return the chance that a unit succeeds: its own, its motion's, the default, or None.

        A trailing `*` (a composite motion) does not matter to the look-up.
        """
        if unit.annotation.rate is not None:
            return unit.annotation.rate
        return self.rates.get(unit.motion.rstrip("*").rstrip(), self.default_rate)

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
