"""What is answered to a question about plans: a plan, or why there is none, and how far it is proven."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from foon_asp.errors import QueryError
from foon_asp.limits import Limit
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectNode
from foon_asp.planning.plan import Plan
from foon_asp.planning.query import PlanQuery
from foon_asp.query.status import Status

if TYPE_CHECKING:
    from foon_asp.draw.formats import Drawing


@dataclass(frozen=True, slots=True, repr=False)
class PlanAnswer:
    """The answer to a question about plans; it is true if it has a plan, which was replayed.

    `asked` is the question, its goals as object nodes, `effects` what each unit does under its semantics.
    `status` is `OPTIMAL` (proven by the engine: the cheapest plan, or for clingo the cheapest of those with
    the fewest parallel steps), `SOLVED`, `UNSOLVABLE` (proven), `LIMIT` (the time or the steps ran out; the
    plan is the best so far, if there is one), `GAVE_UP` or `FAILED`; `reason` says why. `cost` is what the
    plan costs by the criterion, a chance if that is success alone, None if it is infinite. `seconds` is wall
    time.

    `span` is when the last step ends, in a plan of an engine that plans in time.

    clingo alone proves `steps` and `bound`: no plan takes fewer parallel steps, and a plan that there is
    takes no more; no plan of so many steps is cheaper, or likelier to succeed.
    """

    asked: PlanQuery
    effects: Effects
    status: Status
    plan: Plan | None
    cost: float | None
    reason: str
    seconds: float
    steps: int | None = None
    bound: float | None = None
    limit: Limit | None = None
    span: float | None = None

    def __bool__(self) -> bool:
        return self.plan is not None

    def __str__(self) -> str:
        from foon_asp.render.plan import answer_text

        return answer_text(self).rstrip()

    def __repr__(self) -> str:
        goals = "; ".join(map(str, self.goals))
        return f"<PlanAnswer: {goals}, {self.status}{f': {self.reason}' if self.reason else ''}>"

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return the plan as a picture; raise `QueryError` if there is none."""
        if self.plan is None:
            raise QueryError(f"no plan: {self.reason or self.status}")
        return self.plan.draw(dark=dark)

    def _repr_html_(self) -> str:
        from foon_asp.render.notebook import plan_answer_html

        return plan_answer_html(self)

    @property
    def goals(self) -> tuple[ObjectNode, ...]:
        """The goals, as object nodes."""
        return self.asked.query.nodes

    @property
    def engine(self) -> str:
        """Who planned."""
        return self.asked.engine

    @property
    def semantics(self) -> str:
        """What was used up."""
        return self.asked.semantics

    @property
    def by(self) -> str:
        """The criterion that the plan was to be cheap by."""
        return str(self.asked.criterion)
