"""What locks the units that never run, and the edits that would free them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass

from foon_asp.audit.unlock import edits
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, State
from foon_asp.model.world import World


@dataclass(frozen=True, slots=True)
class Lock:
    """A need that keeps units from ever running, and the edit that opens most of them.

    The edit: in `unit`, the input `need` is replaced by `replacement` (None: nothing that can be had
    resembles it, so only taking it away is proposed). `circle` are the units that keep the need from
    being made, `unit` among them; empty if nothing makes it. `opens` are the units that can run after the
    edit and the edits of the locks before; `unlocks` the goals among what they make, or else the end
    products.
    """

    unit: FunctionalUnit
    need: ObjectNode
    replacement: ObjectNode | None
    circle: tuple[FunctionalUnit, ...]
    opens: tuple[FunctionalUnit, ...]
    unlocks: tuple[ObjectNode, ...]


def find_locks(world: World, goals: Sequence[ObjectNode] = ()) -> Iterator[Lock]:
    """Yield the edits that open units that never run, each time the one that opens most of what is left."""
    units = world.foon.units
    available = set(world.closure.available)
    for edit in edits(world):
        fresh = {made for unit in edit.opened for made in world.units.makes[unit]} - available
        need = world.node(edit.need)
        yield Lock(
            unit=units[edit.unit],
            need=need,
            replacement=_resembling(world, units[edit.unit], need, available),
            circle=tuple(units[unit] for unit in edit.circle),
            opens=tuple(units[unit] for unit in edit.opened),
            unlocks=_products(world, fresh, goals),
        )
        available |= fresh


def _resembling(
    world: World, unit: FunctionalUnit, need: ObjectNode, available: Set[ObjectId]
) -> ObjectNode | None:
    """Return what was probably meant instead of a need: it can be had, and differs in one respect.

    The label is the same. Either it lacks just what the other inputs of the unit bring, as if the output
    had been written among the inputs, or the contents are the same and one state differs.
    """
    inputs = [world.foon.objects[number] for number in unit.inputs]
    beside = [node for node in inputs if node != need and need.label not in node.containers]
    brought = {label for node in beside for label in (node.label, *node.contents)}
    contents, others = _contents_and_rest(need)
    candidates = []
    known = world.foon.objects
    alike = (*known.labelled(need.label), *world.ids[len(known) :])
    for node in (world.node(number) for number in alike if number in available):
        if node.label != need.label or node.bare:
            continue
        its_contents, its_others = _contents_and_rest(node)
        gain = contents - its_contents
        if others == its_others and its_contents < contents and gain <= brought:
            candidates.append((len(gain), node.sort_key, node))
        elif contents == its_contents and others & its_others and len(others ^ its_others) <= 2:
            candidates.append((len(others ^ its_others), node.sort_key, node))
    return min(candidates)[2] if candidates else None


def _contents_and_rest(node: ObjectNode) -> tuple[set[str], set[State]]:
    return set(node.contents), {state for state in node.states if state.name != "contains"}


def _products(world: World, fresh: set[ObjectId], goals: Sequence[ObjectNode]) -> tuple[ObjectNode, ...]:
    """Return the goals among objects, or else those that no unit needs."""
    reached = [goal for goal in goals if world.id_of(goal) in fresh]
    ends = [world.node(object_id) for object_id in sorted(fresh) if object_id not in world.units.users]
    return tuple(reached or ends)
