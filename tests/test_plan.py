"""Planning with consumption: effects, replay, orderings, and plans held against a search by brute force."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from itertools import chain, combinations
from random import Random

import brute_force
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_foons import MOTIONS, RATES, domain, domains, many, motions, node

from foon_asp.builder import FoonBuilder
from foon_asp.criteria import Level
from foon_asp.dataset import Dataset
from foon_asp.decode import column, rows
from foon_asp.effects import SEMANTICS, Effects
from foon_asp.errors import QueryError
from foon_asp.facts import facts
from foon_asp.graph import Annotation, FunctionalUnit, ObjectNode
from foon_asp.kitchen import Kitchen
from foon_asp.plan import Plan, Store, hopeless, orderings, replay_plan
from foon_asp.plan_clingo import PlanResult, plan
from foon_asp.prices import Prices
from foon_asp.problem import Domain, Problem
from foon_asp.solve import Solver

# --- The definitions, written down once more --------------------------------------------------------


class World:
    """What units do by the definitions alone; shares nothing with `foon_asp.effects` or `foon_asp.plan`.

    A state holds what was made, and how many of each counted object the kitchen has left.
    """

    def __init__(self, where: Domain, semantics: str) -> None:
        self.where, self.semantics = where, semantics
        stock = dict.fromkeys(where.kitchen.objects)
        counts = {} if semantics == "add" else dict(where.kitchen.quantities)
        self.endless = stock.keys() - counts.keys()
        self.start: State = (frozenset(), tuple(sorted(counts.items(), key=str)))
        self.needs = {unit.id: brute_force.needs(where, unit) for unit in where.foon.units}
        self.makes = {unit.id: {o for o in self.outputs(unit) if self.real(o)} for unit in where.foon.units}
        self.takes = {unit.id: self.taken(unit) for unit in where.foon.units}

    def outputs(self, unit: FunctionalUnit) -> list[ObjectNode]:
        return [self.where.foon.objects[number] for number in unit.outputs]

    def real(self, thing: ObjectNode) -> bool:
        """Whether an object is no mere tool; labels alone do not tell."""
        return bool(thing.states) or self.where.level == 1

    def taken(self, unit: FunctionalUnit) -> set[ObjectNode]:
        if self.semantics == "add":
            return set()
        taken = {self.where.foon.objects[number] for number in unit.inputs} - set(self.outputs(unit))
        if self.semantics == "transform":
            held = [
                content
                for output in self.outputs(unit)
                for state in output.states
                if state.name == "contains"
                for content in state.contents or ()
            ]
            forms = {output.label for output in self.outputs(unit) if self.real(output)}
            taken = {thing for thing in taken if thing.label in forms or thing.label in held}
        return {thing for thing in taken if self.real(thing) and thing not in self.endless}

    def has(self, state: State, thing: ObjectNode) -> bool:
        made, left = state
        return thing in self.endless or thing in made or dict(left).get(thing, 0) > 0

    def lacks(self, state: State, unit: int) -> set[ObjectNode]:
        return {need for need in self.needs[unit] if not self.has(state, need)}

    def after(self, state: State, units: Iterable[int]) -> State:
        made, counts = set(state[0]), dict(state[1])
        for unit in units:
            for thing in self.takes[unit]:
                if thing in made:
                    made.discard(thing)
                elif thing in counts:
                    counts[thing] = max(0, counts[thing] - 1)
            made |= self.makes[unit]
        return frozenset(made), tuple(sorted(counts.items(), key=str))

    def disturbs(self, one: int, other: int) -> bool:
        """Whether one unit takes away what the other needs, takes or makes."""
        return bool(self.takes[one] & (self.needs[other] | self.takes[other] | self.makes[other]))

    def steps(self, state: State) -> Iterator[tuple[int, ...]]:
        """Yield every set of units that can be done at once."""
        ready = [unit for unit in self.needs if not self.lacks(state, unit)]
        for size in range(len(ready) + 1):
            for units in combinations(ready, size):
                pairs = list(combinations(units, 2))
                if not any(self.disturbs(a, b) or self.disturbs(b, a) for a, b in pairs):
                    yield units


State = tuple[frozenset[ObjectNode], tuple[tuple[ObjectNode, int], ...]]


def fewest_then_cheapest(
    world: World, goals: Collection[ObjectNode], prices: Prices
) -> tuple[int, int, int] | None:
    """Return the fewest steps to all goals, the least cost of so many, and how few units that takes.

    All states are kept, each with what fees were paid on the way and what that cost.
    """
    layer: dict[tuple[State, frozenset[str]], tuple[int, int]] = {(world.start, frozenset()): (0, 0)}
    seen: set[State] = set()
    steps = 0
    while True:
        done = [cost for (state, _), cost in layer.items() if all(world.has(state, goal) for goal in goals)]
        if done:
            return (steps, *min(done))
        if {state for state, _ in layer} <= seen:
            return None
        seen |= {state for state, _ in layer}
        following: dict[tuple[State, frozenset[str]], tuple[int, int]] = {}
        for (state, paid), (cost, count) in layer.items():
            for units in world.steps(state):
                keys = paid.union(*(prices.once.get(unit, ()) for unit in units))
                more = sum(prices.per_unit[unit] for unit in units)
                more += sum(prices.fees[key] for key in keys - paid)
                place = (world.after(state, units), keys)
                new = (cost + more, count + len(units))
                following[place] = min(new, following.get(place, new))
        layer = following
        steps += 1


def recipe(seed: int) -> Domain:
    """Make a FOON in which things are shared and made again: most units need what others make."""
    random = Random(seed)
    things = [node(f"{random.choice('abc')}[s{number}]") for number in range(7)]
    builder = FoonBuilder()
    for thing in things:
        builder.object(thing)
    for place in range(2, 7):
        for _ in range(random.choice([1, 1, 2])):
            inputs = random.sample(range(place), random.choice([1, 2, 2]))
            outputs = [place, *([random.choice(inputs)] if random.random() < 0.25 else [])]
            builder.unit(random.choice(MOTIONS), inputs, outputs, Annotation())
    rates = {motion: random.choice(RATES) for motion in MOTIONS}
    return Domain(builder.build(), Kitchen(tuple(things[:2]), frozenset(), rates))


recipes = st.integers(0, 10**6).map(recipe)


@st.composite
def stores(draw: st.DrawFn, levels: tuple[int, ...] = (3,)) -> Domain:
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
    return Domain(where.foon, kitchen, strict=where.strict, level=draw(st.sampled_from(levels)))


# Mostly those under which plans are more than task trees.
semantics_ = st.sampled_from([*SEMANTICS, "consume", "consume", "transform"])


def goals(where: Domain) -> st.SearchStrategy[ObjectNode]:
    """Draw a goal: mostly one of those that take longest to make."""
    rounds = where.closure.available
    things = sorted(range(len(where.foon.objects)), key=lambda thing: -rounds.get(thing, 0))
    return st.sampled_from([where.node(thing) for thing in things[:1] * 4 + things[:2] * 2 + things])


# --- Effects and replay -----------------------------------------------------------------------------


@many(300)
@given(stores(levels=(1, 2, 3)), semantics_)
def test_effects_are_those_of_the_encoding_and_of_the_definitions(where: Domain, semantics: str) -> None:
    effects, world = Effects(where, semantics), World(where, semantics)
    constants: dict[str, str | int] = {"semantics": semantics, "strict": int(where.strict)}
    answer = Solver(["consumption.lp"], facts(Problem(where, (), whole=True)), constants).best()
    units = range(len(where.foon.units))
    deletes = {(unit, thing) for unit in units for thing in effects.deletes(unit)}
    assert set(rows(answer, "deletes")) == deletes
    assert set(column(answer, "endless")) == effects.endless
    assert {(unit, where.node(thing)) for unit, thing in deletes} == {
        (unit, thing) for unit in units for thing in world.takes[unit]
    }
    assert {where.node(thing) for thing in effects.endless} == world.endless
    for unit in units:
        assert {where.node(thing) for thing in effects.adds(unit)} == world.makes[unit]


KITCHEN_UNITS = (
    "onion[whole] + (knife) -chop-> onion[chopped] + (knife)",
    "onion[chopped] + bowl[empty] + lid -pour-> bowl{onion} + onion[chopped]@bowl",
    "bowl{onion} + onion[chopped]@bowl + salt -salt-> bowl{onion,salt}",
)


@pytest.mark.parametrize(
    ("semantics", "unit", "expected"),
    [
        ("add", 1, set()),
        ("transform", 0, {"onion[whole]"}),
        ("consume", 0, {"onion[whole]"}),
        # The lid neither became anything nor went anywhere.
        ("transform", 1, {"onion[chopped]", "bowl[empty]"}),
        ("consume", 1, {"onion[chopped]", "bowl[empty]", "lid"}),
        # The bowl with onion in it is an implied view, and is gone all the same.
        ("transform", 2, {"bowl{onion}", "onion[chopped]@bowl", "salt"}),
        ("consume", 2, {"bowl{onion}", "onion[chopped]@bowl", "salt"}),
    ],
)
def test_what_each_semantics_uses_up(semantics: str, unit: int, expected: set[str]) -> None:
    where = domain(KITCHEN_UNITS, "(knife)", utensils=["bowl"])
    deleted = {where.node(thing) for thing in Effects(where, semantics).deletes(unit)}
    assert deleted == {node(text) for text in expected}


def test_an_unknown_semantics_is_refused() -> None:
    with pytest.raises(QueryError, match="unknown semantics 'eat'; there are add, transform, consume"):
        Effects(domain(KITCHEN_UNITS), "eat")


@many(300)
@given(stores(levels=(1, 2, 3)), semantics_, st.data())
def test_replay_is_the_definition(where: Domain, semantics: str, data: st.DataObject) -> None:
    """Units are drawn from those that can be executed, but for a blind one now and then."""
    effects, world = Effects(where, semantics), World(where, semantics)
    state, order, failed = world.start, [], False
    every = list(world.needs)
    for _ in range(data.draw(st.integers(0, 8))):
        ready = [unit for unit in every if not world.lacks(state, unit)]
        unit = data.draw(st.sampled_from(ready * 5 + every))
        order.append(unit)
        if lacking := world.lacks(state, unit):
            failed = True
            break
        state = world.after(state, [unit])
    goal = data.draw(st.sampled_from(where.foon.objects))
    replay = replay_plan(effects, [where.id_of(goal)], order)
    if failed:
        assert (replay.executable, replay.failed_at) == (False, len(order) - 1)
        assert set(replay.missing) == lacking
    else:
        assert replay.failed_at is None
        assert replay.executable == world.has(state, goal)
        assert replay.missing == (() if replay.executable else (goal,))


def test_a_product_is_used_up_before_the_stock() -> None:
    units = ("a -make-> egg", "egg -fry-> dish", "egg -boil-> soup")
    where = with_quantities(units, "a + egg", egg=1)
    store = Store(Effects(where, "consume"))
    assert [store.execute(unit) for unit in (0, 1, 2)] == [[], [], []]
    assert not store.has(where.id_of(node("egg")))
    assert store.execute(1) == [where.id_of(node("egg"))]


def with_quantities(units: Iterable[str], kitchen: str, **counts: int) -> Domain:
    where = domain(units, kitchen)
    quantities = {node(text): count for text, count in counts.items()}
    return Domain(where.foon, replace(where.kitchen, quantities=quantities))


# --- Orderings --------------------------------------------------------------------------------------


def wandering(effects: Effects, random: Random, length: int) -> list[int]:
    """Return units that can be executed in this order, drawn at random."""
    store, order = Store(effects), list[int]()
    for _ in range(length):
        units = list(range(len(effects.domain.foon.units)))
        random.shuffle(units)
        done = next((unit for unit in units if not store.execute(unit)), None)
        if done is None:
            break
        order.append(done)
    return order


def final(effects: Effects, order: Iterable[int]) -> tuple[set[int], dict[int, int]] | None:
    """Return what is at hand in the end, or None if the order cannot be executed."""
    store = Store(effects)
    return None if any(store.execute(unit) for unit in order) else (store.made, store.left)


@many(300)
@given(stores(), semantics_, st.integers(0, 10**6))
def test_every_order_that_keeps_the_orderings_ends_the_same(where: Domain, semantics: str, seed: int) -> None:
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
    where = domain([*KITCHEN_UNITS, "lid -turn-> bowl[empty]"], "onion[whole] + (knife) + lid + salt")
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
def test_the_earliest_steps_are_parallel_ones(where: Domain, semantics: str, seed: int) -> None:
    effects, world = Effects(where, semantics), World(where, semantics)
    order = wandering(effects, Random(seed), 8)
    steps = Plan.of(effects, (), order).steps
    state = world.start
    for step in range(1, max(steps, default=0) + 1):
        units = [unit for unit, own in zip(order, steps, strict=True) if own == step]
        assert not any(world.lacks(state, unit) for unit in units)
        pairs = list(combinations(units, 2))
        assert not any(world.disturbs(a, b) or world.disturbs(b, a) for a, b in pairs if a != b)
        state = world.after(state, units)


# --- Plans ------------------------------------------------------------------------------------------

BY = ("units", "inputs", "success", "motions", "units+2*motions")


@many(250)
@given(stores(levels=(1, 3, 3, 3)), semantics_, st.sampled_from(BY), st.data())
def test_plans_are_the_best_there_are(where: Domain, semantics: str, by: str, data: st.DataObject) -> None:
    goal = data.draw(goals(where))
    level = Level.parse(by)
    every = Prices.of(Problem(where, (), whole=True), level)
    result = plan(where, goal, semantics, by)
    expected = fewest_then_cheapest(World(where, semantics), [goal], every)
    if expected is None:
        assert (result.status, result.plan) == ("unreachable", None)
        assert result.reason
        return
    steps, cost, count = expected
    assert result.status == "optimal"
    assert result.plan is not None
    assert result.plan.executable
    assert (result.steps, result.plan.makespan) == (steps, steps)
    assert result.cost == result.bound == level.bound(cost + level.base)
    assert len(result.plan.units) == count
    parallel(result, World(where, semantics))


def scramble(seed: int) -> Domain:
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
    return Domain(builder.build(), Kitchen(stock, frozenset(), rates, quantities=counts))


def hardest(world: World) -> list[ObjectNode]:
    """Return the two or three things that take most units to have at once."""
    states, queue = {world.start}, [world.start]
    for state in queue:
        for unit in world.needs:
            if not world.lacks(state, unit) and (after := world.after(state, [unit])) not in states:
                states.add(after)
                queue.append(after)
    things = [thing for thing in world.where.foon.objects if thing not in world.endless]
    hard: list[ObjectNode] = []
    place = -1
    for goals in chain(combinations(things, 2), combinations(things, 3)):
        first = next((i for i, s in enumerate(queue) if all(world.has(s, goal) for goal in goals)), -1)
        if first > place:
            hard, place = list(goals), first
    return hard


@pytest.mark.parametrize("semantics", ["transform", "consume"])
def test_plans_of_hard_goals_are_the_best_there_are(semantics: str) -> None:
    most = 0
    for seed in range(250):
        where = scramble(seed)
        world = World(where, semantics)
        goals = hardest(world)
        level = Level.parse(BY[seed % len(BY)])
        prices = Prices.of(Problem(where, (), whole=True), level)
        expected = fewest_then_cheapest(world, goals, prices)
        assert expected is not None
        result = plan(where, goals, semantics, str(level))
        assert result.plan is not None
        assert result.cost == level.bound(expected[1] + level.base)
        assert (result.status, result.steps, len(result.plan.units)) == ("optimal", expected[0], expected[2])
        parallel(result, world)
        most = max(most, result.steps)
    assert most >= 5


def parallel(result: PlanResult, world: World) -> None:
    """Execute a plan step by step; the units of a step must not need what another one of it makes."""
    assert result.plan is not None
    state = world.start
    for step in range(1, result.plan.makespan + 1):
        pairs = zip(result.plan.units, result.plan.steps, strict=True)
        units = tuple(sorted(unit for unit, own in pairs if own == step))
        assert units in set(world.steps(state))
        state = world.after(state, units)
    assert all(world.has(state, goal) for goal in result.goals)


@many(250)
@given(stores(), semantics_, st.data())
def test_hopeless_is_never_wrong(where: Domain, semantics: str, data: st.DataObject) -> None:
    goals = data.draw(st.lists(st.sampled_from(where.foon.objects), min_size=1, max_size=2, unique=True))
    world = World(where, semantics)
    seen, queue = {world.start}, [world.start]
    for state in queue:
        for unit in world.needs:
            if not world.lacks(state, unit) and (after := world.after(state, [unit])) not in seen:
                seen.add(after)
                queue.append(after)
    reached = any(all(world.has(state, goal) for goal in goals) for state in queue)
    ids = [where.id_of(goal) for goal in goals]
    assert hopeless(Effects(where, semantics), ids, list(world.needs), 10_000) == (not reached)


TWO_CAKES = (
    "egg -beat-> batter",
    "batter -bake-> cake",
    "batter -fry-> waffle",
    "cake + waffle -serve-> feast",
)


def test_what_is_used_up_is_made_again() -> None:
    where = domain(TWO_CAKES, "egg")
    fewest = {semantics: plan(where, node("feast"), semantics) for semantics in SEMANTICS}
    done = {name: len(each.plan.units) if each.plan else None for name, each in fewest.items()}
    assert done == {"add": 4, "transform": 4, "consume": 5}
    assert fewest["add"].steps == 3
    # Batter is made, and used up, and made again.
    assert fewest["consume"].steps == 5


@pytest.mark.parametrize(("eggs", "status"), [(1, "unreachable"), (2, "optimal")])
def test_what_is_counted_runs_out(eggs: int, status: str) -> None:
    result = plan(with_quantities(TWO_CAKES, "egg", egg=eggs), node("feast"), "consume")
    assert result.status == status
    assert ("too much is used up" in result.reason) == (eggs == 1)


def test_what_is_counted_can_be_made_once_it_ran_out() -> None:
    """The kitchen has one egg, and a hen: its unit matters though the egg is at hand."""
    where = with_quantities([*TWO_CAKES, "hen -lay-> egg + hen"], "egg + hen", egg=1)
    result = plan(where, node("feast"), "consume")
    assert result.plan is not None
    assert motions(where, result.plan.units) == {"beat", "bake", "fry", "serve", "lay"}


def test_a_fee_is_paid_once() -> None:
    units = ("a -cut-> b", "b -cut-> goal", "a -fry-> c", "c -boil-> goal")
    where = domain(units, "a")
    result = plan(where, node("goal"), "consume", "motions")
    assert result.plan is not None
    assert motions(where, result.plan.units) == {"cut"}
    assert result.cost == 1


def test_a_goal_at_hand_takes_no_step() -> None:
    result = plan(domain(TWO_CAKES, "cake"), node("cake"))
    assert (result.status, result.steps, result.cost) == ("optimal", 0, 0)
    assert result.plan is not None
    assert result.plan.units == ()


def test_several_goals_must_be_there_together() -> None:
    where = with_quantities(TWO_CAKES, "egg", egg=1)
    assert plan(where, node("cake")).status == plan(where, node("waffle")).status == "optimal"
    assert plan(where, [node("cake"), node("waffle")]).status == "unreachable"


def test_limits_are_said() -> None:
    where = domain(TWO_CAKES, "egg")
    few = plan(where, node("feast"), max_steps=3)
    assert (few.status, few.plan, few.steps) == ("limit", None, 4)
    late = plan(where, node("feast"), time_limit=0)
    assert (late.status, late.plan, late.steps) == ("limit", None, 3)


def test_only_one_level_is_minimised() -> None:
    where = domain(TWO_CAKES, "egg")
    with pytest.raises(QueryError, match="one level"):
        plan(where, node("feast"), by="units,inputs")


def test_what_no_unit_makes_is_unreachable_at_once() -> None:
    result = plan(domain(TWO_CAKES, ""), node("feast"))
    assert result.status == "unreachable"
    assert "the kitchen lacks" in result.reason


@pytest.mark.parametrize("semantics", SEMANTICS)
def test_public_goals(universal: Dataset, universal_domain: Domain, semantics: str) -> None:
    """All goals that can be made are planned for with proof, but for one that takes over 50 steps."""
    statuses = dict[str, list[str]]()
    for goal in universal.goals:
        if semantics != "add" and goal.label == "cheese pizza":
            continue
        result = plan(universal_domain, goal, semantics, time_limit=60)
        statuses.setdefault(result.status, []).append(goal.label)
        if result.plan is not None:
            assert result.plan.makespan >= universal_domain.closure.available[universal_domain.id_of(goal)]
    assert sorted(statuses) == ["optimal", "unreachable"]
    assert sorted(statuses["unreachable"]) == ["fried rice", "whipped cream"]
    assert len(statuses["optimal"]) == (23 if semantics == "add" else 22)
