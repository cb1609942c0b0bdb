"""PDDL exports of whatever is drawn: names, readers, effects, orderings."""

from __future__ import annotations

import random
import re
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from unified_planning.engines import UPSequentialSimulator

from foon_asp.characters import is_label
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectId, ObjectNode, Source, State, UnitId, contains, inside
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.pddl.names import RESERVED, Namer, read_names
from foon_asp.planning.pddl.styles import STYLES, document
from foon_asp.planning.pddl.task import Fact, planning_task
from foon_asp.planning.pddl.unified import to_partial_order, to_sequential_plan, unified
from foon_asp.planning.pddl.write import comment, written_names
from foon_asp.planning.plan import Plan, orderings
from foon_asp.planning.prices import Prices
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from foon_asp.retrieval.tree import TaskTree
from support import brute_force, small_foons
from support.examples import many
from support.pddl_by_others import before_pairs, check_readers, closed, holds
from support.pddl_exports import assert_descriptions_match_one_object_only, can_execute, whole_task

# The translator of Fast Downward leaves its files open; the others warn of what is theirs alone.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
NAME = re.compile(r"[a-z][a-z0-9-]*")
_ODD = ["and", "define", "object", "not", "Onion", "onion", '"', "(", ")", ";", "*", "?x", "7 up", "jalapeño"]
ODD_LABELS = st.one_of(
    st.sampled_from(_ODD), st.text(max_size=6), st.text(alphabet="ab -()\"';*é\n", max_size=90)
)

LABELS = ODD_LABELS.filter(is_label)
"""Odd, but what a FOON can hold; the rest is refused where it enters."""


# Names


@many(200)
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


@many(30)
@given(st.lists(LABELS, min_size=2, max_size=5, unique=True), st.sampled_from(STYLES))
def test_odd_labels_export_and_parse(
    tmp_path_factory: pytest.TempPathFactory, labels: list[str], style: str
) -> None:
    foon = odd_foon(labels)
    where = World.of(foon, Kitchen(tuple(foon.objects[: len(labels)]), frozenset(labels[:1]), {}, 1.0))
    goal = ObjectId(len(foon.objects) - 1)
    task = planning_task(Problem(where, (goal,), whole=True), Effects(where, "consume"))
    written = document(task, style)
    folder = tmp_path_factory.mktemp("odd")
    check_readers(written, folder)
    assert len(task.names.objects) == len(task.object_ids)
    assert len(task.names.units) == len(foon.units)
    (folder / "names.json").write_text(written_names(written))
    read = read_names(folder / "names.json", where)
    assert (read.objects, read.units) == (task.names.objects, task.names.units)
    assert read.arguments == {name: taken for name, taken in written.arguments.items() if taken}


# Text


@given(st.text())
def test_comments_cannot_be_left(text: str) -> None:
    for line in comment(text, "  "):
        assert line.splitlines() == [line]
        assert line.startswith("  ;")


# Prices


@many(150)
@given(
    small_foons.queries(),
    st.sampled_from(
        ["units", "inputs", "success", "time", "tools", "dirty", "motions", "2*units+tools+0.5*dirty"]
    ),
)
def test_prices_add_up_to_what_a_tree_costs(query: tuple[World, ObjectNode], by: str) -> None:
    where, goal = query
    problem, criterion = Problem.of(where, [goal]), Criterion.parse(by)
    prices = Prices.of(problem, criterion)
    tree = TaskTree.of(where, problem.goals, problem.units)
    paid = sum(prices.per_unit[unit] for unit in tree.units)
    due = {key for unit in tree.units for key in prices.once.get(unit, ())}
    paid += sum(prices.fees[key] for key in due)
    assert prices.fees.keys() == due
    assert prices.tariff.bound(prices.tariff.base + paid) == pytest.approx(
        criterion.cost(tree.costs) if by != "success" else tree.costs.success, rel=1e-3
    )


# Effects


@st.composite
def counted_domains(draw: st.DrawFn) -> tuple[World, str]:
    where = draw(small_foons.domains(strict=None))
    quantities = {node: draw(st.integers(1, 2)) for node in where.kitchen.objects if draw(st.booleans())}
    kitchen = replace(where.kitchen, quantities=quantities)
    return World.of(where.foon, kitchen, strict=where.strict), draw(st.sampled_from(SEMANTICS))


@many(60)
@given(counted_domains(), st.sampled_from(STYLES), st.integers(0, 10**6))
def test_effects_are_those_of_the_semantics(drawn: tuple[World, str], style: str, seed: int) -> None:
    """Walk at random: the simulator of unified_planning can do what `Supply` can, and then has the same."""
    where, semantics = drawn
    effects = Effects(where, semantics)
    task = whole_task(where, effects)
    target = unified(document(task, style))
    chance = random.Random(seed)
    done: list[UnitId] = []
    supply = Supply(effects)
    for _ in range(5):
        unit = chance.choice(brute_force.every_unit(where))
        if supply.execute(unit):
            assert not can_execute(task, [*done, unit])
        else:
            done.append(unit)
    plan = Plan.of(effects, (), done)
    with UPSequentialSimulator(target.problem) as simulator:
        state = simulator.get_initial_state()
        for instance in to_sequential_plan(plan, target, effects).actions:
            state = simulator.apply(state, instance.action, instance.actual_parameters)
            assert state is not None, instance
        for thing in task.object_ids:
            there = holds(target, state, Fact("there", thing))
            left = sum(
                count
                for count in range(effects.counted.get(thing, 0) + 1)
                if holds(target, state, Fact("left", thing, count))
            )
            assert (there or left > 0) == supply.has(thing), where.node(thing)
            if Fact("left", thing, effects.counted.get(thing, 0)) in task.initially:
                assert there + left == (thing in supply.made) + supply.left[thing]


# The lifted style


@many(150)
@given(st.lists(LABELS, min_size=2, max_size=5, unique=True))
def test_descriptions_match_one_object_only(labels: list[str]) -> None:
    foon = odd_foon(labels)
    where = World.of(foon, Kitchen(()))
    written = document(whole_task(where, Effects(where, "consume")), "lifted")
    assert_descriptions_match_one_object_only(written)


# Plans there and back


@many(60)
@given(small_foons.domains(), st.sampled_from(SEMANTICS), st.integers(0, 10**6))
def test_orderings_are_those_of_the_plan(where: World, semantics: str, seed: int) -> None:
    effects = Effects(where, semantics)
    target = unified(document(whole_task(where, effects)))
    chance, supply, done = random.Random(seed), Supply(effects), list[UnitId]()
    for _ in range(8):
        unit = chance.choice(brute_force.every_unit(where))
        if not supply.execute(unit):
            done.append(unit)
    partial = to_partial_order(Plan.of(effects, (), done), target, effects)
    names = target.document.task.names
    assert sorted(before_pairs(partial, names.units)) == sorted(
        (done[first], done[second]) for first, second in closed(orderings(effects, done))
    )
