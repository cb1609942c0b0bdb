"""PDDL exports: names, text, readers, effects, plans there and back."""

from __future__ import annotations

import json
import random
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
import small_foons
from conftest import PUBLIC_DATA, ROOT
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.builder import FoonBuilder
from foon_asp.constraints import Constraints
from foon_asp.criteria import Level
from foon_asp.dataset import read_foon
from foon_asp.effects import SEMANTICS, Effects
from foon_asp.errors import InputError, QueryError
from foon_asp.graph import Annotation, Foon, ObjectNode, Source, State, contains, inside
from foon_asp.kitchen import Kitchen
from foon_asp.pddl import (
    export,
    from_unified_plan,
    to_partial_order,
    to_sequential_plan,
    unified,
    written_names,
)
from foon_asp.pddl_document import STYLES, Document, document
from foon_asp.pddl_names import RESERVED, DomainNames, Namer, read_names
from foon_asp.pddl_task import Fact, Task, executed_steps, exported_units, planning_task
from foon_asp.pddl_text import comment, domain_text, problem_text
from foon_asp.plan import Plan, Store, orderings
from foon_asp.prices import Prices
from foon_asp.problem import Domain, Problem
from foon_asp.tree import TaskTree

# The translator of Fast Downward leaves its files open; the others warn of what is theirs alone.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")

NAME = re.compile(r"[a-z][a-z0-9-]*")

_ODD = ["and", "define", "object", "not", "Onion", "onion", '"', "(", ")", ";", "*", "?x", "7 up", "jalapeño"]
ODD_LABELS = st.one_of(
    st.sampled_from(_ODD), st.text(max_size=6), st.text(alphabet="ab -()\"';*é\n", max_size=90)
)


def counted(where: Domain, **quantities: int) -> Domain:
    """Say of how many kitchen objects, by label, there are not plenty."""
    kitchen = where.kitchen
    counts = {node: quantities[node.label] for node in kitchen.objects if node.label in quantities}
    return Domain(where.foon, replace(kitchen, quantities=counts), strict=where.strict)


def soup() -> Domain:
    """A kitchen with two onions, and a bowl that comes in two views."""
    where = small_foons.domain(
        [
            "onion[whole] + (knife) -chop-> onion[chopped] + (knife)",
            "onion[chopped] + bowl[empty] -put-> bowl{onion} + onion[chopped]@bowl",
            "bowl{onion} + onion[chopped]@bowl + water -cook-> soup + bowl[dirty]",
            "bowl[dirty] + water -wash-> bowl[empty]",
        ],
        "onion[whole] + (knife) + bowl[empty] + water",
        utensils=["bowl", "knife"],
        rates={"chop": 0.9, "put": 1.0, "cook": 0.5, "wash": 1.0},
    )
    return counted(where, onion=2, bowl=1)


def exported(
    where: Domain,
    goals: Iterable[ObjectNode],
    semantics: str = "consume",
    level: str | None = None,
    style: str = "objects",
    durative: bool = False,
) -> Document:
    problem = where.problem(goals)
    task = planning_task(problem, Effects(where, semantics), Level.parse(level) if level else None)
    return document(task, style, durative)


@lru_cache(maxsize=1)
def readers() -> tuple[Any, Any, Any]:
    """Make each reader once: they take longer to set up than to read."""
    io = pytest.importorskip("unified_planning.io", reason="unified-planning is not installed")
    pddl_domain = pytest.importorskip("pddl.parser.domain", reason="the package pddl is not installed")
    pddl_problem = pytest.importorskip("pddl.parser.problem", reason="the package pddl is not installed")
    return io.PDDLReader(), pddl_domain.DomainParser(), pddl_problem.ProblemParser()


def up_reading(written: Document) -> Any:
    return readers()[0].parse_problem_string(domain_text(written), problem_text(written))


def check_up(written: Document) -> None:
    """Parse in unified_planning, where a single action takes about 20 ms."""
    assert {action.name for action in up_reading(written).actions} == {
        action.name for action in written.actions
    }


