"""The JSON Schemas of all that is read and written: `python -m foon_asp.cli.schemas DIR` writes them.

They are made from the `wire` modules, where each shape is declared once. Those of this version are in
`docs/schema/`, where `make schemas` puts them.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta

from foon_asp.asp.wire import TERM, AskedJson, FunctionJson
from foon_asp.audit.wire import AuditJson, StatisticsJson
from foon_asp.io import atomic
from foon_asp.io.object_wire import ObjectJson
from foon_asp.io.wire import FEW, dumps
from foon_asp.planning.schedule_wire import ResourcesJson, ScheduleAnswerJson
from foon_asp.planning.wire import EngineJson, NamedPlanJson, PlanAnswerJson, PlanJson
from foon_asp.query.wire import NodeJson, QueryJson
from foon_asp.retrieval.adapt_wire import AdaptationJson
from foon_asp.retrieval.check_wire import CheckJson
from foon_asp.retrieval.consolidate_wire import ConsolidationJson
from foon_asp.retrieval.explain_wire import ExplanationJson
from foon_asp.retrieval.wire import (
    AlternativesJson,
    AnswerRowJson,
    ComparisonRowJson,
    ErrorRowJson,
    HumanTableJson,
    MenuJson,
    ReachJson,
    RetrievalJson,
    SuggestionsJson,
)

DIALECT = "https://json-schema.org/draft/2020-12/schema"

_PAPER = ("paper_ids", "paper_success", "paper_inputs")
_RATES = ("greedy_success", "greedy_success_reference")
Compared = Annotated[
    ComparisonRowJson,
    Meta(
        extra_json_schema={
            "dependentRequired": {
                name: [other for other in group if other != name]
                for group in (_PAPER, _RATES)
                for name in group
            }
        }
    ),
]
"""A row of a comparison, with the columns that come together or not at all."""


@dataclass(frozen=True, slots=True)
class Declared:
    """What a schema is of: a type, or one of several. Without a description it is that of the type."""

    title: str
    types: tuple[Any, ...]
    description: str = ""
    more: tuple[Any, ...] = ()
    """Types that members refer to by name."""


DECLARED = {
    "adapt": Declared("foon-asp adapt --format json", (AdaptationJson,)),
    "audit": Declared("foon-asp audit --format json", (AuditJson,)),
    "batch-query": Declared("foon-asp batch: a line of the query file", (QueryJson,), more=(NodeJson,)),
    "batch-result": Declared(
        "foon-asp batch: a line of the results",
        (AnswerRowJson, ErrorRowJson),
        "One row for each query, in the order of the query file.",
    ),
    "check": Declared(
        "foon-asp check --format json",
        (CheckJson, list[CheckJson]),
        "What is wrong with a task tree; a list where there are several.",
    ),
    "compare": Declared(
        "foon-asp compare --format json",
        (Annotated[list[Compared], FEW], Annotated[list[HumanTableJson], FEW]),
        "One row for each goal. Without --human, a cell for each method: the paper_* columns are there only "
        "for the goals and the FOON that the paper reports; the greedy_success columns only if success rates "
        "are known. With --human, the likeliest tree for 0, 1, 2, … human steps.",
    ),
    "consolidate": Declared("foon-asp consolidate --format json", (ConsolidationJson,)),
    "decode": Declared(
        "foon-asp pddl decode --format json",
        (PlanJson, NamedPlanJson),
        "Units in the order of execution; with what names.json says of them alone where nobody has named the "
        "FOON of the export.",
    ),
    "engines": Declared(
        "foon-asp engines --format json", (Annotated[list[EngineJson], FEW],), "The planning engines."
    ),
    "explain": Declared("foon-asp explain --format json", (ExplanationJson,)),
    "goals": Declared(
        "foon-asp goals --format json",
        (list[ObjectJson],),
        "The goals of the data folder, each once, in the order of the file.",
    ),
    "menu": Declared("foon-asp menu --format json", (MenuJson,)),
    "plan": Declared("foon-asp plan --format json", (PlanAnswerJson,)),
    "query": Declared("foon-asp query --format json", (AskedJson,), more=(FunctionJson,)),
    "reach": Declared("foon-asp reach --format json", (ReachJson,)),
    "resources": Declared("foon-asp schedule --resources", (ResourcesJson,)),
    "retrieve": Declared(
        "foon-asp retrieve --format json",
        (
            RetrievalJson,
            Annotated[list[RetrievalJson], FEW],
            AlternativesJson,
            Annotated[list[AlternativesJson], FEW],
        ),
        "One answer for a goal on the command line; with --goals, a list of answers in the order of the "
        "file. With -n, --all-optimal, --diverse or --pareto each answer holds several trees.",
    ),
    "schedule": Declared("foon-asp schedule --format json", (ScheduleAnswerJson,)),
    "stats": Declared("foon-asp stats --format json", (StatisticsJson,)),
    "suggest": Declared("foon-asp suggest --format json", (SuggestionsJson,)),
}
"""What is declared, by the names of the schemas."""


def schema(name: str) -> dict[str, Any]:
    """Return one of the `DECLARED` schemas."""
    declared = DECLARED[name]
    found, components = msgspec.json.schema_components(
        declared.types + declared.more, ref_template="#/$defs/{name}"
    )
    values = _tidy([*found[: len(declared.types)]])
    value = values[0] if len(values) == 1 else {"oneOf": values}
    shapes = {_shape_name(each): _tidy(shape) for each, shape in components.items()}
    if "function" in shapes:
        shapes["term"] = TERM
    if "$ref" in value:
        value = shapes.pop(value["$ref"].rpartition("/")[2])
    description = declared.description or value.pop("description")
    head = {"$schema": DIALECT, "title": declared.title, "description": description}
    return head | value | ({"$defs": shapes} if shapes else {})


def _shape_name(name: str) -> str:
    """Return what a class is called in schemas: `tree_unit` for `TreeUnitJson`."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name.removesuffix("Json")).lower()


def _tidy(part: Any) -> Any:
    """Leave out the names of classes, which mean nothing to others, and the line breaks of docstrings."""
    if isinstance(part, list):
        return [_tidy(each) for each in part]
    if not isinstance(part, dict):
        return part
    tidied: dict[str, Any] = {}
    for key, value in part.items():
        if key == "properties":
            tidied[key] = {name: _tidy(member) for name, member in value.items()}
        elif key == "description":
            tidied[key] = " ".join(value.split())
        elif key == "$ref":
            start, _, name = value.rpartition("/")
            tidied[key] = f"{start}/{_shape_name(name)}"
        elif key != "title":
            tidied[key] = _tidy(value)
    return tidied


def write_schemas(folder: Path) -> Iterable[Path]:
    """Write all schemas into a folder, and yield their paths."""
    for name in DECLARED:
        path = folder / f"{name}.schema.json"
        atomic.write_text(path, dumps(schema(name)))
        yield path


if __name__ == "__main__":
    for written in write_schemas(Path(sys.argv[1])):
        sys.stdout.write(f"{written}\n")
