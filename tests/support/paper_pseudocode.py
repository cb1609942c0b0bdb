"""The retrieval program that the seed paper prints, transcribed literally: a search from the goal.

It never asks whether the chosen units can be executed. It reads the FOON itself and shares nothing with
`foon_asp.units` or the encodings.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from foon_asp.model.node import FunctionalUnit, ObjectNode, UnitId
from foon_asp.model.world import World


def retrieve(world: World, goal: ObjectNode, heuristic: str) -> list[UnitId]:
    """Return unit ids in the order in which they are found; `heuristic`: first, success or inputs."""
    objects = world.foon.objects
    kitchen = world.kitchen.objects
    tree: list[UnitId] = []
    searched: list[ObjectNode] = []
    queue = deque([goal])
    while queue:
        thing = queue.popleft()
        if thing in searched or thing in kitchen:
            continue
        searched.append(thing)
        candidates = [
            unit
            for unit in world.foon.units
            if any(objects[output] == thing for output in unit.outputs) and _makes(world, unit, thing)
        ]
        if not candidates:
            continue
        chosen = _choose(world, candidates, heuristic)
        if chosen.id in tree:
            continue
        tree.append(chosen.id)
        inputs = [objects[number] for number in chosen.inputs]
        for other in inputs:
            if other not in queue and not _shown_twice(world, other, inputs):
                queue.append(other)
    return tree


def _makes(world: World, unit: FunctionalUnit, output: ObjectNode) -> bool:
    """Say whether an output has states, or else is neither a utensil nor called like an input."""
    before = [world.foon.objects[number].label for number in unit.inputs]
    return bool(output.states) or not (output.label in world.kitchen.utensils or output.label in before)


def _choose(world: World, candidates: Sequence[FunctionalUnit], heuristic: str) -> FunctionalUnit:
    chosen = candidates[0]
    for unit in candidates[1:]:
        if heuristic == "success":
            better = world.kitchen.rates[unit.motion] > world.kitchen.rates[chosen.motion]
        elif heuristic == "inputs":
            better = len(unit.inputs) < len(chosen.inputs)
        else:
            better = False
        if better:
            chosen = unit
    return chosen


def _shown_twice(world: World, thing: ObjectNode, inputs: Sequence[ObjectNode]) -> bool:
    """A utensil with one thing in it is skipped if that thing is an input too, in that utensil."""
    if thing.label not in world.kitchen.utensils or len(thing.contents) != 1:
        return False
    content = thing.contents[0]
    return any(other.label == content and thing.label in other.containers for other in inputs)
