"""What units use up, and in which order they can be executed."""

from __future__ import annotations

import pytest

from foon_asp.errors import QueryError
from foon_asp.model.consumption import Effects
from foon_asp.model.node import UnitId
from foon_asp.model.supply import Supply
from support.plan_worlds import KITCHEN_UNITS, with_quantities
from support.small_foons import node, world

# --- Effects and replay -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("semantics", "unit", "expected"),
    [
        ("add", 1, set()),
        ("transform", 0, {"onion[whole]"}),
        ("consume", 0, {"onion[whole]"}),
        # The lid neither became anything nor went anywhere.
        ("transform", 1, {"onion[chopped]", "bowl[empty]"}),
        ("consume", 1, {"onion[chopped]", "bowl[empty]", "lid"}),
        # The bowl with onion in it is an implied view, and is gone all the same.
        ("transform", 2, {"bowl{onion}", "onion[chopped]@bowl", "salt"}),
        ("consume", 2, {"bowl{onion}", "onion[chopped]@bowl", "salt"}),
    ],
)
def test_what_each_semantics_uses_up(semantics: str, unit: UnitId, expected: set[str]) -> None:
    where = world(KITCHEN_UNITS, "(knife)", utensils=["bowl"])
    deleted = {where.node(thing) for thing in Effects(where, semantics).deletes(unit)}
    assert deleted == {node(text) for text in expected}


def test_an_unknown_semantics_is_refused() -> None:
    with pytest.raises(QueryError, match="unknown semantics 'eat'; there are add, transform, consume"):
        Effects(world(KITCHEN_UNITS), "eat")


def test_a_product_is_used_up_before_the_stock() -> None:
    units = ("a -make-> egg", "egg -fry-> dish", "egg -boil-> soup")
    where = with_quantities(units, "a + egg", egg=1)
    supply = Supply(Effects(where, "consume"))
    assert [supply.execute(unit) for unit in map(UnitId, (0, 1, 2))] == [[], [], []]
    assert not supply.has(where.id_of(node("egg")))
    assert supply.execute(UnitId(1)) == [where.id_of(node("egg"))]
