"""What an export was made of, as hashes: a plan is decoded with the FOON and the kitchen of its export."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from functools import cache

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World


def foon_hash(world: World, units: Mapping[str, UnitId]) -> str:
    """Return a hash of what some units list, need and make, each by the name of an action.

    The order of objects does not matter, nor do other units of the FOON.
    """

    @cache
    def meaning(number: ObjectId) -> tuple[object, ...]:
        # Not the text of the node: how that is written may change.
        return world.node(number).sort_key

    def meanings(objects: Iterable[ObjectId]) -> list[tuple[object, ...]]:
        return sorted(map(meaning, objects))

    return _hash(
        [name, unit.motion, *map(meanings, (unit.inputs, unit.outputs, *ports))]
        for name, unit, ports in (
            (name, world.foon.units[number], (world.units.needs[number], world.units.makes[number]))
            for name, number in sorted(units.items())
        )
    )


def kitchen_hash(effects: Effects, objects: Mapping[str, ObjectId]) -> str:
    """Return a hash of which of some objects are at hand, each by its name, and how many if that matters."""
    stock, counted = effects.world.stock, effects.counted
    return _hash([name, counted.get(number)] for name, number in sorted(objects.items()) if number in stock)


def _hash(rows: Iterable[list[object]]) -> str:
    digest = hashlib.sha256()
    for row in rows:
        digest.update(json.dumps(row).encode() + b"\n")
    return digest.hexdigest()
