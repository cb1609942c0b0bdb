"""Queries as JSON: what a line of a query file may say, declared once, and how it is read.

A line is refused by one sentence that names the place, `'constraints.max_units' is at least 0, not -1`: our
words for what msgspec finds, and for what types cannot say.
"""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterable
from typing import Annotated, Any, NoReturn, cast

import msgspec
from msgspec import Meta, field, structs

from foon_asp.errors import QueryError
from foon_asp.io.files import kind_of
from foon_asp.io.objects import object_from_json, refuse_unknown_keys
from foon_asp.io.wire import HalfCharacterError, JsonObject, Text, converted, means
from foon_asp.numbers import COUNT, LEAST_SUCCESS, LIKENESS, MEGABYTES, SECONDS
from foon_asp.query.constraints import ConstraintKeys, Constraints
from foon_asp.query.goals import Named
from foon_asp.query.kitchen_change import KitchenChange
from foon_asp.query.method import Method
from foon_asp.query.query import Query
from foon_asp.query.substitution import BY_TABLE, SOURCES, Replacement
from foon_asp.values import said
from foon_asp.words import closest

_NAMED = [
    {"type": "string", "minLength": 1, "description": "A text, as on the command line."},
    {"$ref": "#/$defs/node"},
]
NamedJson = Annotated[Any, Meta(extra_json_schema={"oneOf": _NAMED})]
"""A `Named` as JSON: a text or a `NodeJson`. What is read is more, as in kitchen and goal files."""

Whole = Annotated[int, Meta(ge=COUNT.least, lt=COUNT.most + 1)]
Success = Annotated[float, Meta(gt=LEAST_SUCCESS.least, le=LEAST_SUCCESS.most)]
Seconds = Annotated[float, Meta(ge=SECONDS.least, le=SECONDS.most)]
Megabytes = Annotated[float, Meta(gt=MEGABYTES.least, le=MEGABYTES.most)]


_MOST_DIGITS = 4000
"""Python reads no whole number of more than 4300 digits."""


class NodeJson(JsonObject, kw_only=True):
    """An object node, written as kitchen and goal files write it."""

    label: Annotated[Text, means("What the object is.")]
    states: Annotated[tuple[str, ...], means("Its states.")] = ()
    ingredients: Annotated[tuple[str, ...], means("The contents of its state `contains`.")] = ()
    container: Annotated[str | None, means("The object that it is in.")] = None


class ConstraintsJson(JsonObject, omit_defaults=True):
    """Constraints by name, as docs/constraints.md explains them."""

    without: Annotated[tuple[str, ...], means("Labels that no unit touches.")] = ()
    diets: Annotated[tuple[str, ...], means("Names of diets that come with the program.")] = ()
    without_tools: Annotated[tuple[str, ...], means("Labels that no unit handles.")] = ()
    avoid_motions: Annotated[tuple[str, ...], means("Motions that no unit has.")] = ()
    only_motions: Annotated[
        tuple[str, ...] | None, means("The motions that units may have; null allows all.")
    ] = None
    use_units: Annotated[tuple[Whole, ...], means("Ids of units that are in the tree.")] = ()
    avoid_units: Annotated[tuple[Whole, ...], means("Ids of units that are not.")] = ()
    max_units: Annotated[Whole | None, means("At most so many units.")] = None
    max_depth: Annotated[Whole | None, means("At most so many rounds of parallel execution.")] = None
    min_success: Annotated[Success | None, means("The least chance that the tree succeeds.")] = None
    human_steps: Annotated[Whole | None, means("How many steps a human, who never fails, may do.")] = None

    def read(self) -> Constraints:
        """Return the constraints; raise `QueryError` for an unknown diet."""
        return Constraints.of(cast(ConstraintKeys, structs.asdict(self)))


class SubstituteJson(JsonObject, omit_defaults=True):
    """A label, and what may replace it, as a line of a table says it."""

    label: Annotated[Text, means("What the data call it.")]
    by: Annotated[Text | None, means("What may replace it; null if it may be left out.")]
    likeness: Annotated[
        float,
        Meta(gt=LIKENESS.least, le=LIKENESS.most),
        means("How well it does so; at 1 nobody would notice."),
    ]
    note: Annotated[Text, means("What is told with it.")] = BY_TABLE

    def read(self) -> Replacement:
        """Return the replacement; raise `QueryError` for one that cannot be made."""
        return Replacement(self.label, self.by, self.likeness, self.note)


