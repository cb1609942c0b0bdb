"""What may be replaced where something is missing, and by whose word."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from foon_asp.errors import InputError, QueryError
from foon_asp.io.files import read_string, rows
from foon_asp.io.similar import ingredient_vectors
from foon_asp.model.node import check_label
from foon_asp.model.similarity import Likeness, Similar, Similarity, Table, Words
from foon_asp.model.world import World
from foon_asp.numbers import LIKENESS, SHARE
from foon_asp.values import a_list, said

SOURCES = ("foon", "vectors")
"""What tells which labels are alike, beside a table: the FOON itself, and vectors of ingredients."""

BY_TABLE = "as the table says"
"""Why one label stands for another where a table has no note."""


@dataclass(frozen=True, slots=True)
class Replacement:
    """A label, and what replaces it or may; None if it is left out. `why` says who says so.

    `likeness` is above 0 and at most 1, and how well the one stands for the other. What is left out may have
    a likeness of 0.
    """

    label: str
    by: str | None
    likeness: float
    why: str = BY_TABLE

    def __post_init__(self) -> None:
        """Raise `QueryError` for what no replacement can be; labels are in lower case."""
        for name in ("label", "by", "why"):
            value = getattr(self, name)
            if name == "by" and value is None:
                continue
            check_label(value, f"{name!r} of a replacement")
            if name != "why":
                object.__setattr__(self, name, value.strip().lower())
        kind = SHARE if self.by is None else LIKENESS
        object.__setattr__(self, "likeness", kind.checked(self.likeness, "likeness"))
        if self.label == self.by:
            raise QueryError(f"{said(self.label)} is replaced by itself")

    @property
    def cost(self) -> int:
        """What it costs, as `encodings/criteria/likeness.lp` has it: thousandths short of 1, at least 1."""
        return max(1, round(1000 * (1 - self.likeness)))

    def __str__(self) -> str:
        what = f"{self.label} is left out" if self.by is None else f"{self.by} instead of {self.label}"
        return f"{what} ({self.likeness:.3g}: {self.why})"


Given = str | Replacement
"""A source by its name, or a replacement that may be made."""


@dataclass(frozen=True, slots=True)
class Substitution:
    """Which replacements may be made: those of a table, and those that some sources say.

    A table is trusted most, then vectors, then the FOON: the first that knows a pair of labels judges it.
    """

    sources: frozenset[str] = frozenset()
    table: tuple[Replacement, ...] = ()

    @classmethod
    def of(cls, given: bool | str | Iterable[Given] | Substitution | None) -> Substitution | None:
        """Read what people give: sources and replacements, or one source; True is the FOON itself.

        Nothing at all, or False, is no substitution. Raises `QueryError`.
        """
        if given is None or given is False or isinstance(given, Substitution):
            return given or None
        names = ["foon"] if given is True else [given] if isinstance(given, str) else given
        listed = a_list(names, "substitute", "sources and replacements")
        table = tuple(each for each in listed if isinstance(each, Replacement))
        sources = [each for each in listed if not isinstance(each, Replacement)]
        for source in sources:
            if source not in SOURCES:
                raise QueryError(f"'substitute' goes by {' or '.join(SOURCES)}, not by {said(source)}")
        pairs = [(row.label, row.by) for row in table]
        for label, by in pairs:
            if pairs.count((label, by)) > 1:
                raise QueryError(f"two likenesses of {said(label)} and {said(by)}; keep one")
        return cls(frozenset(sources), table)

    def similar(self, world: World) -> Similar:
        """Return the measure of labels in a world, the most trusted first."""
        return Similar([*self._measures(), *([world.uses] if "foon" in self.sources else [])])

    def _measures(self) -> list[Similarity]:
        """Return the measures that are the same in all worlds."""
        pairs = {(row.label, row.by): Likeness(row.likeness, row.why) for row in self.table if row.by}
        return [Table(pairs), *([Words(ingredient_vectors())] if "vectors" in self.sources else [])]

    def alike(self) -> Callable[[str, str], float]:
        """Return how alike two labels are, whichever stands for the other; 0 if nothing is known of them.

        That takes no FOON. Raises `QueryError` if a FOON is to say it, or if something is left out.
        """
        if "foon" in self.sources:
            raise QueryError("labels are the same by a table or by vectors, not by foon: name one of these")
        if left_out := [row.label for row in self.table if row.by is None]:
            raise QueryError(f"{said(left_out[0])} is the same as nothing; name two labels a line")
        similar = Similar(self._measures())

        def likeness(one: str, other: str) -> float:
            found = (similar.likeness(one, other), similar.likeness(other, one))
            return max((each.value for each in found if each is not None), default=0.0)

        return likeness

    def check(self, world: World) -> None:
        """Raise `QueryError` for a table that replaces utensils, or makes some of them."""
        for row in self.table:
            for label in (row.label, row.by):
                if label in world.kitchen.utensils:
                    raise QueryError(f"{said(label)} is a utensil; only food is replaced")


def read_substitutes(path: Path) -> list[Replacement]:
    """Read lines of `label<tab>replaced by<tab>likeness<tab>note`; the note may be left out.

    What replaces a label may be `-`: then it may be left out. Each pair stands once.
    """
    found: dict[tuple[str, str | None], Replacement] = {}
    for line, text in rows(read_string(path)):
        fields = [field.strip() for field in text.split("\t")]
        try:
            label, by, likeness, note = fields if len(fields) > 3 else [*fields, ""]
            value = LIKENESS.read(likeness)
            row = Replacement(label, None if by == "-" else by, value, note or BY_TABLE)
        except (ValueError, QueryError):
            advice = "write label<tab>replaced by<tab>likeness<tab>note, the likeness above 0 and at most 1"
            raise InputError(path, line, f"cannot read {said(text)}", advice) from None
        if found.setdefault((row.label, row.by), row) is not row:
            raise InputError(path, line, f"{said(label)} by {said(by)} stands twice", "keep one of the lines")
    return list(found.values())
