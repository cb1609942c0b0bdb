"""The two readings of a functional unit: what it needs, and what it makes.

`encodings/units.lp` says the same declaratively; the tests hold both equal.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from foon_asp.model.arrays import Index, Kept, Mask, Numbers, Places, Rows, distinct, numbers, places
from foon_asp.model.foon import Foon
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.relations import Matching, StandIns
from foon_asp.model.tables import ObjectTable


class Vessels(NamedTuple):
    """The utensils that are handled where an object is listed, and those that hold something there."""

    handled: frozenset[str]
    filled: frozenset[str]


class Units:
    """What each unit needs and makes, given which labels are utensils.

    `takes[U]` and `gives[U]`: inputs and outputs, as `match_relations` reads them. `needs[U]`: what it takes,
    but for implied views; `makes[U]`: what it gives, but for bare objects that are only listed again: those
    of utensils, and those whose label an input has. `needed[U]` and `made[U]` are the same, for searches that
    come by again and again; `vessels[O]` are the utensils in an object.
    With `strict` every input is needed. With `labels_only` every output is made: where nodes are labels
    alone, all are bare, and that does not tell a tool from an object that is made. `products` are the bare
    outputs that are made, for a FOON whose units are those of another one with other labels or less known of
    them: there it was read what is a product.
    """

    def __init__(
        self,
        foon: Foon,
        utensils: Collection[str],
        *,
        strict: bool = False,
        labels_only: bool = False,
        match_relations: Matching = "strict",
        products: Collection[tuple[UnitId, ObjectId]] | None = None,
    ) -> None:
        self.foon = foon
        self.strict = strict
        self.labels_only = labels_only
        self.match_relations = match_relations
        self.takes, self.gives = foon.units.inputs, foon.units.outputs
        self.stand_ins = StandIns(foon.objects) if self.loose else None
        if self.stand_ins is not None:
            self.takes, self.gives = self.stand_ins.read(self.takes), self.stand_ins.read(self.gives)
        takes, gives = self.takes, self.gives
        self.needs = takes if strict else takes.where(~_implied(takes, foon.objects, utensils, self.loose))
        if labels_only:
            self.makes = gives
        elif products is None:
            self.makes = gives.where(~_listed_again(takes, gives, foon.objects, utensils))
        else:
            self.makes = gives.where(_stateful(gives, foon.objects) | _among(gives, products))
        self.needed: Kept[UnitId, tuple[ObjectId, ...]] = Kept(self.needs.__getitem__)
        self.made: Kept[UnitId, tuple[ObjectId, ...]] = Kept(self.makes.__getitem__)
        # Not a method: what refers to itself stays in memory until Python looks for cycles.
        self.vessels: Kept[ObjectId, Vessels] = Kept(partial(_vessels, foon.objects, frozenset(utensils)))

    @cached_property
    def written(self) -> dict[tuple[UnitId, bool], str]:
        """What was written of units; `foon_asp.retrieval.wire` keeps it."""
        return {}

    @property
    def loose(self) -> bool:
        """Whether what is on, under or with something counts as in it."""
        return self.match_relations == "loose"

    def read(self, number: ObjectId) -> ObjectId:
        """Return the id of the object as which one is read; what the FOON does not know is read as itself."""
        if self.stand_ins is None or number >= len(self.stand_ins.numbers):
            return number
        return ObjectId(int(self.stand_ins.numbers[number]))

    def stand_in(self, node: ObjectNode) -> ObjectNode:
        """Return the object node as which a node is read."""
        return node if self.stand_ins is None else self.stand_ins.of(node)

    @cached_property
    def makers(self) -> Index[ObjectId, UnitId]:
        """The units that make an object, in file order."""
        return Index(self.makes, len(self.foon.objects))

    @cached_property
    def making(self) -> Kept[ObjectId, tuple[UnitId, ...]]:
        """The same for searches, of any object: none where there are none."""
        return Kept(self.makers.of)

    @cached_property
    def users(self) -> Index[ObjectId, UnitId]:
        """The units that need an object, in file order."""
        return Index(self.needs, len(self.foon.objects))


def _stateful(ports: Rows[UnitId, ObjectId], objects: ObjectTable) -> Mask:
    """Say of each port whether its object has a state."""
    return (objects.states.lengths > 0)[ports.values]


def _among(ports: Rows[UnitId, ObjectId], some: Collection[tuple[UnitId, ObjectId]]) -> Mask:
    """Say of each port whether it is one of some."""
    pairs = zip(ports.owners.tolist(), ports.values.tolist(), strict=True)
    return np.array([pair in some for pair in pairs], dtype=np.bool_)


def _listed_again(
    takes: Rows[UnitId, ObjectId],
    gives: Rows[UnitId, ObjectId],
    objects: ObjectTable,
    utensils: Collection[str],
) -> Mask:
    """Say of each output whether it is bare, and a utensil or of the label of an input of the same unit."""
    again = ~_stateful(gives, objects)
    utensil = np.array([label in utensils for label in objects.labels], dtype=np.bool_)
    asked = again & ~utensil[objects.label[gives.values]]
    if asked.any():
        units = np.zeros(len(takes), dtype=np.bool_)
        units[gives.owners[asked]] = True
        own = units[takes.owners]
        before, behind = (
            side.owners[which].astype(np.int64) * len(objects.labels) + objects.label[side.values[which]]
            for side, which in ((takes, own), (gives, asked))
        )
        _, again[asked] = places(behind, distinct(before))
    return again


def _vessels(objects: ObjectTable, utensils: frozenset[str], number: ObjectId) -> Vessels:
    node = objects[number]
    holding = {node.label, *node.containers} if node.contents else set(node.containers)
    return Vessels(utensils.intersection(node.handled_labels), utensils & holding)


_Labels = Rows[ObjectId, int]
"""For each object some labels, as numbers."""

_NONE, _SEVERAL = -1, -2
"""What stands for nothing, and for several labels, among the numbers of labels."""


def _implied(
    inputs: Rows[UnitId, ObjectId], objects: ObjectTable, utensils: Collection[str], loose: bool
) -> Mask:
    """Say of each input of each unit whether it is an implied view.

    A view is a utensil that contains a single label; it is implied where another input of the unit is an
    object of that label in that utensil. Both sides come down to a pair of labels: content and utensil.
    """
    label, sole, vessels = _contents(objects, loose)
    utensil = np.array([label in utensils for label in objects.labels], dtype=np.bool_)
    view = utensil[objects.label] & (sole != _NONE)
    words = 1 + max(int(part.max(initial=0)) for part in (label, sole, vessels.values))
    shown = sole.astype(np.int64) * words + label
    pairs = distinct(shown[view])
    there = label[vessels.owners].astype(np.int64) * words + vessels.values
    place, known = places(there, pairs)
    shows: _Labels = Rows(vessels.offsets, place.astype(np.int32)).where(known)

    implied: Mask = view[inputs.values]
    owners = inputs.owners.astype(np.int64) * len(pairs)
    seen = owners[implied] + np.searchsorted(pairs, shown[inputs.values[implied]])
    held = np.repeat(owners, shows.lengths[inputs.values]) + shows.gather(inputs.values)
    _, implied[implied] = places(seen, distinct(held))
    return implied


def _contents(objects: ObjectTable, loose: bool) -> tuple[Numbers, Numbers, _Labels]:
    """Return the label of each object, that of all that it contains, or -1, and those of what it is in.

    With `loose` they are those of whatever it is related to.

    Labels are numbers of words here: those of the states, and further ones for labels that no state names.
    """
    kinds, states = objects.kinds, objects.states
    codes = dict(kinds.codes)
    label = numbers(codes.setdefault(label, len(codes)) for label in objects.labels)[objects.label]

    filled = (kinds.name == codes.get("contains", _NONE)) & (kinds.contents.lengths > 0)
    content = np.full(len(kinds), _NONE, dtype=np.int32)
    first, last = (kinds.contents.values[end] for end in _ends(kinds.contents, filled))
    # Contents are sorted, so all are the same if the first and the last one are.
    content[filled] = np.where(first == last, first, _SEVERAL)
    contents: _Labels = Rows(states.offsets, content[states.values]).where(filled[states.values])
    sole = np.full(len(objects), _NONE, dtype=np.int32)
    sole[contents.owners] = np.maximum(contents.values, _NONE)
    for number in map(ObjectId, np.flatnonzero(contents.lengths > 1).tolist()):
        distinct = set(objects[number].contents)
        sole[number] = codes[distinct.pop()] if len(distinct) == 1 else _NONE

    inside = kinds.relatum != _NONE
    if not loose:
        inside &= kinds.name == codes.get("in", _NONE)
    vessels: _Labels = Rows(states.offsets, kinds.relatum[states.values]).where(inside[states.values])
    return label, sole, vessels


def _ends(table: Rows[int, int], which: Mask) -> tuple[Places, Places]:
    """Return where the first and the last value are of some rows that are not empty."""
    return table.offsets[:-1][which], table.offsets[1:][which] - 1
