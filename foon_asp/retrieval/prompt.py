"""What is wrong with a task tree, as one paragraph for a language model that is to write it again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from foon_asp.io.findings import Severity
from foon_asp.model.node import FunctionalUnit
from foon_asp.model.world import World
from foon_asp.words import counted

if TYPE_CHECKING:
    # The answers import this module, to write themselves.
    from foon_asp.retrieval.check import Check, CheckedStep, Lack, Nearest


def prompt(found: Check) -> str:
    """Return the faults of a tree as one paragraph; of a tree without any that it can be executed."""
    sentences = [
        *_lost(found),
        *(sentence for step in found.steps for sentence in _of_step(found.world, step)),
    ]
    if not found.steps:
        head = "The task tree has no step that can be read."
    elif not found.executable:
        head = f"The task tree of {counted(len(found.steps), 'step')} cannot be executed in its order."
    else:
        head = f"The task tree of {counted(len(found.steps), 'step')} can be executed in its order."
    if found.order is not None:
        head += f" It can be executed in the order {', '.join(map(str, found.order))}."
    if sentences:
        sentences.append(
            "Write the whole task tree again, with these faults mended and nothing else changed."
        )
    return " ".join([head, *sentences])


def _lost(found: Check) -> Iterator[str]:
    for finding in found.listing.findings:
        if finding.severity is Severity.ERROR:
            yield f"In line {finding.line} something could not be read: {finding.message}."


def _of_step(world: World, step: CheckedStep) -> Iterator[str]:
    name = f"Step {step.place} ({step.unit.motion})"
    for lack in step.missing:
        yield f"{name} needs {lack.node}, which no step before it makes and is not at hand{_hints(lack)}."
        yield from _likely(world, lack)
    for lack in step.doubtful:
        yield f"{name} needs {lack.node}, which no step makes{_hints(lack)}."
        yield from _likely(world, lack)
    if step.idle:
        yield f"{name} brings about nothing that was not there before."
    if step.unused:
        yield f"{name} makes {named(world, step.unit)}, which no later step takes."


def _hints(lack: Lack) -> str:
    return f" (there is {joined(map(near_text, lack.nearest))})" if lack.nearest else ""


def near_text(near: Nearest) -> str:
    """Say what resembles something, and where it is from."""
    if near.difference == "later":
        return f"the same made later, by step {near.step}"
    return f"{near.node} from {'the kitchen' if near.step is None else f'step {near.step}'}"


def _likely(world: World, lack: Lack) -> Iterator[str]:
    if lack.likely is not None:
        tools = f" (with {joined(lack.likely.lacks)} at hand)" if lack.likely.lacks else ""
        yield f"A step before it is likely missing{tools}: {unit_text(world, lack.likely.unit)}."


def unit_text(world: World, unit: FunctionalUnit) -> str:
    """Write a unit in one line."""
    takes, gives = (joined(map(world.node, side)) for side in (unit.inputs, unit.outputs))
    return f"{unit.motion}: {takes} → {gives}"


def named(world: World, unit: FunctionalUnit) -> str:
    """Write what a unit makes."""
    return joined(map(world.node, world.units.makes[unit.id]))


def joined(texts: Iterable[object]) -> str:
    """Join names that may have commas in them."""
    return "; ".join(map(str, texts))
