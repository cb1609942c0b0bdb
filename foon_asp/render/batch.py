"""The rows of a batch: what is written for each query, as a JSON line or a row of a Parquet table."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import fields
from functools import cache
from typing import TYPE_CHECKING, Any

from foon_asp.criteria import Costs
from foon_asp.files import object_from_json
from foon_asp.render.json import retrieval_value
from foon_asp.retrieve import Retrieval
from foon_asp.state_syntax import object_to_json

if TYPE_CHECKING:
    import pyarrow as pa

_START = re.compile(rb'\{"line": (\d+), "status": "([a-z]+)", ')


def row_value(
    line: int, name: str | int | float | None, result: Retrieval | str, *, timings: bool
) -> dict[str, Any]:
    """Return the value of a row: an answer, or one sentence of what is wrong with the query.

    `name` is the id that the query gave itself.
    """
    if isinstance(result, str):
        return {"line": line, "status": "error", "id": name, "error": result}
    value = retrieval_value(result)
    start = {"line": line, "status": value.pop("status"), "id": name}
    if len(result.goals) > 1:
        start["goals"] = [object_to_json(goal) for goal in result.goals]
    if not timings:
        del value["seconds"]
    return start | value


def row_bytes(value: dict[str, Any]) -> bytes:
    """Write a row as one line, without its end."""
    try:
        return json.dumps(value, ensure_ascii=False).encode("utf-8")
    except UnicodeEncodeError:
        # Half of a surrogate pair, which JSON can escape but UTF-8 cannot write.
        return json.dumps(value).encode("ascii")


def row_start(row: bytes) -> tuple[int, str] | None:
    """Return the line number and the status of a row, or None if it does not begin like one."""
    match = _START.match(row)
    return None if match is None else (int(match[1]), match[2].decode())


@cache
def parquet_schema() -> pa.Schema:
    """Return the columns of the table; what does not apply to a row is null there."""
    import pyarrow as pa

    whole = {"units", "inputs", "depth", "tools", "dirty", "motions", "time", "human"}
    return pa.schema(
        [
            pa.field("line", pa.int64(), nullable=False),
            pa.field("id", pa.string()),
            pa.field("status", pa.string(), nullable=False),
            pa.field("goal", pa.list_(pa.string())),
            pa.field("method", pa.string()),
            pa.field("by", pa.list_(pa.string())),
            pa.field("founded", pa.bool_()),
            pa.field("executable", pa.bool_()),
            pa.field("tree", pa.list_(pa.int32())),
            *(
                pa.field(field.name, pa.int64() if field.name in whole else pa.float64())
                for field in fields(Costs)
            ),
            pa.field("reason", pa.string()),
            pa.field("error", pa.string()),
            pa.field("seconds", pa.float64()),
            pa.field("result", pa.string(), nullable=False),
        ]
    )


def parquet_table(rows: Sequence[bytes]) -> pa.Table:
    """Return some rows as a table."""
    import pyarrow as pa

    return pa.Table.from_pylist([_flat(row) for row in rows], schema=parquet_schema())


def _flat(row: bytes) -> dict[str, Any]:
    value = json.loads(row)
    name = value["id"]
    flat = {
        "line": value["line"],
        "id": None if name is None else _writable(name if isinstance(name, str) else json.dumps(name)),
        "status": value["status"],
        "result": row.decode("utf-8"),
    }
    if value["status"] == "error":
        return flat | {"error": _writable(value["error"])}
    return flat | {
        "goal": _goal_texts(value.get("goals") or [value["goal"]]),
        "tree": [unit["id"] for unit in value["units"]] if value["costs"] else None,
        "reason": value["reason"] or None,
        "seconds": value.get("seconds"),
        **{key: value[key] for key in ("method", "by", "founded", "executable")},
        **(value["costs"] or {}),
    }


def _goal_texts(goals: Iterable[object]) -> list[str]:
    return [str(object_from_json(goal)) for goal in goals]


def _writable(text: str) -> str:
    return text.encode("utf-8", "replace").decode("utf-8")