Source = Annotated[str, Meta(extra_json_schema={"enum": [*SOURCES]})]
"""What tells which labels are alike."""


class QueryJson(JsonObject, kw_only=True, omit_defaults=True, dict=True):
    """One query. What is left out is as on the command line."""

    id: Annotated[
        str | int | float | None,
        means("Anything that tells the query from others; it comes back in the result."),
    ] = None
    goal: Annotated[
        Any,
        Meta(
            extra_json_schema={
                "oneOf": [*_NAMED, {"type": "array", "minItems": 1, "items": {"oneOf": _NAMED}}]
            }
        ),
        means("What to make; several goals are made by one tree."),
    ]
    kitchen: Annotated[
        tuple[NamedJson, ...] | None, means("What is at hand, instead of the kitchen of the data.")
    ] = None
    add: Annotated[tuple[NamedJson, ...], means("What is at hand beside the kitchen of the data.")] = ()
    remove: Annotated[
        tuple[NamedJson, ...],
        means(
            "What of that kitchen is not at hand; a text may name it as shortly as is clear within the "
            "kitchen."
        ),
    ] = ()
    method: Annotated[
        str,
        Meta(extra_json_schema={"enum": [method.value for method in Method]}),
        means("How units are chosen; optimal if left out."),
    ] = Method.OPTIMAL.value
    by: Annotated[
        str | tuple[str, ...],
        means("Criteria, the most important first, with commas or as a list; as --by."),
    ] = ()
    reference: Annotated[bool, means("True drops foundedness, as --reference does.")] = False
    time_limit: Annotated[
        Seconds | None, means("Seconds for this query; null or left out: what --time-limit says.")
    ] = None
    memory_limit: Annotated[
        Megabytes | None,
        means("Megabytes for a process that solves this query; null or left out: what --memory-limit says."),
    ] = None
    constraints: Annotated[ConstraintsJson, means("What the tree must and must not do.")] = field(
        default_factory=ConstraintsJson
    )
    substitute: Annotated[
        bool | Source | tuple[Source | SubstituteJson, ...],
        means(
            "What may be replaced where there is no tree otherwise: as a source says, or as a list of "
            "sources and replacements does. True is the source foon; false, nothing."
        ),
    ] = False

    def query(self) -> Query:
        """Return the question that is asked; raise `QueryError` for whatever is wrong with it."""
        goals = self.goal if isinstance(self.goal, list) else [self.goal]
        if not goals:
            raise QueryError("the list of goals is empty")
        named = _all_named("goal", goals) if isinstance(self.goal, list) else (_named("goal", self.goal),)
        return Query(
            *named,
            by=self.by,
            method=self.method,
            founded=not self.reference,
            constraints=self.constraints.read(),
            time_limit=self.time_limit,
            memory_limit=self.memory_limit,
            kitchen=KitchenChange.of(
                None if self.kitchen is None else _all_named("kitchen", self.kitchen),
                _all_named("add", self.add),
                _all_named("remove", self.remove),
            ),
            substitute=self._substitute(),
        )

    def _substitute(self) -> bool | str | list[str | Replacement]:
        if not isinstance(self.substitute, tuple):
            return self.substitute
        return [each.read() if isinstance(each, SubstituteJson) else each for each in self.substitute]


def _all_named(key: str, values: Iterable[object]) -> tuple[Named, ...]:
    return tuple(_named(f"{key}[{place}]", value) for place, value in enumerate(values))


def _named(path: str, value: object) -> Named:
    if isinstance(value, str):
        return value
    try:
        return object_from_json(value, refuse_unknown_keys)
    except ValueError as error:
        raise QueryError(f"{said(path)}: {error}") from None


def read_query_line(line: bytes) -> Query:
    """Read a query line; all that can be known to be wrong without the data raises `QueryError`."""
    return read_query(parse_line(line))


