"""Kitchens: the same one however it is written, and what is at hand where none is."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from foon_asp.io.files import rows
from foon_asp.io.findings import CUT_OFF
from foon_asp.io.kitchen import KitchenFiles
from foon_asp.io.object_wire import object_to_json
from foon_asp.io.syntax import says_none
from foon_asp.io.text import object_lines
from foon_asp.io.wire import dumps
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectNode
from foon_asp.model.relations import MATCHINGS, Matching
from foon_asp.model.world import World
from support import brute_force
from support.drawn_foons import NODE
from support.examples import many
from support.small_foons import domains, queries

NOTHING = FoonBuilder().build()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("kitchens")


def _plain(node: ObjectNode) -> bool:
    """Tell whether a line means just the node: one that begins with `#`, or says `none`, means nothing."""
    text = str(node)
    return [row for _, row in rows(text)] == [text] and not says_none(text) and "[{" not in text


@many(150)
@given(nodes=st.lists(NODE, min_size=1, max_size=5, unique=True))
def test_a_kitchen_is_the_same_however_it_is_written(folder: Path, nodes: list[ObjectNode]) -> None:
    objects = [object_to_json(node) for node in nodes]
    texts = {
        "JSON": dumps(objects),
        "wrapped": dumps({"kitchen": {"objects": objects}}),
        "lines": "".join(json.dumps(json.loads(dumps(each))) + "\n" for each in objects),
        "cut off": dumps([*objects, {"label": "x"}]).removesuffix('"x"\n  }\n]\n'),
        "text": "".join(f"{line}\n" for node in nodes for line in object_lines(node)),
    }
    if all(map(_plain, nodes)):
        texts["labels"] = "".join(f"{node}\n" for node in nodes)
        texts["list"] = dumps(list(map(str, nodes)))
    path = folder / "kitchen"
    for form, text in texts.items():
        path.write_text(text, encoding="utf-8", newline="")
        kitchen, findings = KitchenFiles(str(path)).read(NOTHING)
        assert set(World.of(NOTHING, kitchen).kitchen.objects) == set(nodes), form
        assert any(each.code == CUT_OFF for each in findings) == (form == "cut off"), form


@many(150)
@given(where=domains(), matching=st.sampled_from(MATCHINGS))
def test_without_a_kitchen_all_is_at_hand_that_is_needed_and_no_unit_makes(
    where: World, matching: Matching
) -> None:
    utensils = where.kitchen.utensils
    world = World.of(
        where.foon,
        Kitchen((), utensils, stated=False),
        strict=where.strict,
        match_relations=matching,
    )
    if matching == "loose":
        needed = {world.node(number) for row in world.units.needs for number in row}
        made = {world.node(number) for row in world.units.makes for number in row}
    else:
        needed = {node for unit in where.foon.units for node in brute_force.needs(where, unit)}
        made = {node for unit in where.foon.units for node in brute_force.makes(where, unit)}
    assert set(world.kitchen.objects) == needed - made
    assert not world.strangers


@many(150)
@given(query=queries())
def test_a_label_means_all_of_it_that_no_unit_makes(query: tuple[World, ObjectNode]) -> None:
    where, goal = query
    assume(where.foon.labelled(goal.label))
    world = World.of(where.foon, Kitchen((), where.kitchen.utensils, labels=(goal.label,)))
    made = {node for unit in where.foon.units for node in brute_force.makes(where, unit)}
    assert set(world.kitchen.objects) == set(where.foon.labelled(goal.label)) - made