def check_others(written: Document, folder: Path) -> None:
    """Parse in the package `pddl`, and in Fast Downward's translator."""
    _, parse_domain, parse_problem = readers()
    domain = parse_domain(domain_text(written))
    assert {action.name for action in domain.actions} == {action.name for action in written.actions}
    parse_problem(problem_text(written))
    reader = pytest.importorskip(
        "fast_downward.translate.pddl_parser", reason="the translator of Fast Downward is not installed"
    )
    for name, text in (("domain.pddl", domain_text(written)), ("problem.pddl", problem_text(written))):
        (folder / name).write_text(text, encoding="utf-8")
    task = reader.open(str(folder / "domain.pddl"), str(folder / "problem.pddl"))
    # The translator drops actions that cannot change anything.
    assert {action.name for action in task.actions} <= {action.name for action in written.actions}
    assert len(task.init) >= len(written.initially)


def check_readers(written: Document, folder: Path) -> None:
    check_up(written)
    check_others(written, folder)


# Names


@small_foons.many(200)
@given(st.lists(ODD_LABELS, min_size=1, max_size=12))
def test_names_are_plain_and_one_to_one(texts: list[str]) -> None:
    namer = Namer()
    names = [namer.name(text) for text in texts]
    assert len(set(names)) == len(names)
    assert all(NAME.fullmatch(name) and name not in RESERVED for name in names)
    again = Namer()
    assert [again.name(text) for text in texts] == names


def odd_foon(labels: list[str]) -> Foon:
    """Make a FOON with any labels: as motions, labels, states, relata and contents."""
    builder = FoonBuilder()
    one, two = labels[0], labels[-1]
    nodes = [ObjectNode.of(label) for label in labels]
    nodes += [ObjectNode.of(label, [State(one)]) for label in labels]
    nodes += [ObjectNode.of(one, [inside(two)]), ObjectNode.of(two, [contains(one, one)])]
    nodes += [ObjectNode.of(two, [contains(one)]), ObjectNode.of(two, [contains()])]
    nodes += [ObjectNode.of(one, [State(two, one, (two,))])]
    nodes += [ObjectNode.of(one, [State(two, one), State(two, None, (two,))])]
    ids = list(dict.fromkeys(builder.object(node) for node in nodes))
    for place, label in enumerate(labels):
        note = Annotation(sources=(Source(f"/far away/{label}.txt", place + 1),))
        builder.unit(label, ids[place : place + 2], ids[-3 - place :], note)
    return builder.build()


@small_foons.many(30)
@given(st.lists(ODD_LABELS, min_size=2, max_size=5, unique=True), st.sampled_from(STYLES))
def test_odd_labels_export_and_parse(
    tmp_path_factory: pytest.TempPathFactory, labels: list[str], style: str
) -> None:
    foon = odd_foon(labels)
    where = Domain(foon, Kitchen(tuple(foon.objects[: len(labels)]), frozenset(labels[:1]), {}, 1.0))
    goal = len(foon.objects) - 1
    task = planning_task(Problem(where, (goal,), whole=True), Effects(where, "consume"))
    written = document(task, style)
    folder = tmp_path_factory.mktemp("odd")
    check_readers(written, folder)
    assert len(task.names.objects) == len(task.things)
    assert len(task.names.units) == len(foon.units)
    (folder / "names.json").write_text(written_names(written).encode(errors="replace").decode())
    read = read_names_if_writable(folder / "names.json", where, labels)
    if read is not None:
        assert (read.objects, read.units) == (task.names.objects, task.names.units)


def read_names_if_writable(path: Path, where: Domain, labels: list[str]) -> Any:
    """Read names back; labels with half a surrogate pair cannot be written, and no reader makes them."""
    if any("\ud800" <= character <= "\udfff" for label in labels for character in label):
        return None
    return read_names(path, where)


