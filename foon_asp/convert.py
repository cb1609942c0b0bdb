"""The formats that a FOON can be written in, told by name or by the suffix of the file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from foon_asp.errors import QueryError
from foon_asp.foon_json import write_api, write_units
from foon_asp.graph import Annotation, Foon, FunctionalUnit
from foon_asp.text import write_text


@dataclass(frozen=True, slots=True)
class Format:
    """A format by name, the usual suffix of its files, how to write it, and what it cannot say."""

    name: str
    suffix: str
    write: Callable[[Foon], str]
    loses: Callable[[FunctionalUnit], bool]


def _noted(unit: FunctionalUnit) -> bool:
    """Tell whether an annotator noted more of a unit than labels, and where it stands."""
    note = unit.annotation
    return note != Annotation(sources=note.sources, composite=note.composite)


def _marked(unit: FunctionalUnit) -> bool:
    """Tell whether an object of a unit is marked as the intended goal."""
    return any(mark.goal for mark in unit.annotation.marks)


FORMATS = {
    form.name: form
    for form in (
        Format("text", ".txt", lambda foon: write_text(foon, foon.units), _noted),
        Format("annotated", ".txt", lambda foon: write_text(foon, foon.units, dialect="A"), lambda _: False),
        Format("json", ".json", lambda foon: write_units(foon, foon.units), _noted),
        Format("api-json", ".json", lambda foon: write_api(foon, foon.units), _marked),
    )
}
"""text: labels only (dialect B); annotated: dialect A; json: a list of units (J1); api-json: J2."""


def choose_format(foon: Foon, path: Path, name: str | None) -> Format:
    """Return the format of that name, or the fuller one of those that the suffix of the path may mean.

    Raises `QueryError` if neither says anything.
    """
    if name is not None:
        return FORMATS[name]
    noted = any(_noted(unit) for unit in foon.units)
    if path.suffix == ".txt":
        return FORMATS["annotated" if noted else "text"]
    if path.suffix == ".json":
        return FORMATS["api-json" if noted else "json"]
    raise QueryError(f"{path}: the suffix does not tell the format; name it with --to {'|'.join(FORMATS)}")
