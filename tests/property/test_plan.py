"""Plans against the definitions, written down once more."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import replace
from itertools import chain, combinations
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.asp.facts import facts
from foon_asp.asp.solver import open_solver
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectId, ObjectNode, UnitId
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.plan import Plan, orderings, replay_plan, unreachable_by_search
from foon_asp.planning.prices import Prices
from foon_asp.planning.problem import PlanProblem
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from foon_asp.render.plan import plan_text
from support import brute_force
from support.examples import many
from support.plan_worlds import KITCHEN_UNITS, plan, recipes, with_quantities
from support.small_foons import MOTIONS, RATES, domains, node, world
from support.tokens import State, Tokens


def fewest_then_cheapest(
    tokens: Tokens, goals: Collection[ObjectNode], prices: Prices
) -> tuple[int, int, int] | None:
    """Return the fewest steps to all goals, the least cost of so many, and how few units that takes.

    All states are kept, each with what fees were paid on the way and what that cost.
    """
    layer: dict[tuple[State, frozenset[str]], tuple[int, int]] = {(tokens.start, frozenset()): (0, 0)}
    seen: set[State] = set()
    steps = 0
    while True:
        done = [cost for (state, _), cost in layer.items() if all(tokens.has(state, goal) for goal in goals)]
        if done:
            return (steps, *min(done))
        if {state for state, _ in layer} <= seen:
            return None
        seen |= {state for state, _ in layer}
        following: dict[tuple[State, frozenset[str]], tuple[int, int]] = {}
        for (state, paid), (cost, count) in layer.items():
            for units in tokens.steps(state):
                keys = paid.union(*(prices.once.get(unit, ()) for unit in units))
                more = sum(prices.per_unit[unit] for unit in units)
                more += sum(prices.fees[key] for key in keys - paid)
                place = (tokens.after(state, map(tokens.deeds.__getitem__, units)), keys)
                new = (cost + more, count + len(units))
                following[place] = min(new, following.get(place, new))
        layer = following
        steps += 1


@st.composite
def stores(draw: st.DrawFn, levels: tuple[int, ...] = (3,)) -> World:
    """Draw a domain with some of its kitchen counted."""
    where = draw(st.one_of(domains(), recipes, recipes, recipes))
    stock = [*where.kitchen.objects]
    more = draw(st.lists(st.sampled_from(where.foon.objects), max_size=1))
    objects = tuple(dict.fromkeys([*stock, *more]))
    counts = {thing: draw(st.sampled_from([None, None, 1, 2, 3])) for thing in objects}
    kitchen = replace(
        where.kitchen,
        objects=objects,
        quantities={thing: count for thing, count in counts.items() if count is not None},
    )
    return World.of(where.foon, kitchen, strict=where.strict, level=draw(st.sampled_from(levels)))


# Mostly those under which plans are more than task trees.
semantics_ = st.sampled_from([*SEMANTICS, "consume", "consume", "transform"])


def goals(where: World) -> st.SearchStrategy[ObjectNode]:
    """Draw a goal: mostly one of those that take longest to make."""
    rounds = where.closure.available
    things = sorted(where.foon.objects.ids, key=lambda thing: -rounds.get(thing, 0))
    return st.sampled_from([where.node(thing) for thing in things[:1] * 4 + things[:2] * 2 + things])


# --- Effects and replay -----------------------------------------------------------------------------


@many(300)
@given(stores(levels=(1, 2, 3)), semantics_)
def test_effects_are_those_of_the_encoding_and_of_the_definitions(where: World, semantics: str) -> None:
    effects, tokens = Effects(where, semantics), Tokens(where, semantics)
    constants: dict[str, str | int] = {"semantics": semantics, "strict": int(where.strict)}
    answer = open_solver(["consumption.lp"], facts(Problem(where, (), whole=True)), constants).best()
    units = brute_force.every_unit(where)
    deletes = {(unit, thing) for unit in units for thing in effects.deletes(unit)}
    assert set(answer.rows("deletes")) == deletes
    assert set(answer.rows("adds")) == {(unit, thing) for unit in units for thing in effects.adds(unit)}
    restores = {(unit, thing) for unit in units for thing in effects.restores(unit)}
    assert set(answer.rows("restores")) == restores
    assert set(answer.column("endless")) == effects.endless
    assert {(unit, where.node(thing)) for unit, thing in deletes} == {
        (unit, thing) for unit in units for thing in tokens.deeds[unit].takes
    }
    assert {where.node(thing) for thing in effects.endless} == tokens.endless
    for unit in units:
        assert {where.node(thing) for thing in effects.adds(unit)} == tokens.deeds[unit].adds
        assert {where.node(thing) for thing in effects.restores(unit)} == tokens.deeds[unit].restores


@many(300)
@given(stores(levels=(1, 2, 3)), semantics_, st.data())
def test_replay_is_the_definition(where: World, semantics: str, data: st.DataObject) -> None:
    """Units are drawn from those that can be executed, but for a blind one now and then."""
    effects, tokens = Effects(where, semantics), Tokens(where, semantics)
    state, order, failed = tokens.start, [], False
    every = list(tokens.deeds)
    for _ in range(data.draw(st.integers(0, 8))):
        ready = [unit for unit in every if not tokens.lacks(state, tokens.deeds[unit])]
        unit = data.draw(st.sampled_from(ready * 5 + every))
        order.append(unit)
        if lacking := tokens.lacks(state, tokens.deeds[unit]):
            failed = True
            break
        state = tokens.after(state, [tokens.deeds[unit]])
    goal = data.draw(st.sampled_from(where.foon.objects))
    replay = replay_plan(effects, [where.id_of(goal)], order)
    if failed:
        assert (replay.executable, replay.failed_at) == (False, len(order) - 1)
        assert set(replay.missing) == lacking
    else:
        assert replay.failed_at is None
        assert replay.executable == tokens.has(state, goal)
        assert replay.missing == (() if replay.executable else (goal,))


def said_gone(text: str) -> list[set[str]]:
    """Return what the text of a plan says to be gone after each step."""
    steps = re.split(r"^ *[0-9]+\. ", text, flags=re.MULTILINE)[1:]
    lists = [re.search(r"^     gone ((?:.|\n {12})*)", step, re.MULTILINE) for step in steps]
    return [set() if found is None else {*re.split(r";\s+", found[1])} for found in lists]


@many(200)
@given(stores(levels=(1, 2, 3)), semantics_, st.data())
def test_what_is_gone_was_there(where: World, semantics: str, data: st.DataObject) -> None:
    """An implied view that a unit would use up may be gone, or never have been there."""
    effects, tokens = Effects(where, semantics), Tokens(where, semantics)
    state, order, gone = tokens.start, [], []
    for _ in range(data.draw(st.integers(0, 8))):
        ready = [unit for unit in tokens.deeds if not tokens.lacks(state, tokens.deeds[unit])]
        if not ready:
            break
        unit = data.draw(st.sampled_from(ready))
        order.append(unit)
        gone.append({str(thing) for thing in tokens.deeds[unit].takes if tokens.has(state, thing)})
        state = tokens.after(state, [tokens.deeds[unit]])
    assert said_gone(plan_text(Plan.of(effects, (), order), effects)) == gone


# --- Orderings --------------------------------------------------------------------------------------


def wandering(effects: Effects, random: Random, length: int) -> list[UnitId]:
    """Return units that can be executed in this order, drawn at random."""
    supply, order = Supply(effects), list[UnitId]()
    for _ in range(length):
        units = list(brute_force.every_unit(effects.world))
        random.shuffle(units)
        done = next((unit for unit in units if not supply.execute(unit)), None)
        if done is None:
            break
        order.append(done)
    return order


def final(effects: Effects, order: Iterable[UnitId]) -> tuple[set[ObjectId], dict[ObjectId, int]] | None:
    """Return what is at hand in the end, or None if the order cannot be executed."""
    supply = Supply(effects)
    return None if any(supply.execute(unit) for unit in order) else (supply.made, supply.left)


@many(300)
@given(stores(), semantics_, st.integers(0, 10**6))
def test_every_order_that_keeps_the_orderings_ends_the_same(where: World, semantics: str, seed: int) -> None:
    effects, random = Effects(where, semantics), Random(seed)
    order = wandering(effects, random, 8)
    pairs = orderings(effects, order)
    open_, other = set(range(len(order))), []
    while open_:
        ready = [place for place in open_ if not any(b == place and a in open_ for a, b in pairs)]
        other.append(random.choice(ready))
        open_.remove(other[-1])
    assert final(effects, order) is not None
    assert final(effects, [order[place] for place in other]) == final(effects, order)


@pytest.mark.parametrize(
    ("order", "swapped"),
    [
        ("brew drink", "drink brew"),  # One makes what the other needs.
        ("taste drink", "drink taste"),  # One needs what the other takes.
        ("drink brew", "brew drink"),  # One takes what the other makes.
    ],
)
def test_swapping_an_ordered_pair_can_matter(order: str, swapped: str) -> None:
    units = ("leaf -brew-> tea", "tea + (cup) -drink-> joy", "tea -taste-> tea + news")
    kitchen = "leaf + (cup)" if order == "brew drink" else "leaf + (cup) + tea"
    where = with_quantities(units, kitchen, tea=1)
    effects = Effects(where, "consume")
    number = {unit.motion: unit.id for unit in where.foon.units}
    one, other = ([number[motion] for motion in text.split()] for text in (order, swapped))
    assert orderings(effects, one) == [(0, 1)]
    assert final(effects, one) is not None
    assert final(effects, other) != final(effects, one)


@pytest.mark.parametrize("semantics", ["transform", "consume"])
def test_swapping_an_ordered_pair_matters_at_least_sometimes(semantics: str) -> None:
    where = world([*KITCHEN_UNITS, "lid -turn-> bowl[empty]"], "onion[whole] + (knife) + lid + salt")
    effects = Effects(where, semantics)
    broken = kept = 0
    for seed in range(200):
        order = wandering(effects, Random(seed), 6)
        pairs = orderings(effects, order)
        for place in range(len(order) - 1):
            swapped = [*order[:place], order[place + 1], order[place], *order[place + 2 :]]
            same = final(effects, swapped) == final(effects, order)
            broken += not same
            kept += same
            assert same or (place, place + 1) in pairs
    assert broken > 50
    assert kept > 50


@many(200)
@given(stores(), semantics_, st.integers(0, 10**6))
def test_the_earliest_steps_are_parallel_ones(where: World, semantics: str, seed: int) -> None:
    effects, tokens = Effects(where, semantics), Tokens(where, semantics)
    order = wandering(effects, Random(seed), 8)
    steps = Plan.of(effects, (), order).steps
    state = tokens.start
    for step in range(1, max(steps, default=0) + 1):
        units = [unit for unit, own in zip(order, steps, strict=True) if own == step]
        deeds = [tokens.deeds[unit] for unit in units]
        assert not any(tokens.lacks(state, deed) for deed in deeds)
        pairs = [(tokens.deeds[a], tokens.deeds[b]) for a, b in combinations(units, 2) if a != b]
        assert not any(tokens.disturbs(a, b) or tokens.disturbs(b, a) for a, b in pairs)
        state = tokens.after(state, deeds)


# --- Plans ------------------------------------------------------------------------------------------

BY = ("units", "inputs", "success", "motions", "units+2*motions")


@many(250)
@given(stores(levels=(1, 3, 3, 3)), semantics_, st.sampled_from(BY), st.data())
def test_plans_are_the_best_there_are(where: World, semantics: str, by: str, data: st.DataObject) -> None:
    goal = data.draw(goals(where))
    criterion = Criterion.parse(by)
    every = Prices.of(Problem(where, (), whole=True), criterion)
    result = plan(where, goal, semantics, by)
    expected = fewest_then_cheapest(Tokens(where, semantics), [goal], every)
    if expected is None:
        assert (result.status, result.plan) == ("unsolvable", None)
        assert result.reason
        return
    steps, cost, count = expected
    assert result.status == "optimal"
    assert result.plan is not None
    assert result.plan.executable
    assert (result.steps, result.plan.makespan) == (steps, steps)
    assert every.total(result.plan.units) == cost
    assert result.cost == result.bound == pytest.approx(every.tariff.bound(cost + every.tariff.base))
    assert len(result.plan.units) == count
    parallel(result, Tokens(where, semantics))


def scramble(seed: int) -> World:
    """Make a FOON of few things that are used up and made again and again, half of them counted."""
    random = Random(seed)
    things = [node(f"{random.choice('ab')}[s{number}]") for number in range(6)]
    builder = FoonBuilder()
    ids = [builder.object(thing) for thing in things]
    for _ in range(6):
        inputs = random.sample(ids, random.choice([1, 2, 2]))
        outputs = random.sample(ids, random.choice([1, 1, 2]))
        builder.unit(random.choice(MOTIONS), inputs, outputs, Annotation())
    stock = tuple(random.sample(things, 3))
    counts = {thing: random.choice([1, 1, 2]) for thing in stock[: random.choice([2, 3])]}
    rates = {motion: random.choice(RATES) for motion in MOTIONS}
    return World.of(builder.build(), Kitchen(stock, frozenset(), rates, quantities=counts))


def hardest(tokens: Tokens) -> list[ObjectNode]:
    """Return the two or three things that take most units to have at once."""
    states, queue = {tokens.start}, [tokens.start]
    for state in queue:
        for unit in tokens.deeds:
            if (
                not tokens.lacks(state, tokens.deeds[unit])
                and (after := tokens.after(state, [tokens.deeds[unit]])) not in states
            ):
                states.add(after)
                queue.append(after)
    things = [thing for thing in tokens.where.foon.objects if thing not in tokens.endless]
    hard: list[ObjectNode] = []
    place = -1
    for goals in chain(combinations(things, 2), combinations(things, 3)):
        first = next((i for i, s in enumerate(queue) if all(tokens.has(s, goal) for goal in goals)), -1)
        if first > place:
            hard, place = list(goals), first
    return hard


@pytest.mark.parametrize("semantics", ["transform", "consume"])
def test_plans_of_hard_goals_are_the_best_there_are(semantics: str) -> None:
    most = 0
    for seed in range(250):
        where = scramble(seed)
        tokens = Tokens(where, semantics)
        goals = hardest(tokens)
        criterion = Criterion.parse(BY[seed % len(BY)])
        prices = Prices.of(Problem(where, (), whole=True), criterion)
        expected = fewest_then_cheapest(tokens, goals, prices)
        assert expected is not None
        result = plan(where, goals, semantics, str(criterion))
        assert result.plan is not None
        assert prices.total(result.plan.units) == expected[1]
        assert result.cost == pytest.approx(prices.tariff.bound(expected[1] + prices.tariff.base))
        assert (result.status, result.steps, len(result.plan.units)) == ("optimal", expected[0], expected[2])
        parallel(result, tokens)
        most = max(most, expected[0])
    assert most >= 5


def parallel(result: PlanAnswer, tokens: Tokens) -> None:
    """Execute a plan step by step; the units of a step must not need what another one of it makes."""
    assert result.plan is not None
    state = tokens.start
    for step in range(1, result.plan.makespan + 1):
        pairs = zip(result.plan.units, result.plan.steps, strict=True)
        units = tuple(sorted(unit for unit, own in pairs if own == step))
        assert units in set(tokens.steps(state))
        state = tokens.after(state, map(tokens.deeds.__getitem__, units))
    assert all(tokens.has(state, goal) for goal in result.goals)


@many(250)
@given(stores(), semantics_, st.data())
def test_unreachable_by_search_is_never_wrong(where: World, semantics: str, data: st.DataObject) -> None:
    goals = data.draw(st.lists(st.sampled_from(where.foon.objects), min_size=1, max_size=2, unique=True))
    tokens = Tokens(where, semantics)
    seen, queue = {tokens.start}, [tokens.start]
    for state in queue:
        for unit in tokens.deeds:
            if (
                not tokens.lacks(state, tokens.deeds[unit])
                and (after := tokens.after(state, [tokens.deeds[unit]])) not in seen
            ):
                seen.add(after)
                queue.append(after)
    reached = any(all(tokens.has(state, goal) for goal in goals) for state in queue)
    problem = PlanProblem(Effects(where, semantics), tuple(where.id_of(goal) for goal in goals))
    assert unreachable_by_search(problem, 10_000) == (not reached)
