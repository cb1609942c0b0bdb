"""What is used up and what is there, by the definitions, written down once more.

Shares nothing with `foon_asp.model.consumption`, `foon_asp.model.supply` or the encodings.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from foon_asp.model.levels import FULL, project
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from support import brute_force

State = tuple[frozenset[ObjectNode], tuple[tuple[ObjectNode, int], ...]]
"""What was made, and how many of each counted object the kitchen has left."""


class Deed(NamedTuple):
    """What some unit needs, adds, restores and takes away."""

    needs: set[ObjectNode]
    adds: set[ObjectNode]
    restores: set[ObjectNode]
    takes: set[ObjectNode]


def never_used_up(where: World) -> set[ObjectNode]:
    """Return all tools, and what on a lower level stands for several objects; no FOON is all tools."""
    full = where.full
    every = {*full.foon.objects, *full.kitchen.objects}
    stands = [(project(thing, where.level), thing) for thing in every]
    several = {image for image, one in stands for also, other in stands if image == also and one != other}
    tools = {image for image, thing in stands if not thing.states}
    if not any(thing.states for thing in every):
        return several
    if where.level == FULL:
        return tools.difference(*(brute_force.makes(where, unit) for unit in where.foon.units))
    return several | tools


class Tokens:
    """What units of a world do under one of the semantics, and whatever else lists objects on two sides."""

    def __init__(self, where: World, semantics: str) -> None:
        self.where, self.semantics = where, semantics
        stock = dict.fromkeys(where.kitchen.objects)
        self.counts = {} if semantics == "add" else dict(where.kitchen.quantities)
        self.endless = stock.keys() - self.counts.keys()
        self.lasting = never_used_up(where)
        self.start: State = (frozenset(), tuple(sorted(self.counts.items(), key=str)))
        self.deeds = {
            unit.id: self.deed(
                *([where.node(number) for number in side] for side in (unit.inputs, unit.outputs))
            )
            for unit in where.foon.units
        }

    def deed(self, inputs: Sequence[ObjectNode], outputs: Sequence[ObjectNode]) -> Deed:
        needs, made = brute_force.needed(self.where, inputs), brute_force.made(self.where, inputs, outputs)
        # What is needed and given back is no second one, nor is a counted view that was there.
        restores = made.intersection(inputs, self.counts) - needs
        return Deed(needs, made - needs - restores, restores, self._taken(inputs, outputs, made))

    def _taken(
        self, inputs: Sequence[ObjectNode], outputs: Sequence[ObjectNode], made: set[ObjectNode]
    ) -> set[ObjectNode]:
        if self.semantics == "add":
            return set()
        taken = {*inputs} - {*outputs}
        if self.semantics == "transform":
            held = [
                content
                for output in outputs
                for state in output.states
                if state.name == "contains"
                for content in state.contents or ()
            ]
            forms = {output.label for output in made}
            taken = {thing for thing in taken if thing.label in forms or thing.label in held}
        return taken - self.endless - self.lasting

    def has(self, state: State, thing: ObjectNode) -> bool:
        made, left = state
        return thing in self.endless or thing in made or dict(left).get(thing, 0) > 0

    def lacks(self, state: State, deed: Deed) -> set[ObjectNode]:
        return {need for need in deed.needs if not self.has(state, need)}

    def after(self, state: State, deeds: Iterable[Deed]) -> State:
        made, counts = set(state[0]), dict(state[1])
        for deed in deeds:
            restored = {thing for thing in deed.restores if thing not in made and not counts[thing]}
            for thing in deed.takes:
                if thing in made:
                    made.discard(thing)
                elif thing in counts:
                    counts[thing] = max(0, counts[thing] - 1)
            made |= deed.adds | restored
        return frozenset(made), tuple(sorted(counts.items(), key=str))

    def disturbs(self, one: Deed, other: Deed) -> bool:
        """Whether one unit takes away what the other needs, takes or adds."""
        return bool(one.takes & (other.needs | other.takes | other.adds | other.restores))

    def steps(self, state: State) -> Iterator[tuple[UnitId, ...]]:
        """Yield every set of units that can be done at once."""
        ready = [unit for unit, deed in self.deeds.items() if not self.lacks(state, deed)]
        for size in range(len(ready) + 1):
            for units in combinations(ready, size):
                pairs = [(self.deeds[a], self.deeds[b]) for a, b in combinations(units, 2)]
                if not any(self.disturbs(a, b) or self.disturbs(b, a) for a, b in pairs):
                    yield units