def test_names_do_not_depend_on_the_goal() -> None:
    where = soup()
    small = exported(where, [small_foons.node("onion[chopped]")])
    large = exported(where, [small_foons.node("soup")], level="units+tools", style="lifted")
    assert small.task.names.units.items() <= large.task.names.units.items()
    assert small.task.names.objects.items() <= large.task.names.objects.items()
    assert DomainNames.of(where).objects == DomainNames.of(Domain(where.foon, where.kitchen)).objects


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[]", "no names of a PDDL export"),
        ('{"format": "foon-asp pddl names", "version": 2}', "version 2"),
        ('{"format": "foon-asp pddl names", "version": 1}', "'objects'"),
        ('{"format": "foon-asp pddl names", "version": 1, "objects": {"A": 1}}', "'A' is no name"),
    ],
)
def test_unreadable_names(tmp_path: Path, text: str, complaint: str) -> None:
    (tmp_path / "names.json").write_text(text)
    with pytest.raises(InputError, match=complaint):
        read_names(tmp_path / "names.json", soup())


def test_names_of_another_foon(tmp_path: Path) -> None:
    where = soup()
    (tmp_path / "names.json").write_text(written_names(exported(where, [small_foons.node("soup")])))
    read_names(tmp_path / "names.json", where)
    other = small_foons.domain(["onion[raw] -fry-> onion[fried]"], "onion[raw]")
    with pytest.raises(InputError, match=r"is not of this FOON|here, not"):
        read_names(tmp_path / "names.json", other)


# Text

GOLDEN_DOMAIN = """\
; Functional units as actions (style objects, semantics consume). Costs: units.
; names.json says which unit or object each name stands for.
(define (domain foon)
  (:requirements :strips :action-costs)

  (:predicates
    (onion-whole)
    (knife)
    (onion-chopped)
    (onion-whole-left-1)  ; onion [whole]: 1 in the kitchen
    (onion-whole-left-0)  ; onion [whole]: 0 in the kitchen
  )

  (:functions (total-cost) - number)

  ; Take onion [whole] out of the kitchen, which holds 1.
  (:action take-onion-whole-1
    :parameters ()
    :precondition (and (onion-whole-left-1))
    :effect (and
      (onion-whole)
      (onion-whole-left-0)
      (not (onion-whole-left-1))
      (increase (total-cost) 0)))

  ; chop
  ; take onion [whole]; knife
  ; get onion [chopped]
  ; use up onion [whole]
  (:action chop-0
    :parameters ()
    :precondition (and (onion-whole) (knife))
    :effect (and (onion-chopped) (not (onion-whole)) (increase (total-cost) 1)))
)
"""

GOLDEN_PROBLEM = """\
; Get onion [chopped].
(define (problem get-onion-chopped)
  (:domain foon)

  (:init
    (= (total-cost) 0)
    (knife)
    (onion-whole-left-1)
  )

  (:goal (and (onion-chopped)))
  (:metric minimize (total-cost))
)
"""


def test_format() -> None:
    where = small_foons.domain(["onion[whole] + (knife) -chop-> onion[chopped]"], "onion[whole] + (knife)")
    written = exported(counted(where, onion=1), [small_foons.node("onion[chopped]")], level="units")
    assert domain_text(written) == GOLDEN_DOMAIN
    assert problem_text(written) == GOLDEN_PROBLEM
    assert json.loads(written_names(written)) == {
        "format": "foon-asp pddl names",
        "version": 1,
        "style": "objects",
        "semantics": "consume",
        "durative": False,
        "goals": [{"id": 2, "text": "onion [chopped]"}],
        "objects": {
            "onion-whole": {"id": 0, "text": "onion [whole]"},
            "knife": {"id": 1, "text": "knife"},
            "onion-chopped": {"id": 2, "text": "onion [chopped]"},
        },
        "actions": {"chop-0": {"unit": 0, "motion": "chop", "source": ""}},
        "helpers": {
            "take-onion-whole-1": "Take onion [whole] out of the kitchen, which holds 1.",
        },
    }


@given(st.text())
def test_comments_cannot_be_left(text: str) -> None:
    for line in comment(text, "  "):
        assert line.splitlines() == [line]
        assert line.startswith("  ;")


