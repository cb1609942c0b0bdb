"""Whether dishes really use what they are to be made with."""

from __future__ import annotations

from foon_asp.model.node import FunctionalUnit
from foon_asp.model.reachability import within
from foon_asp.model.world import World
from foon_asp.retrieval.suggest import Suggestions

# --- Made with certain things ---------------------------------------------------------------------


def takes(where: World, unit: FunctionalUnit, label: str) -> bool:
    """Say from the definition alone whether a unit takes something called so."""
    for number in unit.inputs:
        thing = where.foon.objects[number]
        if thing.label == label:
            return True
        if any(state.relatum == label or label in (state.contents or ()) for state in thing.states):
            return True
    return False


# --- Real data ------------------------------------------------------------------------------------


def really_used(where: World, result: Suggestions) -> bool:
    return all(
        where.id_of(each.dish)
        not in within(
            where.units,
            where.stock,
            [unit.id for unit in each.tree.functional_units if not takes(where, unit, label)],
        ).available
        for each in result.dishes
        for label in result.using
    )
