"""PDDL exports of small FOONs, walked through by hand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.planning.pddl.styles import Document, document
from foon_asp.planning.pddl.task import Fact, Task, planning_task
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from support import small_foons


def counted(where: World, **quantities: int) -> World:
    """Say of how many kitchen objects, by label, there are not plenty."""
    kitchen = where.kitchen
    counts = {node: quantities[node.label] for node in kitchen.objects if node.label in quantities}
    return World.of(where.foon, replace(kitchen, quantities=counts), strict=where.strict)


def soup() -> World:
    """A kitchen with two onions, and a bowl that comes in two views."""
    where = small_foons.world(
        [
            "onion[whole] + (knife) -chop-> onion[chopped] + (knife)",
            "onion[chopped] + bowl[empty] -put-> bowl{onion} + onion[chopped]@bowl",
            "bowl{onion} + onion[chopped]@bowl + water -cook-> soup + bowl[dirty]",
            "bowl[dirty] + water -wash-> bowl[empty]",
        ],
        "onion[whole] + (knife) + bowl[empty] + water",
        utensils=["bowl", "knife"],
        rates={"chop": 0.9, "put": 1.0, "cook": 0.5, "wash": 1.0},
    )
    return counted(where, onion=2, bowl=1)


def exported(
    where: World,
    goals: Iterable[ObjectNode],
    semantics: str = "consume",
    criterion: str | None = None,
    style: str = "objects",
    durative: bool = False,
) -> Document:
    problem = Problem.of(where, goals)
    task = planning_task(
        problem, Effects(where, semantics), Criterion.parse(criterion) if criterion else None
    )
    return document(task, style, durative)


# Effects


def whole_task(where: World, effects: Effects) -> Task:
    goal = ObjectId(len(where.foon.objects) - 1)
    return planning_task(Problem(where, (goal,), whole=True), effects)


def can_execute(task: Task, units: Sequence[int]) -> bool:
    """Search all ways to put helpers between units: can the units be executed in this order?"""
    reached = {frozenset(task.initially)}
    for unit in units:
        reached = helped(task, reached)
        reached = {
            (state - frozenset(step.deletes)) | frozenset(step.adds)
            for state in reached
            for step in task.steps
            if step.unit == unit and state.issuperset(step.needs)
        }
    return bool(reached)


def helped(task: Task, reached: set[frozenset[Fact]]) -> set[frozenset[Fact]]:
    """Return all states that helpers lead to."""
    open_, found = list(reached), set(reached)
    while open_:
        state = open_.pop()
        for step in task.steps:
            if step.unit is None and state.issuperset(step.needs):
                new = (state - frozenset(step.deletes)) | frozenset(step.adds)
                if new not in found:
                    found.add(new)
                    open_.append(new)
    return found


# The lifted style


def assert_descriptions_match_one_object_only(written: Document) -> None:
    kinds: Mapping[str, str] = dict(written.objects)
    facts: dict[tuple[str, ...], set[str]] = {}
    for atom in written.initially:
        if len(atom) > 1:
            facts.setdefault((atom[0], *atom[2:]), set()).add(atom[1])
    by_kind: dict[str, set[str]] = {}
    for name, kind in kinds.items():
        by_kind.setdefault(kind, set()).add(name)
    for action in written.actions:
        fits = {variable: by_kind[kind] for variable, kind in action.parameters}
        for atom in action.conditions:
            if atom[0] not in ("available", "taken-out", "left") and len(atom) > 1:
                fits[atom[1]] = fits[atom[1]] & facts[(atom[0], *atom[2:])]
        found = tuple(fits[variable] for variable, _ in action.parameters)
        assert found == tuple({name} for name in written.arguments[action.name]), action.name
