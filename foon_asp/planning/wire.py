"""What plans and engines are as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from foon_asp.io.object_wire import ObjectJson, UnitJson, object_to_json
from foon_asp.io.wire import FEW, Amount, Count, JsonObject, LimitName, Place, Text, means, word

if TYPE_CHECKING:
    # The answers import this module, to write themselves.
    from foon_asp.model.node import UnitId
    from foon_asp.planning.answer import PlanAnswer
    from foon_asp.planning.engines import Engine
    from foon_asp.planning.pddl.names import ListedUnit
    from foon_asp.planning.plan import Plan

Semantics = Annotated[
    Literal["add", "transform", "consume"],
    means(
        "What is used up: nothing; what becomes or goes into an output; every input that is not an "
        "output again."
    ),
]


class PlanUnitJson(UnitJson):
    """A functional unit of a plan."""

    step: Annotated[Place, means("The parallel step in which it is done.")]


class PlanJson(JsonObject):
    """Units in the order of execution; a unit may come again."""

    semantics: Semantics
    executable: Annotated[
        bool, means("Whether the replay of the units, in order, from the kitchen reaches the goals.")
    ]
    length: Annotated[Count, means("How many units are done, those that come again each time.")]
    makespan: Annotated[Count, means("How many parallel steps it takes.")]
    units: Annotated[list[PlanUnitJson], means("The functional units in the order of execution.")]
    missing: Annotated[
        list[ObjectJson],
        means(
            "What the first unit that cannot be executed lacks, or the goals that are not there in the "
            "end; empty if executable."
        ),
    ]


def plan_json(plan: Plan) -> PlanJson:
    """Return a plan: the units in order, each with its parallel step; it is what `pddl decode` writes."""
    foon = plan.world.foon
    return PlanJson(
        semantics=word(plan.semantics),
        executable=plan.executable,
        length=len(plan.units),
        makespan=plan.makespan,
        units=[
            PlanUnitJson.of(foon, foon.units[unit], step=step)
            for unit, step in zip(plan.units, plan.steps, strict=True)
        ],
        missing=[object_to_json(node) for node in plan.replay.missing],
    )


class NamedUnitJson(JsonObject):
    """A functional unit of a plan, as names.json has it."""

    id: Annotated[Count, means("Its place among the distinct units of the FOON of the export, from 0.")]
    motion: Annotated[Text, means("The motion.")]
    source: Annotated[str, means("Its file and line as `file:line`; may be empty.")]


class NamedPlanJson(JsonObject):
    """Units in the order of execution, without their FOON: they were not replayed."""

    semantics: Semantics
    executable: Annotated[None, means("Nobody knows without the FOON.")]
    length: Annotated[Count, means("How many units are done, those that come again each time.")]
    units: Annotated[list[NamedUnitJson], means("The functional units in the order of execution.")]


def named_plan_json(
    units: Sequence[UnitId], listed: Mapping[UnitId, ListedUnit], semantics: str
) -> NamedPlanJson:
    """Return what `pddl decode` writes where the FOON of the export is not at hand."""
    named = [NamedUnitJson(unit, listed[unit].motion, listed[unit].source) for unit in units]
    return NamedPlanJson(word(semantics), None, len(named), named)


class PlanAnswerJson(JsonObject):
    """What an engine found for some goals."""

    goals: Annotated[list[ObjectJson], FEW, means("The object nodes that were asked for.")]
    engine: Annotated[Text, means("The engine, as foon-asp engines lists it.")]
    by: Annotated[Text, means("What is cheap: a criterion or a weighted sum.")]
    status: Annotated[
        Literal["optimal", "solved", "unsolvable", "limit", "gave up", "failed"],
        means(
            "optimal: proven (for clingo, the cheapest of the plans with the fewest parallel steps). "
            "solved: a plan. unsolvable: proven. limit: the time or the steps ran out. gave up: no plan "
            "was found, and none is ruled out. failed: the engine broke down."
        ),
    ]
    reason: Annotated[str, means("Why there is no plan, or why it is not proven; may be empty.")]
    semantics: Semantics
    cost: Annotated[
        float | None,
        means(
            "What the plan costs by `by`, a chance if that is success alone; null if there is no plan, or "
            "if its chance is 0 and `by` is a sum, which is infinite then."
        ),
    ]
    plan: Annotated[PlanJson | None, means("The plan, replayed; null if there is none.")]
    span: Annotated[
        float | None, means("When the last step ends, in a plan of an engine that plans in time; else null.")
    ]
    seconds: Annotated[Amount, means("Wall time, without reading the files.")]
    limit: LimitName


def plan_answer_json(answer: PlanAnswer) -> PlanAnswerJson:
    """Return what `plan --format json` writes."""
    return PlanAnswerJson(
        goals=[object_to_json(goal) for goal in answer.goals],
        engine=answer.engine,
        by=answer.by,
        status=word(answer.status),
        reason=answer.reason,
        semantics=word(answer.semantics),
        cost=answer.cost,
        plan=None if answer.plan is None else plan_json(answer.plan),
        span=answer.span,
        seconds=round(answer.seconds, 6),
        limit=answer.limit,
    )


class EngineJson(JsonObject):
    """A planning engine."""

    name: Annotated[Text, means("What --engine takes.")]
    promises: Annotated[str, means("What its plans are.")]
    licence: Annotated[str, means("The licence of the planner.")]
    installed: Annotated[bool, means("Whether it can be used here.")]
    package: Annotated[str, means("The package that brings it along.")]


def engines_json(engines: Iterable[Engine]) -> list[EngineJson]:
    """Return what `engines --format json` writes."""
    return [
        EngineJson(engine.name, engine.promises, engine.licence, engine.installed, engine.package)
        for engine in engines
    ]
