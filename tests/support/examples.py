"""How many examples a property is tried on: few and the same in each run, or many by `make properties`."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

_ASKED = os.environ.get("FOON_ASP_EXAMPLES")
"""How many times as many examples as a test names; None: a third of them, the same ones in each run."""


_FEW = 20
"""No property is tried on a part of so few examples."""


def many(examples: int) -> settings:
    """Try a property on so many examples, if nothing else is asked for a third of them."""
    return settings(max_examples=_number(examples))


def profile() -> settings:
    """Return the settings of all properties: however slow the machine is, they are tried."""
    return settings(
        deadline=None,
        derandomize=_ASKED is None,
        max_examples=_number(100),
        print_blob=True,
        suppress_health_check=[HealthCheck.too_slow],
    )


def _number(examples: int) -> int:
    if _ASKED is not None:
        return max(1, round(examples * float(_ASKED)))
    return max(min(examples, _FEW), examples // 3)
