"""The search for edits finds what `unlock.lp` does, which is the definition, edit after edit."""

from __future__ import annotations

import random

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.asp.solver import open_solver
from foon_asp.audit.unlock import Edit, edits
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, UnitId
from foon_asp.model.world import World
from support.examples import many
from support.small_foons import domains, node

Recipes = list[tuple[list[int], list[int]]]


def of_recipes(recipes: Recipes, stock: list[int]) -> World:
    """Make a world of units that need and make objects by numbers."""
    builder = FoonBuilder()
    for place, (needs, makes) in enumerate(recipes):
        before, behind = ([builder.object(node(f"o{each}")) for each in side] for side in (needs, makes))
        builder.unit(f"m{place}", before, behind, Annotation())
    return World.of(builder.build(), Kitchen(tuple(node(f"o{number}") for number in stock)))


Row = tuple[object, object, list[int], list[int]]
"""Unit and need of an edit, what it opens, and the circle that it breaks."""


def best_edits(world: World, closed: set[UnitId]) -> list[Row]:
    """Return the best edits by the encoding, which differ in their circles alone."""
    units = world.units
    opened = set(units.foon.units.ids) - closed
    there = {*world.stock, *(made for unit in opened for made in units.makes[unit])}
    lines = [f"kitchen({each})." for each in sorted(there)]
    for unit in sorted(closed):
        lines.append(f"unit({unit}).")
        lines += [f"needs({unit},{need})." for need in units.needs[unit]]
        lines += [f"makes({unit},{made})." for made in units.makes[unit]]
    found: list[Row] = []
    for model in open_solver(["audit/unlock.lp"], "\n".join(lines)).all_best("circle").found:
        [(edited, need)] = model.rows("edit")
        found.append((edited, need, model.column("opened"), model.column("circle")))
    return found


def check(world: World) -> list[Edit]:
    """Compare each edit with those that the encoding calls best for what is left; return all."""
    closed = set(world.foon.units.ids) - world.closure.executable.keys()
    found = list(edits(world))
    for edit in found:
        ours = edit.unit, edit.need, list(edit.opened), list(edit.circle)
        assert ours in best_edits(world, closed)
        closed -= set(edit.opened)
    assert best_edits(world, closed) == []
    return found


NUMBERS = st.integers(0, 6)
SIDE = st.lists(NUMBERS, min_size=1, max_size=2, unique=True)


@many(120)
@given(st.lists(st.tuples(SIDE, SIDE), min_size=1, max_size=10), st.lists(NUMBERS, max_size=1))
def test_each_edit_is_a_best_one_by_the_encoding(recipes: Recipes, stock: list[int]) -> None:
    found = check(of_recipes(recipes, stock))
    event(f"{min(len(found), 3)} edits")
    event(f"a circle of {max((len(edit.circle) for edit in found), default=0)}")


@many(40)
@given(domains())
def test_units_are_read_as_everywhere(world: World) -> None:
    check(world)


@pytest.mark.parametrize("seed", range(12))
def test_many_units(seed: int) -> None:
    """Rings that are wound into each other, with needs that a second unit must meet."""
    draw = random.Random(seed)
    count = draw.choice([20, 40])
    recipes = [
        (
            draw.sample(range(count), draw.choice([1, 1, 1, 2])),
            draw.sample(range(count), draw.choice([1, 1, 2])),
        )
        for _ in range(count)
    ]
    assert check(of_recipes(recipes, []))
