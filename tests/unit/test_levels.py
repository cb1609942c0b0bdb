"""Levels of detail: what they show, and that what can be done in full can be done on every level."""

from __future__ import annotations

import pytest

from foon_asp.errors import QueryError
from foon_asp.model.consumption import Effects
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.levels import LEVELS, at_level, project
from foon_asp.model.node import Annotation, Interval, Mark, ObjectNode, Source, State
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.query.goals import find_goal
from support.level_checks import on
from support.small_foons import foon, node, nodes, world

# --- What a level shows ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("thing", "level_2", "level_1"),
    [
        ("onion[whole]", "onion[whole]", "(onion)"),
        ("(knife)", "(knife)", "(knife)"),
        ("bowl{onion}", "bowl[contains]", "(bowl)"),
        ("bowl{}", "bowl[contains]", "(bowl)"),
        ("bowl[dirty]{onion,salt}@sink", "bowl[dirty,contains]@sink", "(bowl)"),
        ("onion[chopped]@bowl", "onion[chopped]@bowl", "(onion)"),
    ],
)
def test_a_level_shows_so_much_of_an_object(thing: str, level_2: str, level_1: str) -> None:
    assert project(node(thing), 3) == node(thing)
    assert project(node(thing), 2) == node(level_2)
    assert project(node(thing), 1) == node(level_1)


def test_states_that_become_equal_are_one() -> None:
    both = ObjectNode.of("pan", [State("on", "stove", ("oil",)), State("on", "stove"), State("hot")])
    assert project(both, 2) == ObjectNode.of("pan", [State("on", "stove"), State("hot")])


def test_units_that_become_equal_are_one() -> None:
    full = foon(
        "salt + bowl{rice} -pour-> bowl{rice,salt}",
        "salt + bowl{pasta} -pour-> bowl{pasta,salt}",
        "salt + bowl{rice} -mix-> bowl{rice,salt}",
    )
    assert at_level(full, 3) is full
    view = at_level(full, 2)
    assert [unit.motion for unit in view.units] == ["pour", "mix"]
    assert view.objects == nodes("salt + bowl[contains]")
    assert view.duplicates == 1
    assert at_level(view, 1).duplicates == at_level(full, 1).duplicates == 1


def test_annotations_and_sources_are_kept() -> None:
    builder = FoonBuilder()
    rice, pasta, salt = (builder.object(node(text)) for text in ("bowl{rice}", "bowl{pasta}", "salt"))
    marks = (Mark(False), Mark(True), Mark(goal="!"))
    builder.unit(
        "pour", [rice, pasta], [salt], Annotation((Source("a", 1),), times=(Interval(3.0),), marks=marks)
    )
    builder.unit("pour", [pasta], [salt], Annotation((Source("b", 7),), times=(Interval(9.0),)))
    for level in (2, 1):
        (unit,) = at_level(builder.build(), level).units
        expected = Annotation(
            (Source("a", 1), Source("b", 7)), times=(Interval(3.0),), marks=(marks[0], marks[2])
        )
        assert unit.annotation == expected


def test_the_marks_of_ports_that_are_not_read_go_with_them() -> None:
    builder = FoonBuilder()
    bowl, onion, soup = (builder.object(node(text)) for text in ("bowl{onion}", "onion@bowl", "soup"))
    knife = builder.object(node("(knife)"))
    marks = (Mark(False), Mark(True), Mark(False), Mark(goal="!"))
    builder.unit("cut", [bowl, onion], [knife, soup], Annotation(marks=marks))
    kitchen = Kitchen((), frozenset({"bowl", "knife"}))
    (unit,) = World.of(builder.build(), kitchen, level=2).foon.units
    assert unit.annotation.marks == (Mark(True), Mark(goal="!"))


@pytest.mark.parametrize("level", [0, 4, -1])
def test_there_are_three_levels(level: int) -> None:
    with pytest.raises(QueryError, match=f"no level {level}"):
        at_level(foon("a -go-> b"), level)
    with pytest.raises(QueryError, match=f"no level {level}"):
        World.of(foon("a -go-> b"), Kitchen(()), level=level)


# --- Planning on a level --------------------------------------------------------------------------


def test_what_is_needed_is_read_before_contents_are_gone() -> None:
    """On level 2 `bowl [contains]` cannot be seen to be only another view of the onion."""
    units = ["bowl{onion} + onion@bowl -cook-> soup"]
    full = world(units, "onion@bowl", utensils=["bowl"])
    assert [on(level, full).closure.executable.keys() for level in LEVELS] == [{0}] * 3
    view = at_level(full.foon, 2)
    assert not World.of(view, full.kitchen).closure.executable


def test_what_is_made_is_read_before_states_are_gone() -> None:
    """On level 1 everything is bare: the clean knife is made, the knife that is listed again is not."""
    units = ["a -cut-> b + (knife)", "(fork) -wash-> fork[clean] + b"]
    full = world(units, "a + (fork)", utensils=["knife"])
    view = on(1, full)
    made = [{view.node(thing).label for thing in makes} for makes in view.units.makes]
    assert made == [{"b"}, {"fork", "b"}]
    assert view.id_of(node("(knife)")) not in view.closure.available


def test_goals_are_found_in_full_and_as_they_are_shown() -> None:
    full = world(["onion[whole] + (knife) -cut-> onion[chopped]{juice}"], "onion[whole] + (knife) + pan[hot]")
    goal = node("onion[chopped]{juice}")
    assert on(2, full).project(goal) == node("onion[chopped,contains]")
    assert on(2, full).id_of(goal) == on(2, full).id_of(node("onion[chopped,contains]")) == 2
    assert find_goal(on(1, full), "onion") == on(1, full).project(goal) == node("(onion)")
    assert on(1, full).id_of(node("pan[cold]")) == len(on(1, full).foon.objects)
    with pytest.raises(QueryError, match="unknown goal 'leek'"):
        on(1, full).id_of(node("leek"))


# --- Properties -----------------------------------------------------------------------------------


def test_labels_only_makes_bare_outputs() -> None:
    listed = foon("(b) + a -cut-> (b) + (c) + (d)")
    assert Units(listed, ["d"]).makes == [(2,)]
    assert Units(listed, ["d"], labels_only=True).makes == [(0, 2, 3)]


@pytest.mark.parametrize("level", LEVELS)
def test_a_product_without_states_is_made_and_used_up(level: int) -> None:
    """On level 3; below, what has no state stands for a tool, as it always did."""
    full = world(["a -blend-> (b)", "(b) + (knife) -pour-> c", "(b) + (knife) -top-> d"], "a + (knife)")
    view = on(level, full)
    assert all(unit in view.closure.executable for unit in view.foon.units.ids)
    effects = Effects(view, "consume")
    assert [[str(view.node(gone)) for gone in effects.deletes(unit)] for unit in view.foon.units.ids] == [
        [],
        ["b"] if level == 3 else [],
        ["b"] if level == 3 else [],
    ]
