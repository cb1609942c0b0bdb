"""What a task tree must not do: constraints by name, and rules of the user's own."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from enum import Enum, auto
from numbers import Integral
from pathlib import Path
from typing import Any, TypedDict

from foon_asp.errors import QueryError
from foon_asp.io.kitchen import read_labels
from foon_asp.model.node import UnitId, check_label
from foon_asp.numbers import COUNT, LEAST_SUCCESS
from foon_asp.resources import diets as built_in_diets
from foon_asp.values import a_list, said
from foon_asp.words import closest, counted


class Form(Enum):
    """Which values a constraint takes."""

    LABELS = auto()
    """Labels or motions; each is a constraint by itself."""
    ONLY = auto()
    """Labels or motions, which are one constraint together; None is no constraint, unlike an empty list."""
    UNITS = auto()
    """Ids of units; each is a constraint by itself."""
    DIETS = auto()
    """Names and the labels of each."""
    COUNT = auto()
    """A whole number from 0, or None."""
    CHANCE = auto()
    """A number above 0 and at most 1, or None."""


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of constraint, and what it is called everywhere.

    `flag` is the option of the command line, `value` and `meaning` are its help. `atom` is the predicate in
    `encodings/constraints/`: `atom(Name, Value)`. `wording` makes the name of a constraint from its value.
    `name`, which is that of the field of `Constraints`, is also the key in Python and in JSON.
    """

    form: Form
    flag: str
    value: str
    meaning: str
    atom: str
    wording: Callable[[Any], str]
    name: str = ""

    def constraints(self, given: Any) -> Iterator[tuple[str, tuple[str | int | float, ...]]]:
        """Yield the name of each constraint that the values of a field make, and what it is about."""
        if given is None:
            return
        if self.form is Form.DIETS:
            yield from ((self.wording(name), labels) for name, labels in given)
        elif self.form in (Form.LABELS, Form.UNITS):
            yield from ((self.wording(value), (value,)) for value in given)
        else:
            yield self.wording(given), given if self.form is Form.ONLY else (given,)

    def tidied(self, given: Any) -> Any:
        """Return what people give as `Constraints` holds it; raise `QueryError`."""
        if given is None:
            return None
        if self.form in (Form.LABELS, Form.ONLY):
            return _labels(given, self.name)
        if self.form is Form.DIETS:
            return _diets(given)
        if self.form is Form.COUNT:
            return COUNT.checked(given, self.name)
        if self.form is Form.CHANCE:
            return LEAST_SUCCESS.checked(given, self.name)
        if self.form is Form.UNITS:
            return tuple(dict.fromkeys(_unit(each, self.name) for each in a_list(given, self.name, "ids")))
        return given


def _row(kind: Kind) -> Any:
    """Return a field of `Constraints` that is a kind of constraint."""
    listed = kind.form in (Form.LABELS, Form.UNITS, Form.DIETS)
    return field(default=() if listed else None, metadata={"kind": kind})


class ConstraintKeys(TypedDict, total=False):
    """The constraints by the keys that they have in Python and in JSON: those of `KINDS`, and rules."""

    without: Iterable[str]
    without_tools: Iterable[str]
    avoid_motions: Iterable[str]
    only_motions: Iterable[str] | None
    use_units: Iterable[int]
    avoid_units: Iterable[int]
    max_units: int | None
    max_depth: int | None
    min_success: float | None
    human_steps: int | None
    diets: Iterable[str] | Mapping[str, Iterable[str]]
    rules: Iterable[str]


