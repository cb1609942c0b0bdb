"""What a level of detail must show, by the definitions."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from foon_asp.model.levels import LEVELS, project
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from support import brute_force

METHODS: list[tuple[str, tuple[str, ...]]] = [
    ("first", ()),
    ("ids", ()),
    ("greedy", ("success",)),
    ("greedy", ("inputs",)),
    ("optimal", ("units",)),
    ("optimal", ("success",)),
    ("optimal", ("inputs", "depth")),
]


def on(level: int, full: World) -> World:
    return World.of(full.foon, full.kitchen, strict=full.strict, level=level)


# --- Properties -----------------------------------------------------------------------------------

Ports = frozenset[ObjectNode]


def read_units(full: World, level: int) -> set[tuple[Ports, str, Ports]]:
    """Return what the units of a FOON need and make on a level, by the definitions."""
    return {
        (
            frozenset(project(thing, level) for thing in brute_force.needs(full, unit)),
            unit.motion,
            frozenset(project(thing, level) for thing in brute_force.makes(full, unit)),
        )
        for unit in full.foon.units
    }


def shown(view: World) -> list[tuple[Ports, str, Ports]]:
    """Return what the units of a domain need and make, by its own reading."""
    reading = view.units
    return [
        (
            frozenset(map(view.node, reading.needs[unit.id])),
            unit.motion,
            frozenset(map(view.node, reading.makes[unit.id])),
        )
        for unit in view.foon.units
    ]


def made(kitchen: Collection[ObjectNode], units: Sequence[tuple[Ports, str, Ports]]) -> set[ObjectNode]:
    at_hand = set(kitchen)
    before = -1
    while before < len(at_hand):
        before = len(at_hand)
        for needs, _, makes in units:
            if needs <= at_hand:
                at_hand |= makes
    return at_hand


def check_lower_levels(full: World) -> None:
    """Whatever can be reached or executed on a level can be on the levels below."""
    views = {level: on(level, full) for level in LEVELS}
    for upper, lower in ((3, 2), (2, 1), (3, 1)):
        above, below = views[upper], views[lower]
        there = {below.node(number) for number in below.closure.available}
        assert {project(above.node(number), lower) for number in above.closure.available} <= there
        pairs = zip(above.images, below.images, strict=True)
        done = {image for unit, image in pairs if unit in above.closure.executable}
        assert done <= below.closure.executable.keys()


def images(view: World, units: Sequence[UnitId]) -> list[UnitId]:
    return list(dict.fromkeys(view.images[unit] for unit in units))
