"""Explanations: what is missing is exactly the least, circles are circles, steps are there for a reason."""

from __future__ import annotations

from dataclasses import replace

import pytest

from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.model.node import UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.goals import find_goal
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.unreachable import unreachable_reason
from foon_asp.render.explain import explanation_text, reason_text
from foon_asp.retrieval.explain import MOST, explain, explain_step
from foon_asp.retrieval.nearest import Near
from foon_asp.retrieval.retrieve import retrieve
from support.cli import run
from support.explanations import as_nodes, check_every_goal, kitchen_without, poorer, value
from support.small_foons import node, nodes, world, written

# --- Guises of the dish ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("units", "goal", "missing"),
    [
        # Only what units make of other things is a guise of the dish; the rest is bought.
        (("flour -bake-> pie", "pie[cold] -heat-> pie"), "pie", "flour"),
        (("flour + salt -bake-> pie", "plate{pie} -take-> pie"), "pie", "flour + salt"),
        (("flour + salt -bake-> pie", "pan[warm]@pie -lift-> pie"), "pie", "flour + salt"),
        (("flour + x -bake-> pie{a,b}", "dish{a,b} -lift-> pie{a,b}"), "pie{a,b}", "flour + x"),
        (("flour + x -bake-> pie{a,b}", "dish{a,b,c} -sort-> pie{a,b}"), "pie{a,b}", "dish{a,b,c}"),
        # The dish in another guise is better than nothing, but only if no unit makes it.
        (("pie[cold] + (oven) -heat-> pie",), "pie", "pie[cold] + (oven)"),
        (("plate{pie} -take-> pie",), "pie", "plate{pie}"),
        (("pie[cold] -heat-> pie", "pie -cool-> pie[cold]"), "pie", None),
        # An empty vessel is no dish, and what it holds is.
        (("bowl[empty] + egg -crack-> bowl{egg,salt}",), "bowl{egg,salt}", "bowl[empty] + egg"),
        (
            ("bowl{a} -m-> bowl{a,b}", "bowl[empty] + x + y -n-> bowl{a,b}"),
            "bowl{a,b}",
            "bowl[empty] + x + y",
        ),
        (("soup@pan -pour-> bowl{soup}", "x + y -cook-> bowl{soup}"), "bowl{soup}", "x + y"),
        (("water@jug -pour-> bowl{water}",), "bowl{water}", "water@jug"),
        # Raw comes before prepared, however much it is; an empty vessel is raw though units empty it.
        (("a -m-> p", "p -n-> goal", "p -back-> a", "b + c + d -o-> goal"), "goal", "b + c + d"),
        (("bowl[empty] + a -m-> goal", "bowl{goal} -n-> bowl[empty]"), "goal", "bowl[empty] + a"),
        (("p + q -m-> goal", "p -n-> q", "q -o-> p"), "goal", "p"),
        # Of as many things the plainest are best.
        (("cup{a,b} -m-> goal", "cup{a} -n-> goal"), "goal", "cup{a}"),
        (("cup[wet,cold] -m-> goal", "cup[wet] -n-> goal"), "goal", "cup[wet]"),
        # No unit makes it.
        (("goal -m-> b",), "goal", None),
    ],
)
def test_the_dish_in_another_guise_comes_last(units: tuple[str, ...], goal: str, missing: str | None) -> None:
    where = world(units, utensils=("bowl",))
    found = explain(where, Query(node(goal)), most=MOST)
    sets = {frozenset(as_nodes(where, each)) for each in found.missing.sets} if found.missing else set()
    expected = set() if missing is None else {frozenset(nodes(missing))}
    if units[0].startswith("p + q"):
        expected.add(frozenset([node("q")]))
    assert sets == expected


def test_the_goal_is_never_missing_nor_what_is_there() -> None:
    where = world(["a + b -m-> goal", "goal -n-> b"], "a")
    found = explain(where, Query(node("goal")))
    assert [str(thing.node) for thing in found.missing_objects] == ["b [ready]"]


