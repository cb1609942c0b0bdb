"""The formats that a FOON can be written in, told by name or by the suffix of the file."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from foon_asp.errors import QueryError
from foon_asp.io.json import write_api, write_units
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon
from foon_asp.model.node import Annotation, FunctionalUnit


@dataclass(frozen=True, slots=True)
class Format:
    """A format by name, the usual suffix of its files, and which units say what it cannot say."""

    name: str
    suffix: str
    loses: Callable[[FunctionalUnit], bool]

    def write(
        self, foon: Foon, units: Iterable[FunctionalUnit] | None = None, comments: Iterable[str] = ()
    ) -> str:
        """Write a FOON, or some of its units in an order of their own; JSON has no comments."""
        chosen = foon.units if units is None else units
        if self.name == "json":
            return write_units(foon, chosen)
        if self.name == "api-json":
            return write_api(foon, chosen)
        return write_text(foon, chosen, comments, "A" if self.name == "annotated" else "B")


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
        Format("text", ".txt", _noted),
        Format("annotated", ".txt", lambda _: False),
        Format("json", ".json", _noted),
        Format("api-json", ".json", _marked),
    )
}
"""text: labels only (dialect B); annotated: dialect A; json: a list of units (J1); api-json: J2."""


def check_suffix(path: Path, name: str) -> None:
    """Raise `QueryError` if a file would have the suffix of other formats than the one that is named."""
    suffix = path.suffix.lower()
    meant = [form.name for form in FORMATS.values() if form.suffix == suffix]
    if meant and name not in meant:
        raise QueryError(f"{path}: the suffix says {' or '.join(meant)}, and --to {name}; change one of them")


def choose_format(foon: Foon, path: Path, name: str | None) -> Format:
    """Return the format of that name, or the fuller one of those that the suffix of the path may mean.

    Raises `QueryError` if neither says anything.
    """
    if name is not None:
        return FORMATS[name]
    noted = any(_noted(unit) for unit in foon.units)
    suffix = path.suffix.lower()
    if suffix == ".txt":
        return FORMATS["annotated" if noted else "text"]
    if suffix == ".json":
        return FORMATS["api-json" if noted else "json"]
    raise QueryError(f"{path}: the suffix does not tell the format; name it with --to {'|'.join(FORMATS)}")
