"""The two readings of a unit, and what follows from them by plain graph search.

`encodings/units.lp` and `encodings/reachability.lp` say the same declaratively; the tests hold both
equal. Here it decides which part of a FOON is worth giving to the solver.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from foon_asp.graph import Foon, FunctionalUnit, ObjectNode

Ids = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Closure:
    """What can be reached from a kitchen, with the round (1, 2, …) in which it first can be."""

    available: dict[int, int]
    executable: dict[int, int]


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
        objects = foon.objects
        views = {} if strict else _views(objects, utensils)
        bare = set() if labels_only else {number for number, node in enumerate(objects) if node.bare}
        self.needs: list[Ids] = []
        self.makes: list[Ids] = []
        for unit in foon.units:
            needs = unit.inputs
            if not views.keys().isdisjoint(needs):
                needs = tuple(o for o in needs if not _implied(o, unit, views, objects))
            self.needs.append(needs)
            makes = unit.outputs
            if not bare.isdisjoint(makes):
                makes = tuple(o for o in makes if o not in bare)
            self.makes.append(makes)

    @cached_property
    def makers(self) -> dict[int, list[int]]:
        """The units that make an object, in file order."""
        return _index(enumerate(self.makes))

    @cached_property
    def users(self) -> dict[int, list[int]]:
        """The units that need an object, in file order."""
        return _index(enumerate(self.needs))

    def forward(self, kitchen: Iterable[int], units: Collection[int] | None = None) -> Closure:
        """Return the least fixpoint from the kitchen, over all units or the given ones."""
        if units is None:
            units = range(len(self.needs))
            users = self.users
        else:
            users = _index((unit, self.needs[unit]) for unit in units)
        missing = {unit: len(self.needs[unit]) for unit in units}
        available = dict.fromkeys(kitchen, 0)
        executable: dict[int, int] = {}
        ready = [unit for unit, count in missing.items() if count == 0]
        fresh = list(available)
        depth = 0
        while fresh or ready:
            for thing in fresh:
                for unit in users.get(thing, ()):
                    missing[unit] -= 1
                    if missing[unit] == 0:
                        ready.append(unit)
            depth += 1
            fresh = []
            for unit in ready:
                executable[unit] = depth
                for thing in self.makes[unit]:
                    if thing not in available:
                        available[thing] = depth
                        fresh.append(thing)
            ready = []
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
            for unit in self.makers.get(open_.pop(), ()):
                if unit in found or (units is not None and unit not in units):
                    continue
                found.add(unit)
                for thing in self.needs[unit]:
                    if thing not in wanted and thing not in kitchen:
                        wanted.add(thing)
                        open_.append(thing)
        return sorted(found)


def _index(table: Iterable[tuple[int, Ids]]) -> dict[int, list[int]]:
    index: dict[int, list[int]] = {}
    for unit, things in table:
        for thing in things:
            index.setdefault(thing, []).append(unit)
    return index


def _views(objects: Sequence[ObjectNode], utensils: Collection[str]) -> dict[int, str]:
    """Return the utensils that contain a single thing, with the label of that thing."""
    views: dict[int, str] = {}
    for number, node in enumerate(objects):
        if node.label in utensils:
            contents = set(node.contents)
            if len(contents) == 1:
                views[number] = contents.pop()
    return views


def _implied(thing: int, unit: FunctionalUnit, views: dict[int, str], objects: Sequence[ObjectNode]) -> bool:
    content = views.get(thing)
    if content is None:
        return False
    vessel = objects[thing].label
    return any(
        objects[other].label == content and vessel in objects[other].containers for other in unit.inputs
    )
