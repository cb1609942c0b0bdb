"""What schedules and resources are as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, field

from foon_asp.io.object_wire import ObjectJson, UnitJson, object_to_json
from foon_asp.io.wire import FEW, Amount, Count, JsonObject, LimitName, Place, Text, means, word
from foon_asp.planning.wire import Semantics

if TYPE_CHECKING:
    # The answers import this module, to write themselves.
    from foon_asp.planning.schedule import Schedule
    from foon_asp.planning.schedule_answer import ScheduleAnswer


Word = Annotated[str, Meta(pattern=r"\S")]
"""A label or a motion, as the name of a number."""


class UsedJson(JsonObject):
    """One of several stations or utensils."""

    name: Annotated[Text, means("The name of the station, or the label of the utensil.")]
    number: Annotated[Place, means("Which of them, from 1.")]


class ByJson(JsonObject):
    """Who does a step."""

    worker: Annotated[Text, means("The name of the worker.")]
    hands: Annotated[list[Place], means("With which hands, from 1.")]


class MadeJson(JsonObject):
    """Where a step has an object from that another step makes."""

    object: Annotated[ObjectJson, means("The object.")]
    step: Annotated[Place, means("The step that makes it.")]


class ScheduledStepJson(JsonObject):
    """A step of a schedule."""

    step: Annotated[Place, means("Its number, by the start.")]
    unit: Annotated[UnitJson, means("The functional unit.")]
    start: Annotated[Count, means("When it begins.")]
    end: Annotated[Count, means("When it ends.")]
    guessed: Annotated[
        bool, means("Whether its time is neither that of its video nor of a table of motions.")
    ]
    by: Annotated[ByJson | None, means("Who does it; null if it goes by itself.")]
    uses: Annotated[
        list[UsedJson],
        means(
            "The limited stations and utensils that it takes; a utensil that it fills is in use until "
            "what is in it was taken out."
        ),
    ]
    origins: Annotated[list[MadeJson], means("What it takes of other steps; all else is from the kitchen.")]


class ScheduleJson(JsonObject):
    """A schedule of a front."""

    makespan: Annotated[Count, means("When the last step ends.")]
    cost: Annotated[float | None, means("What it costs by `by`; null if that is infinite.")]
    steps: Annotated[list[ScheduledStepJson], means("The steps by their starts.")]


class ScheduleAnswerJson(JsonObject):
    """The shortest schedule for some goals."""

    goals: Annotated[list[ObjectJson], FEW, means("The object nodes that were asked for.")]
    semantics: Semantics
    by: Annotated[str | None, means("What counts after the makespan: a criterion or a weighted sum.")]
    status: Annotated[
        Literal["optimal", "unsolvable", "limit"],
        means(
            "optimal: proven that none is shorter, and of those as short none is cheaper. unsolvable: "
            "proven. limit: the best so far, if there is one."
        ),
    ]
    reason: Annotated[str, means("Why there is none, or why it is not proven; may be empty.")]
    unit: Annotated[
        Literal["s", "steps"],
        means("The unit of all times: seconds, or steps where no duration is known and each takes 1."),
    ]
    makespan: Annotated[Count | None, means("When the last step ends; null if there is no schedule.")]
    bound: Annotated[Count, means("No schedule is shorter: proven.")]
    proven: Annotated[bool, means("Whether the makespan is that bound.")]
    cost: Annotated[
        float | None,
        means("What it costs by `by`, a chance if that is success alone; null without one, or if infinite."),
    ]
    steps: Annotated[list[ScheduledStepJson], means("The steps by their starts.")]
    front: Annotated[
        list[ScheduleJson],
        means("Longer schedules, each cheaper than the one before; empty if not asked for."),
    ]
    seconds: Annotated[Amount, means("Wall time, without reading the files.")]
    limit: LimitName


def _steps(schedule: Schedule, guessed: frozenset[int]) -> list[ScheduledStepJson]:
    world = schedule.world
    foon = world.foon
    return [
        ScheduledStepJson(
            step=place,
            unit=UnitJson.of(foon, foon.units[step.unit]),
            start=step.start,
            end=step.end,
            guessed=step.unit in guessed,
            by=ByJson(step.worker, list(step.hands)) if step.hands else None,
            uses=[UsedJson(name, number) for name, number in (*step.stations, *step.vessels)],
            origins=[
                MadeJson(object_to_json(world.node(object_id)), maker + 1)
                for object_id, maker in step.origins
            ],
        )
        for place, step in enumerate(schedule.steps, 1)
    ]


def schedule_json(answer: ScheduleAnswer) -> ScheduleAnswerJson:
    """Return what `schedule --format json` writes."""
    guessed = frozenset[int](answer.durations.guessed)
    criterion = answer.asked.criterion
    return ScheduleAnswerJson(
        goals=[object_to_json(goal) for goal in answer.goals],
        semantics=word(answer.asked.semantics),
        by=None if criterion is None else str(criterion),
        status=word(answer.status),
        reason=answer.reason,
        unit=word(answer.durations.unit),
        makespan=answer.makespan,
        bound=answer.bound,
        proven=answer.proven,
        cost=answer.cost,
        steps=[] if answer.schedule is None else _steps(answer.schedule, guessed),
        front=[ScheduleJson(each.makespan, cost, _steps(each, guessed)) for each, cost in answer.front],
        seconds=round(answer.seconds, 6),
        limit=answer.limit,
    )


class WorkerJson(JsonObject, omit_defaults=True):
    """Somebody who works."""

    name: Annotated[Text, means("What it is called.")]
    hands: Annotated[Place, means("How many hands; each does one step at a time.")] = 1
    rate: Annotated[float, means("How much faster than the videos it works, above 0.")] = 1.0
    motions: Annotated[list[Text] | None, means("The motions that it can do; null for all.")] = None
    cannot: Annotated[list[Text], means("The motions that it cannot do.")] = field(default_factory=list)


class StationJson(JsonObject, omit_defaults=True):
    """A place that a step takes while it lasts."""

    name: Annotated[Text, means("What it is called, as burner or oven.")]
    count: Annotated[Place, means("How many there are.")] = 1
    motions: Annotated[list[Text], means("Steps with these motions take one.")] = field(default_factory=list)
    labels: Annotated[list[Text], means("Steps that list an object with one of these labels take one.")] = (
        field(default_factory=list)
    )


class ResourcesJson(JsonObject, omit_defaults=True):
    """Who works, and what there is of which there is not plenty."""

    workers: Annotated[
        list[WorkerJson] | None, means("Who works; one cook with two hands if nothing is said.")
    ] = None
    stations: Annotated[list[StationJson], means("Stations; there is plenty of all others.")] = field(
        default_factory=list
    )
    utensils: Annotated[
        dict[Word, Place], means("How many there are of utensils, by label; plenty of all others.")
    ] = field(default_factory=dict)
    hands: Annotated[
        dict[Word, Count],
        means(
            "How many hands a motion takes, 1 if nothing is said; with 0 it goes by itself, as baking does."
        ),
    ] = field(default_factory=dict)
