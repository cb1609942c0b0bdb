"""Replacements in random small FOONs: the likest, as brute force finds them, and a tree that replays."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.levels import FULL
from foon_asp.model.node import ObjectNode, State
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.substitution import Replacement
from foon_asp.retrieval.retrieve import retrieve
from support import brute_force, brute_substitution
from support.examples import many
from support.small_foons import world

FOOD = ("apple", "berry", "cocoa")
FORMS = ("{}[raw]", "{}[cut]", "{}@bowl", "bowl{{{}}}")
PAIRS = ("bowl{{{},{}}}", "pie{{{},{}}}", "pie[hot]{{{},{}}}")


@st.composite
def questions(draw: st.DrawFn) -> tuple[World, ObjectNode, list[Replacement], tuple[str, ...]]:
    """Draw a world in which some food is handled and mixed, a goal, a table, and what to do without."""
    food, form = st.sampled_from(FOOD), st.sampled_from(FORMS)
    handled = st.builds(lambda one, old, new: f"{old.format(one)} -cut-> {new.format(one)}", food, form, form)
    mixed = st.builds(
        lambda one, other, old, new, pair: (
            f"{old.format(one)} + {new.format(other)} -mix-> {pair.format(one, other)}"
        ),
        food,
        food,
        form,
        form,
        st.sampled_from(PAIRS),
    )
    whole = st.builds(str.format, st.sampled_from(PAIRS), food, food)
    baked = st.builds("{} -bake-> {}".format, whole, whole)
    units = draw(st.lists(mixed, min_size=1, max_size=2)) + draw(st.lists(handled, max_size=3))
    units += draw(st.lists(baked, max_size=1))
    stock = draw(st.lists(st.builds(str.format, form, food), min_size=2, max_size=4, unique=True))
    utensils = draw(st.sampled_from([("bowl",), ()]))
    where = world(units, " + ".join(stock), utensils=utensils)
    where = where.on_level(draw(st.sampled_from([3, 3, 3, 2, 1])))
    goal = where.foon.objects[where.foon.units[where.foon.units.ids[0]].outputs[0]]
    ways = st.tuples(food, st.sampled_from([*FOOD, None])).filter(lambda each: each[0] != each[1])
    pairs = draw(st.lists(ways, min_size=2, max_size=5, unique=True))
    rows = [Replacement(one, by, draw(st.sampled_from([0.3, 0.5, 0.7, 0.9, 1.0]))) for one, by in pairs]
    named = sorted(where.foon.named_labels.intersection(FOOD))
    # What a level does not show cannot be avoided there.
    without = draw(st.lists(st.sampled_from(named), max_size=1)) if where.level == FULL else []
    return where, goal, rows, tuple(without)


@many(800)
@given(questions())
def test_the_likest_replacements_are_found(
    question: tuple[World, ObjectNode, list[Replacement], tuple[str, ...]],
) -> None:
    where, goal, rows, without = question
    answer = retrieve(where, Query(goal, substitute=rows, without=without))
    best = brute_substitution.best(where, goal, rows, without)
    if best is None:
        assert answer.status == Status.UNREACHABLE
        return
    assert answer.status == Status.OPTIMAL
    tree = answer.tree
    assert tree is not None
    assert brute_substitution.cost(tree.replacements) == best[0]
    assert brute_substitution.counts(where, tree, best[1])
    assert set(tree.replacements) <= set(rows)
    # The tree is shown with the replacements made, and can be executed so with the kitchen as it is.
    shown = tree.world
    assert shown.kitchen.objects == where.kitchen.objects or not tree.replacements
    wanted = shown.node(tree.goals[0])
    assert brute_force.replays(shown, wanted, tree.units)
    assert not {
        label
        for unit in tree.functional_units
        for o in (*unit.inputs, *unit.outputs)
        for label in shown.node(o).named_labels
    } & set(without)


def _on(node: ObjectNode) -> ObjectNode:
    """Say `on` of an object where it is in something."""
    return ObjectNode(
        node.label,
        tuple(
            State("on", each.relatum) if each.name == "in" and each.relatum else each for each in node.states
        ),
    )


@many(150)
@given(questions().filter(lambda question: question[0].level == FULL))
def test_relations_that_are_matched_loosely_change_nothing(
    question: tuple[World, ObjectNode, list[Replacement], tuple[str, ...]],
) -> None:
    """What is on something in half of a FOON, and in it in the other, is replaced as if all were in it."""
    where, goal, rows, without = question
    builder = FoonBuilder()
    for unit in where.foon.units:
        sides = [[where.foon.objects[o] for o in ports] for ports in (unit.inputs, unit.outputs)]
        if unit.id % 2:
            sides = [[*map(_on, side)] for side in sides]
        before, behind = ([builder.object(node) for node in side] for side in sides)
        builder.unit(unit.motion, before, behind, unit.annotation)
    stock = Kitchen(tuple(map(_on, where.kitchen.objects)), where.kitchen.utensils, {}, 1.0)
    loose = World.of(builder.build(), stock, match_relations="loose")
    answers = [retrieve(each, Query(goal, substitute=rows, without=without)) for each in (where, loose)]
    assert answers[0].status == answers[1].status
    plain, matched = (each.tree for each in answers)
    if plain is not None and matched is not None:
        assert matched.executable
        assert len(matched) == len(plain)
        costs = {brute_substitution.cost(each.replacements) for each in (plain, matched)}
        assert len(costs) == 1
