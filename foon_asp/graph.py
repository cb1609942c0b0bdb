"""The FOON itself: object nodes, functional units, and the graph they form. Pure data, no I/O.

Object nodes and functional units are small values, made when they are asked for; the graph itself is kept in
arrays, so that a million units fit into memory and are searched quickly.
"""

from __future__ import annotations

from dataclasses import dataclass

from foon_asp.tables import ObjectTable, UnitTable
from foon_asp.values import (
    Annotation,
    FunctionalUnit,
    Mark,
    ObjectNode,
    Source,
    State,
    contains,
    inside,
)

__all__ = [
    "Annotation",
    "Foon",
    "FunctionalUnit",
    "Mark",
    "ObjectNode",
    "Source",
    "State",
    "contains",
    "inside",
]


@dataclass(frozen=True, slots=True)
class Foon:
    """A FOON: object nodes and functional units, each named by its index.

    `builder.FoonBuilder` makes one, or `store.open_store` from tables on disk.
    """

    objects: ObjectTable
    units: UnitTable
    duplicates: int = 0

    def id_of(self, node: ObjectNode) -> int | None:
        """Return the id of a node, or None if the FOON does not know it."""
        return self.objects.find([node])[0]

    def labelled(self, label: str) -> list[ObjectNode]:
        """Return all object nodes with a label."""
        return [self.objects[number] for number in self.objects.labelled(label)]

    @property
    def motions(self) -> list[str]:
        """All motion labels, sorted."""
        return sorted(self.units.motions)

    @property
    def labels(self) -> set[str]:
        """The labels of all object nodes."""
        return set(self.objects.labels)

    @property
    def named_labels(self) -> set[str]:
        """Every label that an object node names: its own, those of relata and of contents."""
        return self.labels | self.objects.kinds.named

    def marked_goals(self) -> list[ObjectNode]:
        """Return the outputs that the annotators marked as intended goals, in file order."""
        found: dict[ObjectNode, None] = {}
        for unit in self.units:
            ports = unit.inputs + unit.outputs
            for port, mark in zip(ports, unit.annotation.marks, strict=False):
                if mark.goal:
                    found[self.objects[port]] = None
        return list(found)
