"""The step that a task tree most likely lacks where something is missing: a unit of the known FOON."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from foon_asp.asp.facts import facts, gap_facts
from foon_asp.asp.program import OPTIMISE
from foon_asp.asp.solver import open_solver
from foon_asp.errors import InternalError
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem


@dataclass(frozen=True, slots=True)
class Gap:
    """An object that a step of a tree lacks, and all that is at hand before that step."""

    missing: ObjectId
    there: Collection[ObjectId]


@dataclass(frozen=True, slots=True)
class Likely:
    """The known unit that most likely closes a gap, and the tools that it would need besides."""

    unit: UnitId
    lacks: tuple[ObjectId, ...]


def likely_steps(world: World, known: int, gaps: Sequence[Gap]) -> list[Likely | None]:
    """Return for each gap the unit that most likely closes it, of the first `known` units of a FOON.

    All that the unit needs is at hand, but for tools: what is bare, and empty utensils. None if no unit does.
    """
    missing = tuple(dict.fromkeys(gap.missing for gap in gaps))
    makers = sorted({unit for each in missing for unit in world.units.makers.of(each) if unit < known})
    if not makers:
        return [None] * len(gaps)
    problem = Problem(world, missing, among=tuple(makers))
    needs = {unit: world.units.needs[unit] for unit in makers}
    needed = sorted({need for each in needs.values() for need in each})
    asked = [(gap.missing, [need for need in needed if need in gap.there]) for gap in gaps]
    constants = {"strict": int(world.strict)}
    text = facts(problem) + gap_facts(asked)
    model = open_solver(["retrieval/likely.lp"], text, constants, OPTIMISE).best()
    found: list[Likely | None] = [None] * len(gaps)
    for gap, unit in model.rows("closes"):
        assert isinstance(gap, int)
        assert isinstance(unit, int)
        found[gap] = _checked(world, gaps[gap], UnitId(unit))
    return found


def _checked(world: World, gap: Gap, unit: UnitId) -> Likely:
    """Return what a unit lacks in a gap; raise `InternalError` if it does not close it."""
    lacks = tuple(need for need in world.units.needs[unit] if need not in gap.there)
    if gap.missing not in world.units.makes[unit] or not all(
        world.is_tool(world.node(each)) for each in lacks
    ):
        raise InternalError(f"unit {unit} does not make {world.node(gap.missing)} here, as likely.lp says")
    return Likely(unit, lacks)
