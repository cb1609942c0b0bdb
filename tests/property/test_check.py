"""Trees that someone else made, judged as plain Python judges them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import permutations

from hypothesis import given
from hypothesis import strategies as st

import foon_asp as fa
from foon_asp.io.trees import Listing, Trees
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.node import ObjectNode, Source, UnitId
from foon_asp.model.world import World
from foon_asp.planning.plan import replay_plan
from foon_asp.retrieval.check import Check, CheckQuery, check_trees
from support import brute_force
from support.examples import many
from support.small_foons import domains

Drawn = tuple[World, tuple[UnitId, ...], int]


@st.composite
def _trees(draw: st.DrawFn) -> Drawn:
    """Draw a FOON in a kitchen, some of its units in some order, and how many of its units are known."""
    where = draw(domains(strict=False))
    ids = list(where.foon.units.ids)
    things = list(where.foon.objects)
    more = draw(st.lists(st.sampled_from(things), max_size=len(things) - 1, unique=True))
    counts = draw(st.dictionaries(st.sampled_from(things), st.integers(1, 2), max_size=3))
    stock = tuple(dict.fromkeys((*where.kitchen.objects, *more, *counts)))
    kitchen = replace(where.kitchen, objects=stock, quantities=counts)
    where = World.of(where.foon, kitchen, strict=False)
    order = draw(st.lists(st.sampled_from(ids), min_size=1, max_size=5))
    return where, tuple(order), draw(st.integers(0, len(ids)))


def _checked(drawn: Drawn, *, named: bool, semantics: str = "add") -> Check:
    where, order, known = drawn
    trees = Trees(where.foon, known, (Listing("tree", order, (Source(),) * len(order)),))
    kitchen = where.kitchen if named else None
    query = CheckQuery(kitchen, where.kitchen.utensils, True, semantics, "strict")
    return check_trees(trees, query)[0]


def _lacks(where: World, order: Sequence[UnitId], at_hand: set[ObjectNode]) -> list[set[ObjectNode]]:
    """Return what each unit lacks, by the definitions alone; each is gone on from as if it were executed."""
    found = []
    for number in order:
        unit = where.foon.units[number]
        found.append(brute_force.needs(where, unit) - at_hand)
        at_hand = at_hand | brute_force.makes(where, unit)
    return found


def _raw(where: World, order: Sequence[UnitId]) -> set[ObjectNode]:
    """Return what the units need and none of them brings about."""
    units = [where.foon.units[number] for number in order]
    needs = [brute_force.needs(where, unit) for unit in units]
    brings = [brute_force.makes(where, unit) - need for unit, need in zip(units, needs, strict=True)]
    return set().union(*needs).difference(*brings)


@given(_trees(), st.booleans())
@many(200)
def test_what_is_missing_is_what_plain_replay_misses(drawn: Drawn, named: bool) -> None:
    where, order, _ = drawn
    check = _checked(drawn, named=named)
    at_hand = set(where.kitchen.objects) if named else _raw(where, order)
    lacks = _lacks(where, order, at_hand)
    assert [{lack.node for lack in step.missing} for step in check.steps] == lacks
    assert check.executable is not any(lacks)
    orders = list(permutations(range(len(order)))) if any(lacks) else []
    possible = any(not any(_lacks(where, [order[place] for place in each], at_hand)) for each in orders)
    assert (check.order is not None) is possible
    if check.order is not None:
        assert not any(_lacks(where, [order[place - 1] for place in check.order], at_hand))


@given(_trees())
@many(100)
def test_with_what_a_tree_needs_it_can_be_executed_and_with_less_not(drawn: Drawn) -> None:
    where, order, _ = drawn
    needs = set(_checked(drawn, named=False).needs)
    assert not any(_lacks(where, order, needs))
    for need in needs:
        assert any(_lacks(where, order, needs - {need}))


@given(_trees(), st.sampled_from(SEMANTICS))
@many(250)
def test_what_is_used_up_must_be_made_again(drawn: Drawn, semantics: str) -> None:
    where, order, _ = drawn
    check = _checked(drawn, named=True, semantics=semantics)
    effects = Effects(where, semantics)

    def works(units: Sequence[UnitId]) -> bool:
        return replay_plan(effects, (), units).executable

    assert check.executable is works(order)
    if not check.executable:
        assert (check.order is not None) is any(map(works, permutations(order)))
    if check.order is not None:
        assert sorted(check.order) == list(range(1, len(order) + 1))
        assert works([order[place - 1] for place in check.order])


@given(_trees(), st.booleans())
@many(200)
def test_a_likely_step_closes_its_gap_and_none_is_better(drawn: Drawn, named: bool) -> None:
    where, order, known = drawn
    check = _checked(drawn, named=named)
    at_hand = set(where.kitchen.objects) if named else _raw(where, order)
    for number, step in zip(order, check.steps, strict=True):
        for lack in (*step.missing, *step.doubtful):
            ranks = {
                unit.id: rank
                for unit in where.foon.units
                if unit.id < known and (rank := _rank(where, unit, lack.node, at_hand)) is not None
            }
            best = min(ranks, key=lambda each: ranks[each], default=None)
            assert (None if lack.likely is None else lack.likely.unit.id) == best
        at_hand = at_hand | brute_force.makes(where, where.foon.units[number])


def _rank(
    where: World, unit: fa.FunctionalUnit, missing: ObjectNode, at_hand: set[ObjectNode]
) -> tuple[bool, int, int, int] | None:
    """Return how good a unit is to close a gap, the less the better; None if it does not close it."""
    needs = brute_force.needs(where, unit)
    lacks = needs - at_hand
    tools = {thing for thing in lacks if not thing.states}
    tools |= {
        thing
        for thing in lacks
        if thing.label in where.kitchen.utensils and not any(state.contents for state in thing.states)
    }
    if missing not in brute_force.makes(where, unit) or lacks != tools:
        return None
    changes = any(thing.label == missing.label for thing in needs & at_hand)
    return not changes, len(lacks), len(needs), unit.id
