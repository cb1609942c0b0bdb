"""Criteria of the user's own are refused where nothing is optimised by them."""

from __future__ import annotations

from foon_asp.query.constraints import Constraints


def refuse_criteria(constraints: Constraints, why: str) -> None:
    """Raise `InputError` for rules that say anything of a criterion, with why it would be void."""
    if constraints.rules:
        # Most questions have no rules, and what looks at them takes a while to load.
        from foon_asp.asp.aims import refuse_aims

        refuse_aims(constraints.rules, why)