def test_lines_are_short() -> None:
    for style in STYLES:
        written = exported(soup(), [small_foons.node("soup")], level="units+tools", style=style)
        assert max(map(len, (domain_text(written) + problem_text(written)).splitlines())) <= 100


def test_the_examples_of_the_documentation() -> None:
    """Every block of PDDL in docs/pddl.md stands so in an export of the same small FOON."""
    where = small_foons.domain(
        ["onion[whole] + (knife) -chop-> onion[chopped]"], "onion[whole] + (knife)", utensils=["knife"]
    )
    where = counted(where, onion=1)
    texts = []
    for style in STYLES:
        for durative in (False, True):
            for level in (None, "units", "units+tools"):
                written = exported(
                    where, [small_foons.node("onion[chopped]")], "consume", level, style, durative
                )
                texts.append(domain_text(written) + problem_text(written))
    blocks = re.findall(r"```pddl\n(.*?)```", (ROOT / "docs" / "pddl.md").read_text(), re.DOTALL)
    assert len(blocks) >= 4
    for block in blocks:
        assert any(block in text for text in texts), block


# Reading back


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("durative", [False, True])
@pytest.mark.parametrize("level", [None, "2*units+tools+motions"])
@pytest.mark.parametrize("semantics", SEMANTICS)
def test_what_is_read_is_the_same_problem(
    style: str, durative: bool, level: str | None, semantics: str
) -> None:
    written = exported(soup(), [small_foons.node("soup")], semantics, level, style, durative)
    read = up_reading(written)
    assert read == unified(written).problem
    assert read.name == written.problem_name


def test_files(tmp_path: Path) -> None:
    where = soup()
    problem, effects = where.problem([small_foons.node("soup")]), Effects(where, "transform")
    written = export(problem, effects, Level.parse("time"), "lifted", True, folder=tmp_path / "new")
    names = ["domain.pddl", "names.json", "problem.pddl"]
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == names
    assert (tmp_path / "new" / "domain.pddl").read_text() == domain_text(written)
    first = {name: (tmp_path / "new" / name).read_bytes() for name in names}
    export(problem, effects, Level.parse("time"), "lifted", True, folder=tmp_path / "new")
    assert {name: (tmp_path / "new" / name).read_bytes() for name in names} == first


def subgraph_files() -> list[str]:
    return sorted(path.name for path in (PUBLIC_DATA / "subgraphs").glob("*.txt")) or ["none"]


@pytest.mark.parametrize("name", subgraph_files())
def test_public_subgraphs_parse(public_data: Path, tmp_path: Path, name: str) -> None:
    foon = read_foon([public_data / "subgraphs" / name]).foon
    made = {thing for unit in foon.units for thing in unit.outputs if not foon.objects[thing].bare}
    kitchen = [node for number, node in enumerate(foon.objects) if number not in made]
    where = Domain(foon, Kitchen(tuple(kitchen)))
    goals = foon.marked_goals() or [foon.objects[foon.units[-1].outputs[-1]]]
    written = exported(where, goals[:1], "consume", "units", "objects")
    check_readers(written, tmp_path)
    lifted = exported(where, goals[:1], "consume", "units", "lifted")
    check_others(lifted, tmp_path)
    if len(lifted.actions) < 8:
        # unified_planning takes seconds for the descriptions of a large one.
        check_up(lifted)
        check_up(exported(where, goals[:1], "transform", None, "objects", durative=True))


# Slices


def test_makers_of_what_the_kitchen_counts_are_exported() -> None:
    where = soup()
    goal = where.problem([small_foons.node("soup")])
    assert small_foons.motions(where, exported_units(goal, Effects(where, "add"))) == {"chop", "put", "cook"}
    # There is one empty bowl; to have another it must be washed.
    assert "wash" in small_foons.motions(where, exported_units(goal, Effects(where, "consume")))


def test_goals_that_cannot_be_reached_are_exported_with_all_that_leads_to_them() -> None:
    where = small_foons.domain(["a -mix-> b", "b -fry-> c"], "")
    problem = where.problem([small_foons.node("c")])
    assert problem.units == []
    assert exported_units(problem, Effects(where, "add")) == [0, 1]


