"""One tree made of several as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from foon_asp.io.object_wire import ObjectJson, SourceJson, UnitJson, object_to_json
from foon_asp.io.wire import Amount, Count, JsonObject, Place, Text, means, word
from foon_asp.model.node import Source
from foon_asp.retrieval.explain_wire import ExplanationJson, explanation_json
from foon_asp.retrieval.wire import (
    CostsJson,
    RetrievalJson,
    costs_json,
    objects_json,
    retrieval_json,
    some_costs_json,
)

if TYPE_CHECKING:
    # The answer imports this module, to write itself.
    from foon_asp.retrieval.consolidate import Backing, Consolidation, Dropped, SampleReport, Vote
    from foon_asp.retrieval.samples import Reworded


class SupportJson(JsonObject):
    """How many of the trees have a step."""

    step: Annotated[Place, means("Its place in the order of execution, from 1.")]
    support: Annotated[Place, means("How many of the trees have it.")]
    trees: Annotated[list[Text], means("The trees that have it.")]
    sources: Annotated[list[SourceJson], means("Where it stands in these.")]


class VoteJson(JsonObject):
    """Something that trees are for."""

    object: Annotated[ObjectJson, means("What it is.")]
    trees: Annotated[list[Text], means("The trees that are for it.")]


class SampleJson(JsonObject):
    """One of the trees, by itself."""

    tree: Annotated[Text, means("Its file, with its place there if there are several.")]
    steps: Annotated[Count, means("Its steps.")]
    dropped: Annotated[Count, means("How many of these were left out.")]
    whole: Annotated[
        CostsJson | None,
        means(
            "What it costs as it stands, each unit once; null if it does not make the goal in this kitchen."
        ),
    ]
    alone: Annotated[
        CostsJson | None, means("What the best tree of its own sound steps costs; null if there is none.")
    ]


class DroppedJson(JsonObject):
    """A step that was left out."""

    tree: Annotated[Text, means("The tree that has it.")]
    source: Annotated[SourceJson, means("Where it stands.")]
    fault: Annotated[
        Literal["unreadable", "incomplete", "state", "location", "motion"],
        means(
            "unreadable: it is no unit. incomplete: it takes nothing, or brings nothing about. state, "
            "location, motion: the model of these does not allow a transition."
        ),
    ]
    reason: Annotated[Text, means("What is wrong with it.")]
    unit: Annotated[UnitJson | None, means("The unit, in the words of all trees; null if it is unreadable.")]


class RewordedJson(JsonObject):
    """A word that is written otherwise."""

    kind: Annotated[Literal["label", "state", "motion"], means("What the word is.")]
    word: Annotated[Text, means("What stands in the files.")]
    instead: Annotated[Text, means("What is written instead, because more trees write it so.")]
    why: Annotated[
        Literal["spelling", "number", "misspelling", "likeness"],
        means(
            "spelling: they differ in blanks, hyphens and capitals alone. number: one is the plural of the "
            "other. misspelling: it looks like a misspelling. likeness: a measure says so."
        ),
    ]
    sources: Annotated[list[SourceJson], means("The steps in which it stands.")]


class ConsolidationJson(JsonObject):
    """One tree made of several trees of a dish (docs/consolidating.md)."""

    answer: Annotated[RetrievalJson, means("The tree, as `retrieve` answers; or why there is none.")]
    support: Annotated[
        list[SupportJson], means("For each step of the tree, in its order, which trees have it.")
    ]
    votes: Annotated[
        list[VoteJson], means("What the trees are for; the goal is the first if it was not named.")
    ]
    trees: Annotated[list[SampleJson], means("The trees, each by itself.")]
    dropped: Annotated[list[DroppedJson], means("The steps that were left out.")]
    reworded: Annotated[list[RewordedJson], means("The words that are written otherwise.")]
    kitchen: Annotated[list[ObjectJson], means("What was taken to be at hand.")]
    unpriced: Annotated[list[Text], means("Motions without a cost; they count as the dearest.")]
    explanation: Annotated[
        ExplanationJson | None, means("Why no tree is left, as `explain` says it; null if there is one.")
    ]
    seconds: Annotated[Amount, means("Wall time, without reading the files.")]


def consolidation_json(found: Consolidation) -> ConsolidationJson:
    """Return what `consolidate --format json` writes."""
    tree = found.answer.tree
    units = () if tree is None else tree.units
    return ConsolidationJson(
        answer=retrieval_json(found.answer),
        support=[_support(place, found.backing[unit]) for place, unit in enumerate(units, 1)],
        votes=[_vote(vote) for vote in found.votes],
        trees=[_sample(each) for each in found.samples],
        dropped=[_dropped(found, each) for each in found.dropped],
        reworded=[_reworded(each) for each in found.reworded],
        kitchen=objects_json(found.kitchen),
        unpriced=list(found.unpriced),
        explanation=None if found.explanation is None else explanation_json(found.explanation),
        seconds=round(found.seconds, 6),
    )


def _support(place: int, backing: Backing) -> SupportJson:
    return SupportJson(place, len(backing.trees), list(backing.trees), list(map(_source, backing.sources)))


def _source(source: Source) -> SourceJson:
    return SourceJson(source.file, source.line, source.video)


def _vote(vote: Vote) -> VoteJson:
    return VoteJson(object_to_json(vote.node), list(vote.trees))


def _sample(report: SampleReport) -> SampleJson:
    whole = None if report.whole is None else costs_json(report.whole)
    return SampleJson(report.name, report.steps, report.dropped, whole, some_costs_json(report.alone.tree))


def _dropped(found: Consolidation, dropped: Dropped) -> DroppedJson:
    unit = None if dropped.unit is None else UnitJson.of(found.foon, dropped.unit)
    return DroppedJson(dropped.tree, _source(dropped.source), word(dropped.fault), dropped.reason, unit)


def _reworded(reworded: Reworded) -> RewordedJson:
    aligned = reworded.aligned
    sources = list(map(_source, reworded.sources))
    return RewordedJson(reworded.kind, aligned.word, aligned.instead, word(aligned.why), sources)
