"""The rows of a batch: what is written for each query, as a JSON line or a row of a Parquet table."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from functools import cache
from typing import TYPE_CHECKING, Any

from msgspec import to_builtins

from foon_asp.io.objects import object_from_json
from foon_asp.io.wire import JsonObject
from foon_asp.query.objective import Costs
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.wire import error_row_json, row_json, unit_texts

if TYPE_CHECKING:
    import pyarrow as pa

Id = str | int | float | None
"""The id that a query gave itself, if any."""


@dataclass(frozen=True, slots=True)
class Row:
    """What is written for one query: the number of its line, its id, how it ended, and the whole as JSON.

    `json` is one line, without its end.
    """

    line: int
    id: Id
    status: str
    json: bytes

    def __reduce__(self) -> tuple[type[Row], tuple[int, Id, str, bytes]]:
        # Rows go from process to process. As dataclasses do it by themselves, that takes five times as long.
        return Row, (self.line, self.id, self.status, self.json)


_LINES = json.JSONEncoder(ensure_ascii=False)

_NO_UNITS = '"units": []'
"""Where the units of a tree are put, which are written already."""

Rows = list[Row]
"""The answers to some queries, in their order."""


def answer_row(line: int, name: Id, answer: Answer, *, timings: bool = False) -> Row:
    """Return the row of a query that was answered, with the seconds it took if there are to be timings."""
    row = row_json(line, name, answer, timings=timings, units=[])
    units = [] if answer.tree is None else unit_texts(answer.tree)
    # No text has this in it: there, quotes have backslashes.
    text = _LINES.encode(to_builtins(row)).replace(_NO_UNITS, f'"units": [{", ".join(units)}]', 1)
    try:
        written = text.encode("utf-8")
    except UnicodeEncodeError:
        written = _in_ascii(row_json(line, name, answer, timings=timings))
    return Row(line, name, str(answer.status), written)


def error_row(line: int, name: Id, error: str) -> Row:
    """Return the row of a query that was not answered; `error` is one sentence of what is wrong."""
    row = error_row_json(line, name, error)
    try:
        written = _LINES.encode(to_builtins(row)).encode("utf-8")
    except UnicodeEncodeError:
        written = _in_ascii(row)
    return Row(line, name, "error", written)


def _in_ascii(row: JsonObject) -> bytes:
    """Write a row with half of a surrogate pair in it, which JSON can escape but UTF-8 cannot write."""
    return json.dumps(to_builtins(row)).encode("ascii")


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


def parquet_table(rows: Sequence[Row]) -> pa.Table:
    """Return some rows as a table."""
    import pyarrow as pa

    return pa.Table.from_pylist([_flat(row) for row in rows], schema=parquet_schema())


def _flat(row: Row) -> dict[str, Any]:
    value = json.loads(row.json)
    flat = {
        "line": row.line,
        "id": None
        if row.id is None
        else _writable(row.id if isinstance(row.id, str) else json.dumps(row.id)),
        "status": row.status,
        "result": row.json.decode("utf-8"),
    }
    if row.status == "error":
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
