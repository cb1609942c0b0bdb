"""Suggestions: which dishes there are, how they are ranked, and that they are really made with a thing."""

from __future__ import annotations

import json
from dataclasses import replace
from math import log

import pytest
from jsonschema import Draft202012Validator
from msgspec import to_builtins

from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, Interval, Mark
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.render.suggest import suggestions_text
from foon_asp.retrieval.suggest import Suggestions, find_dishes, suggest
from foon_asp.retrieval.wire import suggestions_json
from support.paths import SCHEMAS
from support.small_foons import motions, node, nodes, world, written

SCHEMA = SCHEMAS / "suggest.schema.json"
UTENSILS = ("bowl", "pot", "cup")


def names(result: Suggestions) -> list[str]:
    return [written(each.dish) for each in result.dishes]


# --- Which dishes there are -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("units", "kitchen", "dishes"),
    [
        pytest.param(("a -m-> b", "b -m-> c"), "a", "c", id="what no unit takes"),
        pytest.param(("a -m-> b", "x -m-> y"), "a", "b", id="what the kitchen can make"),
        pytest.param(("a -m-> b + c",), "a + c", "b", id="what the kitchen does not have"),
        pytest.param(("a -m-> b + (bowl)",), "a", "b", id="no tool that is listed again"),
        pytest.param(("a -m-> b + bowl[dirty]",), "a", "b", id="no empty utensil"),
        pytest.param(("a -m-> bowl{a,b}",), "a", "bowl{a,b}", id="a utensil with something in it"),
        pytest.param(("a -m-> bowl{b} + b@bowl",), "a", "b@bowl", id="a thing, not the vessel it is in"),
        pytest.param(
            ("a -m-> bowl{b} + b@bowl", "b@bowl -m-> c"), "a", "c", id="no vessel of a thing that goes on"
        ),
        pytest.param(
            ("a + s -m-> pot{a,s} + s@pot", "pot{a,s} -m-> c"), "a + s", "c", id="nothing in what goes on"
        ),
        pytest.param(
            ("a + s -m-> pot{a,s} + s@pot", "pot{a,s} -m-> c", "s -put-> s@pot"),
            "a + s",
            "c + s@pot",
            id="unless it is made apart, too",
        ),
        pytest.param(("a -m-> b", "s -m-> s@b"), "a + s", "b", id="nothing in a thing that is no utensil"),
    ],
)
def test_end_products(units: tuple[str, ...], kitchen: str, dishes: str) -> None:
    where = world(units, kitchen, utensils=UTENSILS)
    assert {written(where.node(dish)) for dish in find_dishes(where)} == set(map(written, nodes(dishes)))


def test_where_utensils_are_not_known_anything_may_hold_a_dish() -> None:
    where = world(["a -m-> b@bowl", "a -m-> bowl[dirty]"], "a")
    assert [written(where.node(dish)) for dish in find_dishes(where)] == ["b@bowl", "bowl[dirty]"]


def test_goals_come_first_and_may_be_taken_further() -> None:
    where = world(["a -m-> b", "b -m-> c", "x -m-> y"], "a + z")
    goals = [*nodes("b + y + z + a"), node("nobody knows it")]
    assert [written(where.node(dish)) for dish in find_dishes(replace(where, goals=tuple(goals)))] == [
        "b",
        "c",
    ]


def test_marked_goals_are_dishes() -> None:
    builder = FoonBuilder()
    a, b, c = (builder.object(node(name)) for name in "abc")
    builder.unit("m", [a], [b], Annotation(marks=(Mark(), Mark(goal="!"))))
    builder.unit("m", [b], [c], Annotation())
    where = World.of(builder.build(), Kitchen((node("a"),)))
    assert find_dishes(where) == [b, c]


def test_everything_that_can_be_made() -> None:
    where = world(["a -m-> b + bowl[dirty] + (cup)", "b -m-> c", "x -m-> y"], "a", utensils=UTENSILS)
    result = suggest(where, Query(), everything=True)
    assert names(result) == ["b", "bowl[dirty]", "c"]
    assert result.candidates == 3


