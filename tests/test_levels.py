"""Levels of detail: what they show, and that what can be done in full can be done on every level."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import brute_force
import clingo
import pytest
from hypothesis import event, given
from hypothesis import strategies as st
from small_foons import domain, domains, foon, many, motions, node, nodes, queries

import foon_asp
from foon_asp import resources
from foon_asp.builder import FoonBuilder
from foon_asp.dataset import Dataset
from foon_asp.errors import QueryError
from foon_asp.facts import facts
from foon_asp.goals import find_goal
from foon_asp.graph import Annotation, Foon, Mark, ObjectNode, Source, State
from foon_asp.kitchen import Kitchen
from foon_asp.levels import LEVELS, at_level, project
from foon_asp.problem import Domain, Problem
from foon_asp.reading import Reading
from foon_asp.retrieve import reach, retrieve
from foon_asp.solve import Solver
from foon_asp.tree import TaskTree, replay

METHODS: list[tuple[str, tuple[str, ...]]] = [
    ("first", ()),
    ("ids", ()),
    ("greedy", ("success",)),
    ("greedy", ("inputs",)),
    ("optimal", ("units",)),
    ("optimal", ("success",)),
    ("optimal", ("inputs", "depth")),
]
WITH_REFERENCE = [each for each in METHODS if each[0] != "ids" and "depth" not in each[1]]


def on(level: int, full: Domain) -> Domain:
    return Domain(full.foon, full.kitchen, strict=full.strict, level=level)


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
    builder.unit("pour", [rice, pasta], [salt], Annotation((Source("a", 1),), start=3.0, marks=marks))
    builder.unit("pour", [pasta], [salt], Annotation((Source("b", 7),), start=9.0))
    for level in (2, 1):
        (unit,) = at_level(builder.build(), level).units
        expected = Annotation((Source("a", 1), Source("b", 7)), start=3.0, marks=(marks[0], marks[2]))
        assert unit.annotation == expected


def test_the_marks_of_ports_that_are_not_read_go_with_them() -> None:
    builder = FoonBuilder()
    bowl, onion, soup = (builder.object(node(text)) for text in ("bowl{onion}", "onion@bowl", "soup"))
    knife = builder.object(node("(knife)"))
    marks = (Mark(False), Mark(True), Mark(False), Mark(goal="!"))
    builder.unit("cut", [bowl, onion], [knife, soup], Annotation(marks=marks))
    kitchen = Kitchen((), frozenset({"bowl"}))
    (unit,) = Domain(builder.build(), kitchen, level=2).foon.units
    assert unit.annotation.marks == (Mark(True), Mark(goal="!"))


@pytest.mark.parametrize("level", [0, 4, -1])
def test_there_are_three_levels(level: int) -> None:
    with pytest.raises(QueryError, match=f"no level {level}"):
        at_level(foon("a -go-> b"), level)
    with pytest.raises(QueryError, match=f"no level {level}"):
        Domain(foon("a -go-> b"), Kitchen(()), level=level)


# --- Planning on a level --------------------------------------------------------------------------


def test_what_is_needed_is_read_before_contents_are_gone() -> None:
    """On level 2 `bowl [contains]` cannot be seen to be only another view of the onion."""
    units = ["bowl{onion} + onion@bowl -cook-> soup"]
    full = domain(units, "onion@bowl", utensils=["bowl"])
    assert [on(level, full).closure.executable.keys() for level in LEVELS] == [{0}] * 3
    view = at_level(full.foon, 2)
    assert not Domain(view, full.kitchen).closure.executable


def test_what_is_made_is_read_before_states_are_gone() -> None:
    """On level 1 everything is bare: the clean knife is made, the knife that is listed again is not."""
    full = domain(["a -cut-> b + (knife)", "(fork) -wash-> fork[clean] + b"], "a + (fork)")
    view = on(1, full)
    made = [{view.node(thing).label for thing in makes} for makes in view.reading.makes]
    assert made == [{"b"}, {"fork", "b"}]
    assert view.id_of(node("(knife)")) not in view.closure.available


def test_a_foon_that_was_cut_to_labels_before_can_still_be_planned_on() -> None:
    cut = at_level(foon("a + (knife) -cut-> b"), 1)
    kitchen = Kitchen(tuple(nodes("a + (knife)")))
    result = retrieve(Domain(cut, kitchen, level=1), node("b"))
    assert result.tree is not None
    assert len(result.tree.units) == 1


def test_goals_are_found_in_full_and_as_they_are_shown() -> None:
    full = domain(
        ["onion[whole] + (knife) -cut-> onion[chopped]{juice}"], "onion[whole] + (knife) + pan[hot]"
    )
    goal = node("onion[chopped]{juice}")
    assert on(2, full).project(goal) == node("onion[chopped,contains]")
    assert on(2, full).id_of(goal) == on(2, full).id_of(node("onion[chopped,contains]")) == 2
    assert find_goal(on(1, full), "onion") == on(1, full).project(goal) == node("(onion)")
    assert on(1, full).id_of(node("pan[cold]")) == len(on(1, full).foon.objects)
    with pytest.raises(QueryError, match="unknown goal 'leek'"):
        on(1, full).id_of(node("leek"))


@pytest.mark.parametrize("level", LEVELS)
def test_facts_can_be_piped_to_clingo(level: int, tmp_path: Path, built_in: Dataset) -> None:
    view = Domain(built_in.foon, built_in.kitchen, level=level)
    path = tmp_path / "facts.lp"
    path.write_text(facts(Problem(view, (), whole=True)), "utf-8")
    said: list[str] = []
    control = clingo.Control(["--warn=all"], lambda _, message: said.append(message))
    control.load(str(path))
    control.load(str(resources.encoding("reachability.lp")))
    control.ground([("base", [])])
    with control.solve(yield_=True) as handle:
        (model,) = handle
        shown = model.symbols(shown=True)
    available = {atom.arguments[0].number for atom in shown if atom.name == "available"}
    assert available == view.closure.available.keys() > set(view.stock)
    assert said == []


# --- Properties -----------------------------------------------------------------------------------

Ports = frozenset[ObjectNode]


def read_units(full: Domain, level: int) -> set[tuple[Ports, str, Ports]]:
    """Return what the units of a FOON need and make on a level, by the definitions."""
    return {
        (
            frozenset(project(thing, level) for thing in brute_force.needs(full, unit)),
            unit.motion,
            frozenset(project(thing, level) for thing in brute_force.makes(full, unit)),
        )
        for unit in full.foon.units
    }


def shown(view: Domain) -> list[tuple[Ports, str, Ports]]:
    """Return what the units of a domain need and make, by its own reading."""
    reading = view.reading
    return [
        (
            frozenset(map(view.node, reading.needs[unit.id])),
            unit.motion,
            frozenset(map(view.node, reading.makes[unit.id])),
        )
        for unit in view.foon.units
    ]


def made(kitchen: Collection[ObjectNode], units: Sequence[tuple[Ports, str, Ports]]) -> set[ObjectNode]:
    at_hand = set(kitchen)
    before = -1
    while before < len(at_hand):
        before = len(at_hand)
        for needs, _, makes in units:
            if needs <= at_hand:
                at_hand |= makes
    return at_hand


@pytest.mark.parametrize("level", [1, 2])
@many(150)
@given(full=domains())
def test_readings_are_those_of_the_full_units_projected(level: int, full: Domain) -> None:
    view = on(level, full)
    assert len(shown(view)) == len(set(shown(view))) == len(view.foon.units)
    assert set(shown(view)) == read_units(full, level)
    assert view.kitchen.objects == tuple(dict.fromkeys(project(o, level) for o in full.kitchen.objects))
    for unit, image in zip(full.foon.units, view.images, strict=True):
        needs, motion, makes = shown(view)[image]
        assert motion == unit.motion
        assert needs == {project(thing, level) for thing in brute_force.needs(full, unit)}
        assert makes == {project(thing, level) for thing in brute_force.makes(full, unit)}


@pytest.mark.parametrize("level", LEVELS)
@many(100)
@given(full=domains())
def test_units_lp_reads_a_level_as_the_plain_reading_does(level: int, full: Domain) -> None:
    view = on(level, full)
    text = facts(Problem(view, (), whole=True)) + "#show needs/2. #show makes/2."
    answer = Solver(["units.lp"], text, {"strict": int(view.strict)}).best(None)
    assert answer.atoms is not None
    for name, table in (("needs", view.reading.needs), ("makes", view.reading.makes)):
        found = {arguments for predicate, arguments in answer.atoms if predicate == name}
        assert found == {(unit, thing) for unit, things in enumerate(table) for thing in things}


@pytest.mark.parametrize("level", LEVELS)
@many(100)
@given(full=domains())
def test_reach_is_what_the_definitions_make(level: int, full: Domain) -> None:
    view = on(level, full)
    available, _ = reach(view)
    kitchen = {project(thing, level) for thing in full.kitchen.objects}
    expected = made(kitchen, list(read_units(full, level)))
    assert {view.node(number) for number in available} == expected


def check_lower_levels(full: Domain) -> None:
    """Whatever can be reached or executed on a level can be on the levels below."""
    views = {level: on(level, full) for level in LEVELS}
    for upper, lower in ((3, 2), (2, 1), (3, 1)):
        above, below = views[upper], views[lower]
        there = {below.node(number) for number in below.closure.available}
        assert {project(above.node(number), lower) for number in above.closure.available} <= there
        pairs = zip(above.images, below.images, strict=True)
        done = {image for unit, image in pairs if unit in above.closure.executable}
        assert done <= below.closure.executable.keys()


@many(300)
@given(domains())
def test_what_is_reachable_is_reachable_on_lower_levels(full: Domain) -> None:
    check_lower_levels(full)


def images(view: Domain, units: Sequence[int]) -> list[int]:
    return list(dict.fromkeys(view.images[unit] for unit in units))


@pytest.mark.parametrize(("method", "by"), METHODS, ids=str)
@many(60)
@given(query=queries())
def test_the_image_of_a_task_tree_is_a_task_tree(
    method: str, by: tuple[str, ...], query: tuple[Domain, ObjectNode]
) -> None:
    full, goal = query
    tree = retrieve(full, goal, method, by).tree
    event("a tree" if tree else "no tree")
    if tree is not None:
        for level in LEVELS:
            view = on(level, full)
            assert replay(view, [view.id_of(goal)], images(view, tree.units)).executable


@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize(("method", "by"), METHODS, ids=str)
@many(60)
@given(query=queries())
def test_every_method_works_on_a_level(
    method: str, by: tuple[str, ...], level: int, query: tuple[Domain, ObjectNode]
) -> None:
    full, goal = query
    view = on(level, full)
    result = retrieve(view, goal, method, by)
    units = shown(view)
    kitchen = view.kitchen.objects
    target = project(goal, level)
    event(result.status)
    if target not in made(kitchen, units):
        assert result.status == "unreachable"
        assert result.tree is None
        assert result.reason
        return
    assert result.tree is not None
    assert result.tree.executable
    assert target in made(kitchen, [units[unit] for unit in result.tree.units])
    if by == ("units",):
        least = min(
            size
            for size in range(len(units) + 1)
            for chosen in combinations(units, size)
            if target in made(kitchen, chosen)
        )
        assert len(result.tree.units) == least


@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize(("method", "by"), WITH_REFERENCE, ids=str)
@many(40)
@given(query=queries())
def test_the_published_reading_works_on_a_level(
    method: str, by: tuple[str, ...], level: int, query: tuple[Domain, ObjectNode]
) -> None:
    full, goal = query
    view = on(level, full)
    result = retrieve(view, goal, method, by, founded=False)
    makers = [unit for unit in shown(view) if project(goal, level) in unit[2]]
    in_kitchen = project(goal, level) in view.kitchen.objects
    assert (result.tree is not None) == (in_kitchen or bool(makers))


@many(100)
@given(domains(), st.sampled_from([2, 1]))
def test_the_view_of_a_view_is_a_view(full: Domain, level: int) -> None:
    def content(view: Foon) -> tuple[list[ObjectNode], list[tuple[str, object, object]]]:
        return list(view.objects), [(unit.motion, unit.inputs, unit.outputs) for unit in view.units]

    view = at_level(full.foon, level)
    assert content(at_level(view, level)) == content(view)
    assert content(at_level(at_level(full.foon, 2), level)) == content(view)
    assert len(view.units) + view.duplicates == len(full.foon.units) + full.foon.duplicates


def test_labels_only_makes_bare_outputs() -> None:
    assert Reading(foon("a -cut-> (b)"), ()).makes == [()]
    assert Reading(foon("a -cut-> (b)"), (), labels_only=True).makes == [(1,)]


# --- The public data ------------------------------------------------------------------------------


def independent_count(full: Foon, level: int) -> tuple[int, int]:
    """Count units and objects on a level as sets of what is shown."""

    def seen(number: int) -> object:
        thing = full.objects[number]
        if level == 1:
            return thing.label
        if level == 2:
            return thing.label, frozenset((state.name, state.relatum) for state in thing.states)
        return thing.label, frozenset(thing.states)

    units = {
        (unit.motion, frozenset(map(seen, unit.inputs)), frozenset(map(seen, unit.outputs)))
        for unit in full.units
    }
    return len(units), len({seen(number) for number in range(len(full.objects))})


@pytest.mark.parametrize(
    ("folder", "expected"),
    [
        ("universal", {3: (2376, 4305), 2: (2287, 2610), 1: (2079, 502)}),
        ("subgraphs", {3: (1099, 2152), 2: (1064, 1377), 1: (991, 337)}),
    ],
)
def test_units_and_objects_of_the_public_data(
    public_data: Path, folder: str, expected: dict[int, tuple[int, int]]
) -> None:
    full = foon_asp.load(public_data / folder).foon
    views = {level: at_level(full, level) for level in LEVELS}
    found = {level: (len(view.units), len(view.objects)) for level, view in views.items()}
    assert found == {level: independent_count(full, level) for level in LEVELS}
    assert found == expected


def with_starting_objects(dataset: Dataset) -> Domain:
    """Give a FOON that has no kitchen all objects that no unit makes."""
    reading = Reading(dataset.foon, ())
    starts = tuple(thing for number, thing in enumerate(dataset.foon.objects) if number not in reading.makers)
    return Domain(dataset.foon, replace(dataset.kitchen, objects=starts, default_rate=1.0))


def test_what_is_reachable_in_the_public_data_is_reachable_on_lower_levels(
    public_data: Path, universal_domain: Domain
) -> None:
    check_lower_levels(universal_domain)
    check_lower_levels(with_starting_objects(foon_asp.load(public_data / "subgraphs")))


@pytest.mark.parametrize(
    ("level", "units", "executable", "available"),
    [(3, 2376, 2306, 4192), (2, 2275, 2255, 2588), (1, 2015, 2003, 498)],
)
def test_reach_on_the_levels_of_the_universal_foon(
    universal_domain: Domain, level: int, units: int, executable: int, available: int
) -> None:
    view = on(level, universal_domain)
    found = reach(view)
    read = read_units(universal_domain, level)
    kitchen = {project(thing, level) for thing in universal_domain.kitchen.objects}
    at_hand = made(kitchen, list(read))
    assert {view.node(number) for number in found[0]} == at_hand
    assert len(found[0]) == available
    if level < 3:
        assert len(view.foon.units) == len(read)
        assert len(found[1]) == sum(needs <= at_hand for needs, _, _ in read)
    assert (len(view.foon.units), len(found[1])) == (units, executable)


@pytest.mark.parametrize(("method", "by"), METHODS, ids=str)
def test_public_goals_on_lower_levels(
    universal: Dataset, universal_domain: Domain, method: str, by: tuple[str, ...]
) -> None:
    views = [on(level, universal_domain) for level in (2, 1)]
    for goal in universal.goals:
        tree: TaskTree | None = retrieve(universal_domain, goal, method, by).tree
        for view in views:
            result = retrieve(view, goal, method, by)
            if tree is None:
                continue
            assert replay(view, [view.id_of(goal)], images(view, tree.units)).executable
            assert result.tree is not None
            assert result.tree.executable
            if method == "optimal" and by == ("units",):
                assert len(result.tree.units) <= len(tree.units)


def test_each_level_has_its_own_units(universal_domain: Domain) -> None:
    """A unit of a view stands for all units that become equal to it."""
    for level in (2, 1):
        view = on(level, universal_domain)
        assert sorted(set(view.images)) == list(range(len(view.foon.units)))
        sources = sum(len(unit.annotation.sources) for unit in view.foon.units)
        assert sources == sum(len(unit.annotation.sources) for unit in universal_domain.foon.units)
        assert motions(view, view.images) == motions(universal_domain, range(len(view.images)))
