"""Dishes adapted in random small FOONs: the nearest, as brute force finds them, and a tree that replays."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.model.levels import FULL
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.substitution import Replacement
from foon_asp.retrieval.adapt import adapt_dish
from support import brute_adaptation, brute_force, brute_substitution
from support.examples import many
from support.small_foons import world

FOOD = ("apple", "berry", "cocoa")
MORE = (*FOOD, "date")
FORMS = ("{}[cut]", "{}@bowl", "bowl{{{}}}", "{}[raw]")
WHOLE = ("pie{{{},{}}}", "pie[hot]{{{},{}}}", "bowl{{{},{}}}")
STRAINER = "strainer[clean]"

Asked = tuple[World, list[ObjectNode], list[Replacement], tuple[str, ...], tuple[str, ...]]


@st.composite
def questions(draw: st.DrawFn) -> Asked:
    """Draw a world in which food is handled and mixed, dishes, a table, what is wanted and what is not.

    Of each ingredient there is some, or it is cut from what is raw, or cooked of other food, or there is
    none. A dish may take a tool that something else made clean.
    """
    food = st.sampled_from(FOOD)
    units: list[str] = []
    stock: list[str] = []
    for _ in range(draw(st.integers(1, 2))):
        pair = draw(st.tuples(food, food))
        parts = [draw(st.sampled_from(FORMS)).format(each) for each in pair]
        if draw(st.integers(0, 3)) == 0:
            parts.append(STRAINER)
            units.append(f"{draw(food)}[raw] + strainer[dirty] -clean-> {STRAINER}")
            stock.append("strainer[dirty]")
        units.insert(0, f"{' + '.join(parts)} -mix-> {draw(st.sampled_from(WHOLE)).format(*pair)}")
        for each, part in zip(pair, parts, strict=False):
            way = draw(st.sampled_from(("there", "cut", "cut", "cooked", "lacking")))
            other = draw(food) if way == "cooked" else each
            if way == "there":
                stock.append(part)
            elif way != "lacking" and part != f"{other}[raw]":
                units.append(f"{other}[raw] -{way}-> {part}")
            stock += [f"{other}[raw]"] * draw(st.integers(0, 1))
    stock += draw(st.lists(st.builds(str.format, st.sampled_from(FORMS), st.sampled_from(MORE)), max_size=2))
    utensils = ("bowl", "strainer") if draw(st.booleans()) else ("strainer",)
    where = world(units[:6], " + ".join(dict.fromkeys(stock)), utensils=utensils)
    where = where.on_level(draw(st.sampled_from([3, 3, 3, 2, 1])))
    goals = [where.foon.objects[unit.outputs[0]] for unit in where.foon.units if unit.motion == "mix"]
    ways = st.tuples(food, st.sampled_from([*MORE, None])).filter(lambda each: each[0] != each[1])
    pairs = draw(st.lists(ways, min_size=2, max_size=5, unique=True))
    rows = [Replacement(one, by, draw(st.sampled_from([0.3, 0.5, 0.7, 1.0]))) for one, by in pairs]
    named = sorted(where.foon.named_labels.intersection(FOOD))
    # What a level does not show cannot be avoided there.
    without = draw(st.lists(st.sampled_from(named), max_size=1)) if where.level == FULL else []
    left = [label for label in MORE if label not in without]
    wanted = draw(st.lists(st.sampled_from(left), max_size=2, unique=True))
    return where, list(dict.fromkeys(goals)), rows, tuple(wanted), tuple(without)


@many(300)
@given(questions())
def test_the_nearest_dish_is_found(question: Asked) -> None:
    where, dishes, rows, wanted, without = question
    best = []
    for dish in dishes:
        found = adapt_dish(where, Query(dish, substitute=rows, without=without), wanted)
        # The dish itself is never at hand.
        others = where.with_stock(node for node in where.kitchen.objects if node != dish)
        expected = brute_adaptation.best(others, dish, rows, wanted, without)
        if expected is None:
            assert found.status == Status.UNREACHABLE
            assert found.answer.reason
            continue
        tree = found.tree
        assert found.status == Status.OPTIMAL
        assert tree is not None
        assert found.distance is not None
        assert round(1000 * found.distance) == expected[0]
        assert brute_substitution.counts(where, tree, expected[1])
        best.append(expected)
        # The tree is shown with all changes made, and can be executed so in the kitchen with what is brought.
        shown = tree.world
        assert shown.kitchen.objects == (*others.kitchen.objects, *found.brought)
        assert brute_force.replays(shown, shown.node(tree.goals[0]), tree.units)
        named = {
            label
            for unit in tree.functional_units
            for o in (*unit.inputs, *unit.outputs)
            for label in shown.node(o).named_labels
        }
        assert not named & set(without)
        assert named >= set(wanted) - set(found.missing)
        assert all(set(node.named_labels) & set(wanted) for node in found.brought)
    if len(dishes) > 1 and best and all(dish.label == "pie" for dish in dishes):
        found = adapt_dish(where, Query("pie", substitute=rows, without=without), wanted)
        assert round(1000 * (found.distance or 0)) == min(best)[0]