def test_no_more_sets_are_sought_than_asked_for() -> None:
    units = ["a + b + c + d + e + f -mix-> goal"]
    units += [f"{thing}{k} -make-> {thing}" for thing in "abcdef" for k in range(2)]
    units += [f"{thing} -unmake-> {thing}{k}" for thing in "abcdef" for k in range(2)]
    where = world(units)
    found = explain(where, Query(node("goal")), most=MOST)
    assert found.missing is not None
    assert (len(found.missing.sets), found.missing.complete) == (MOST, False)
    assert f"There are more: no more than {MOST} were looked for." in explanation_text(found)
    every = explain(where, Query(node("goal")), most=1000)
    assert every.missing is not None
    assert (len(every.missing.sets), every.missing.complete) == (3**6, True)


# --- What there is instead ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kitchen", "lacks", "nearest"),
    [
        ("egg[boiled]", "egg[raw]", ["egg[boiled]"]),
        ("egg[raw]@box + egg[boiled]", "egg[raw]", ["egg[raw]@box", "egg[boiled]"]),
        ("cake{egg,flour}", "egg[raw]", []),
        ("bowl{egg} + bowl{egg,flour,salt}", "egg[raw]", ["bowl{egg}"]),
        ("bowl{oil} + oil@can", "bowl{milk}", []),
        ("bowl{milk,sugar} + milk@can + cup{milk}", "bowl{milk}", ["cup{milk}", "milk@can"]),
        ("cup{a} + bowl{a} + cup{b}", "bowl{a,b}", ["bowl{a}", "cup{b}", "cup{a}"]),
        ("(drinking glass) + (pan)", "drinking glas[empty]", ["(drinking glass)"]),
        ("(bowl) + (rice bowl) + onion", "salad bowl[empty]", ["(bowl)"]),
        ("bowl{soy sauce}", "cup{sauce}", ["bowl{soy sauce}"]),
        ("(cutter) + (cutting board)", "(pizza cutter)", ["(cutter)"]),
        ("leaf green", "(green)", []),
    ],
)
def test_what_the_kitchen_has_instead(kitchen: str, lacks: str, nearest: list[str]) -> None:
    where = world([f"{lacks} -m-> goal"], kitchen, utensils=("bowl", "cup", "salad bowl"))
    [thing] = explain(where, Query(node("goal"))).missing_objects
    assert [written(near.node) for near in thing.near] == nearest
    assert all(near.at_hand for near in thing.near)


def test_what_the_kitchen_can_make_instead() -> None:
    where = world(["egg[whole] -crack-> egg[raw]", "egg[boiled] -m-> goal"], "egg[whole]")
    [thing] = explain(where, Query(node("goal"))).missing_objects
    assert thing.near == (Near(node("egg[whole]"), True), Near(node("egg[raw]"), False))


def test_what_resembles_a_goal_that_no_unit_makes() -> None:
    where = world(["egg[raw] -boil-> egg[boiled]"], "egg[raw]")
    found = explain(where, Query(node("egg[raw]")))
    assert (found.status, found.steps) == ("reachable", ())
    assert explanation_text(found) == "egg [raw]\nnothing to do: the kitchen has it\n"
    empty = explain(world(["egg[raw] -boil-> egg[boiled]"], "egg[old]"), Query(node("egg[raw]")))
    assert (
        explanation_text(empty)
        == "egg [raw]\nno task tree: no unit makes egg [raw]\n  the kitchen has egg [old]\n"
    )


# --- Constraints ----------------------------------------------------------------------------------


def test_the_constraints_that_must_give_way_are_named(built_in: Dataset) -> None:
    where = built_in.world()
    held = Constraints(avoid_motions=("shake",), max_units=5, without_tools=("oven",))
    found = explain(where, Query(built_in.goals[0], constraints=held))
    assert (found.status, found.give_way, found.missing) == ("constrained", ("avoid motion shake",), None)
    assert found.reason in explanation_text(found)
    assert (
        retrieve(where, Query(built_in.goals[0], constraints=replace(held, avoid_motions=()))).tree
        is not None
    )


