"""A task tree as numbered steps, or why there is none."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from foon_asp.model.node import FunctionalUnit, ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.objective import Criterion
from foon_asp.render.proof import limit_text, proof_text
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.tree import Replay, TaskTree, origins
from foon_asp.words import chance_text, counted, short_source, wrapped


def retrieval_text(result: Answer) -> str:
    """Write a task tree as numbered steps, or say why there is none."""
    changes = () if result.tree is None else map(str, result.tree.replacements)
    return "\n".join(retrieval_lines(result, changes)) + "\n"


def retrieval_lines(result: Answer, changes: Iterable[str]) -> list[str]:
    """Return the lines of the same; what was changed in the tree stands before its steps."""
    lines = [str(result.goal), _verdict(result)]
    if result.tree is not None:
        lines += [*changes, "", *steps_text(result.tree)]
    return lines


def _verdict(result: Answer) -> str:
    how = result.query.method + (f" by {','.join(result.by)}" if result.by else "")
    if not result.query.founded:
        how += ", reference reading"
    tree = result.tree
    if tree is None:
        if result.status == "limit":
            return f"no task tree was found before the {limit_text(result.limit)} ({how})"
        return f"no task tree: {result.reason}"
    if not tree.units:
        return "nothing to do: the kitchen has it"
    parts = costs_parts(tree, result.by)
    proof = proof_text(result.status, result.limit)
    parts += [f"{paid} by your rules at priority {priority}" for priority, paid in result.own.items()]
    text = ", ".join(parts) + f" ({how}{', ' + proof if proof else ''})"
    for name, value in result.bound.items():
        if Criterion.parse(name).names == ("success",):
            text += f"\nproven so far: {name} at most {chance_text(value)}"
        else:
            text += f"\nproven so far: {name} at least {value:.3g}"
    return "\n".join([text, *not_executable(tree)])


def not_executable(tree: TaskTree) -> list[str]:
    """Return the line that belongs to each tree that cannot be executed; none for all others."""
    if tree.executable:
        return []
    return [f"NOT EXECUTABLE in any order: {failure_text(tree.replay)}"]


def failure_text(replay: Replay) -> str:
    """Say where a replay failed, and what was missing there."""
    step = "in the end" if replay.failed_at is None else f"at step {replay.failed_at + 1}"
    if not replay.missing:
        return "what it lacks was not written down"
    return f"{step} it lacks {'; '.join(map(str, replay.missing))}"


_UNITS = {
    "tools": "tool",
    "dirty": "container",
    "motions": "motion",
    "time": "second",
    "human": "human step",
}
"""How criteria are counted that are only shown where they were asked for."""


def costs_parts(tree: TaskTree, by: Iterable[str]) -> list[str]:
    """Return what a tree costs by the usual criteria and by those that were asked for."""
    costs = tree.costs
    parts = [counted(costs.units, "step")]
    if costs.depth is not None:
        parts.append(counted(costs.depth, "round"))
    parts.append(counted(costs.inputs, "input"))
    if costs.success is not None:
        parts.append(f"success {chance_text(costs.success)}")
    if costs.cost is not None:
        parts.append(f"cost {costs.cost:.6g}")
    asked = {name for text in by for name in Criterion.parse(text).names}
    for name, word in _UNITS.items():
        if name in asked or (name == "human" and tree.human):
            parts.append(counted(getattr(costs, name), word))
    return parts


def steps_text(tree: TaskTree, notes: Mapping[UnitId, str] | None = None) -> list[str]:
    """Write each unit: the motion, what it takes (and from which step), what it makes, where it stands.

    `notes` are written behind the first lines of some units.
    """
    lines: list[str] = []
    rows = zip(tree.functional_units, tree.numbers, origins(tree), strict=True)
    for place, (unit, number, maker) in enumerate(rows, 1):
        head = head_line(unit, place, " (human)" if unit.id in tree.human else "", number)
        lines += [head + (notes or {}).get(unit.id, ""), *port_lines(tree.world, unit, maker)]
    return lines


def head_line(unit: FunctionalUnit, place: int, note: str = "", number: UnitId | None = None) -> str:
    """Write the number of a step, its motion with a note behind it, and where the unit stands.

    `number` is the id of the unit where it comes from, if that is another one.
    """
    source = unit.source
    where = f"{short_source(source.file, source.line)}, " if source.file else ""
    return f"{place:3}. {unit.motion}{note}  [{where}unit {unit.id if number is None else number}]"


def port_lines(
    world: World, unit: FunctionalUnit, maker: Mapping[ObjectId, int], used_up: Iterable[ObjectId] = ()
) -> list[str]:
    """Write what a unit takes and makes; `maker` are the places of the steps that made what it takes.

    These objects are as relations are read. `used_up` are objects that are not there afterwards.
    """
    foon = world.foon
    others: list[str] = []
    tools: list[str] = []
    for number in unit.inputs:
        node = foon.objects[number]
        step = maker.get(world.units.read(number))
        name = str(node) + ("" if step is None else f" (step {step})")
        (tools if node.bare and step is None else others).append(name)
    return [
        *_listed("take", others),
        *_listed("with", tools),
        *_listed("get", [str(foon.objects[number]) for number in world.units.makes[unit.id]]),
        *_listed("gone", [str(foon.objects[number]) for number in used_up]),
    ]


def _listed(word: str, names: Sequence[str]) -> list[str]:
    return wrapped("; ".join(names), f"     {word:5}", " " * 12) if names else []
