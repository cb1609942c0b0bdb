"""What a planner is asked: one question, with what a plan is asked beside it."""

from __future__ import annotations

from dataclasses import dataclass

from foon_asp.errors import QueryError
from foon_asp.model.consumption import SEMANTICS
from foon_asp.query.constraints import FREE
from foon_asp.query.method import Method
from foon_asp.query.objective import UNITS, Criterion
from foon_asp.query.query import Query
from foon_asp.values import said

MAX_STEPS = 100
"""How many parallel steps are tried if nothing else is said."""

OWN_ENGINE = "clingo"
"""The engine that is our own; all others are found by unified_planning."""


@dataclass(frozen=True, slots=True)
class PlanQuery:
    """A question about plans.

    `query`: goals, criterion, time limit (seconds) and kitchen. `engine`: who plans. `semantics`: what is
    used up. `max_steps`: how many parallel steps clingo tries, `MAX_STEPS` if nothing is said; others count
    none.
    Raises `QueryError` for what a plan cannot do, whatever the data are.
    """

    query: Query
    engine: str = OWN_ENGINE
    semantics: str = "consume"
    max_steps: int | None = None

    def __post_init__(self) -> None:
        if self.semantics not in SEMANTICS:
            raise QueryError(f"unknown semantics {said(self.semantics)}; there are {', '.join(SEMANTICS)}")
        if self.max_steps is not None and self.engine != OWN_ENGINE:
            raise QueryError("--max-steps is for the engine clingo; the others do not count parallel steps")
        if self.query.method != Method.OPTIMAL:
            raise QueryError(
                f"plans are not chosen by the method {said(self.query.method.value)}; name an engine"
            )
        if not self.query.founded:
            raise QueryError("a plan can be executed; the published reading of units is for task trees alone")
        if self.query.constraints != FREE:
            raise QueryError("a plan takes no constraints; retrieve a task tree, or plan without them")
        if len(self.query.by) > 1:
            raise QueryError(
                "a plan is minimised on one level, after its steps; weigh the criteria, as in a+b"
            )

    @property
    def criterion(self) -> Criterion:
        """What is cheap: the number of units if nothing is said."""
        [criterion] = self.query.by or UNITS
        return criterion