def test_a_goal_at_hand_needs_no_action(tmp_path: Path) -> None:
    where = small_foons.domain(["a -mix-> b"], "a")
    for style in STYLES:
        written = exported(where, [small_foons.node("a")], style=style, level="units")
        assert written.actions == ()
        check_readers(written, tmp_path)


def test_no_place_for_constraints() -> None:
    where = soup()
    problem = where.problem([small_foons.node("soup")], constraints=Constraints(max_units=3))
    with pytest.raises(QueryError, match="no place for constraints"):
        planning_task(problem, Effects(where, "add"))


# Prices


@pytest.mark.parametrize(("level", "instead"), [("depth", "durative"), ("units+human", "task tree")])
def test_criteria_without_a_price(level: str, instead: str) -> None:
    with pytest.raises(QueryError, match=instead):
        Prices.of(soup().problem([small_foons.node("soup")]), Level.parse(level))


@small_foons.many(150)
@given(
    small_foons.queries(),
    st.sampled_from(
        ["units", "inputs", "success", "time", "tools", "dirty", "motions", "2*units+tools+0.5*dirty"]
    ),
)
def test_prices_add_up_to_what_a_tree_costs(query: tuple[Domain, ObjectNode], by: str) -> None:
    where, goal = query
    problem, level = where.problem([goal]), Level.parse(by)
    prices = Prices.of(problem, level)
    tree = TaskTree.of(where, problem.goals, problem.units)
    paid = sum(prices.per_unit[unit] for unit in tree.units)
    due = {key for unit in tree.units for key in prices.once.get(unit, ())}
    paid += sum(prices.fees[key] for key in due)
    assert prices.fees.keys() == due
    assert level.bound(level.base + paid) == pytest.approx(
        level.cost(tree.costs) if by != "success" else tree.costs.success, rel=1e-3
    )


# Effects


@st.composite
def counted_domains(draw: st.DrawFn) -> tuple[Domain, str]:
    where = draw(small_foons.domains(strict=None))
    quantities = {node: draw(st.integers(1, 2)) for node in where.kitchen.objects if draw(st.booleans())}
    kitchen = replace(where.kitchen, quantities=quantities)
    return Domain(where.foon, kitchen, strict=where.strict), draw(st.sampled_from(SEMANTICS))


def whole_task(where: Domain, effects: Effects) -> Task:
    goal = len(where.foon.objects) - 1
    return planning_task(Problem(where, (goal,), whole=True), effects)


@small_foons.many(60)
@given(counted_domains(), st.sampled_from(STYLES), st.integers(0, 10**6))
def test_effects_are_those_of_the_semantics(drawn: tuple[Domain, str], style: str, seed: int) -> None:
    """Walk at random: the simulator of unified_planning can do what `Store` can, and then has the same."""
    engines = pytest.importorskip("unified_planning.engines", reason="unified-planning is not installed")
    where, semantics = drawn
    effects = Effects(where, semantics)
    task = whole_task(where, effects)
    target = unified(document(task, style))
    chance = random.Random(seed)
    done: list[int] = []
    store = Store(effects)
    for _ in range(5):
        unit = chance.choice(range(len(where.foon.units)))
        if store.execute(unit):
            assert not can_execute(task, [*done, unit])
        else:
            done.append(unit)
    plan = Plan.of(effects, (), done)
    with engines.UPSequentialSimulator(target.problem) as simulator:
        state = simulator.get_initial_state()
        for instance in to_sequential_plan(plan, target, effects).actions:
            state = simulator.apply(state, instance.action, instance.actual_parameters)
            assert state is not None, instance
        for thing in task.things:
            there = holds(target, state, Fact("there", thing))
            left = sum(
                count
                for count in range(effects.counted.get(thing, 0) + 1)
                if holds(target, state, Fact("left", thing, count))
            )
            assert (there or left > 0) == store.has(thing), where.node(thing)
            if Fact("left", thing, effects.counted.get(thing, 0)) in task.initially:
                assert there + left == (thing in store.made) + store.left[thing]