def test_levels_of_detail(built_in: Dataset) -> None:
    for level in (1, 2):
        where = built_in.world(level=level)
        result = suggest(where, Query())
        goals = {where.project(goal) for goal in built_in.goals} - set(where.kitchen.objects)
        assert {each.dish for each in result.dishes} >= goals
        assert all(each.tree.executable for each in result.dishes)
    with_egg = suggest(where, Query(), using=["egg"])
    assert 0 < len(with_egg.dishes) < with_egg.candidates == len(result.dishes)


# --- How they are ranked --------------------------------------------------------------------------

MENU = (
    "egg -boil-> boiled egg",
    "egg + salt -whisk-> batter",
    "batter -fry-> omelette",
    "milk -warm-> cocoa",
    "bread + butter -spread-> toast",
)
RATES = {"boil": 0.9, "whisk": 0.99, "fry": 0.95, "warm": 0.9, "spread": 0.5}
STOCK = "egg + salt + milk + bread + butter"


@pytest.mark.parametrize(
    ("by", "expected"),
    [
        ("", ["boiled egg", "cocoa", "toast", "omelette"]),
        ("success", ["omelette", "boiled egg", "cocoa", "toast"]),
        ("units,inputs", ["boiled egg", "cocoa", "toast", "omelette"]),
        ("inputs,success", ["boiled egg", "cocoa", "toast", "omelette"]),
        ("depth,success", ["boiled egg", "cocoa", "toast", "omelette"]),
        ("success+0.1*units", ["boiled egg", "cocoa", "omelette", "toast"]),
    ],
)
def test_ranking(by: str, expected: list[str]) -> None:
    where = world(MENU, STOCK, rates=RATES)
    result = suggest(where, Query(by=by))
    assert names(result) == expected
    assert result.by == tuple(by.split(",")) if by else ("units",)
    assert result.skipped == 0


def test_each_dish_has_its_best_tree() -> None:
    where = world((*MENU, "batter -bake-> cocoa"), STOCK, rates={**RATES, "bake": 1.0})
    by_units, by_success = (suggest(where, Query(by=by)) for by in ("units", "success"))
    assert [motions(where, each.tree.units) for each in by_units.dishes if each.dish.label == "cocoa"] == [
        {"warm"}
    ]
    assert [motions(where, each.tree.units) for each in by_success.dishes if each.dish.label == "cocoa"] == [
        {"whisk", "bake"}
    ]


def test_equal_chances_are_equal_in_whatever_order_they_are_multiplied() -> None:
    assert log(0.1 * 0.2 * 0.7) > log(0.7 * 0.2 * 0.1)
    units = ("m -x-> n", "n -y-> o", "o -z-> second", "m -z-> p", "p -y-> q", "q -x-> first")
    rates = {"x": 0.1, "y": 0.2, "z": 0.7}
    assert names(suggest(world(units, "m", rates=rates), Query(by="success"))) == ["first", "second"]


WIDE = ("a -s1-> p", "a -s2-> q", "a -s3-> r", "a -s4-> s", "p + q + r + s -join-> x")
DEEP = ("a -d1-> d", "d -d2-> e", "e -d3-> f", "f -d4-> x")
LESS_DEEP = ("a -l1-> l", "l -l2-> m", "a -l3-> n", "m + n -l4-> x")


@pytest.mark.parametrize("units", [(*WIDE, *DEEP, *LESS_DEEP), (*LESS_DEEP, *DEEP, *WIDE)])
@pytest.mark.parametrize("using", [(), ("a",)])
def test_depth_is_counted_as_far_as_it_takes(units: tuple[str, ...], using: tuple[str, ...]) -> None:
    """The best tree has fewer units than the least deep one; of two such it is the less deep one."""
    where = world(units, "a")
    assert [each.costs.depth for each in suggest(where, Query(by="depth"), using=using).dishes] == [2]
    (dish,) = suggest(where, Query(by="units,depth"), using=using).dishes
    assert motions(where, dish.tree.units) == {"l1", "l2", "l3", "l4"}


def test_constraints_hold() -> None:
    where = world(MENU, STOCK, rates=RATES)
    result = suggest(where, Query(constraints=Constraints(avoid_motions=("fry",), without=("milk",))))
    assert names(result) == ["boiled egg", "toast"]
    assert result.candidates == 4
    assert names(suggest(where, Query(constraints=Constraints(max_depth=1)))) == [
        "boiled egg",
        "cocoa",
        "toast",
    ]
    assert names(suggest(where, Query(constraints=Constraints(avoid_motions=("fry",))), using=["salt"])) == []


