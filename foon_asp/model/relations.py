"""How relations between objects are matched: by name, or loosely, where what is on a thing counts as in it.

Published JSON says only that an object is in another one, annotated files say how. `encodings/units.lp` reads
objects by these stand-ins, too.
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from foon_asp.errors import QueryError
from foon_asp.model.arrays import K, Numbers, Rows
from foon_asp.model.node import ObjectId, ObjectNode, inside
from foon_asp.model.tables import ObjectTable
from foon_asp.values import said

Matching = Literal["strict", "loose"]
"""How relations are matched; `strict` tells `on` from `in`."""

MATCHINGS: tuple[Matching, ...] = get_args(Matching)


def check_matching(matching: object) -> None:
    """Raise `QueryError` if relations cannot be matched so."""
    if matching not in MATCHINGS:
        raise QueryError(f"relations are matched {' or '.join(MATCHINGS)}, not {said(matching)}")


def loosened(node: ObjectNode) -> ObjectNode:
    """Return an object node with all its relations called `in`."""
    related = [state for state in node.states if state.relatum is not None and state.contents is None]
    if all(state.name == "in" for state in related):
        return node
    others = (state for state in node.states if state not in related)
    return ObjectNode.of(node.label, (*others, *(inside(state.relatum or "") for state in related)))


class StandIns:
    """Which object of a FOON stands for each: the first that differs only in the names of relations."""

    def __init__(self, objects: ObjectTable) -> None:
        self._objects = objects
        self._first: dict[ObjectNode, ObjectId] = {}
        self.numbers: Numbers = np.fromiter(
            (self._first.setdefault(loosened(objects[number]), number) for number in objects.ids),
            dtype=np.int32,
            count=len(objects),
        )

    def of(self, node: ObjectNode) -> ObjectNode:
        """Return the object that stands for a node; one that resembles none of the FOON stands for itself."""
        number = self._first.get(loosened(node))
        return node if number is None else self._objects[number]

    def read(self, ports: Rows[K, ObjectId]) -> Rows[K, ObjectId]:
        """Return rows of objects with their stand-ins, each once in a row."""
        read = Rows[K, ObjectId](ports.offsets, self.numbers[ports.values])
        pairs = read.owners.astype(np.int64) * len(self.numbers) + read.values
        first = np.zeros(len(pairs), dtype=np.bool_)
        first[np.unique(pairs, return_index=True)[1]] = True
        return read.where(first)