def holds(target: Any, state: Any, fact: Fact) -> bool:
    atoms = target.atoms
    return fact in atoms and bool(state.get_value(atoms[fact]).bool_constant_value())


def can_execute(task: Task, units: list[int]) -> bool:
    """Search all ways to put helpers between units: can the units be executed in this order?"""
    reached = {frozenset(task.initially)}
    for unit in units:
        reached = helped(task, reached)
        reached = {
            (state - frozenset(step.deletes)) | frozenset(step.adds)
            for state in reached
            for step in task.steps
            if step.unit == unit and state.issuperset(step.needs)
        }
    return bool(reached)


def helped(task: Task, reached: set[frozenset[Fact]]) -> set[frozenset[Fact]]:
    """Return all states that helpers lead to."""
    open_, found = list(reached), set(reached)
    while open_:
        state = open_.pop()
        for step in task.steps:
            if step.unit is None and state.issuperset(step.needs):
                new = (state - frozenset(step.deletes)) | frozenset(step.adds)
                if new not in found:
                    found.add(new)
                    open_.append(new)
    return found


def test_a_view_that_the_kitchen_counts_is_used_up_if_there_is_one() -> None:
    where = small_foons.domain(
        ["bowl{onion} + onion@bowl -tip-> onion[raw]", "bowl{onion} -scrape-> onion@bowl"],
        "bowl{onion} + onion@bowl",
        utensils=["bowl"],
    )
    where = counted(where, bowl=1, onion=2)
    effects = Effects(where, "consume")
    task = whole_task(where, effects)
    assert [step.name for step in task.steps if step.unit == 0] == ["tip-0", "tip-0-without-0"]
    assert can_execute(task, [0, 0])
    assert not can_execute(task, [0, 1])
    assert can_execute(task, [1, 0])


def test_what_is_made_does_not_swallow_what_the_kitchen_has() -> None:
    units = [
        "bowl[empty] -name-> map",
        "clay -form-> bowl[empty]",
        "bowl[empty] + stone -smash-> bowl[broken]",
    ]
    where = counted(small_foons.domain(units, "bowl[empty] + clay + stone"), bowl=1)
    # Under `transform` a bowl is smashed, but not used up by giving it a name.
    effects = Effects(where, "transform")
    task = whole_task(where, effects)
    for units_done, possible in (([0, 1, 2, 2], True), ([0, 1, 1, 2, 2], True), ([0, 1, 2, 2, 2], False)):
        assert Plan.of(effects, (), units_done).executable is possible
        assert can_execute(task, units_done) is possible
        steps = [step.unit for step in executed_steps(task, effects, units_done) if step.unit is not None]
        assert (steps == units_done) is possible


# The lifted style


@small_foons.many(150)
@given(st.lists(ODD_LABELS, min_size=2, max_size=5, unique=True))
def test_descriptions_match_one_object_only(labels: list[str]) -> None:
    foon = odd_foon(labels)
    where = Domain(foon, Kitchen(()))
    written = document(whole_task(where, Effects(where, "consume")), "lifted")
    assert_descriptions_match_one_object_only(written)


def test_the_same_twice_is_told_from_the_same_once() -> None:
    where = small_foons.domain(["bowl{egg} + egg -crack-> bowl{egg,egg}"], "bowl{egg} + egg")
    text = problem_text(exported(where, [small_foons.node("bowl{egg,egg}")], style="lifted"))
    assert "(contains-2-times bowl-egg-egg the-egg)" in text
    assert "known-as" not in text


def test_public_descriptions_match_one_object_only(universal_domain: Domain) -> None:
    problem = Problem(universal_domain, (0,), whole=True)
    written = document(planning_task(problem, Effects(universal_domain, "consume")), "lifted")
    assert_descriptions_match_one_object_only(written)