def parse_line(line: bytes) -> dict[str, Any]:
    """Return the JSON object of a query line; raise `QueryError`."""
    try:
        value = json.loads(
            line.decode("utf-8"),
            parse_int=_whole,
            parse_constant=_refuse_constant,
            object_pairs_hook=_refuse_twice,
        )
    except UnicodeDecodeError as error:
        raise QueryError(f"byte 0x{line[error.start]:02x} is not UTF-8; save the file as UTF-8") from None
    except json.JSONDecodeError as error:
        raise QueryError(f"not JSON: {error.msg} at column {error.colno}") from None
    except ValueError as error:
        raise QueryError(f"not JSON that can be read: {error}") from None
    except RecursionError:
        raise QueryError("not JSON that can be read: nested too deeply") from None
    if not isinstance(value, dict):
        raise QueryError(f'a query is an object like {{"goal": "whipped cream"}}, not {kind_of(value)}')
    return value


def _whole(text: str) -> int:
    if len(text) > _MOST_DIGITS:
        raise ValueError("a number has thousands of digits")
    return int(text)


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON number")


def _refuse_twice(members: list[tuple[str, Any]]) -> dict[str, Any]:
    value = dict(members)
    if len(value) < len(members):
        (twice, _), *_ = Counter(key for key, _ in members).most_common(1)
        raise QueryError(f"the key {said(twice)} comes twice")
    return value


def query_id(value: dict[str, Any]) -> str | int | float | None:
    """Return the id of a query, so that even a refusal can name it; raise `QueryError` if it is none."""
    given = value.get("id")
    if isinstance(given, float) and not math.isfinite(given):
        raise QueryError("'id' is a number that is too large")
    try:
        return msgspec.convert(given, str | int | float | None)
    except msgspec.ValidationError as error:
        raise _refusal(error, given, "id") from None


def read_query(value: dict[str, Any]) -> Query:
    """Read the JSON object of a query; raise `QueryError` as `read_query_line` does."""
    query_id(value)
    _check_keys(value, QueryJson, "key")
    if isinstance(value.get("constraints"), dict):
        _check_keys(value["constraints"], ConstraintsJson, "constraint")
    if isinstance(value.get("substitute"), list):
        for row in value["substitute"]:
            if isinstance(row, dict):
                _check_keys(row, SubstituteJson, "key of a replacement")
    try:
        asked = converted(value, QueryJson)
    except msgspec.ValidationError as error:
        raise _refusal(error, value) from None
    return asked.query()


def _check_keys(value: dict[str, Any], shape: type[JsonObject], word: str) -> None:
    known = shape.__struct_fields__
    for key in value:
        if key not in known:
            raise QueryError(
                f"unknown {word} {said(key)}{closest(key, known, 1)}; there are {', '.join(known)}"
            )


_TYPES = {
    "int": "a whole number",
    "float": "a number",
    "str": "a text",
    "bool": "true or false",
    "array": "a list",
    "object": "an object",
    "null": "null",
}
_BOUNDS = {">=": "at least", ">": "above", "<=": "at most", "<": "below"}
_WRONG_TYPE = re.compile(r"Expected `([^`]+)`, got")
_OUT_OF_BOUNDS = re.compile(r"Expected `\w+` ([<>]=?) (\S+)")
_LACKING = re.compile(r"Object missing required field `(\w+)`")
_WHERE = re.compile(r" - at `\$\.?(.*)`$")


def _refusal(error: msgspec.ValidationError, value: object, path: str = "") -> QueryError:
    """Say in our words what msgspec finds wrong with a part of a value."""
    message = str(error)
    if isinstance(error, HalfCharacterError):
        return QueryError(f"the query has {message}")
    if place := _WHERE.search(message):
        path = place[1]
        value = _part(value, path)
    elif not path:
        return QueryError("the query has no 'goal'")
    if match := _LACKING.match(message):
        return QueryError(f"{said(path)} has no {said(match[1])}")
    if match := _WRONG_TYPE.match(message):
        names = match[1].split(" | ")
        wanted = " or ".join(_TYPES[name] for name in names if name != "int" or "float" not in names)
        shown = said(value) if isinstance(value, float) else kind_of(value)
        return QueryError(f"{said(path)} is {wanted}, not {shown}")
    if match := _OUT_OF_BOUNDS.match(message):
        return QueryError(
            f"{said(path)} is {_BOUNDS[match[1]]} {float(match[2]):.10g}, not {str(value)[:40]}"
        )
    return QueryError(f"{said(path)} is a number that is too large")


def _part(value: Any, path: str) -> object:
    """Return what stands at a place like `constraints.use_units[1]`."""
    for key, place in re.findall(r"(\w+)|\[(\d+)\]", path):
        value = value[key] if key else value[int(place)]
    return value
