"""Suggestions: which dishes there are, how they are ranked, and that they are really made with a thing."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from itertools import combinations
from math import isclose, log
from pathlib import Path

import brute_force
import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from small_foons import domain, domains, many, motions, node, nodes, written

from foon_asp.builder import FoonBuilder
from foon_asp.constraints import Constraints
from foon_asp.dataset import Dataset
from foon_asp.errors import QueryError
from foon_asp.graph import Annotation, FunctionalUnit, Mark
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain
from foon_asp.render.suggest import suggestions_text, suggestions_value
from foon_asp.retrieve import retrieve
from foon_asp.suggest import Suggestions, find_dishes, suggest

SCHEMA = Path(__file__).parent.parent / "docs" / "schema" / "suggest.schema.json"
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
        pytest.param(("a -m-> b + (spoon)",), "a", "b", id="no tool that is listed again"),
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
    where = domain(units, kitchen, utensils=UTENSILS)
    assert {written(where.node(dish)) for dish in find_dishes(where)} == set(map(written, nodes(dishes)))


def test_where_utensils_are_not_known_anything_may_hold_a_dish() -> None:
    where = domain(["a -m-> b@bowl", "a -m-> bowl[dirty]"], "a")
    assert [written(where.node(dish)) for dish in find_dishes(where)] == ["b@bowl", "bowl[dirty]"]


def test_goals_come_first_and_may_be_taken_further() -> None:
    where = domain(["a -m-> b", "b -m-> c", "x -m-> y"], "a + z")
    goals = [*nodes("b + y + z + a"), node("nobody knows it")]
    assert [written(where.node(dish)) for dish in find_dishes(where, goals)] == ["b", "c"]


def test_marked_goals_are_dishes() -> None:
    builder = FoonBuilder()
    a, b, c = (builder.object(node(name)) for name in "abc")
    builder.unit("m", [a], [b], Annotation(marks=(Mark(), Mark(goal="!"))))
    builder.unit("m", [b], [c], Annotation())
    where = Domain(builder.build(), Kitchen((node("a"),)))
    assert find_dishes(where) == [b, c]


def test_everything_that_can_be_made() -> None:
    where = domain(["a -m-> b + bowl[dirty] + (spoon)", "b -m-> c", "x -m-> y"], "a", utensils=UTENSILS)
    result = suggest(where, everything=True)
    assert names(result) == ["b", "bowl[dirty]", "c"]
    assert result.candidates == 3


def test_levels_of_detail(built_in: Dataset) -> None:
    for level in (1, 2):
        where = built_in.domain(level=level)
        result = suggest(where, built_in.goals)
        goals = {where.project(goal) for goal in built_in.goals} - set(where.kitchen.objects)
        assert {each.dish for each in result.dishes} >= goals
        assert all(each.tree.executable for each in result.dishes)
    with_egg = suggest(where, built_in.goals, using=["egg"])
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
    where = domain(MENU, STOCK, rates=RATES)
    result = suggest(where, by=by)
    assert names(result) == expected
    assert result.by == tuple(by.split(",")) if by else ("units",)
    assert result.skipped == 0


def test_each_dish_has_its_best_tree() -> None:
    where = domain((*MENU, "batter -bake-> cocoa"), STOCK, rates={**RATES, "bake": 1.0})
    by_units, by_success = (suggest(where, by=by) for by in ("units", "success"))
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
    assert names(suggest(domain(units, "m", rates=rates), by="success")) == ["first", "second"]


WIDE = ("a -s1-> p", "a -s2-> q", "a -s3-> r", "a -s4-> s", "p + q + r + s -join-> x")
DEEP = ("a -d1-> d", "d -d2-> e", "e -d3-> f", "f -d4-> x")
LESS_DEEP = ("a -l1-> l", "l -l2-> m", "a -l3-> n", "m + n -l4-> x")


@pytest.mark.parametrize("units", [(*WIDE, *DEEP, *LESS_DEEP), (*LESS_DEEP, *DEEP, *WIDE)])
@pytest.mark.parametrize("using", [(), ("a",)])
def test_depth_is_counted_as_far_as_it_takes(units: tuple[str, ...], using: tuple[str, ...]) -> None:
    """The best tree has fewer units than the least deep one; of two such it is the less deep one."""
    where = domain(units, "a")
    assert [each.costs.depth for each in suggest(where, by="depth", using=using).dishes] == [2]
    (dish,) = suggest(where, by="units,depth", using=using).dishes
    assert motions(where, dish.tree.units) == {"l1", "l2", "l3", "l4"}


def test_constraints_hold() -> None:
    where = domain(MENU, STOCK, rates=RATES)
    result = suggest(where, constraints=Constraints(avoid_motions=("fry",), without=("milk",)))
    assert names(result) == ["boiled egg", "toast"]
    assert result.candidates == 4
    assert names(suggest(where, constraints=Constraints(max_depth=1))) == ["boiled egg", "cocoa", "toast"]
    assert names(suggest(where, using=["salt"], constraints=Constraints(avoid_motions=("fry",)))) == []


def test_nothing_is_looked_at_once_the_time_is_up() -> None:
    where = domain(MENU, STOCK, rates=RATES)
    for by in ("units", "depth"):
        result = suggest(where, by=by, time_limit=0)
        assert (result.dishes, result.skipped, result.candidates) == ((), 4, 4)
        assert suggest(where, by=by, time_limit=0, using=["egg"]).skipped == 2
        assert len(suggest(where, by=by, time_limit=60).dishes) == 4


def test_dishes_of_unknown_time_are_not_the_quickest() -> None:
    builder = FoonBuilder()
    a, b, c = (builder.object(node(name)) for name in "abc")
    builder.unit("m", [a], [b], Annotation())
    builder.unit("m", [a], [c], Annotation(start=10, end=25))
    where = Domain(builder.build(), Kitchen((node("a"),)))
    assert [(each.dish.label, each.costs.time) for each in suggest(where, by="time").dishes] == [("c", 15)]


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
        suggest(domain(MENU, STOCK, rates=RATES), by=by, using=using)


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
    where = domain(units, stock, rates=RATES)
    result = suggest(where, [node("x")] if where.foon.id_of(node("x")) else (), using=using)
    # Only x is of interest, where there is one.
    found = [each for each in result.dishes if units == MENU or each.dish == node("x")]
    trees = [" ".join(sorted(motions(where, each.tree.units))) for each in found]
    assert trees == [" ".join(sorted(tree.split())) for tree in expected]
    assert result.using == tuple(label.strip().lower() for label in using)


def takes(where: Domain, unit: FunctionalUnit, label: str) -> bool:
    """Say from the definition alone whether a unit takes something called so."""
    for number in unit.inputs:
        thing = where.foon.objects[number]
        if thing.label == label:
            return True
        if any(state.relatum == label or label in (state.contents or ()) for state in thing.states):
            return True
    return False


def tree_costs(where: Domain, goal: int, using: Sequence[str]) -> tuple[list[brute_force.Costs], ...]:
    """Return what trees cost that really use the labels, and those of them with no superfluous unit."""
    dish = where.node(goal)
    numbers = range(len(where.foon.units))
    found: dict[frozenset[int], brute_force.Costs] = {}
    for size in range(len(numbers) + 1):
        for units in combinations(numbers, size):
            costs = brute_force.costs(where, dish, units)
            if costs is not None:
                found[frozenset(units)] = costs
    takers = {label: {u.id for u in where.foon.units if takes(where, u, label)} for label in using}

    def makes(units: Iterable[int]) -> bool:
        return dish in brute_force.closure(where, units)[0]

    real = [
        costs for units, costs in found.items() if not any(makes(units - takers[label]) for label in takers)
    ]
    small = [
        costs
        for units, costs in found.items()
        if all(units & takers[label] for label in takers) and not any(makes(units - {unit}) for unit in units)
    ]
    return real, small


QUESTIONS = [("units",), ("success",), ("inputs", "units"), ("depth", "units"), ("units", "depth")]


@pytest.mark.parametrize("by", QUESTIONS, ids=",".join)
@many(60)
@given(where=domains(), data=st.data())
def test_best_by_brute_force(by: tuple[str, ...], where: Domain, data: st.DataObject) -> None:
    """The best tree that really uses something is the best small one that uses it."""
    at_hand, done = brute_force.closure(where, range(len(where.foon.units)))
    made = [thing for thing in where.foon.objects if at_hand.get(thing, 0) > 0]
    inputs = [where.foon.units[unit].inputs for unit in sorted(done)]
    labels = sorted(
        {label for things in inputs for thing in things for label in where.node(thing).named_labels}
    )
    assume(made and labels)
    using = data.draw(st.lists(st.sampled_from(labels), min_size=1, max_size=2, unique=True))
    result = suggest(where, by=by, using=using, everything=True)
    assert result.skipped == 0
    assert result.candidates == len(made)
    found = {where.id_of(each.dish): each for each in result.dishes}
    goal = data.draw(st.sampled_from([where.id_of(thing) for thing in made]))
    real, small = tree_costs(where, goal, using)
    event(f"{len(using)} labels, {'no ' * (not real)}tree")
    assert (goal in found) == bool(real) == bool(small)
    if not real:
        return
    expected = brute_force.best(real, by)
    if "depth" not in by:
        # Superfluous units can only help to be done in fewer rounds.
        assert {name: brute_force.best(small, by)[name] for name in by} == {
            name: expected[name] for name in by
        }
    tree = found[goal].tree
    assert brute_force.replays(where, where.node(goal), tree.units)
    paid = brute_force.costs(where, where.node(goal), tree.units)
    assert paid is not None
    for name in by:
        assert paid[name] == expected[name] or (
            name == "success" and isclose(float(paid[name]), float(expected[name]), rel_tol=1e-4)
        )
    for label in using:
        rest = [unit.id for unit in tree.steps if not takes(where, unit, label)]
        assert where.node(goal) not in brute_force.closure(where, rest)[0]


@many(60)
@given(where=domains())
def test_without_ingredients_it_is_the_method_optimal(where: Domain) -> None:
    result = suggest(where, everything=True)
    for each in result.dishes:
        alone = retrieve(where, each.dish).tree
        assert alone is not None
        assert each.costs.units == alone.costs.units
    keys = [(each.costs.units, str(each.dish)) for each in result.dishes]
    assert keys == sorted(keys)


# --- How they are written -------------------------------------------------------------------------


def test_text() -> None:
    where = domain(MENU, STOCK, rates=RATES)
    assert suggestions_text(suggest(where)) == (
        "4 dishes, the best by units first\n"
        "\n"
        "units  dish\n"
        "    1  boiled egg [ready]\n"
        "    1  cocoa [ready]\n"
        "    1  toast [ready]\n"
        "    2  omelette [ready]\n"
    )
    assert suggestions_text(suggest(where, by="success,depth", using=["egg", "salt"])) == (
        "1 dish made with egg and salt, the best by success, depth first\n"
        "\n"
        "success  depth  units  dish\n"
        "  0.941      2      2  omelette [ready]\n"
    )
    assert suggestions_text(suggest(where), 1).splitlines()[2:] == [
        "units  dish",
        "    1  boiled egg [ready]",
        "and 3 more",
    ]
    assert suggestions_text(suggest(where, using=["egg", "milk"])) == (
        "no dish made with egg and milk was found\n"
    )
    assert suggestions_text(suggest(where, time_limit=0)) == (
        "no dish was found\nthe time ran out: 4 more candidates not looked at\n"
    )


def test_a_chance_that_is_not_known_is_no_chance() -> None:
    where = domain(MENU[:1], "egg")
    object.__setattr__(where.kitchen, "default_rate", None)
    with pytest.raises(QueryError, match="no success rate"):
        suggest(where, by="success")
    assert suggest(where).dishes[0].costs.success is None


def test_json() -> None:
    validator = Draft202012Validator(json.loads(SCHEMA.read_text("utf-8")))
    where = domain(MENU, STOCK, rates=RATES)
    for result in (
        suggest(where, by="success,2*units+inputs", using=["egg"]),
        suggest(where, constraints=Constraints(without=("milk",))),
        suggest(where, time_limit=0),
    ):
        validator.validate(suggestions_value(result))
    value = suggestions_value(suggest(where, using=["egg"]), 1)
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
    where = built_in.domain()
    result = suggest(where, built_in.goals, using=["egg"])
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
    assert {each.dish for each in suggest(where, built_in.goals).dishes} >= set(built_in.goals)


def really_used(where: Domain, result: Suggestions) -> bool:
    return all(
        where.id_of(each.dish)
        not in where.reading.execute(
            where.stock, [unit.id for unit in each.tree.steps if not takes(where, unit, label)]
        ).available
        for each in result.dishes
        for label in result.using
    )


def test_universal_dishes(universal: Dataset, universal_domain: Domain) -> None:
    where = universal_domain
    every = suggest(where, universal.goals)
    best = {each.dish: each.costs.units for each in every.dishes}
    assert every.candidates == len(best) == 231
    for goal in universal.goals:
        tree = retrieve(where, goal).tree
        assert best.get(goal) == (None if tree is None else tree.costs.units)
    for using, count in ((["egg"], 100), (["egg", "milk"], 50)):
        result = suggest(where, universal.goals, using=using)
        assert len(result.dishes) == count
        assert all(each.tree.executable and best[each.dish] <= each.costs.units for each in result.dishes)
        assert really_used(where, result)


def test_universal_dishes_by_success(universal: Dataset, universal_domain: Domain) -> None:
    """Core-guided optimisation of some of these takes very long, unless encoding and program help it."""
    for using, count in ((["garlic"], 76), (["butter", "milk"], 43), (["egg"], 100)):
        result = suggest(universal_domain, universal.goals, "success", using=using, time_limit=60)
        assert (len(result.dishes), result.skipped) == (count, 0)
        assert really_used(universal_domain, result)


@pytest.mark.parametrize(("name", "value"), [("_PATIENCE", 0.0), ("_BATCH", 1), ("_BATCH", 100_000)])
def test_how_dishes_are_grounded_together_does_not_matter(
    name: str, value: float, built_in: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    where = built_in.domain()
    expected = [suggest(where, built_in.goals, by, using=["salt"]) for by in ("units", "success")]
    monkeypatch.setattr(f"foon_asp.suggest.{name}", value)
    found = [suggest(where, built_in.goals, by, using=["salt"]) for by in ("units", "success")]
    for one, other in zip(expected, found, strict=True):
        assert len(one.dishes) > 20
        assert [(each.dish, each.costs.units) for each in one.dishes] == [
            (each.dish, each.costs.units) for each in other.dishes
        ]
