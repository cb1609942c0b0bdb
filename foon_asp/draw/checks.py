"""Task trees that someone else made, as pictures, with the faults that `check` finds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import PurePath

from foon_asp.draw.picture import Picture
from foon_asp.draw.units import Drawn, Scene, drawn
from foon_asp.model.node import ObjectId
from foon_asp.retrieval.check import Check, CheckedStep, Lack
from foon_asp.words import counted, cut


def check_picture(check: Check) -> Picture:
    """Return a tree in the order of its file, with what is wrong with it said in its steps."""
    world = check.world
    units = [
        Drawn(
            step.unit.id,
            step.place,
            faults=tuple(_faults(step)),
            lacks=frozenset(_ids(check, (*step.missing, *step.doubtful))),
        )
        for step in check.steps
    ]
    # The last step of a tree without a mark leaves dirty dishes, too.
    wanted = [node for node in check.goals if not world.is_tool(node)] or check.goals
    goals = [world.units.read(world.id_of(node)) for node in wanted]
    nodes, edges = drawn(Scene(world, units, goals, world.stock))
    wrong = sum(not step.flawless for step in check.steps)
    verdict = "executable" if check.executable else "not executable as it stands"
    found = f"{counted(len(units), 'step')}, {verdict}"
    if wrong:
        found += f", something to say of {wrong}"
    name = PurePath(check.name).name
    return Picture(f"{name}: {found}", f"The task tree {name}: {found}.", nodes, edges)


def _ids(check: Check, lacks: tuple[Lack, ...]) -> Iterator[ObjectId]:
    for lack in lacks:
        yield check.world.units.read(check.world.id_of(lack.node))


def _faults(step: CheckedStep) -> Iterator[str]:
    """Yield what is wrong with a step, in a few words each."""
    for lack in step.missing:
        later = next((near.step for near in lack.nearest if near.difference == "later"), None)
        yield f"lacks {lack.node}" if later is None else f"too early: step {later} makes {lack.node}"
    yield from (f"doubtful: {lack.node}" for lack in step.doubtful)
    if step.idle:
        yield "brings about nothing new"
    if step.unused:
        yield "nothing takes what it makes"


def side_by_side(pictures: list[Picture]) -> Picture:
    """Return several pictures as one; they have nothing in common."""
    if len(pictures) == 1:
        return pictures[0]
    nodes, edges = [], []
    for number, picture in enumerate(pictures):
        names = {node.key: f"{node.key}_{number}" for node in picture.nodes}
        nodes += [replace(node, key=names[node.key]) for node in picture.nodes]
        edges += [replace(edge, tail=names[edge.tail], head=names[edge.head]) for edge in picture.edges]
    titles = "; ".join(dict.fromkeys(picture.title for picture in pictures if picture.title))
    return Picture(cut(titles), " ".join(picture.summary for picture in pictures), nodes, edges)