def test_nothing_is_looked_at_once_the_time_is_up() -> None:
    where = world(MENU, STOCK, rates=RATES)
    for by in ("units", "depth"):
        result = suggest(where, Query(by=by, time_limit=0))
        assert (result.dishes, result.skipped, result.candidates) == ((), 4, 4)
        assert suggest(where, Query(by=by, time_limit=0), using=["egg"]).skipped == 2
        assert len(suggest(where, Query(by=by, time_limit=60)).dishes) == 4


def test_dishes_of_unknown_time_are_not_the_quickest() -> None:
    builder = FoonBuilder()
    a, b, c = (builder.object(node(name)) for name in "abc")
    builder.unit("m", [a], [b], Annotation())
    builder.unit("m", [a], [c], Annotation(times=(Interval(10, 25),)))
    where = World.of(builder.build(), Kitchen((node("a"),)))
    assert [(each.dish.label, each.costs.time) for each in suggest(where, Query(by="time")).dishes] == [
        ("c", 15)
    ]


@pytest.mark.parametrize(
    ("by", "using", "message"),
    [
        ("unit", (), "there is no criterion 'unit'"),
        ("tools", (), "do not say what is a utensil"),
        ("time", (), "time"),
        ("", ("eg",), "nothing in this FOON is called 'eg'; closest: egg"),
        ("", ("egg", "caviar"), "nothing in this FOON is called 'caviar'"),
        ("", (" ",), "nothing in this FOON is called ''"),
    ],
)
def test_questions_that_make_no_sense(by: str, using: tuple[str, ...], message: str) -> None:
    with pytest.raises(QueryError, match=message):
        suggest(world(MENU, STOCK, rates=RATES), Query(by=by), using=using)


# --- Made with certain things ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("units", "using", "expected"),
    [
        pytest.param(MENU, ("egg",), ["boil", "whisk fry"], id="one thing"),
        pytest.param(MENU, ("egg", "salt"), ["whisk fry"], id="two things"),
        pytest.param(MENU, (" EGG ",), ["boil", "whisk fry"], id="however it is written"),
        pytest.param(MENU, ("egg", "milk"), [], id="no dish has both"),
        pytest.param(("bowl{egg,milk} -m-> x",), ("egg",), ["m"], id="contents"),
        pytest.param(("milk@bowl -m-> x",), ("bowl",), ["m"], id="relata"),
        pytest.param(("(knife) + milk -m-> x",), ("knife",), ["m"], id="tools"),
        pytest.param(("milk -m-> x + egg",), ("egg",), [], id="not what is only made"),
        pytest.param(
            ("milk -quick-> x", "egg -one-> y", "y -two-> x"),
            ("egg",),
            ["one two"],
            id="a longer way, if that is the one with it",
        ),
        pytest.param(
            ("milk -m-> p + o", "egg -n-> o", "p + o -join-> x"),
            ("egg",),
            [],
            id="no step that makes what is there already",
        ),
        pytest.param(
            ("milk -m-> p + o", "egg -n-> o", "p + o -join-> x", "salt -o-> p"),
            ("egg",),
            ["n o join"],
            id="a way on which it is not there already",
        ),
        pytest.param(
            ("egg -n-> a", "milk + a -m-> b", "b -back-> a", "b -o-> x"),
            ("milk",),
            ["n m o"],
            id="no circle",
        ),
        pytest.param(
            ("egg -n-> a", "a -back-> egg[again]", "egg[again] -on-> a", "a -o-> x"),
            ("egg",),
            ["n o"],
            id="the first of several ways with it",
        ),
    ],
)
def test_made_with(units: tuple[str, ...], using: tuple[str, ...], expected: list[str]) -> None:
    stock = "egg + salt + milk + bread + butter + bowl{egg,milk} + milk@bowl + (knife)"
    where = world(units, stock, rates=RATES)
    result = suggest(where, Query(), using=using)
    # Only x is of interest, where there is one.
    found = [each for each in result.dishes if units == MENU or each.dish == node("x")]
    trees = [" ".join(sorted(motions(where, each.tree.units))) for each in found]
    assert trees == [" ".join(sorted(tree.split())) for tree in expected]
    assert result.using == tuple(label.strip().lower() for label in using)


# --- How they are written -------------------------------------------------------------------------


