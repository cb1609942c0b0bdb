"""How it is said what is proven of an answer."""

from __future__ import annotations

from foon_asp.limits import Limit
from foon_asp.query.status import Status


def proof_text(status: Status, limit: Limit | None) -> str:
    """Return `proven optimal`, `time limit, not proven`, or nothing."""
    if status is Status.LIMIT:
        return f"{limit_text(limit)}, not proven"
    return "proven optimal" if status is Status.OPTIMAL else ""


def limit_text(limit: Limit | None) -> str:
    """Return what a limit is called; one that is not known is of time."""
    return "interruption" if limit is Limit.INTERRUPT else f"{limit or Limit.TIME} limit"
