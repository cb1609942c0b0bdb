"""What the kitchen can make, as text."""

from __future__ import annotations

from collections.abc import Iterable

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World


def reach_text(
    world: World, available: Iterable[ObjectId], executable: Iterable[UnitId], *, listing: bool
) -> str:
    """Say how much of the FOON the kitchen can execute and make."""
    available = list(available)
    made = [object_id for object_id in available if object_id not in world.stock]
    lines = [
        f"units    {len(list(executable)):6} of {len(world.foon.units)} can be executed",
        f"objects  {len(available):6} available: {len(world.stock)} in the kitchen,"
        f" {len(made)} can be made (the FOON knows {len(world.foon.objects)})",
    ]
    if listing:
        lines += sorted(str(world.node(object_id)) for object_id in made)
    return "\n".join(lines) + "\n"
