"""The trace against the literal search."""

from __future__ import annotations

from collections.abc import Iterable

from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.trace import explore, trace
from support import brute_force
from support.examples import many
from support.small_foons import queries

Drawn = tuple[World, ObjectNode]


# --- Properties -----------------------------------------------------------------------------------


class TooLongError(Exception):
    """The literal search takes too long: it repeats itself without end."""


class Literal:
    """The depth-bounded search as it is defined, without any memory, over brute force's own reading."""

    def __init__(self, where: World) -> None:
        self.where = where
        self.visits: list[tuple[ObjectNode, int]] = []
        self.kept: set[ObjectNode] = set()

    def search(self, thing: ObjectNode, left: int, depth: int = 0) -> set[ObjectNode] | None:
        """Return the objects of the tree that makes a thing, or None if there is none so deep."""
        self.visits.append((thing, depth))
        if len(self.visits) > 3000:
            raise TooLongError
        if thing in self.where.kitchen.objects:
            return {thing}
        for unit in self.where.foon.units if left else ():
            if thing not in brute_force.makes(self.where, unit):
                continue
            needed = brute_force.needs(self.where, unit)
            needs = [each for each in map(self.where.node, unit.inputs) if each in needed]
            found = [self.search(need, left - 1, depth + 1) for need in needs]
            parts = [each for each in found if each is not None]
            if len(parts) == len(found):
                return {thing}.union(*parts)
        return None


def is_part(short: Iterable[object], long: Iterable[object]) -> bool:
    """Say whether a sequence is another one with some members left out."""
    rest = iter(long)
    return all(item in rest for item in short)


@many(300)
@given(queries(), st.integers(0, 6))
def test_each_limit_is_the_literal_search_with_repeats_left_out(query: Drawn, limit: int) -> None:
    where, goal = query
    literal = Literal(where)
    try:
        kept = literal.search(goal, limit)
    except TooLongError:
        assume(False)
    bound = explore(where, where.id_of(goal), limit)
    visits = [(where.node(thing), depth) for thing, depth in bound.explored]
    assert bound.reached == (kept is not None)
    assert is_part(visits, literal.visits)
    things = [thing for thing, _ in visits]
    repeats = len(literal.visits) - len({thing for thing, _ in literal.visits})
    event("repeats" if repeats else "no repeats")
    if not repeats:
        assert visits == literal.visits
    assert (kept or set()) <= set(things)


@many(150)
@given(queries())
def test_it_ends_at_the_bound_of_the_method_ids(query: Drawn) -> None:
    where, goal = query
    found = trace(where, where.id_of(goal))
    rounds, _ = brute_force.closure(where, brute_force.every_unit(where))
    tree = retrieve(where, Query(goal, method="ids")).tree
    last = found[-1]
    assert [bound.limit for bound in found] == list(range(len(found)))
    assert not any(bound.reached for bound in found[:-1])
    assert last.reached == (goal in rounds) == (tree is not None)
    if tree is None:
        seen = {thing for bound in found[:-1] for thing, _ in bound.explored}
        assert {thing for thing, _ in last.explored} <= seen
        return
    assert last.limit == rounds[goal] == tree.depth
    # The tree of the method lies within what was explored last, and so does all that the goal takes.
    things = {where.node(thing) for thing, _ in last.explored}
    assert {where.node(thing) for unit in tree.units for thing in where.units.needs[unit]} <= things
    enough = [unit.id for unit in where.foon.units if brute_force.needs(where, unit) <= things]
    assert brute_force.closure(where, enough)[0][goal] == last.limit


def distances(where: World, goal: ObjectNode) -> dict[ObjectNode, int]:
    """Return how many units objects are away from the goal, by any way at all."""
    found = {goal: 0}
    for _ in where.foon.objects:
        for unit in where.foon.units:
            made = [found[thing] for thing in brute_force.makes(where, unit) if thing in found]
            for thing in brute_force.needs(where, unit) if made else ():
                found[thing] = min(min(made) + 1, found.get(thing, min(made) + 1))
    return found


@many(150)
@given(queries())
def test_no_object_is_further_away_than_the_limit(query: Drawn) -> None:
    where, goal = query
    away = distances(where, goal)
    for bound in trace(where, where.id_of(goal)):
        visits: dict[int, list[int]] = {}
        for thing, depth in bound.explored:
            assert away[where.node(thing)] <= depth <= bound.limit
            visits.setdefault(thing, []).append(depth)
        # So there are at most objects times depth of them.
        assert all(len(depths) == len(set(depths)) for depths in visits.values())