def test_text() -> None:
    where = world(MENU, STOCK, rates=RATES)
    assert suggestions_text(suggest(where, Query())) == (
        "4 dishes, the best by units first\n"
        "\n"
        "units  dish\n"
        "    1  boiled egg [ready]\n"
        "    1  cocoa [ready]\n"
        "    1  toast [ready]\n"
        "    2  omelette [ready]\n"
    )
    assert suggestions_text(suggest(where, Query(by="success,depth"), using=["egg", "salt"])) == (
        "1 dish made with egg and salt, the best by success, depth first\n"
        "\n"
        "success  depth  units  dish\n"
        "  0.941      2      2  omelette [ready]\n"
    )
    assert suggestions_text(suggest(where, Query()), 1).splitlines()[2:] == [
        "units  dish",
        "    1  boiled egg [ready]",
        "and 3 more",
    ]
    assert suggestions_text(suggest(where, Query(), using=["egg", "milk"])) == (
        "no dish made with egg and milk was found\n"
    )
    assert suggestions_text(suggest(where, Query(time_limit=0))) == (
        "no dish was found\nthe time ran out: 4 more candidates not looked at\n"
    )


def test_a_chance_that_is_not_known_is_no_chance() -> None:
    where = world(MENU[:1], "egg")
    object.__setattr__(where.kitchen, "default_rate", None)
    with pytest.raises(QueryError, match="no success rate"):
        suggest(where, Query(by="success"))
    assert suggest(where, Query()).dishes[0].costs.success is None


def test_json() -> None:
    validator = Draft202012Validator(json.loads(SCHEMA.read_text("utf-8")))
    where = world(MENU, STOCK, rates=RATES)
    for result in (
        suggest(where, Query(by="success,2*units+inputs"), using=["egg"]),
        suggest(where, Query(constraints=Constraints(without=("milk",)))),
        suggest(where, Query(time_limit=0)),
    ):
        validator.validate(to_builtins(suggestions_json(result)))
    value = to_builtins(suggestions_json(suggest(where, Query(), using=["egg"]), 1))
    validator.validate(value)
    assert json.loads(json.dumps(value)) == value
    assert (value["found"], value["candidates"], value["using"], value["by"]) == (2, 4, ["egg"], ["units"])
    assert [(each["dish"]["label"], each["units"]) for each in value["dishes"]] == [("boiled egg", [0])]
    for member in value:
        assert not validator.is_valid({name: part for name, part in value.items() if name != member})
    assert not validator.is_valid({**value, "more": 1})
    for member in value["dishes"][0]:
        short = {name: part for name, part in value["dishes"][0].items() if name != member}
        assert not validator.is_valid({**value, "dishes": [short]})


# --- Real data ------------------------------------------------------------------------------------


def test_built_in_dishes_with_egg(built_in: Dataset) -> None:
    where = built_in.world()
    result = suggest(where, Query(), using=["egg"])
    assert [(each.costs.units, str(each.dish)) for each in result.dishes] == [
        (1, "egg [boiled] in [bowl]"),
        (6, "pot [used] {water}"),
        (7, "omelette [cooked] on [plate]"),
        (13, "pancake [cooked] on [plate]"),
        (14, "banana bread [baked] on [cutting board]"),
        (18, "brownie [cut] on [plate]"),
        (25, "apple pie [baked] in [pie dish]"),
        (27, "fried rice [hot] on [plate]"),
    ]
    assert {each.dish for each in suggest(where, Query()).dishes} >= set(built_in.goals)


@pytest.mark.parametrize(("name", "value"), [("_PATIENCE", 0.0), ("_BATCH", 1), ("_BATCH", 100_000)])
def test_how_dishes_are_grounded_together_does_not_matter(
    name: str, value: float, built_in: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    where = built_in.world()
    expected = [suggest(where, Query(by=by), using=["salt"]) for by in ("units", "success")]
    monkeypatch.setattr(f"foon_asp.retrieval.suggest.{name}", value)
    found = [suggest(where, Query(by=by), using=["salt"]) for by in ("units", "success")]
    for one, other in zip(expected, found, strict=True):
        assert len(one.dishes) > 20
        assert [(each.dish, each.costs.units) for each in one.dishes] == [
            (each.dish, each.costs.units) for each in other.dishes
        ]
