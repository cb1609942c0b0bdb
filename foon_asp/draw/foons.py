"""FOONs as pictures: all units of a small one, what is around an object, and an overview of a large one."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from foon_asp import limits
from foon_asp.draw import words
from foon_asp.draw.picture import Edge, Node, Picture, Role
from foon_asp.draw.units import Drawn, Scene, drawn, is_tool
from foon_asp.errors import QueryError
from foon_asp.io.kitchen import read_labels
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.method import Method
from foon_asp.query.query import Query
from foon_asp.resources import built_in_data
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import find_dishes
from foon_asp.retrieval.tree import TaskTree
from foon_asp.words import counted, cut

_GAP = 2.0
"""Inches between what is shared and the dishes, for arrows that are many and long."""

MOST_UNITS = 120
"""How many units are drawn one by one; a larger FOON gets an overview."""

_TITLE = 90
"""How many letters a title has at most."""

_DISHES, _SHARED = 32, 28
"""How many dishes an overview has, and how many things that they share."""


def usual_utensils() -> frozenset[str]:
    """Return the labels of utensils where nobody says them: those of the built-in data."""
    return read_labels(built_in_data() / "utensils.txt")


def foon_picture(world: World) -> Picture:
    """Return a FOON as a picture: its units, or if they are too many an overview of its dishes."""
    if len(world.foon.units) > MOST_UNITS:
        return overview_picture(world)
    goals = _named(world)
    units = [Drawn(unit) for unit in world.foon.units.ids]
    nodes, edges = drawn(Scene(world, units, goals, world.stock if world.stock else None))
    return Picture("", f"A FOON of {_size(world)}.", nodes, edges)


def _named(world: World) -> list[ObjectId]:
    """Return what the data and the annotators name as goals, as far as it is made."""
    found = (world.foon.id_of(node) for node in (*world.goals, *world.foon.marked_goals()))
    makers = world.units.makers
    return [number for number in dict.fromkeys(found) if number is not None and number in makers]


def _size(world: World) -> str:
    return f"{counted(len(world.foon.units), 'unit')} and {counted(len(world.foon.objects), 'object node')}"


def around_picture(world: World, node: ObjectNode, hops: int = 1) -> Picture:
    """Return the units that make or need an object, and with more `hops` those around these.

    Units are not reached by way of tools, which nearly all of them need. Those nearest are drawn, at most
    `MOST_UNITS`. Raises `QueryError` if the FOON does not have the object.
    """
    centre = world.id_of(node)
    found, left_out = _around(world, centre, hops)
    if not found:
        raise QueryError(f"no unit makes {node}, and none needs it")
    units = [Drawn(unit) for unit in sorted(found)]
    stock = world.stock if world.stock else None
    marks = {centre: "here"}
    nodes, edges = drawn(Scene(world, units, (), stock, kept={centre}, marks=marks))
    # The double line tells it from all others.
    key = next(each.key for each in nodes if each.mark == "here")
    nodes = [replace(each, mark="", goal=True) if each.key == key else each for each in nodes]
    more = f"; {counted(left_out, 'unit')} further off left out" if left_out else ""
    summary = f"What is within {counted(hops, 'hop')} of {node}: {counted(len(found), 'unit')}{more}."
    return Picture(cut(f"around {node}{more}", _TITLE), summary, nodes, edges, sideways=True)


def _around(world: World, centre: ObjectId, hops: int) -> tuple[list[UnitId], int]:
    """Return the units within some hops of an object, the nearest first, and how many are left out."""
    reading = world.units
    seen = {centre}
    found: dict[UnitId, None] = {}
    fresh: Collection[ObjectId] = [centre]
    for _ in range(hops):
        limits.check()
        near = dict.fromkeys(
            unit for number in fresh for unit in (*reading.makers.of(number), *reading.users.of(number))
        )
        new = [unit for unit in near if unit not in found]
        found.update(dict.fromkeys(new))
        touched = (number for unit in new for number in (*reading.needs[unit], *reading.makes[unit]))
        fresh = [
            number for number in dict.fromkeys(touched) if number not in seen and not is_tool(world, number)
        ]
        seen.update(fresh)
    units = list(found)
    return units[:MOST_UNITS], max(0, len(units) - MOST_UNITS)


def overview_picture(world: World) -> Picture:
    """Return dishes, and what several of them share: an arrow leads from that to each dish it goes into.

    A dish is what the data or the annotators name, else what nothing takes further. How it is made is what
    the greedy method finds, from all that no unit makes if there is no kitchen. Of things that
    go into the same dishes, one after the other, the last one stands for all.
    """
    if not world.stock:
        world = World.of(
            world.foon,
            replace(world.kitchen, stated=False),
            strict=world.strict,
            match_relations=world.match_relations,
            goals=world.goals,
        )
    trees, left_out = _dish_trees(world)
    if not trees:
        raise QueryError(
            "this FOON has no dish that can be made; name an object to look around with --around"
        )
    shared = _shared(world, trees)
    sharing = {goal for each in shared for goal in each.dishes}
    nodes = [_dish(world, goal, tree) for goal, tree in trees.items() if goal in sharing]
    edges = []
    for place, each in enumerate(shared):
        nodes.append(each.node(world, f"s{place}"))
        edges += [Edge(f"s{place}", f"d{goal}", f"{each.name} → {world.node(goal)}") for goal in each.dishes]
    apart = [goal for goal in trees if goal not in sharing]
    nodes += _apart(world, apart)
    more = f", and {left_out} more" if left_out else ""
    sharing_what = "and what they share" if shared else "which share nothing"
    title = f"{_size(world)}: {len(trees)} dishes{more}, {sharing_what}"
    return Picture(title, f"An overview of {title}.", nodes, edges, sideways=True, gap=_GAP)


def _apart(world: World, dishes: Sequence[ObjectId]) -> list[Node]:
    """Return the dishes that share nothing, as words, for there is nothing to be seen of them."""
    if not dishes:
        return []
    names = [world.node(dish).label for dish in dishes]
    shown = words.lines([f"{name}," for name in names[:-1]] + names[-1:], most=len(names))
    return [
        Node("n0", Role.NOTE, "on their own", shown, "", "\n".join(str(world.node(each)) for each in dishes))
    ]


@dataclass(frozen=True, slots=True)
class _Common:
    """Object nodes that each go into several dishes, and these dishes.

    All have the same label, or the same contents, which is the `name`.
    """

    name: str
    forms: tuple[ObjectId, ...]
    dishes: tuple[ObjectId, ...]

    def node(self, world: World, key: str) -> Node:
        """Return it as a node; only one that stands alone has its states in it."""
        forms = [world.node(number) for number in self.forms]
        details = (f"{len(forms)} forms",) if len(forms) > 1 else words.details(forms[0])
        if len(forms) == 1 and forms[0].contents:
            details = (f"in {words.head(forms[0])}",)
        mark = f"in {len(self.dishes)} dishes"
        title = "\n".join([*map(str, forms), mark])
        return Node(key, Role.SHARED, self.name, details, mark, title)


def _dish(world: World, goal: ObjectId, tree: TaskTree) -> Node:
    node = world.node(goal)
    steps = counted(len(tree), "step")
    return Node(f"d{goal}", Role.DISH, words.head(node), (steps,), "", f"{node}\n{steps}")


def _dish_trees(world: World) -> tuple[dict[ObjectId, TaskTree], int]:
    """Return a task tree for each dish, or for those with the most steps, and how many are left out."""
    named = [number for number in _named(world) if number in world.closure.available]
    dishes = named if len(named) > 1 else find_dishes(world)
    trees: dict[ObjectId, TaskTree] = {}
    for dish in dishes:
        limits.check()
        tree = retrieve(world, Query(world.node(dish), method=Method.GREEDY, by="inputs")).tree
        if tree is not None and tree.units:
            trees[dish] = tree
    longest = sorted(trees, key=lambda dish: (-len(trees[dish]), dish))[:_DISHES]
    return {dish: trees[dish] for dish in sorted(longest)}, len(trees) - len(longest)


def _shared(world: World, trees: Mapping[ObjectId, TaskTree]) -> list[_Common]:
    """Return what the trees of several dishes make, by label; what goes into the most dishes comes first."""
    dishes: dict[ObjectId, list[ObjectId]] = {}
    after: dict[ObjectId, set[ObjectId]] = {}
    for goal, tree in trees.items():
        made = dict.fromkeys(number for unit in tree.units for number in world.units.makes[unit])
        for unit in tree.units:
            for number in world.units.needs[unit]:
                after.setdefault(number, set()).update(world.units.makes[unit])
        for number in made:
            if number in after and number not in world.stock and _is_food(world, number):
                dishes.setdefault(number, []).append(goal)
    common = {number: goals for number, goals in dishes.items() if len(goals) > 1}
    # Of what goes into the same dishes, one after the other, the last one stands for all.
    passed = {
        number
        for number, goals in common.items()
        if any(other != number and common.get(other) == goals for other in after[number])
    }
    forms: dict[str, list[ObjectId]] = {}
    for number in sorted(common.keys() - passed or common):
        node = world.node(number)
        forms.setdefault(words.contents_head(node) or node.label, []).append(number)
    found = [
        _Common(
            words.short(name),
            tuple(each),
            tuple(goal for goal in trees if any(goal in common[number] for number in each)),
        )
        for name, each in forms.items()
    ]
    return sorted(found, key=lambda each: (-len(each.dishes), each.forms))[:_SHARED]


def _is_food(world: World, number: ObjectId) -> bool:
    """Whether an object is no tool, and no vessel that only shows again what is in it."""
    node = world.node(number)
    if node.label not in world.kitchen.utensils:
        return not is_tool(world, number)
    return len(set(node.contents)) > 1
