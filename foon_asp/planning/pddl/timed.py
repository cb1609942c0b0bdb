"""Schedules as plans of PDDL 2.1: a line for each step with its start and its duration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property

from foon_asp.errors import QueryError
from foon_asp.model.node import UnitId
from foon_asp.planning.pddl.styles import Document
from foon_asp.planning.pddl.task import Step
from foon_asp.planning.schedule import Schedule

EPSILON = Decimal("0.01")
"""What ends must be over for so long before anything begins that needs it: what VAL tells apart."""


@dataclass(frozen=True)
class TimedPlan:
    """A schedule in the names of a document that was made with its durations.

    `starts`: when each step begins, a little later than in the schedule: behind whatever had ended before.
    """

    schedule: Schedule
    document: Document

    @cached_property
    def actions(self) -> list[Step]:
        """Return the action of each step; raise `QueryError` if one of them has another duration there."""
        ways: dict[UnitId, list[Step]] = {}
        for step in self.document.task.steps:
            if step.unit is not None:
                ways.setdefault(step.unit, []).append(step)
            elif step.deletes:
                raise QueryError(
                    "the kitchen counts what is used up; in PDDL it is taken out by actions that take time, "
                    "which no schedule has: leave the quantities out"
                )
        found = []
        for each in self.schedule.steps:
            action = ways.get(each.unit, [])
            if len(action) != 1 or action[0].duration != each.end - each.start:
                unit = self.schedule.world.foon.units[each.unit]
                raise QueryError(
                    f"{unit.motion!r} takes {each.end - each.start}, but not in this export; export with the "
                    "durations of the schedule, for workers of rate 1"
                )
            found.append(action[0])
        return found

    @cached_property
    def starts(self) -> Sequence[Decimal]:
        """Return when each step begins."""
        steps = self.schedule.steps
        starts: list[Decimal] = []
        for step in steps:
            earlier = zip(steps, starts, strict=False)
            over = [begun + (each.end - each.start) for each, begun in earlier if each.end <= step.start]
            starts.append(max((moment + EPSILON for moment in over), default=Decimal(step.start)))
        return starts

    def text(self) -> str:
        """Return the lines of a plan file, `0.000: (action argument …) [5.000]`."""
        arguments = self.document.arguments
        lines = [
            f"{start:.3f}: ({' '.join((action.name, *arguments[action.name]))}) [{action.duration:.3f}]\n"
            for action, start in zip(self.actions, self.starts, strict=True)
        ]
        return "".join(lines)
