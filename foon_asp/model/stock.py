"""What is at hand where a kitchen does not list it: objects that are named by their label, or none at all.

Of all that a FOON knows, the kitchen has what no unit makes; what is made, it makes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from foon_asp.model.arrays import Mask
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectId, ObjectNode
from foon_asp.model.units import Units


def listed(kitchen: Kitchen, units: Units) -> Kitchen:
    """Return a kitchen that lists all its objects: those of its labels, and without any what no unit makes.

    A label that the FOON does not know is that of an object without states.
    """
    if not (kitchen.labels or (not kitchen.stated and not kitchen.objects)):
        return kitchen
    made = _made(units)
    found = list(kitchen.objects)
    for label in kitchen.labels:
        found += labelled(units, label, made) if units.foon.labelled(label) else [ObjectNode(label)]
    if not kitchen.stated and not found:
        needed = np.zeros(len(made), dtype=np.bool_)
        needed[units.needs.values] = True
        found = _nodes(units, np.flatnonzero(needed & ~made).tolist())
    return replace(kitchen, objects=tuple(dict.fromkeys(found)), labels=())


def labelled(units: Units, label: str, made: Mask | None = None) -> list[ObjectNode]:
    """Return the object nodes with a label that no unit makes; `made` says which ones units make."""
    made = _made(units) if made is None else made
    numbers = dict.fromkeys(map(units.read, units.foon.objects.labelled(label)))
    return _nodes(units, (number for number in numbers if not made[number]))


def _made(units: Units) -> Mask:
    mask = np.zeros(len(units.foon.objects), dtype=np.bool_)
    mask[units.makes.values] = True
    return mask


def _nodes(units: Units, numbers: Iterable[int]) -> list[ObjectNode]:
    return [units.foon.objects[ObjectId(number)] for number in numbers]
