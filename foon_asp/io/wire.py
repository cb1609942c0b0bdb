"""How JSON is declared and written: what the `wire` modules of all floors share.

Each shape is declared once, as a `JsonObject` whose members say their types, their ranges and what they mean.
From these declarations the values are made and `docs/schema/` is generated.
"""

from __future__ import annotations

import json
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta

from foon_asp.limits import Limit

Count = Annotated[int, Meta(ge=0)]
"""A whole number from 0."""

Place = Annotated[int, Meta(ge=1)]
"""A whole number from 1."""

Amount = Annotated[float, Meta(ge=0)]
"""A number from 0."""

Chance = Annotated[float, Meta(ge=0, le=1)]
"""A number from 0 to 1."""

Text = Annotated[str, Meta(min_length=1)]
"""A text that is not empty."""

FEW = Meta(min_length=1)
"""A list that is not empty."""

UNIQUE = Meta(extra_json_schema={"uniqueItems": True})
"""A list in which nothing comes twice."""


class JsonObject(msgspec.Struct, forbid_unknown_fields=True):
    """A JSON object with these members and no others. Those that are `UNSET` are not written."""


class HalfCharacterError(msgspec.ValidationError):
    """Half of a surrogate pair stands where something else than a text is wanted."""


V = TypeVar("V")


def converted(value: object, shape: type[V]) -> V:
    """Return a JSON value as what is declared; raise `msgspec.ValidationError` and nothing else."""
    try:
        return msgspec.convert(value, shape)
    except UnicodeEncodeError as error:
        half = f"U+{ord(error.object[error.start]):04X}"
        raise HalfCharacterError(f"half a character ({half}) where no text is wanted") from None


def means(description: str) -> Meta:
    """Say what a member means, for its schema."""
    return Meta(description=description)


LimitName = Annotated[
    Limit | None,
    means("Which limit ended the work: time, memory, or interrupt, the user's Ctrl-C; null if none did."),
]
"""Which limit ended the work."""


def word(value: object) -> Any:
    """Return a text, or what is written as one, for a member that is one of a few words."""
    return str(value)


def dumps(value: object) -> str:
    """Write a declared value, or any JSON value, with stable formatting."""
    return json.dumps(msgspec.to_builtins(value), indent=2, ensure_ascii=False) + "\n"
