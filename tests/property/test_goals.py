"""Whatever object nodes are called, what is printed of one means that one, and no other."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.errors import QueryError
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectNode, State
from foon_asp.model.world import World
from foon_asp.query.goals import find_object, written_object
from support import drawn_foons

WORDS = st.lists(
    st.sampled_from(
        ["ice", "cream", "in", "on", "attached to", "contains", "with", 'a"', '"b"', ",", "A", " "]
    ),
    min_size=1,
    max_size=4,
).map(" ".join)
SIGNS = st.text('[]{}",ab ', min_size=1, max_size=6)
NAMES = (WORDS | SIGNS).map(str.strip).filter(bool)
"""Labels, states and contents that hold the signs of the notation."""

ODD_STATE = st.builds(
    State,
    NAMES,
    st.none() | NAMES,
    st.none() | st.lists(NAMES, max_size=2).map(lambda items: tuple(sorted(items))),
)
NODE = drawn_foons.NODE | st.builds(ObjectNode.of, NAMES, st.lists(ODD_STATE, max_size=3))


def world_of(nodes: list[ObjectNode], kitchen: list[ObjectNode]) -> World:
    builder = FoonBuilder()
    for node in nodes:
        builder.object(node)
    return World.of(builder.build(), Kitchen(tuple(kitchen)), goals=nodes[:1])


@given(st.lists(NODE, min_size=1, max_size=8), st.lists(NODE, max_size=3))
def test_every_object_has_a_name_that_means_it(nodes: list[ObjectNode], kitchen: list[ObjectNode]) -> None:
    world = world_of(nodes, kitchen)
    for level in (1, 2, 3):
        seen = world.on_level(level)
        for number in seen.ids:
            assert find_object(seen, str(seen.node(number))) == seen.node(number)


@given(drawn_foons.NODE)
def test_what_is_printed_is_read_without_a_foon(node: ObjectNode) -> None:
    assert written_object(str(node)) == node


@given(st.lists(NODE, min_size=2, max_size=8, unique=True))
def test_no_two_objects_have_one_name(nodes: list[ObjectNode]) -> None:
    assert len({str(node) for node in nodes}) == len(nodes)


@given(drawn_foons.NODE, st.text('[]{}",ain ', max_size=12))
def test_any_text_is_an_object_or_is_refused(node: ObjectNode, rest: str) -> None:
    world = world_of([node], [])
    for text in (rest, node.label + rest, str(node) + rest):
        try:
            assert find_object(world, text) == node
        except QueryError as error:
            assert "\n" not in str(error)  # noqa: PT017 - it need not be raised


@pytest.mark.parametrize(
    "pattern",
    ["ice [a]{} [b", "ice{}", 'ice "{}', "ice [{}", "ice {{{}", "{}"],
)
@pytest.mark.parametrize("repeated", [" in a", " in [a]", '"a" ', "[a] ", "{a} ", "a, ", '""', " ", "x"])
def test_a_goal_text_takes_time_in_proportion_to_its_length(pattern: str, repeated: str) -> None:
    world = world_of([ObjectNode("ice"), ObjectNode("a")], [])
    text = pattern.format(repeated * (200_000 // len(repeated)))
    started = time.process_time()
    try:
        found = str(find_object(world, text))
    except QueryError as error:
        found = str(error)
    assert time.process_time() - started < 2
    assert len(found) < 1_000
