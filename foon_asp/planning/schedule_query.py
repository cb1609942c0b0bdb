"""What a scheduler is asked: one question, with who and what there is, and how long things take."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from foon_asp.errors import QueryError
from foon_asp.model.node import check_label
from foon_asp.numbers import DURATION
from foon_asp.planning.query import PlanQuery
from foon_asp.planning.resources import Resources
from foon_asp.query.objective import Criterion
from foon_asp.query.query import Query


@dataclass(frozen=True, slots=True)
class ScheduleQuery:
    """A question about schedules.

    `query`: goals, time limit (seconds), kitchen, and a criterion that counts after the makespan, if one is
    named. `semantics`: what is used up. `durations`: how long motions take, in seconds, where no video says
    it. `front`: all trade-offs between the makespan and the criterion.
    Raises `QueryError` for what a schedule cannot do, whatever the data are.
    """

    query: Query
    resources: Resources = field(default_factory=Resources)
    semantics: str = "consume"
    durations: Mapping[str, float] = field(default_factory=dict)
    front: bool = False

    def __post_init__(self) -> None:
        # What holds for plans holds for schedules.
        PlanQuery(self.query, semantics=self.semantics)
        for motion, seconds in self.durations.items():
            check_label(motion, "a motion")
            DURATION.checked(seconds, f"durations[{motion!r}]")
        if self.front and not self.query.by:
            raise QueryError("a front is between the makespan and a criterion; name one, as in --by success")

    @property
    def criterion(self) -> Criterion | None:
        """What counts after the makespan."""
        return next(iter(self.query.by), None)
