"""Dishes of the public data, asked for by their ingredients."""

from __future__ import annotations

from pathlib import Path

import foon_asp as fa
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.substitution import Replacement
from foon_asp.retrieval.adapt import adapt_dish


def test_a_salad_with_mango_and_without_tomato(universal_world: World) -> None:
    rows = [
        Replacement("pineapple", "mango", 0.7),
        Replacement("tomato", "papaya", 0.9),
        Replacement("mayonnaise", "aioli", 0.8),
    ]
    query = Query("salad", without=["tomato"], substitute=rows)
    found = adapt_dish(universal_world, query, ["mango", "aioli"])
    assert found.status == Status.OPTIMAL
    assert found.dish.label == "carrot salad"
    assert found.distance == 0.5
    assert sorted(str(row.by) for row in found.additions) == ["aioli", "mango"]
    # Of thirteen dishes one has mango of itself; there is no aioli in it, and no mayonnaise.
    assert len(found.candidates) == 13
    assert {each.dish.label: each.distance for each in found.candidates}["shrimp mango salad"] == 1
    assert found.tree is not None
    assert found.tree.executable
    named = {label for step in found for node in step.takes for label in node.named_labels}
    assert {"mango", "aioli"} <= named
    assert "tomato" not in named


def test_categories_of_annotated_files(public_data: Path) -> None:
    """15 is salads: each of the four is marked in a file of its own."""
    folder = public_data / "subgraphs"
    files = [*sorted(folder.glob("*sal[ae]*.txt")), folder / "0033-miso_soup.txt"]
    world = fa.load(foon=files, kitchen=public_data / "universal" / "kitchen.json")
    assert sorted(each.dish.label for each in world.adapt("15").candidates) == [
        "carrot salad",
        "greek salad",
        "potato salad",
        "salad",
    ]