def assert_descriptions_match_one_object_only(written: Document) -> None:
    kinds: Mapping[str, str] = dict(written.objects)
    facts: dict[tuple[str, ...], set[str]] = {}
    for atom in written.initially:
        if len(atom) > 1:
            facts.setdefault((atom[0], *atom[2:]), set()).add(atom[1])
    by_kind: dict[str, set[str]] = {}
    for name, kind in kinds.items():
        by_kind.setdefault(kind, set()).add(name)
    for action in written.actions:
        fits = {variable: by_kind[kind] for variable, kind in action.parameters}
        for atom in action.conditions:
            if atom[0] not in ("available", "taken-out", "left") and len(atom) > 1:
                fits[atom[1]] = fits[atom[1]] & facts[(atom[0], *atom[2:])]
        found = tuple(fits[variable] for variable, _ in action.parameters)
        assert found == tuple({name} for name in written.arguments[action.name]), action.name


# Durative actions


def test_durations_come_from_the_annotation() -> None:
    builder = FoonBuilder()
    a, b, c = (builder.object(small_foons.node(text)) for text in ("a", "b", "c"))
    builder.unit("mix", [a], [b], Annotation(start=10.0, end=72.0))
    builder.unit("fry", [b], [c], Annotation())
    where = Domain(builder.build(), Kitchen((small_foons.node("a"),)))
    written = exported(where, [small_foons.node("c")], durative=True)
    assert [action.duration for action in written.actions] == [62, 1]
    assert ":duration (= ?duration 62)" in domain_text(written)
    assert "(:metric minimize (total-time))" in problem_text(written)


def test_what_is_needed_and_kept_must_last() -> None:
    where = small_foons.domain(
        ["(knife) -get-> pan[hot]", "pan[hot] + egg -fry-> egg[fried] + pan[hot]", "pan[hot] -cool-> pan"],
        "(knife) + egg",
    )
    written = exported(where, [small_foons.node("egg[fried]"), small_foons.node("pan")], durative=True)
    lasting = {action.name: action.lasting for action in written.actions}
    assert lasting == {"get-0": (), "fry-1": (("pan-hot",),), "cool-2": ()}


# Plans there and back


@pytest.mark.parametrize("style", STYLES)
def test_plans_there_and_back(style: str) -> None:
    plans = pytest.importorskip("unified_planning.plans", reason="unified-planning is not installed")
    where = soup()
    effects = Effects(where, "consume")
    problem = where.problem([small_foons.node("soup")])
    written = document(planning_task(problem, effects, Level.parse("units+tools")), style)
    target = unified(written)
    plan = Plan.of(effects, problem.goals, [0, 1, 2, 3, 0, 1, 2])
    assert plan.executable
    sequential = to_sequential_plan(plan, target, effects)
    partial = to_partial_order(plan, target, effects)
    names = [instance.action.name for instance in sequential.actions]
    assert len(names) == 7 + 2 + 3, "seven units, two fees, two onions and a bowl taken out"
    assert is_valid(target.problem, sequential)
    for found in (sequential, partial):
        back = from_unified_plan(found, written.task.names, effects, problem.goals)
        assert back.executable
        assert sorted(back.units) == sorted(plan.units)
    for order in islice(partial.all_sequential_plans(), 12):
        assert is_valid(target.problem, order)
    timed = plans.TimeTriggeredPlan(
        [(place, instance, None) for place, instance in enumerate(sequential.actions)]
    )
    assert from_unified_plan(timed, written.task.names, effects, problem.goals).units == plan.units


def is_valid(problem: Any, plan: Any) -> bool:
    from unified_planning.shortcuts import PlanValidator

    with PlanValidator(name="sequential_plan_validator") as validator:
        return bool(validator.validate(problem, plan))


@small_foons.many(60)
@given(small_foons.domains(), st.sampled_from(SEMANTICS), st.integers(0, 10**6))
def test_orderings_are_those_of_the_plan(where: Domain, semantics: str, seed: int) -> None:
    effects = Effects(where, semantics)
    target = unified(document(whole_task(where, effects)))
    chance, store, done = random.Random(seed), Store(effects), list[int]()
    for _ in range(8):
        unit = chance.choice(range(len(where.foon.units)))
        if not store.execute(unit):
            done.append(unit)
    partial = to_partial_order(Plan.of(effects, (), done), target, effects)
    names = target.document.task.names
    assert sorted(before_pairs(partial, names.units)) == sorted(
        (done[first], done[second]) for first, second in closed(orderings(effects, done))
    )


