"""What rules of one's own show, as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from msgspec import Meta

from foon_asp.io.object_wire import ObjectJson, object_to_json
from foon_asp.io.wire import Amount, Count, JsonObject, LimitName, Text, means, word

if TYPE_CHECKING:
    # The answer imports this module, to write itself.
    from foon_asp.asp.ask import RulesAnswer, Table
    from foon_asp.asp.terms import Term

TermJson = Annotated[Any, Meta(extra_json_schema={"$ref": "#/$defs/term"})]
"""An integer, a text, a list of terms or a `FunctionJson`; `TERM` says so, for types go in no circles."""

TERM = {
    "description": "A number, a text, a tuple as an array, or a named term.",
    "anyOf": [
        {"type": "integer"},
        {"type": "string"},
        {"type": "array", "items": {"$ref": "#/$defs/term"}},
        {"$ref": "#/$defs/function"},
    ],
}
"""The schema of a term."""


class FunctionJson(JsonObject):
    """A term with a name, like oven or step(3)."""

    name: Annotated[Text, means("The name, with - before it if the term is negated; also #inf and #sup.")]
    arguments: Annotated[list[TermJson], means("The arguments; empty for a constant.")]


def term_json(term: Term) -> Any:
    """Return a term as a `TermJson`."""
    if isinstance(term, tuple):
        return [term_json(each) for each in term]
    if isinstance(term, int | str):
        return term
    return FunctionJson(term.name, [term_json(each) for each in term.arguments])


class PredicateJson(JsonObject):
    """All shown atoms, or terms, with one name and arity."""

    name: Annotated[
        str,
        means(
            "The name, with - before it if it is negated; empty for shown terms that are tuples or have "
            "no arguments."
        ),
    ]
    arity: Annotated[Count, means("How many columns there are.")]
    columns: Annotated[
        list[Text],
        means(
            "The variables that name the columns, where a rule first derives the predicate; empty unless "
            "all its arguments are variables there."
        ),
    ]
    count: Annotated[Count, means("How many rows there are.")]
    rows: Annotated[
        list[list[TermJson]],
        means(
            "The arguments of each atom, sorted: numbers by size, texts in natural order. An atom "
            "without arguments is one empty row."
        ),
    ]


def _predicate(table: Table) -> PredicateJson:
    heading = table.heading
    rows = [[term_json(term) for term in row] for row in table.rows]
    return PredicateJson(heading.name, heading.arity, list(heading.columns), len(rows), rows)


class AskedJson(JsonObject):
    """What the rules of a query show."""

    goals: Annotated[
        list[ObjectJson],
        means("The goals that were named, in their order; empty if the rules ran over the whole FOON."),
    ]
    status: Annotated[
        Literal["found", "optimal", "none", "limit"],
        means(
            "found: the rules optimise nothing and have a stable model. optimal: a proven best model. "
            "none: the rules have no stable model. limit: the time ran out; the predicates, if not null, "
            "are those of the best model so far."
        ),
    ]
    costs: Annotated[
        list[int],
        means(
            "What the model pays by each priority of #minimize and weak constraints, the highest "
            "priority first; empty if nothing is optimised or there is no model."
        ),
    ]
    more: Annotated[
        bool | None,
        means(
            "Whether another model that is as good shows something else; null if the time ran out before "
            "that was known."
        ),
    ]
    predicates: Annotated[
        list[PredicateJson] | None,
        means("What the model shows, in the order of the rules; null if no model was found."),
    ]
    seconds: Annotated[Amount, means("Wall time of the query, without reading the FOON.")]
    limit: LimitName


def asked_json(answer: RulesAnswer) -> AskedJson:
    """Return what `query --format json` writes."""
    return AskedJson(
        goals=[object_to_json(goal) for goal in answer.goals],
        status=word(answer.status),
        costs=list(answer.costs),
        more=answer.more,
        predicates=None if answer.tables is None else [_predicate(table) for table in answer.tables],
        seconds=round(answer.seconds, 6),
        limit=answer.limit,
    )
