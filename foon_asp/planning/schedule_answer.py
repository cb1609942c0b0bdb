"""What is answered to a question about schedules: one, or why there is none, and how far it is proven."""

from __future__ import annotations

from dataclasses import dataclass

from foon_asp.io.wire import dumps
from foon_asp.limits import Limit
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectNode
from foon_asp.planning.durations import Durations
from foon_asp.planning.schedule import Schedule
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.query.status import Status


@dataclass(frozen=True, slots=True, repr=False)
class ScheduleAnswer:
    """The answer to a question about schedules; it is true if it has a schedule, which was judged.

    `status` is `OPTIMAL` (proven: no schedule is shorter, and of those that are as short none is cheaper),
    `UNSOLVABLE` (proven), or `LIMIT`: the schedule is the best so far, if there is one. `bound`: no schedule
    is shorter than that, proven. `cost` is what the schedule costs by the criterion, a chance if that is
    success alone, None without one and if it is infinite. `front`: schedules that are longer, each cheaper
    than the one before, if that was asked for. `seconds` is wall time.
    """

    asked: ScheduleQuery
    effects: Effects
    durations: Durations
    status: Status
    schedule: Schedule | None
    bound: int
    cost: float | None
    reason: str
    seconds: float
    limit: Limit | None = None
    front: tuple[tuple[Schedule, float | None], ...] = ()

    def __bool__(self) -> bool:
        return self.schedule is not None

    def __repr__(self) -> str:
        made = "none" if self.schedule is None else f"{self.schedule.makespan} {self.durations.unit}"
        return f"<Schedule: {made}, {self.status}>"

    def __str__(self) -> str:
        from foon_asp.render.schedule import schedule_text

        return schedule_text(self).rstrip()

    def to_json(self) -> str:
        """Return the answer as the command writes it with `--format json`."""
        from foon_asp.planning.schedule_wire import schedule_json

        return dumps(schedule_json(self))

    @property
    def goals(self) -> tuple[ObjectNode, ...]:
        """The goals, as object nodes."""
        return self.asked.query.nodes

    @property
    def makespan(self) -> int | None:
        """When the last step ends."""
        return None if self.schedule is None else self.schedule.makespan

    @property
    def proven(self) -> bool:
        """Whether no schedule is shorter."""
        return self.schedule is not None and self.bound >= self.schedule.makespan
