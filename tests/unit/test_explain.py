"""Explanations: what is missing is exactly the least, circles are circles, steps are there for a reason."""

from __future__ import annotations

from support.explanations import SCHEMA

# --- JSON -----------------------------------------------------------------------------------------


def test_the_schema_is_strict() -> None:
    open_ = [SCHEMA]
    while open_:
        part = open_.pop()
        open_ += [item for item in part.values() if isinstance(item, dict)]
        open_ += [
            item
            for items in part.values()
            if isinstance(items, list)
            for item in items
            if isinstance(item, dict)
        ]
        if part.get("type") == "object":
            assert part["additionalProperties"] is False
            assert set(part["required"]) == set(part["properties"])
            assert all(member["description"] for member in part["properties"].values())
