"""Planning engines as a list."""

from __future__ import annotations

from collections.abc import Sequence

from foon_asp.planning.engines import Engine
from foon_asp.render.table import table


def engines_text(engines: Sequence[Engine]) -> str:
    """Write which engines there are, what they promise, and how to install the others."""
    lines = table([(engine.name, engine.promises, _state(engine)) for engine in engines], "<")
    lines.append("Any other engine that unified_planning finds can be named, too.")
    return "\n".join(lines) + "\n"


def _state(engine: Engine) -> str:
    return f"[{engine.licence}; {'installed' if engine.installed else engine.install}]"
