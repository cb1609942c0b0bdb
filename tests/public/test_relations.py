"""How many objects of the public kitchen the annotated subgraphs know, by how relations are matched."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.io.folder import Dataset, foon_files, read_foon
from foon_asp.model.relations import Matching
from foon_asp.model.world import World


@pytest.mark.parametrize(("matching", "known"), [("strict", 379), ("loose", 462)])
def test_objects_of_the_kitchen_that_the_subgraphs_know(
    public_data: Path, universal: Dataset, matching: Matching, known: int
) -> None:
    subgraphs = read_foon(foon_files(public_data / "subgraphs")).foon
    world = World.of(subgraphs, universal.kitchen, match_relations=matching)
    objects = set(universal.kitchen.objects)
    assert len(objects) == 1174
    assert sum(subgraphs.id_of(world.project(node)) is not None for node in objects) == known
