"""Query lines: what is read, what it means, and how each refusal names its place."""

from __future__ import annotations

import json
import math
from dataclasses import fields
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.errors import QueryError
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.query.wire import ConstraintsJson, QueryJson, parse_line, query_id, read_query_line

# --- What is read, as the hand-written reader reads it --------------------------------------------

TEXTS = st.text(max_size=4) | st.sampled_from([" Egg", "egg", "whisk", "units", "vegan", "units,success"])
NUMBERS = (
    st.integers(-2, 3)
    | st.sampled_from([2**31 - 1, 2**31, 10**400, 1e9, 1e10, 0.5, 1.0, -0.0])
    | st.floats(allow_nan=False, allow_infinity=False)
)
VALUES = st.recursive(
    st.none() | st.booleans() | NUMBERS | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS, inner, max_size=2),
    max_leaves=4,
)
RIGHT_NODES = st.fixed_dictionaries(
    {"label": st.sampled_from(["ice", " Egg"])},
    optional={
        "states": st.lists(st.sampled_from(["whole", "in [cup]"]) | TEXTS, max_size=2) | st.none(),
        "ingredients": st.lists(TEXTS, max_size=2),
        "container": st.none() | TEXTS,
        "colour": VALUES,
    },
)
NODES = RIGHT_NODES | st.fixed_dictionaries(
    {},
    optional={
        "label": VALUES,
        "object_label": TEXTS,
        "states": st.lists(TEXTS | st.fixed_dictionaries({"state_label": TEXTS}), max_size=2) | VALUES,
        "ingredients": VALUES,
        "container": VALUES,
    },
)
MANY = st.lists(TEXTS | RIGHT_NODES, max_size=2)
LABELS = st.lists(TEXTS, max_size=3)
COUNTS = st.integers(0, 3)
UNITS = st.lists(COUNTS, max_size=3)
RIGHT = {
    "id": TEXTS | NUMBERS,
    "goal": TEXTS | RIGHT_NODES | st.lists(TEXTS | RIGHT_NODES, min_size=1, max_size=2),
    "kitchen": MANY | st.none(),
    "add": MANY,
    "remove": MANY,
    "method": st.sampled_from(["optimal", "greedy", "ids", "best"]),
    "by": TEXTS | LABELS,
    "reference": st.booleans(),
    "time_limit": st.floats(0, 1e9) | COUNTS | st.none(),
}
RIGHT_CONSTRAINTS = {
    "without": LABELS,
    "without_tools": LABELS,
    "avoid_motions": LABELS,
    "only_motions": LABELS | st.none(),
    "use_units": UNITS,
    "avoid_units": UNITS,
    "max_units": COUNTS | st.none(),
    "max_depth": COUNTS | st.none(),
    "min_success": st.floats(0.01, 1) | st.just(1) | st.none(),
    "human_steps": COUNTS | st.none(),
    "diets": st.lists(st.sampled_from(["vegan", "vegetarian"]), max_size=2),
}
WRONG = VALUES | NUMBERS | NODES | st.lists(NODES | NUMBERS, max_size=2)
"""What a member is said to be now and then; some of it is right."""


@st.composite
def objects(draw: st.DrawFn, right: dict[str, st.SearchStrategy[Any]]) -> dict[str, Any]:
    """Draw an object whose members are mostly right, so that much of it is accepted."""
    value: dict[str, Any] = draw(st.fixed_dictionaries({}, optional=right))
    if draw(st.integers(0, 2)) == 0:
        value[draw(st.sampled_from([*right, "gaol"]))] = draw(WRONG)
    return value


@st.composite
def queries(draw: st.DrawFn) -> dict[str, Any]:
    value: dict[str, Any] = draw(objects(RIGHT))
    if draw(st.integers(0, 7)):
        value.setdefault("goal", "ice")
        if "add" in value or "remove" in value:
            value.pop("kitchen", None)
    if draw(st.booleans()):
        value["constraints"] = draw(objects(RIGHT_CONSTRAINTS))
    return value


def read(line: bytes) -> Query | None:
    """Return what a line asks, or None if it is refused; any other error is a fault."""
    try:
        return read_query_line(line)
    except QueryError:
        return None


@given(VALUES | st.binary(max_size=8) | queries())
def test_a_line_is_read_or_refused(value: object) -> None:
    query = read(value if isinstance(value, bytes) else json.dumps(value).encode())
    if query is not None:
        assert isinstance(value, dict)
        goals = value["goal"] if isinstance(value["goal"], list) else [value["goal"]]
        assert len(query.goals) == len(goals)
        assert query.method == value.get("method", "optimal")
        assert query.founded is not value.get("reference", False)
        assert query.time_limit == value.get("time_limit")
        assert (query.kitchen.objects is None) == (value.get("kitchen") is None)
        assert len(query.kitchen.add) == len(value.get("add", ()))


@given(objects(RIGHT_CONSTRAINTS))
def test_constraints_are_all_declared(value: dict[str, Any]) -> None:
    assert [*ConstraintsJson.__struct_fields__, "rules"] == [each.name for each in fields(Constraints)]
    query = read(json.dumps({"goal": "ice", "constraints": value}).encode())
    if query is not None:
        assert ConstraintsJson().read() == Constraints()
        held = {each.name for each in fields(Constraints)}
        assert {name for name in held if getattr(query.constraints, name) not in ((), None)} <= set(value)


@pytest.mark.parametrize(
    "text", ['{"goal": "ice", "id": 7}', '{"goal": ["ice", {"label": "egg"}], "by": "units"}']
)
def test_what_is_written_reads_the_same(text: str) -> None:
    declared = msgspec.convert(parse_line(text.encode()), QueryJson)
    written = msgspec.json.encode(declared)
    assert read_query_line(written) == read_query_line(text.encode())
    assert msgspec.convert(parse_line(written), QueryJson) == declared


