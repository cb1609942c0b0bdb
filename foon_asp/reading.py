"""The two readings of a unit, and what follows from them by plain graph search.

`encodings/units.lp` and `encodings/reachability.lp` say the same declaratively; the tests hold both
equal. Here it decides which part of a FOON is worth giving to the solver.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foon_asp.arrays import Index, Mask, Numbers, Places, Rounds, Rows, numbers
from foon_asp.graph import Foon
from foon_asp.search import fixpoint
from foon_asp.tables import ObjectTable


@dataclass(frozen=True, slots=True)
class Closure:
    """What can be reached from a kitchen, with the round (1, 2, …) in which it first can be."""

    available: Mapping[int, int]
    executable: Mapping[int, int]


class Reading:
    """What each unit needs and makes, given which labels are utensils.

    `needs[U]`: inputs that are not implied views; `makes[U]`: outputs that are not bare.
    With `strict` every input is needed. With `labels_only` every output is made: where nodes are labels
    alone, all are bare, and that does not tell a tool from a thing that is made.
    """

    def __init__(
        self,
        foon: Foon,
        utensils: Collection[str],
        *,
        strict: bool = False,
        labels_only: bool = False,
    ) -> None:
        self._objects = len(foon.objects)
        inputs, outputs = foon.units.inputs, foon.units.outputs
        stateful = foon.objects.states.lengths > 0
        self.needs = inputs if strict else inputs.where(~_implied(inputs, foon.objects, utensils))
        self.makes = outputs if labels_only else outputs.where(stateful[outputs.values])

    @cached_property
    def makers(self) -> Index:
        """The units that make an object, in file order."""
        return Index(self.makes, self._objects)

    @cached_property
    def users(self) -> Index:
        """The units that need an object, in file order."""
        return Index(self.needs, self._objects)

    def forward(self, kitchen: Iterable[int]) -> Closure:
        """Return the least fixpoint from the kitchen, over all units."""
        rounds = fixpoint(self.needs, self.users.rows, self.makes, kitchen)
        return Closure(*map(Rounds, rounds))

    def execute(self, kitchen: Container[int], units: Iterable[int]) -> Closure:
        """Return the least fixpoint from the kitchen over some units, as quick as these are few.

        What none of the units needs of the kitchen is left out.
        """
        users: dict[int, list[int]] = {}
        available: dict[int, int] = {}
        executable: dict[int, int] = {}
        missing: dict[int, int] = {}
        for unit in units:
            needs = self.needs[unit]
            available.update((thing, 0) for thing in needs if thing in kitchen)
            lacking = [thing for thing in needs if thing not in available]
            missing[unit] = len(lacking)
            for thing in lacking:
                users.setdefault(thing, []).append(unit)
        ready = [unit for unit, count in missing.items() if count == 0]
        depth = 0
        while ready:
            depth += 1
            executable.update((unit, depth) for unit in ready)
            made = dict.fromkeys(thing for unit in ready for thing in self.makes[unit])
            fresh = [thing for thing in made if thing not in available and thing not in kitchen]
            available.update((thing, depth) for thing in fresh)
            ready = []
            for unit in (unit for thing in fresh for unit in users.get(thing, ())):
                missing[unit] -= 1
                if missing[unit] == 0:
                    ready.append(unit)
        return Closure(available, executable)

    def backward(
        self, goals: Iterable[int], kitchen: Collection[int], units: Collection[int] | None = None
    ) -> list[int]:
        """Return, sorted, the units that can matter for the goals, among all or the given ones.

        A unit matters if it makes a goal, or something that a unit which matters needs and the
        kitchen does not have.
        """
        found: set[int] = set()
        open_ = [goal for goal in goals if goal not in kitchen]
        wanted = set(open_)
        while open_:
            for unit in self.makers.of(open_.pop()):
                if unit in found or (units is not None and unit not in units):
                    continue
                found.add(unit)
                for thing in self.needs[unit]:
                    if thing not in wanted and thing not in kitchen:
                        wanted.add(thing)
                        open_.append(thing)
        return sorted(found)


_NONE, _SEVERAL = -1, -2
"""What stands for nothing, and for several things, among the numbers of labels."""


def _implied(inputs: Rows, objects: ObjectTable, utensils: Collection[str]) -> Mask:
    """Say of each input of each unit whether it is an implied view.

    A view is a utensil that contains a single thing; it is implied where another input of the unit is that
    thing in that utensil. Both sides come down to a pair of labels, the thing's and the utensil's.
    """
    label, sole, places = _contents(objects)
    utensil = np.array([label in utensils for label in objects.labels], dtype=np.bool_)
    view = utensil[objects.label] & (sole != _NONE)
    words = 1 + max(int(part.max(initial=0)) for part in (label, sole, places.values))
    shown = sole.astype(np.int64) * words + label
    pairs = np.unique(shown[view])
    there = label[places.owners].astype(np.int64) * words + places.values
    known = np.isin(there, pairs)
    things = Rows(places.offsets, np.searchsorted(pairs, there).astype(np.int32)).where(known)

    implied: Mask = view[inputs.values]
    owners = inputs.owners.astype(np.int64) * len(pairs)
    seen = owners[implied] + np.searchsorted(pairs, shown[inputs.values[implied]])
    held = np.repeat(owners, things.lengths[inputs.values]) + things.gather(inputs.values)
    implied[implied] = np.isin(seen, held)
    return implied


def _contents(objects: ObjectTable) -> tuple[Numbers, Numbers, Rows]:
    """Return the label of each object, that of the only thing it contains, or -1, and those of what it is in.

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
    contents = Rows(states.offsets, content[states.values]).where(filled[states.values])
    sole = np.full(len(objects), _NONE, dtype=np.int32)
    sole[contents.owners] = np.maximum(contents.values, _NONE)
    for number in np.flatnonzero(contents.lengths > 1).tolist():
        things = set(objects[number].contents)
        sole[number] = codes[things.pop()] if len(things) == 1 else _NONE

    inside = (kinds.name == codes.get("in", _NONE)) & (kinds.relatum != _NONE)
    places = Rows(states.offsets, kinds.relatum[states.values]).where(inside[states.values])
    return label, sole, places


def _ends(table: Rows, which: Mask) -> tuple[Places, Places]:
    """Return where the first and the last value are of some rows that are not empty."""
    return table.offsets[:-1][which], table.offsets[1:][which] - 1
