"""The schemas are strict, complete and alike."""

from __future__ import annotations

from typing import Any

import pytest
from jsonschema import Draft202012Validator

from foon_asp.cli.schemas import DECLARED
from foon_asp.cli.schemas import schema as declared
from foon_asp.io.wire import dumps
from foon_asp.query.objective import CRITERIA, Criterion
from support.paths import SCHEMAS
from support.schemas import ALL, schema


def object_schemas(value: object) -> list[dict[str, Any]]:
    """Return all parts of a schema that describe the members of an object."""
    if isinstance(value, list):
        return [found for item in value for found in object_schemas(item)]
    if not isinstance(value, dict):
        return []
    own = [value] if value.get("type") == "object" else []
    return own + [found for item in value.values() for found in object_schemas(item)]


@pytest.mark.parametrize("name", ALL)
def test_schemas_are_strict_and_say_what_each_member_means(name: str) -> None:
    value = schema(name)
    Draft202012Validator.check_schema(value)
    for part in object_schemas(value):
        if "propertyNames" in part:
            # Values by name: any of the names may be there, and no other.
            assert part["propertyNames"].keys() & {"enum", "pattern"}
            assert part["additionalProperties"]["type"] in ("integer", "number")
        else:
            assert part["additionalProperties"] is False
        properties = part.get("properties", {})
        assert set(part.get("required", ())) <= properties.keys()
        assert all(member.get("description") for member in properties.values())


def test_schemas_are_those_of_what_is_declared() -> None:
    assert list(DECLARED) == ALL
    for name in ALL:
        text = (SCHEMAS / f"{name}.schema.json").read_text(encoding="utf-8")
        assert text == dumps(declared(name)), "run make schemas"
    value = schema("goals")["$defs"]["object"]
    assert set(value["required"]) == set(value["properties"])


def test_schemas_know_all_criteria() -> None:
    for name in ("retrieve", "menu"):
        assert tuple(schema(name)["$defs"]["costs"]["properties"]) == CRITERIA
    level = Draft202012Validator(schema("menu")["properties"]["by"]["items"])
    for text in (*CRITERIA, "2*units+inputs", "0.5*success+depth"):
        assert str(Criterion.parse(text)) == text
        assert level.is_valid(text)
    for text in ("", "unit", "units,inputs", "2*", "units+", "-1*units", "units*2", "2 units"):
        assert not level.is_valid(text)
