"""A dish adapted as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from foon_asp.io.object_wire import ObjectJson, object_to_json
from foon_asp.io.wire import UNIQUE, Amount, JsonObject, Text, means, word
from foon_asp.retrieval.wire import Optimality, RetrievalJson, objects_json, retrieval_json

if TYPE_CHECKING:
    # The answer imports this module, to write itself.
    from foon_asp.query.substitution import Replacement
    from foon_asp.retrieval.adapt import Adaptation, Candidate


class AdditionJson(JsonObject):
    """Something wanted that was added beside what it is like."""

    label: Annotated[Text, means("What was added.")]
    beside: Annotated[Text, means("What it goes with: each step does with both what it does with this.")]
    likeness: Annotated[float, Meta(gt=0, le=1), means("How well it would stand for that.")]
    why: Annotated[Text, means("Who says so: the note of a table, or the measure.")]


class CandidateJson(JsonObject):
    """A dish that was looked at."""

    dish: Annotated[ObjectJson, means("The dish.")]
    status: Optimality
    distance: Annotated[
        Amount | None,
        means("How far it is from what was asked; null if it cannot be made so, or no tree is known."),
    ]
    reason: Annotated[str, means("Why it cannot be made so; empty unless the status is unreachable.")]


class AdaptationJson(JsonObject):
    """A dish adapted (docs/adapting.md)."""

    answer: Annotated[
        RetrievalJson,
        means(
            "The tree of the nearest dish with all changes made, as `retrieve` answers; or why there is none."
        ),
    ]
    wanted: Annotated[list[Text], UNIQUE, means("What the dish was to have.")]
    distance: Annotated[
        Amount | None,
        means("How far the dish is from what was asked, in likeness; null if there is no tree."),
    ]
    additions: Annotated[list[AdditionJson], means("What was added beside something else.")]
    missing: Annotated[
        list[Text],
        means("What is wanted and not in the dish: nothing that goes into it is known to be like it."),
    ]
    brought: Annotated[
        list[ObjectJson],
        means("What is taken to be at hand though the kitchen lacks it, because it is wanted."),
    ]
    dishes: Annotated[list[CandidateJson], means("All dishes that were looked at, the nearest first.")]
    seconds: Annotated[Amount, means("Wall time, without reading the files.")]


def adaptation_json(found: Adaptation) -> AdaptationJson:
    """Return what `adapt --format json` writes."""
    return AdaptationJson(
        answer=retrieval_json(found.answer),
        wanted=list(found.wanted),
        distance=found.distance,
        additions=[_addition(row) for row in found.additions],
        missing=list(found.missing),
        brought=objects_json(found.brought),
        dishes=[_candidate(each) for each in found.candidates],
        seconds=round(found.seconds, 6),
    )


def _addition(row: Replacement) -> AdditionJson:
    assert row.by is not None
    return AdditionJson(row.by, row.label, row.likeness, row.why)


def _candidate(each: Candidate) -> CandidateJson:
    return CandidateJson(object_to_json(each.dish), word(each.status), each.distance, each.reason)
