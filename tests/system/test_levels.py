"""Task trees on levels of detail."""

from __future__ import annotations

from pathlib import Path

import clingo
import pytest

from foon_asp.asp.encodings import encoding_path
from foon_asp.asp.facts import facts
from foon_asp.io.folder import Dataset
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.levels import LEVELS, at_level
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.small_foons import foon, node, nodes

# --- Planning on a level --------------------------------------------------------------------------


def test_a_foon_that_was_cut_to_labels_before_can_still_be_planned_on() -> None:
    cut = at_level(foon("a + (knife) -cut-> b"), 1)
    kitchen = Kitchen(tuple(nodes("a + (knife)")))
    result = retrieve(World.of(cut, kitchen, level=1), Query(node("b")))
    assert result.tree is not None
    assert len(result.tree.units) == 1


@pytest.mark.parametrize("level", LEVELS)
def test_facts_can_be_piped_to_clingo(level: int, tmp_path: Path, built_in: Dataset) -> None:
    view = World.of(built_in.foon, built_in.kitchen, level=level)
    path = tmp_path / "facts.lp"
    path.write_text(facts(Problem(view, (), whole=True)), "utf-8")
    said: list[str] = []
    control = clingo.Control(["--warn=all"], lambda _, message: said.append(message))
    control.load(str(path))
    control.load(str(encoding_path("reachability.lp")))
    control.ground([("base", [])])
    with control.solve(yield_=True) as handle:
        (model,) = handle
        shown = model.symbols(shown=True)
    available = {atom.arguments[0].number for atom in shown if atom.name == "available"}
    assert available == view.closure.available.keys() > set(view.stock)
    assert said == []
