"""Goals as people write them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectNode, State, contains, inside
from foon_asp.model.world import World
from foon_asp.query.goals import find_goal, written_object
from support.goal_checks import check_whatever_is_printed_can_be_typed

NODES = [
    ObjectNode.of("ice", [State("crushed"), inside("glass")]),
    ObjectNode.of("ice", [State("cubed"), State("frozen"), inside("tray")]),
    ObjectNode.of("ice cream", [State("soft"), inside("bowl")]),
    ObjectNode.of("ice cream", [State("soft"), contains("nut", "syrup"), inside("bowl")]),
    ObjectNode.of("bowl", [contains("ice cream")]),
    ObjectNode.of("bowl", [contains("ice cream"), State("on", relatum="stove")]),
    ObjectNode.of("lid", []),
    ObjectNode.of("lid", [State("attached to", relatum="stand mixer")]),
    ObjectNode.of("chicken in sauce", [State("cooked")]),
]


@pytest.fixture
def world() -> World:
    builder = FoonBuilder()
    for node in NODES:
        builder.object(node)
    return World.of(builder.build(), Kitchen(()))


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("ice in glass", 0),
        ("Ice [crushed]", 0),
        ("ice [frozen]", 1),
        ("ice [frozen, cubed] in [tray]", 1),
        ("ice cream {}", 2),
        ("ice cream {nut, syrup}", 3),
        ("ice cream {syrup}", 3),
        ("bowl on stove", 5),
        ("bowl contains {ice cream} on [stove]", 5),
        ("lid", 6),
        ("lid {}", 7),
        ("lid attached to [stand mixer]", 7),
        ("chicken in sauce", 8),
    ],
)
def test_parts_may_be_left_out(world: World, text: str, place: int) -> None:
    assert find_goal(world, text) == NODES[place]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ice", r"ambiguous goal 'ice': ice \[crushed\] in \[glass\]; ice \[cubed, frozen\]"),
        ("icecream", r"unknown goal 'icecream'.*closest: ice cream"),
        ("ice [molten]", r"unknown goal 'ice \[molten\]'; with this label there is ice \[crushed\]"),
        ("ice [crushed", r"cannot read '\[crushed' in the goal"),
        ("  ", "the goal is empty"),
    ],
)
def test_errors_name_the_closest(world: World, text: str, message: str) -> None:
    with pytest.raises(QueryError, match=message):
        find_goal(world, text)


@pytest.mark.parametrize("text", ["ice", "ice [frozen]", "ice in tray", "ice [cubed] in tray"])
def test_a_goal_of_the_data_folder_wins_over_other_matches(world: World, text: str) -> None:
    tray = NODES[1]
    other = ObjectNode.of("ice", [State("cubed"), inside("tray")])
    stray = ObjectNode.of("ice", [State("frozen"), inside("tray"), State("on", relatum="table")])
    several = replace(world, kitchen=Kitchen((other, stray)), goals=(tray, NODES[3]))
    # What is just so is meant even there.
    assert find_goal(several, text) == (other if text == str(other).replace("[tray]", "tray") else tray)


def test_an_object_that_is_just_what_is_named_is_meant() -> None:
    whole, in_bowl = (ObjectNode.of("onion", [State("whole"), *more]) for more in ([], [inside("bowl")]))
    flour, poured = ObjectNode("flour"), ObjectNode.of("flour", [inside("bowl")])
    world = World.of(FoonBuilder().build(), Kitchen((in_bowl, whole, poured, flour)), goals=[in_bowl, poured])
    assert find_goal(world, "onion [whole]") == whole
    assert find_goal(world, "onion") == in_bowl
    assert find_goal(world, "flour") == flour
    assert find_goal(world, "flour []") == flour
    assert find_goal(world, "flour {}") == poured


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (ObjectNode("egg [raw]"), '"egg [raw]"'),
        (ObjectNode("chicken in sauce"), '"chicken in sauce"'),
        (ObjectNode.of("chicken in sauce", [State("cooked")]), "chicken in sauce [cooked]"),
        (ObjectNode('3" pan'), '3" pan'),
        (ObjectNode('"big" pan'), '"""big"" pan"'),
        (ObjectNode.of("egg", [State("cut, diced")]), 'egg ["cut, diced"]'),
        (ObjectNode.of("beef", [State("seasoned", contents=("salt",))]), '"beef" seasoned {salt}'),
        (
            ObjectNode.of("beef", [State("raw"), State("seasoned", contents=("salt",))]),
            "beef [raw] seasoned {salt}",
        ),
        (ObjectNode.of("egg", [State("in", "pan", ("oil",))]), "egg in [pan]{oil}"),
        (ObjectNode.of("egg", [contains("oil"), inside("pan")]), "egg {oil} in [pan]"),
        (ObjectNode.of("egg", [contains()]), "egg {}"),
    ],
)
def test_quotes_say_what_would_be_read_otherwise(node: ObjectNode, text: str) -> None:
    assert str(node) == text
    assert written_object(text) == node


def test_whatever_is_printed_can_be_typed(built_in: Dataset) -> None:
    check_whatever_is_printed_can_be_typed(built_in)
