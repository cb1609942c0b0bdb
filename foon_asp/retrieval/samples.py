"""Several trees of one dish in the same words: what each lists, and what was written otherwise."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Literal

from foon_asp import resources
from foon_asp.io.trees import Listing, Trees
from foon_asp.model.alignment import Aligned, Alignment, Measure, align
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.node import ObjectNode, Source, UnitId

Kind = Literal["label", "state", "motion"]
"""What a word is in a tree."""


@dataclass(frozen=True, slots=True)
class Sample:
    """One of several trees: its steps in the order of the file, in the words of all, and where they stand."""

    listing: Listing
    units: tuple[UnitId, ...]
    goals: tuple[ObjectNode, ...]

    @property
    def name(self) -> str:
        """The file of the tree, with its place there if there are several."""
        return self.listing.name

    @property
    def sources(self) -> tuple[Source, ...]:
        """Where each step stands."""
        return self.listing.sources


@dataclass(frozen=True, slots=True)
class Reworded:
    """A word of some trees that is written otherwise, why, and the steps in which it stands."""

    kind: Kind
    aligned: Aligned
    sources: tuple[Source, ...]


@dataclass(frozen=True, slots=True)
class Samples:
    """Several trees in the same words: all of their units in one FOON, each once."""

    foon: Foon
    trees: tuple[Sample, ...]
    alignment: Alignment
    reworded: tuple[Reworded, ...]


@dataclass(frozen=True, slots=True)
class Words:
    """Words that stand beside the trees, in models and tables; they are brought to those of the trees."""

    labels: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    motions: tuple[str, ...] = ()


def read_samples(trees: Trees, beside: Words, measure: Measure | None = None) -> Samples:
    """Bring some trees to the same words; a measure says which labels mean the same in other words."""
    used = [_used(trees.foon, listing) for listing in trees.listings]
    labels, states, motions = ([each[kind] for each in used] for kind in ("label", "state", "motion"))
    alignment = Alignment(
        tuple(align(labels, beside.labels, resources.lexicon(), measure)),
        tuple(align(states, beside.states)),
        tuple(align(motions, beside.motions)),
    )
    write = alignment.rewriter()
    builder = FoonBuilder()
    found = []
    for listing in trees.listings:
        units = []
        for number, source in zip(listing.units, listing.sources, strict=True):
            unit = trees.foon.units[number]
            inputs, outputs = (
                [builder.object(write.node(trees.foon.objects[port])) for port in side]
                for side in (unit.inputs, unit.outputs)
            )
            note = replace(unit.annotation, sources=(source,))
            units.append(builder.unit(write.motion(unit.motion), inputs, outputs, note)[0])
        found.append(Sample(listing, tuple(units), tuple(map(write.node, listing.goals))))
    return Samples(builder.build(), tuple(found), alignment, tuple(_reworded(trees, alignment)))


def _used(foon: Foon, listing: Listing) -> Mapping[Kind, Counter[str]]:
    """Return how often each word stands in a tree."""
    found: dict[Kind, Counter[str]] = {"label": Counter(), "state": Counter(), "motion": Counter()}
    for number in listing.units:
        for kind, word in _words(foon, number):
            found[kind][word] += 1
    return found


def _words(foon: Foon, number: UnitId) -> Iterator[tuple[Kind, str]]:
    unit = foon.units[number]
    yield "motion", unit.motion
    for port in (*unit.inputs, *unit.outputs):
        node = foon.objects[port]
        yield from (("label", label) for label in node.named_labels)
        yield from (("state", name) for name in node.plain_states)


def _reworded(trees: Trees, alignment: Alignment) -> Iterator[Reworded]:
    places: defaultdict[tuple[Kind, str], dict[Source, None]] = defaultdict(dict)
    for listing in trees.listings:
        for number, source in zip(listing.units, listing.sources, strict=True):
            for kind, word in _words(trees.foon, number):
                places[kind, word][source] = None
    kinds: Iterable[tuple[Kind, tuple[Aligned, ...]]] = (
        ("label", alignment.labels),
        ("state", alignment.states),
        ("motion", alignment.motions),
    )
    for kind, words in kinds:
        # Words of models alone stand in no step.
        yield from (
            Reworded(kind, each, tuple(places[kind, each.word]))
            for each in words
            if (kind, each.word) in places
        )
