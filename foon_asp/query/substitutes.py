"""What may replace each label in a world, and how well."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property

from foon_asp.model.world import World
from foon_asp.query.substitution import Replacement, Substitution

AVOIDED = "it is not to be in the dish"
"""Why something is left out of which no table says that it may be."""


class Substitutes:
    """What may replace the labels of a world, worked out label by label.

    What is `wanted` may replace others, though the FOON does not know it, and is never replaced itself; what
    is `avoided` may be left out, with a likeness of 0 where no table says more.
    """

    def __init__(
        self,
        world: World,
        substitution: Substitution,
        wanted: Collection[str] = (),
        avoided: Collection[str] = (),
    ) -> None:
        self._world = world
        self._similar = substitution.similar(world)
        self._left_out = {label: Replacement(label, None, 0.0, AVOIDED) for label in avoided}
        self._left_out |= {row.label: row for row in substitution.table if row.by is None}
        self._known: dict[str, Mapping[str | None, Replacement]] = {}
        self.wanted = frozenset(wanted)

    @cached_property
    def food(self) -> list[str]:
        """All labels but those of utensils, sorted."""
        world = self._world
        named = world.foon.named_labels.union(*(node.named_labels for node in world.strangers))
        return sorted((named | self.wanted) - world.kitchen.utensils)

    def of(self, label: str) -> Mapping[str | None, Replacement]:
        """Return what may replace a label; None: it may be left out."""
        if label not in self._known:
            found: dict[str | None, Replacement] = {}
            if label not in self.wanted:
                found.update(self._alike(label, self.food))
                if label in self._left_out:
                    found[None] = self._left_out[label]
            self._known[label] = found
        return self._known[label]

    def companions(self, label: str) -> dict[str, Replacement]:
        """Return what is wanted and could replace a label, the likest first, and so may go beside it."""
        return self._alike(label, sorted(self.wanted))

    def _alike(self, label: str, among: Iterable[str]) -> dict[str, Replacement]:
        alike = self._similar.replacements(label, among)
        return {by: Replacement(label, by, likeness.value, likeness.why) for by, likeness in alike}
