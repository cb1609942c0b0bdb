"""The questions of docs/querying.md, answered twice on whatever is drawn."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given

from foon_asp.io.folder import Dataset
from foon_asp.model.node import Source
from foon_asp.model.world import World
from support.examples import many
from support.questions import FILES, PLAIN, Plain, ask, check_same_answer, check_skills, check_ways, tables
from support.small_foons import domains, with_units

# --- The questions, answered without any solver ----------------------------------------------------

SMALLER: dict[str, tuple[str, str, dict[str, object]]] = {
    "dirty.lp": (
        'label(O,"bowl"), state(O,"dirty")',
        'label(O,"onion"), state(O,"chopped")',
        {"label": "onion", "state": "chopped"},
    ),
    "bottleneck.lp": (">= 5", ">= 1", {"least": 1}),
    "ingredients.lp": (">= 10", ">= 1", {"least": 1}),
    "oven.lp": ('"oven"', '"cup"', {"broken": "cup"}),
    "rates.lp": ("< 500", "< 900", {"below": 0.9}),
}
"""What to ask instead, so that small FOONs have something to answer."""


@pytest.mark.parametrize("name", PLAIN)
def test_plain_python_gives_the_same_answer_on_random_foons(
    name: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("random")
    old, new, changes = SMALLER.get(name, ("", "", {}))
    assert old in FILES[name]
    text = FILES[name].replace(old, new) if old else FILES[name]
    seen: set[str] = set()

    @many(400)
    @given(domains(strict=False))
    def check(drawn: World) -> None:
        where = with_places(drawn)
        expected = PLAIN[name](Plain(where), **changes)
        found = tables(ask(folder, where, text))
        assert {key: set(rows) for key, rows in found.items()} == expected
        seen.add(repr(expected))

    check()
    assert len(seen) > 3, "hardly any FOON had something to answer"


def with_places(where: World) -> World:
    """Say for each unit that it was read somewhere."""
    units = [
        replace(unit, annotation=replace(unit.annotation, sources=(Source("small.txt", unit.id + 1),)))
        for unit in where.foon.units
    ]
    return World.of(with_units(where.foon, units), where.kitchen, strict=where.strict)


@pytest.mark.parametrize("name", PLAIN)
def test_plain_python_gives_the_same_answer(name: str, built_in_world: World, tmp_path: Path) -> None:
    assert check_same_answer(name, built_in_world, tmp_path) == (name != "never.lp")


def test_the_ways_to_make_each_goal(built_in: Dataset, tmp_path: Path) -> None:
    assert check_ways(built_in, tmp_path) >= 4


def test_no_robot_does_with_fewer_skills(built_in: Dataset, tmp_path: Path) -> None:
    check_skills(built_in, tmp_path)


@pytest.fixture(scope="module")
def built_in_world(built_in: Dataset) -> World:
    return built_in.world()
