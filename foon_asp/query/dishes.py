"""Dishes as people ask for them: by a goal, by what they are a kind of, or by a category of the files."""

from __future__ import annotations

from collections.abc import Iterable

from foon_asp.errors import QueryError
from foon_asp.model.lookup import Pattern
from foon_asp.model.node import ObjectNode
from foon_asp.model.notation import read_object
from foon_asp.model.world import World
from foon_asp.query.goals import Named, check_named, find_object
from foon_asp.values import said
from foon_asp.words import closest, shortened


def find_dishes(world: World, named: Named) -> list[ObjectNode]:
    """Return the dishes that may be meant, as the level of a world shows them, each once.

    A node, or a text that says all of one, means itself. Else what has the label, or one that ends in it (a
    greek salad is a salad), and fits the other parts. Of each label the goals of the world and of the files
    are dishes, or where there are none what units make and no unit makes into the same in another state. A
    number that is no label is a category: what the files mark with it. Raises `QueryError` if no unit makes
    any of these.
    """
    check_named(named, "a dish")
    if isinstance(named, ObjectNode):
        return [world.project(named)]
    if not named.strip():
        raise QueryError("the dish is empty; name one, what it is a kind of, or its category")
    full = world.full
    category = named.strip()
    if category.isdecimal() and category not in full.labels:
        found = _of_category(full, category)
    else:
        found = _exactly(full, named) or _of_kind(full, named)
    return list(dict.fromkeys(map(world.project, found)))


def _of_category(world: World, category: str) -> list[ObjectNode]:
    marks = world.foon.goal_marks()
    found = [node for node, names in marks.items() if category in names]
    if not found:
        known = sorted({name for names in marks.values() for name in names if name.isdecimal()}, key=int)
        hint = f"there are {', '.join(known)}" if known else "they mark none at all"
        raise QueryError(f"the files mark no dish with the category {category}; {hint}")
    return found


def _exactly(world: World, text: str) -> list[ObjectNode]:
    """Return the node that is just what a text says of label and states, if there is one."""
    try:
        node = find_object(world, text)
    except QueryError:
        return []
    return [node] if not node.bare and str(node) == text.strip() else []


def _of_kind(world: World, text: str) -> list[ObjectNode]:
    pattern = Pattern.of(read_object(text, world.labels))
    makers, objects = world.units.makers, world.foon.objects
    labels = sorted(label for label in world.foon.labels if _is_kind_of(label, pattern.label))
    kinds = [objects[n] for label in labels for n in objects.labelled(label) if n in makers]
    if not kinds:
        if pattern.label in world.labels:
            raise QueryError(f"no unit makes {said(pattern.label)}, nor anything that ends in this")
        words = [label.split() for label in world.labels]
        ends = {" ".join(each[place:]) for each in words for place in range(len(each))}
        raise QueryError(
            f"nothing in this FOON is called {said(pattern.label)}{closest(pattern.label, ends)}"
        )
    fitting = [node for node in kinds if pattern.of_label(node.label).matches(node, exactly=False)]
    if not fitting:
        raise QueryError(f"no dish is {said(text)}; of this kind there is {shortened(kinds, 5, ';')}")
    named = {*world.goals, *world.foon.goal_marks()}
    by_label: dict[str, list[ObjectNode]] = {}
    for node in fitting:
        by_label.setdefault(node.label, []).append(node)
    return [
        node
        for nodes in by_label.values()
        for node in [each for each in nodes if each in named] or _last(world, nodes)
    ]


def _is_kind_of(label: str, kind: str) -> bool:
    return f" {label}".endswith(f" {kind}")


def _last(world: World, nodes: list[ObjectNode]) -> Iterable[ObjectNode]:
    """Return those of some nodes of a label that no unit makes into another one of them, or else all."""
    among = {world.id_of(node) for node in nodes}
    users, makes = world.units.users, world.units.makes
    last = [
        number
        for number in sorted(among)
        if not any(among & set(makes[unit]) - {number} for unit in users.of(number))
    ]
    return [world.node(number) for number in last or sorted(among)]
