"""What every method returns."""

from __future__ import annotations

from typing import NamedTuple

from foon_asp.limits import Limit
from foon_asp.query.objective import Payments
from foon_asp.query.status import Status
from foon_asp.retrieval.tree import TaskTree


class Found(NamedTuple):
    """Status, tree, bounds, payments and limit, as in `Answer`."""

    status: Status
    tree: TaskTree | None = None
    bound: dict[str, float] = {}  # noqa: RUF012 - never changed
    own: Payments = {}  # noqa: RUF012 - never changed
    limit: Limit | None = None


NOTHING = Found(Status.UNREACHABLE)
"""There is no task tree."""
