"""Several trees made into one, against trying every set of their sound steps; models against plain Python."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from hypothesis import event, given
from hypothesis import strategies as st

import foon_asp as fa
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from support import brute_force
from support.examples import many
from support.small_foons import MOTIONS, domains, with_units

STATES = ("whole", "chopped", "hot", "empty", "dirty", "ready")
PLACES = ("bowl", "cup")

Orders = list[list[str]]


def orders(words: Sequence[str]) -> st.SearchStrategy[Orders]:
    return st.lists(st.lists(st.sampled_from(words), min_size=1, max_size=4, unique=True), max_size=3)


@dataclass(frozen=True)
class Dish:
    """A FOON, and trees that are made of its units; what motions cost, and which transitions there are."""

    foon: Foon
    kitchen: list[ObjectNode] | None
    trees: list[list[UnitId]]
    costs: dict[str, float]
    states: Orders
    locations: Orders
    motions: Orders
    adjacent: bool

    def parts(self) -> list[Foon]:
        return [with_units(self.foon, (self.foon.units[unit] for unit in tree)) for tree in self.trees]

    def asked(self, goal: ObjectNode) -> fa.Consolidation:
        return fa.consolidate(
            *self.parts(),
            goal=goal,
            kitchen=self.kitchen,
            costs=self.costs,
            states=self.states,
            locations=self.locations,
            motions=self.motions,
            adjacent=self.adjacent,
        )


@st.composite
def dishes(draw: st.DrawFn) -> Dish:
    where = draw(domains(strict=False))
    foon = where.foon
    kitchen = draw(st.sampled_from([None, list(where.kitchen.objects), list(where.kitchen.objects)]))
    units = st.sampled_from(list(foon.units.ids))
    trees = draw(st.lists(st.lists(units, min_size=1, max_size=6, unique=True), min_size=1, max_size=3))
    costs = {motion: draw(st.sampled_from([0.0, 0.1, 0.25, 0.9, 2.0])) for motion in MOTIONS}
    return Dish(
        foon,
        kitchen,
        trees,
        costs,
        draw(orders(STATES)),
        draw(orders(PLACES)),
        draw(orders(MOTIONS)),
        draw(st.booleans()),
    )


def leads(model: Orders, one: str, other: str, *, adjacent: bool) -> bool:
    for order in model:
        if one in order and other in order:
            distance = order.index(other) - order.index(one)
            if distance == 1 or (distance > 1 and not adjacent):
                return True
    return False


def allowed(model: Orders, before: set[str], behind: set[str], *, adjacent: bool) -> bool:
    known = {word for order in model for word in order}
    earlier = before & known
    return not earlier or all(
        any(leads(model, one, other, adjacent=adjacent) for one in earlier)
        for other in (behind - before) & known
    )


def said(dish: Dish, label: str, ports: Sequence[ObjectId], relation: bool) -> set[str]:
    nodes = [dish.foon.objects[port] for port in ports if dish.foon.objects[port].label == label]
    return {
        word
        for node in nodes
        for word in ((s.relatum for s in node.states if s.relatum) if relation else node.plain_states)
        if word is not None
    }


def sound(dish: Dish, world: World) -> Iterator[set[UnitId]]:
    """Yield the units of each tree that stay, as the definitions say it."""
    for tree in dish.trees:
        kept = set()
        last: dict[ObjectNode, str] = {}
        for number in tree:
            unit = dish.foon.units[number]
            needs, makes = brute_force.needs(world, unit), brute_force.makes(world, unit)
            fine = bool(unit.inputs and makes)
            labels = {dish.foon.objects[port].label for port in unit.inputs}
            for label in labels & {dish.foon.objects[port].label for port in unit.outputs}:
                for model, relation in ((dish.states, False), (dish.locations, True)):
                    before, behind = (
                        said(dish, label, side, relation) for side in (unit.inputs, unit.outputs)
                    )
                    fine &= allowed(model, before, behind, adjacent=dish.adjacent)
            handed: dict[str, set[str]] = {}
            for need in needs & last.keys():
                if need.label not in world.kitchen.utensils:
                    handed.setdefault(need.label, set()).add(last[need])
            fine &= all(
                allowed(dish.motions, before, {unit.motion}, adjacent=dish.adjacent)
                for before in handed.values()
            )
            last |= dict.fromkeys(makes, unit.motion)
            if fine:
                kept.add(number)
        yield kept


def kitchen_of(world: World, units: set[UnitId]) -> set[ObjectNode]:
    """Return what units need and no other one makes, and utensils with nothing in them."""
    used = [world.foon.units[unit] for unit in units]
    needed = {node for unit in used for node in brute_force.needs(world, unit)}
    made = {node for unit in used for node in brute_force.makes(world, unit) - brute_force.needs(world, unit)}
    empty = {
        node
        for node in needed
        if node.label in world.kitchen.utensils
        and not any(
            state.relatum or state.contents is not None or state.name == "contains" for state in node.states
        )
    }
    return (needed - made) | empty


@many(70)
@given(dish=dishes(), data=st.data())
def test_the_tree_costs_least_of_all_sets_of_sound_steps(dish: Dish, data: st.DataObject) -> None:
    used = {unit for tree in dish.trees for unit in tree}
    ports = {
        port for unit in used for port in (*dish.foon.units[unit].inputs, *dish.foon.units[unit].outputs)
    }
    vessels = {vessel for port in ports for vessel in dish.foon.objects[port].containers}
    bare = World.of(dish.foon, Kitchen((), frozenset(vessels)))
    at_hand = kitchen_of(bare, used) if dish.kitchen is None else dish.kitchen
    world = World.of(
        dish.foon, Kitchen(tuple(at_hand), frozenset(vessels), dict.fromkeys(MOTIONS, 1.0)), strict=False
    )
    rounds, _ = brute_force.closure(world, used)
    things = [dish.foon.objects[port] for port in sorted(ports)]
    last = max(things, key=lambda thing: rounds.get(thing, 0))
    goal = data.draw(st.sampled_from([last] * len(things) + things))
    found = dish.asked(goal)
    assert not found.reworded
    assert set(found.kitchen) == set(world.kitchen.objects)
    kept = list(sound(dish, world))
    assert [each.dropped for each in found.samples] == [
        len(tree) - len(units) for tree, units in zip(dish.trees, kept, strict=True)
    ]
    trees = {
        units: sum((Fraction(str(dish.costs[dish.foon.units[unit].motion])) for unit in units), Fraction(0))
        for units in brute_force.tree_sets(world, [goal])
    }
    costs = least(trees, set().union(*kept))
    event("no tree" if costs is None else f"a tree that costs {'something' if costs else 'nothing'}")
    event(f"{sum(len(tree) for tree in dish.trees) - sum(map(len, kept))} dropped")
    if costs is None:
        assert (found.status, bool(found)) == ("unreachable", False)
        assert found.explanation is not None
        return
    assert found.status == "optimal"
    assert found.answer.tree is not None
    assert found.answer.tree.executable
    assert found.answer.bound == {}
    assert found.answer.tree.costs.cost == costs
    alone = [None if each.alone.costs is None else each.alone.costs.cost for each in found.samples]
    assert alone == [least(trees, units) for units in kept]
    for step in found:
        backing = found.backing[step.unit]
        names = tuple(
            f"tree {place}"
            for place, units in enumerate(kept, 1)
            if any(same(dish, unit, step) for unit in units)
        )
        assert backing.trees == names
        assert names


def same(dish: Dish, number: UnitId, step: fa.Step) -> bool:
    unit = dish.foon.units[number]
    sides = ({dish.foon.objects[port] for port in side} for side in (unit.inputs, unit.outputs))
    return (unit.motion, *sides) == (step.motion, set(step.takes), set(step.outputs))


def least(trees: dict[frozenset[UnitId], Fraction], units: set[UnitId]) -> float | None:
    """Return the least cost of the trees that are made of some units."""
    found = [cost for chosen, cost in trees.items() if chosen <= units]
    return float(min(found)) if found else None
