"""Goals as people write them."""

from __future__ import annotations

import pytest

from foon_asp.builder import FoonBuilder
from foon_asp.dataset import Dataset
from foon_asp.errors import QueryError
from foon_asp.goals import find_goal
from foon_asp.graph import ObjectNode, State, contains, inside
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain

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
def domain() -> Domain:
    builder = FoonBuilder()
    for node in NODES:
        builder.object(node)
    return Domain(builder.build(), Kitchen(()))


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
        ("lid", 7),
        ("lid attached to [stand mixer]", 7),
        ("chicken in sauce", 8),
    ],
)
def test_parts_may_be_left_out(domain: Domain, text: str, place: int) -> None:
    assert find_goal(domain, text) == NODES[place]


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
def test_errors_name_the_closest(domain: Domain, text: str, message: str) -> None:
    with pytest.raises(QueryError, match=message):
        find_goal(domain, text)


def test_a_goal_of_the_data_folder_wins_over_other_matches(domain: Domain) -> None:
    assert find_goal(domain, "ice", [NODES[1]]) == NODES[1]


def test_whatever_is_printed_can_be_typed(built_in: Dataset, universal: Dataset) -> None:
    for dataset in (built_in, universal):
        domain = dataset.domain()
        labels = {node.label for node in dataset.foon.objects}
        tried = [node for node in dataset.foon.objects if not node.bare][:: len(labels) // 50]
        assert len(tried) > 50
        for node in tried:
            text = str(node)
            if not node.plain_states:
                text = text.replace(node.label, f"{node.label} []", 1)
            if not node.contents:
                text = text.replace(node.label, f"{node.label} {{}}", 1)
            assert find_goal(domain, text, [node]) == node