def test_what_is_needed_and_later_taken_away_is_ordered() -> None:
    where = small_foons.domain(
        ["clay -form-> bowl[empty]", "bowl[empty] -name-> map", "bowl[empty] -smash-> bowl[broken]"], "clay"
    )
    effects = Effects(where, "transform")
    target = unified(document(whole_task(where, effects)))
    partial = to_partial_order(Plan.of(effects, (), [0, 1, 2]), target, effects)
    assert (1, 2) in before_pairs(partial, target.document.task.names.units)


def before_pairs(partial: Any, units: Mapping[str, int]) -> list[tuple[int, int]]:
    """Return which units a partial-order plan puts before which, directly or not."""
    steps = list(partial.get_adjacency_list)
    pairs = [
        (steps.index(first), steps.index(second))
        for first, after in partial.get_adjacency_list.items()
        for second in after
    ]
    named = [units[step.action.name] for step in steps]
    return [(named[first], named[second]) for first, second in closed(pairs)]


def closed(pairs: Iterable[tuple[int, int]]) -> set[tuple[int, int]]:
    """Return the transitive closure of pairs."""
    found = set(pairs)
    while more := {(a, d) for a, b in found for c, d in found if b == c} - found:
        found |= more
    return found


def test_plans_of_another_export() -> None:
    where = soup()
    effects = Effects(where, "consume")
    target = unified(exported(where, [small_foons.node("onion[chopped]")]))
    plan = Plan.of(effects, (), [0, 1])
    with pytest.raises(QueryError, match="step 2 of the plan"):
        to_sequential_plan(plan, target, effects)


# Invariants would turn the deletion of what need not be there into a conditional effect.
NO_INVARIANTS = {
    "fast_downward_search_config": "astar(lmcut())",
    "fast_downward_translate_options": ["--invariant-generation-max-candidates", "0"],
}


@pytest.mark.parametrize(("engine", "params"), [("fast-downward", NO_INVARIANTS), ("pyperplan-opt", {})])
@pytest.mark.parametrize("style", STYLES)
def test_planners_find_the_plan(engine: str, params: dict[str, Any], style: str) -> None:
    shortcuts = pytest.importorskip("unified_planning.shortcuts", reason="unified-planning is not installed")
    factory = shortcuts.get_environment().factory
    if engine not in factory.engines:
        pytest.skip(f"the planner {engine} is not installed")
    where = soup()
    effects = Effects(where, "consume")
    problem = where.problem([small_foons.node("soup"), small_foons.node("bowl[empty]")])
    level = Level.parse("units+2*tools") if engine.startswith("fast") else None
    written = document(planning_task(problem, effects, level), style)
    target = unified(written)
    with shortcuts.OneshotPlanner(name=engine, params=params) as planner:
        result = planner.solve(target.problem)
    plan = from_unified_plan(result.plan, written.task.names, effects, problem.goals)
    assert plan.executable
    assert plan.units == (0, 1, 2, 3), "the only bowl is dirty by then"


def test_a_wanted_object_is_taken_out_of_the_kitchen() -> None:
    where = counted(small_foons.domain(["a -mix-> b"], "a"), a=2)
    effects = Effects(where, "consume")
    target = unified(exported(where, [small_foons.node(text) for text in ("a", "b")]))
    sequential = to_sequential_plan(Plan.of(effects, (), [0]), target, effects)
    assert [step.action.name for step in sequential.actions] == ["take-a-ready-2", "mix-0", "take-a-ready-1"]
    assert is_valid(target.problem, sequential)


def test_no_plan_is_an_error() -> None:
    where = soup()
    with pytest.raises(QueryError, match="no plan"):
        from_unified_plan(None, exported(where, []).task.names, Effects(where, "add"), ())