def test_constraints_that_the_missing_things_do_not_help_against() -> None:
    units = ["a + b -fry-> goal", "a -boil-> b[done]"]
    held = Constraints(avoid_motions=("fry",), max_units=7)
    found = explain(world(units, "a"), Query(node("goal"), constraints=held))
    assert (found.status, found.give_way) == ("unreachable", ("avoid motion fry",))
    assert explanation_text(found).endswith(
        "\nEven then there is no task tree, unless these constraints give way:\n  avoid motion fry\n"
    )
    boiling = explain(
        world(units, "a"), Query(node("goal"), constraints=Constraints(avoid_motions=("boil",)))
    )
    assert boiling.give_way == ()


# --- Steps ----------------------------------------------------------------------------------------


def test_a_forced_step_that_nothing_needs() -> None:
    where = world(["a -m-> goal", "a -n-> b"], "a")
    found = explain(where, Query(node("goal"), constraints=Constraints(use_units=(UnitId(1),))))
    idle = next(step for step in found.steps if step.unit.id == 1)
    assert idle.way == ()
    assert "nothing that a later step needs" in explanation_text(found)


def test_a_step_that_is_not_in_the_tree_names_those_that_are(
    built_in: Dataset, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(QueryError, match=r"unit 0 is not in the task tree of whipped cream .* 48 shake, 49"):
        explain_step(built_in.world(), Query(built_in.goals[0]), UnitId(0))
    status, _, err = run(capsys, "explain", "ice", "--instead")
    assert (status, err) == (2, "foon-asp: error: name the step to do without: --step ID\n")


# --- Text -----------------------------------------------------------------------------------------

CIRCLE = (
    "flour + yeast -knead-> dough",
    "dough -save-> starter",
    "starter -feed-> yeast",
    "dough -bake-> bread",
)


def test_text_of_a_circle() -> None:
    where = world(CIRCLE, "flour + yeast[dry]")
    assert explanation_text(explain(where, Query(node("bread")), most=MOST)) == (
        "bread [ready]\n"
        "no task tree: locked in a circle: dough [ready] is needed to make itself (unit 0, unit 2, unit 1)\n"
        "\n"
        "It could be made if the kitchen had one of these 3 choices:\n"
        "  a) yeast [ready] (prepared)\n"
        "  b) dough [ready] (prepared)\n"
        "  c) starter [ready] (prepared)\n"
        "\n"
        "This goes round in a circle:\n"
        "  knead makes dough [ready]\n"
        "      and needs yeast [ready]\n"
        "  feed makes yeast [ready]\n"
        "      and needs starter [ready]\n"
        "  save makes starter [ready]\n"
        "      and needs dough [ready] again\n"
    )


def test_text_of_what_is_missing(built_in: Dataset) -> None:
    where = kitchen_without(built_in, "jar", "heavy cream", "mixing bowl")
    found = explain(where, Query(built_in.goals[0]), most=MOST)
    assert explanation_text(found) == (
        "whipped cream [creamy, whipped] in [mixing bowl]\n"
        "no task tree: the kitchen lacks heavy cream [cold] in [cup], and no unit makes it\n"
        "\n"
        "It could be made if the kitchen had these 2 things:\n"
        "  heavy cream [cold] in [cup]\n"
        "  mixing bowl [empty]\n"
        "      the kitchen has bowl [empty]\n"
        "Nothing else as small would do.\n"
    )


def test_text_of_choices() -> None:
    units = ["(oven) + dough -bake-> bread", "flour + oil@can -mix-> dough", "flour + milk@jug -mix-> dough"]
    assert explanation_text(explain(world(units, "flour + oil@bowl"), Query(node("bread")), most=MOST)) == (
        "bread [ready]\n"
        "no task tree: the kitchen lacks oven, and no unit makes it\n"
        "\n"
        "It could be made if the kitchen had 2 more things. In any case:\n"
        "  oven\n"
        "and one of these 2 choices:\n"
        "  a) oil in [can]\n"
        "  b) milk in [jug]\n"
    )


def test_text_of_the_dish_in_another_state() -> None:
    text = explanation_text(
        explain(world(["egg[raw] + (pot) -boil-> egg[boiled]"]), Query(node("egg[boiled]")))
    )
    assert text == (
        "egg [boiled]\n"
        "no task tree: the kitchen lacks egg [raw] and pot, and no unit makes them\n"
        "\n"
        "It could be made if the kitchen had these 2 things:\n"
        "  egg [raw] (the same thing in another state or place)\n"
        "  pot\n"
    )


def test_text_where_nothing_helps() -> None:
    where = world(["soup[raw] -boil-> soup[raw] + soup[hot]"], "soup[cold]")
    assert explanation_text(explain(where, Query(node("soup[hot]")))) == (
        "soup [hot]\n"
        "no task tree: locked in a circle: soup [raw] is needed to make itself (unit 0)\n"
        "\n"
        "Nothing that could be added to the kitchen would help, but the dish itself.\n"
        "  the kitchen has soup [cold]\n"
        "\n"
        "This goes round in a circle:\n"
        "  boil makes soup [raw]\n"
        "      and needs it itself\n"
        "  the kitchen has soup [cold]\n"
    )


def test_the_first_sentence_can_be_told_before_the_rest(built_in: Dataset) -> None:
    where = kitchen_without(built_in, "lemon")
    goal = find_goal(where, "lemonade")
    problem = Problem.of(where, [goal])
    head = reason_text(goal, unreachable_reason(problem))
    found = explain(where, Query(goal))
    assert head.endswith("no task tree: the kitchen lacks lemon [whole], and no unit makes it\n")
    assert head + explanation_text(found, told=True) == explanation_text(found)
    assert unreachable_reason(Problem.of(built_in.world(), [goal])) == ""


def test_text_of_a_tree_and_its_steps(built_in: Dataset) -> None:
    where = built_in.world()
    assert explanation_text(explain(where, Query(built_in.goals[0]))) == (
        "whipped cream [creamy, whipped] in [mixing bowl]\n"
        "5 steps\n"
        "\n"
        "  1. pour [FOON.txt:489], unit 45\n"
        "     jar {heavy cream}: for step 2\n"
        "  2. add [FOON.txt:498], unit 46\n"
        "     jar {heavy cream, powdered sugar}: for step 3\n"
        "  3. close [FOON.txt:506], unit 47\n"
        "     jar [closed] {heavy cream, powdered sugar}: for step 4\n"
        "  4. shake [FOON.txt:513], unit 48\n"
        "     jar {whipped cream}: for step 5\n"
        "  5. scrape out [FOON.txt:520], unit 49\n"
        "     whipped cream [creamy, whipped] in [mixing bowl]: the goal\n"
    )
    assert explanation_text(explain_step(where, Query(built_in.goals[0]), UnitId(48), instead=True)) == (
        "whipped cream [creamy, whipped] in [mixing bowl]\n"
        "step 4 of 5: shake [FOON.txt:513], unit 48\n"
        "\n"
        "  takes  jar [closed] {heavy cream, powdered sugar} from step 3 (close)\n"
        "  makes  jar {whipped cream}: for step 5 (scrape out)\n"
        "  so     4 shake → 5 scrape out → whipped cream [creamy, whipped] in [mixing bowl]\n"
        "\n"
        "               with it  without it\n"
        "  units              5           6\n"
        "  inputs             9          12\n"
        "  success         0.32       0.403\n"
        "  depth              5           6\n"
        "  tools              4           4\n"
        "  dirty              3           2\n"
        "  motions            5           4\n"
        "\n"
        "without it these steps go (5) and come (6):\n"
        "  -   1. pour [FOON.txt:489], unit 45\n"
        "  -   2. add [FOON.txt:498], unit 46\n"
        "  -   3. close [FOON.txt:506], unit 47\n"
        "  -   4. shake [FOON.txt:513], unit 48\n"
        "  -   5. scrape out [FOON.txt:520], unit 49\n"
        "  +   1. chill [FOON.txt:538], unit 50\n"
        "  +   2. pour [FOON.txt:547], unit 51\n"
        "  +   3. add [FOON.txt:558], unit 52\n"
        "  +   4. add [FOON.txt:568], unit 53\n"
        "  +   5. whisk [FOON.txt:578], unit 54\n"
        "  +   6. whisk [FOON.txt:588], unit 55\n"
    )


def test_text_of_a_step_that_cannot_be_spared() -> None:
    where = world(
        ["(knife) + a -cut-> b + peel", "b + peel -fry-> c", "peel + c + a -mix-> goal"], "a + (knife)"
    )
    assert explanation_text(explain_step(where, Query(node("goal")), UnitId(0), instead=True)) == (
        "goal [ready]\n"
        "step 1 of 3: cut, unit 0\n"
        "\n"
        "  takes  knife from the kitchen\n"
        "         a [ready] from the kitchen\n"
        "  makes  b [ready]: for step 2 (fry)\n"
        "         peel [ready]: for step 2 (fry), step 3 (mix)\n"
        "  so     1 cut → 3 mix → goal [ready]\n"
        "\n"
        "There is no task tree without it.\n"
    )


# --- JSON -----------------------------------------------------------------------------------------


def test_json_of_what_is_missing(built_in: Dataset) -> None:
    where = world(CIRCLE, "flour + yeast[dry]")
    found = value(explain(where, Query(node("bread")), most=MOST))
    assert (found["status"], found["missing"]["sets"]) == ("unreachable", [[0], [1], [2]])
    assert [thing["object"]["label"] for thing in found["missing"]["things"]] == ["yeast", "dough", "starter"]
    assert found["missing"]["things"][0]["nearest"][0]["at_hand"]
    [circle] = found["circles"]
    assert [link["unit"]["motion"] for link in circle["links"]] == ["knead", "feed", "save"]
    assert [link["needs"]["label"] for link in circle["links"]] == ["yeast", "starter", "dough"]
    assert found["steps"] == []
    assert found["costs"] is found["instead"] is None
    nothing = value(
        explain(world(["soup[raw] -boil-> soup[raw] + soup[hot]"], "soup"), Query(node("soup[hot]")))
    )
    assert nothing["missing"]["sets"] == []
    assert nothing["nearest"][0]["object"]["states"] == ["ready"]
    held = Constraints(avoid_motions=("shake",), max_units=5)
    assert value(explain(built_in.world(), Query(built_in.goals[0], constraints=held)))["give_way"] == [
        "avoid motion shake"
    ]


def test_json_of_steps(built_in: Dataset) -> None:
    where = built_in.world()
    for goal in built_in.goals[:6]:
        found = value(explain(where, Query(goal)))
        assert found["costs"]["units"] == len(found["steps"])
        assert all(step["way"] for step in found["steps"])
    found = value(explain_step(where, Query(built_in.goals[0]), UnitId(48), instead=True))
    assert [step["way"] for step in found["steps"]] == [[4, 5]]
    assert (found["instead"]["status"], found["instead"]["costs"]["units"]) == ("optimal", 6)
    assert [unit["motion"] for unit in found["instead"]["comes"]][-1] == "whisk"
    alone = world(["a -m-> goal"], "a")
    assert (
        value(explain_step(alone, Query(node("goal")), UnitId(0), instead=True))["instead"]["status"]
        == "unreachable"
    )
    assert value(explain(where, Query("pesto pasta", time_limit=0)))["status"] == "limit"


# --- All goals, from poor kitchens and on each level ----------------------------------------------


@pytest.mark.parametrize(("kind", "level"), [("empty", 3), ("half", 3), ("half", 2), ("tools", 1)])
def test_what_is_missing_makes_each_goal(built_in: Dataset, kind: str, level: int) -> None:
    where = World.of(built_in.foon, poorer(built_in, kind), level=level)
    lacking = check_every_goal(built_in, where)
    assert lacking == len(built_in.goals) or kind != "empty"
    assert lacking or level == 1