# --- What is refused ------------------------------------------------------------------------------

REFUSED = [
    ("", "not JSON: Expecting value at column 1"),
    ("[1]", 'a query is an object like {"goal": "whipped cream"}, not a list'),
    ('{"goal": NaN}', "not JSON that can be read: NaN is no JSON number"),
    ('{"goal": ' + "[" * 100_000, "not JSON that can be read: nested too deeply"),
    ("{}", "the query has no 'goal'"),
    ('{"goal": []}', "the list of goals is empty"),
    ('{"goal": 5}', "'goal': expected an object, found a number"),
    ('{"goal": ["ice", {}]}', "'goal[1]': 'label' is missing or no text"),
    ('{"goal": "ice", "goal": "egg"}', "the key 'goal' comes twice"),
    ('{"goal": {"label": "a", "label": "b"}}', "the key 'label' comes twice"),
    ('{"gaol": "ice"}', "unknown key 'gaol'; closest: goal; there are id, goal, kitchen, add,"),
    ('{"goal": "ice", "constraints": {"max_unit": 1}}', "unknown constraint 'max_unit'; closest: max_units;"),
    ('{"goal": "ice", "constraints": []}', "'constraints' is an object, not a list"),
    ('{"goal": "ice", "constraints": {"max_units": -1}}', "'constraints.max_units' is at least 0, not -1"),
    (
        '{"goal": "ice", "constraints": {"max_units": "1"}}',
        "'constraints.max_units' is a whole number or null, not",
    ),
    (
        '{"goal": "ice", "constraints": {"use_units": [1, true]}}',
        "'constraints.use_units[1]' is a whole number, not",
    ),
    ('{"goal": "ice", "constraints": {"min_success": 0}}', "'constraints.min_success' is above 0, not 0"),
    (
        '{"goal": "ice", "constraints": {"min_success": 1.5}}',
        "'constraints.min_success' is at most 1, not 1.5",
    ),
    ('{"goal": "ice", "constraints": {"diets": ["vegn"]}}', "no diet 'vegn'; closest: vegan; there are"),
    ('{"goal": "ice", "kitchen": "ice"}', "'kitchen' is a list or null, not a text"),
    ('{"goal": "ice", "kitchen": [], "add": ["egg"]}', "'kitchen' names all objects; leave out 'add' and"),
    ('{"goal": "ice", "by": 5}', "'by' is a text or a list, not a number"),
    ('{"goal": "ice", "reference": 0}', "'reference' is true or false, not a number"),
    ('{"goal": "ice", "time_limit": -1}', "'time_limit' is at least 0, not -1"),
    ('{"goal": "ice", "time_limit": 1' + "0" * 400 + "}", "'time_limit' is a number that is too large"),
    ('{"goal": "ice", "id": 1e999}', "'id' is a number that is too large"),
    ('{"goal": "ice", "id": [1]}', "'id' is a number or a text or null, not a list"),
]


@pytest.mark.parametrize(("text", "message"), REFUSED)
def test_refusals_name_the_place(text: str, message: str) -> None:
    with pytest.raises(QueryError) as refused:
        read_query_line(text.encode())
    assert str(refused.value).startswith(message)


def test_bytes_that_are_no_text_are_refused() -> None:
    with pytest.raises(QueryError, match="byte 0xff is not UTF-8"):
        read_query_line(b'{"goal": "\xff"}')


def test_the_id_of_a_refused_query_is_known() -> None:
    assert query_id({"gaol": 1, "id": "x"}) == "x"
    assert query_id({"id": 10**400}) == 10**400
    assert query_id({}) is None
    wrong: object
    for wrong in (True, [], math.inf):
        with pytest.raises(QueryError, match="'id' is"):
            query_id({"id": wrong})


def test_what_is_left_out_is_as_on_the_command_line() -> None:
    assert read_query_line(b'{"goal": "ice"}') == Query("ice")


# --- Half characters, which JSON can say and no text has --------------------------------------------

_WHOLE: dict[str, Any] = {
    "id": "x",
    "goal": [{"label": "ice", "states": ["cold"], "ingredients": ["water"], "container": "cup"}, "egg"],
    "by": "units",
    "method": "optimal",
    "reference": False,
    "time_limit": 1.5,
    "remove": ["salt"],
    "constraints": {"max_units": 5, "avoid_motions": ["stir"], "use_units": [3], "without": ["milk"]},
}


def with_half(value: Any) -> list[Any]:
    """Return a value with half a character in place of each of its parts and keys, one at a time."""
    found: list[Any] = ["\ud800", ["\ud800"], {"\ud800": 1}]
    if isinstance(value, dict):
        for key, inner in value.items():
            found += [{**value, key: each} for each in with_half(inner)]
        found.append({**value, "\ud800": 1})
    if isinstance(value, list):
        for place, inner in enumerate(value):
            found += [[*value[:place], each, *value[place + 1 :]] for each in with_half(inner)]
    return found


def refusal(value: Any) -> str | None:
    """Return why a query is refused, None if it is not."""
    try:
        read_query_line(json.dumps(value).encode())
    except QueryError as error:
        return str(error)
    return None


def test_half_a_character_is_refused_or_part_of_a_text() -> None:
    assert refusal(_WHOLE) is None
    said = [refusal(value) for value in with_half(_WHOLE)]
    refused = [each for each in said if each is not None]
    assert len(said) > len(refused) > 50
    assert not any("\n" in each for each in refused)
