"""How long each unit takes: as its video shows, as a table says, or as others of its motion took."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from statistics import median

from foon_asp import limits
from foon_asp.model.node import UnitId
from foon_asp.model.world import World
from foon_asp.planning.resources import plain_motion

STEPS = "steps"
"""The unit of time where no duration is known at all: every step takes 1."""

SECONDS = "s"


@dataclass(frozen=True, slots=True)
class Durations:
    """Whole seconds for each unit, at least 1; `guessed` are those that neither a video nor the table says.

    Where nothing is known at all, every step takes 1, and `unit` is `steps` instead of `s`.
    """

    seconds: Mapping[UnitId, int]
    guessed: frozenset[UnitId]
    unit: str


def durations(world: World, units: Iterable[UnitId], table: Mapping[str, float]) -> Durations:
    """Return how long units take: by their own video, by the table of motions, or guessed.

    A guess is the median of what is known of units with the same motion in the whole FOON, else of all.
    """
    asked = list(units)
    known: dict[UnitId, int] = {}
    by_motion: dict[str, list[int]] = {}
    for unit in world.foon.units:
        limits.check()
        motion = plain_motion(unit.motion)
        stated = unit.duration or table.get(motion)
        if stated is not None:
            known[unit.id] = math.ceil(stated)
            by_motion.setdefault(motion, []).append(known[unit.id])
    if not known and not table:
        return Durations(dict.fromkeys(asked, 1), frozenset(), STEPS)
    medians = {motion: _middle(values) for motion, values in by_motion.items()}
    usual = _middle([*known.values()] or [math.ceil(value) for value in table.values()])
    motions = {unit: plain_motion(world.foon.units[unit].motion) for unit in asked}
    return Durations(
        {unit: known.get(unit, medians.get(motions[unit], usual)) for unit in asked},
        frozenset(unit for unit in asked if unit not in known),
        SECONDS,
    )


def _middle(values: list[int]) -> int:
    """Return the median, in whole seconds."""
    return max(1, math.ceil(median(values)))
