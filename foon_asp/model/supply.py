"""What is at hand while units are executed one by one."""

from __future__ import annotations

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId


class Supply:
    """What is at hand while units are executed.

    Of a counted object that is at hand both as a product and in the kitchen, the product is used first.
    """

    def __init__(self, effects: Effects) -> None:
        self.effects = effects
        self.made: set[ObjectId] = set()
        self.left = dict(effects.counted)

    @property
    def at_hand(self) -> frozenset[ObjectId]:
        """All that is there now."""
        left = (object_id for object_id, count in self.left.items() if count > 0)
        return frozenset(self.made).union(self.effects.endless, left)

    def has(self, object_id: ObjectId) -> bool:
        """Whether an object is there now."""
        return object_id in self.effects.endless or object_id in self.made or self.left.get(object_id, 0) > 0

    def used_up(self, unit: UnitId) -> list[ObjectId]:
        """Return what a unit would use up of what is there; an implied view may be gone already."""
        return [object_id for object_id in self.effects.deletes(unit) if self.has(object_id)]

    def lacks(self, unit: UnitId) -> list[ObjectId]:
        """Return what a unit needs and is not there."""
        return [object_id for object_id in self.effects.needs(unit) if not self.has(object_id)]

    def execute(self, unit: UnitId) -> list[ObjectId]:
        """Execute a unit, or return what it lacks and change nothing."""
        lacking = self.lacks(unit)
        if not lacking:
            self.pretend(unit)
        return lacking

    def pretend(self, unit: UnitId) -> None:
        """Have all that a unit makes, whether it lacks something or not; that may be what it gives back."""
        effects = self.effects
        lent = set(self.lacks(unit)).intersection(effects.world.units.makes[unit])
        restored = [object_id for object_id in effects.restores(unit) if not self.has(object_id)]
        for object_id in self.used_up(unit):
            if object_id in self.made:
                self.made.remove(object_id)
            else:
                self.left[object_id] -= 1
        self.made.update(effects.adds(unit), restored, lent)