@dataclass(frozen=True, slots=True)
class Constraints:
    """Constraints on a task tree; each has a name, so that an explanation can speak of it.

    This is the table of the kinds: to add one is to add a row here, its key to `ConstraintKeys` and to
    `wire.ConstraintsJson`, and a rule to `encodings/constraints/constraints.lp`.

    `without`: labels that no unit touches, by label, contents or relatum. `diets`: name and forbidden labels,
    as `without` but under one name, and labels that the FOON does not know are fine. `without_tools`: labels
    that no unit handles, by label or relatum. `only_motions`: None allows all. `use_units`: ids that must be
    in the tree, `avoid_units`: those that must not. `max_depth`: rounds of parallel execution. `min_success`:
    a chance in (0, 1]. `human_steps`: how many steps a human, who never fails, may take over from the robot;
    None: there is no human. `rules`: texts of answer-set programs over the vocabulary, checked by
    `asp.rules.read_rules`.
    """

    without: tuple[str, ...] = _row(
        Kind(
            Form.LABELS,
            flag="--without",
            value="LABEL",
            meaning="no unit touches it, by label, contents or place",
            atom="without",
            wording="without {}".format,
        )
    )
    diets: tuple[tuple[str, tuple[str, ...]], ...] = _row(
        Kind(
            Form.DIETS,
            flag="--diet",
            value="NAME",
            meaning="a diet that comes with the program, or a file of forbidden labels",
            atom="without",
            wording="diet {}".format,
        )
    )
    without_tools: tuple[str, ...] = _row(
        Kind(
            Form.LABELS,
            flag="--without-tool",
            value="LABEL",
            meaning="no unit handles it",
            atom="without_tool",
            wording="without tool {}".format,
        )
    )
    avoid_motions: tuple[str, ...] = _row(
        Kind(
            Form.LABELS,
            flag="--avoid-motion",
            value="MOTION",
            meaning="no unit has this motion",
            atom="avoid_motion",
            wording="avoid motion {}".format,
        )
    )
    only_motions: tuple[str, ...] | None = _row(
        Kind(
            Form.ONLY,
            flag="--only-motions",
            value="FILE",
            meaning="motions that are allowed, one a line",
            atom="only_motion",
            wording=lambda _: "only these motions",
        )
    )
    use_units: tuple[UnitId, ...] = _row(
        Kind(
            Form.UNITS,
            flag="--use-unit",
            value="ID",
            meaning="this unit is in the tree",
            atom="use_unit",
            wording="use unit {}".format,
        )
    )
    avoid_units: tuple[UnitId, ...] = _row(
        Kind(
            Form.UNITS,
            flag="--avoid-unit",
            value="ID",
            meaning="this unit is not in the tree",
            atom="avoid_unit",
            wording="avoid unit {}".format,
        )
    )
    max_units: int | None = _row(
        Kind(
            Form.COUNT,
            flag="--max-units",
            value="N",
            meaning="at most N units",
            atom="max_units",
            wording=lambda count: f"at most {counted(count, 'unit')}",
        )
    )
    max_depth: int | None = _row(
        Kind(
            Form.COUNT,
            flag="--max-depth",
            value="N",
            meaning="at most N rounds of parallel execution, for all units",
            atom="max_depth",
            wording=lambda count: f"at most {counted(count, 'round')}",
        )
    )
    min_success: float | None = _row(
        Kind(
            Form.CHANCE,
            flag="--min-success",
            value="P",
            meaning="the tree succeeds with this chance",
            atom="max_failure",
            wording="success at least {:.15g}".format,
        )
    )
    human_steps: int | None = _row(
        Kind(
            Form.COUNT,
            flag="--human-steps",
            value="N",
            meaning="a human, who never fails, does at most N steps",
            atom="human_steps",
            wording=lambda count: f"at most {counted(count, 'human step')}",
        )
    )
    rules: tuple[str, ...] = ()

    @classmethod
    def of(cls, keys: ConstraintKeys) -> Constraints:
        """Make constraints as people give them: labels in any case, each once, diets by their names.

        Raises `QueryError` for an unknown diet.
        """
        given: dict[str, Any] = {**keys}
        tidied = {kind.name: kind.tidied(given[kind.name]) for kind in KINDS if kind.name in given}
        rules = a_list(keys.get("rules", ()), "rules", "texts")
        for text in rules:
            if not isinstance(text, str):
                raise QueryError(f"rules are texts, not {said(text)}")
        return cls(**tidied, rules=tuple(rules))

    def named(self) -> Iterator[tuple[str, str, tuple[str | int | float, ...]]]:
        """Yield the atom of each constraint, as `encodings/constraints/` has it, its name and values."""
        for kind in KINDS:
            for name, values in kind.constraints(getattr(self, kind.name)):
                yield kind.atom, name, values

    @property
    def names(self) -> list[str]:
        """The names of all constraints, as explanations have them; rules of the user's own are one."""
        return [*(name for _, name, _ in self.named()), *(["rules"] if self.rules else [])]


KINDS: tuple[Kind, ...] = tuple(
    replace(each.metadata["kind"], name=each.name) for each in fields(Constraints) if each.metadata
)
"""All kinds of constraints, in the order of their names in an answer."""

FREE = Constraints()
"""No constraint at all."""


def _labels(labels: Iterable[str], name: str) -> tuple[str, ...]:
    listed = a_list(labels, name, "labels")
    for label in listed:
        check_label(label)
    return tuple(dict.fromkeys(label.strip().lower() for label in listed))


def _unit(value: object, name: str) -> UnitId:
    """Return the id of a unit as Python's own number; whether there is such a unit takes the data."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise QueryError(f"an id of {said(name)} is a whole number, not {said(value)}")
    return UnitId(int(value))


def _diets(diets: Iterable[str] | Mapping[str, Iterable[str]]) -> tuple[tuple[str, tuple[str, ...]], ...]:
    if isinstance(diets, Mapping):
        return tuple((str(name), _labels(labels, f"diets[{said(name)}]")) for name, labels in diets.items())
    listed = a_list(diets, "diets", "names")
    for name in listed:
        check_label(name, "the name of a diet")
    return tuple(read_diet(name) for name in dict.fromkeys(listed))


def read_diet(name: str, path: Path | None = None) -> tuple[str, tuple[str, ...]]:
    """Return a diet, name and forbidden labels: one that comes with the program, or that a file lists.

    Raises `QueryError` for an unknown name, `InputError` for a file that cannot be read.
    """
    known = built_in_diets()
    if path is None:
        if name not in known:
            raise QueryError(f"no diet {said(name)}{closest(name, known, 1)}; there are {', '.join(known)}")
        path = known[name]
    return name, tuple(sorted(read_labels(path)))
