"""What is missing for a goal and why, as a picture: what would be done if it were there, and the circles."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator

from foon_asp.draw.picture import Node, Picture, Role
from foon_asp.draw.trees import title, tree_picture
from foon_asp.draw.units import Drawn, Scene, drawn
from foon_asp.errors import QueryError
from foon_asp.limits import ended
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import FREE
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.unreachable import Circle
from foon_asp.retrieval.explain import Explanation
from foon_asp.retrieval.missing import stocked
from foon_asp.retrieval.nearest import Near
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.words import cut

_LONG = 60
"""How many letters of an object node are said beside the rest."""


def missing_picture(found: Explanation) -> Picture:
    """Return why there is no task tree for a goal as a picture; where there is one, the tree.

    It shows the best tree that there would be if the kitchen had what is missing, and that as missing; the
    units that go round in a circle, with thick arrows; and what the kitchen has instead. Raises `QueryError`
    if the time ran out before that was known.
    """
    if found.status in (Status.REACHABLE, Status.LIMIT) and found.answer is not None and found.answer.tree:
        return tree_picture(found.answer.tree)
    if found.status is Status.LIMIT:
        raise QueryError(f"why there is no task tree was not found: {ended(found.limit)}")
    if found.status is Status.CONSTRAINED:
        return _constrained(found)
    world, goal = found.world, found.world.id_of(found.goal)
    lacking = set(found.missing.sets[0]) if found.missing and found.missing.sets else set()
    circles = [each.circle for each in found.deadlocks]
    # Steps have numbers where they are all that there is to do.
    units: dict[UnitId, int | None] = {
        unit: None if circles else place for place, unit in enumerate(_units(found, lacking), 1)
    }
    ring = {object_id for circle in circles for object_id in circle.objects}
    for unit in _ways(world, lacking or {goal}, ring):
        units.setdefault(unit, None)
    for unit in (unit for circle in circles for unit in circle.units):
        units.setdefault(unit, None)
    # Where nothing helps the goal itself is what is missing.
    lost = lacking or ({goal} if not circles else set())
    scene = Scene(
        world,
        [Drawn(unit, place) for unit, place in units.items()],
        (goal,),
        world.stock,
        kept=ring | lost,
        marks={number: "missing, in a circle" if number in lost else "in a circle" for number in ring},
        missing=lost,
        strong=set(_ring_arrows(circles)),
    )
    nodes, edges = drawn(scene)
    return Picture(f"{title(world, (goal,))}: {_why(found)}", found.reason, [*nodes, *_near(found)], edges)


def _units(found: Explanation, lacking: set[ObjectId]) -> Iterator[UnitId]:
    """Yield the units of the best tree that there would be with what is missing, in their order."""
    if not lacking:
        return
    asked = Query(found.goal, time_limit=found.query.time_limit)
    tree = retrieve(stocked(found.world, sorted(lacking)), asked).tree
    if tree is not None:
        yield from tree.units


def _ways(world: World, starts: Iterable[ObjectId], ring: Container[ObjectId]) -> Iterator[UnitId]:
    """Yield the units on the shortest ways from what is missing to each object of a circle that they reach.

    A way goes from an object to a unit that makes it, and on to what that needs and cannot have.
    """
    came: dict[ObjectId, tuple[ObjectId, UnitId] | None] = dict.fromkeys(sorted(starts))
    there = world.closure.available
    queue = list(came)
    for number in queue:
        if number in ring:
            step = came[number]
            while step is not None:
                before, unit = step
                yield unit
                step = came[before]
            continue
        for unit in world.units.makers.of(number):
            for need in world.units.needs[unit]:
                if need not in came and need not in there:
                    came[need] = (number, unit)
                    queue.append(need)


def _ring_arrows(circles: list[Circle]) -> Iterator[tuple[ObjectId, UnitId]]:
    for circle in circles:
        for place, (number, unit) in enumerate(zip(circle.objects, circle.units, strict=True)):
            yield number, unit
            yield circle.objects[(place + 1) % len(circle.objects)], unit


def _why(found: Explanation) -> str:
    return "locked in a circle" if found.deadlocks else "what is missing"


def _near(found: Explanation) -> Iterator[Node]:
    """Yield what the kitchen has that resembles what is missing, as words."""
    listed = [(str(each.node), each.near) for each in found.missing_objects]
    listed += [(str(found.world.node(each.circle.objects[0])), each.near) for each in found.deadlocks]
    listed.append((str(found.goal), found.near))
    for place, (name, near) in enumerate(dict(listed).items()):
        if near:
            yield Node(
                f"n{place}", Role.NOTE, f"like {cut(name, _LONG)}:", _names(near), "", _whole(name, near)
            )


def _names(near: tuple[Near, ...]) -> tuple[str, ...]:
    return tuple(cut(str(each.node), _LONG) for each in near)


def _whole(name: str, near: tuple[Near, ...]) -> str:
    return "\n".join([f"the kitchen has, and it is like {name}:", *(str(each.node) for each in near)])


def _constrained(found: Explanation) -> Picture:
    """Return the best tree without constraints, for these alone forbid it, and which must give way."""
    free = retrieve(found.world, Query(found.goal, constraints=FREE, time_limit=found.query.time_limit)).tree
    said = f"forbidden by {', '.join(found.give_way)}" if found.give_way else "forbidden by the constraints"
    head = f"{title(found.world, (found.world.id_of(found.goal),))}: {said}"
    picture = Picture("", "", (), ()) if free is None else tree_picture(free)
    return Picture(head, found.reason, picture.nodes, picture.edges)
