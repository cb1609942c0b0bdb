"""What stands beside a FOON and is unknown to it: objects, goals, and words that are probably misspelt.

A table of rates, a list of utensils or a diet may rightly know more than one FOON does. So a word that is
near to nothing is left alone. An object of the kitchen or a goal is told whatever it is near to.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from foon_asp.io.findings import Finding, Severity
from foon_asp.io.folder import BESIDE, Dataset, Sources
from foon_asp.model.node import ObjectNode
from foon_asp.model.stock import labelled
from foon_asp.model.world import World
from foon_asp.words import closest, likest, shortened

_NEAR = 0.75
"""How much a word must resemble a known one to be taken for it, of 1."""


@dataclass(frozen=True, slots=True)
class Words:
    """The words of a file, and those that the FOON knows of the kind.

    `beside` says that it was made for the FOON: named by the user, or beside it in its folder.
    """

    name: str
    what: str
    words: Collection[str]
    known: Collection[str]
    beside: bool = True

    def misspelt(self) -> Iterator[tuple[str, str]]:
        """Yield the words that are probably misspelt, each with what is near."""
        for word, near in likest(sorted(set(self.words).difference(self.known)), self.known, _NEAR):
            # What another FOON has beside what is near is another word: crank, beside crack.
            if self.beside or near not in self.words:
                yield word, near


def unknown(dataset: Dataset, world: World) -> Iterator[Finding]:
    """Yield what the files beside a FOON name and the FOON, seen in full, does not know."""
    beside = dataset.sources.beside
    for node in world.strangers if dataset.kitchen.stated else ():
        message = f"the kitchen has {node}, which the FOON does not know{nearest(world, node)}"
        yield Finding("unknown-object", Severity.WARNING, beside["kitchen"], 0, message)
    for node in unknown_goals(world):
        message = f"the goal {node} is no object of this FOON{nearest(world, node)}"
        yield Finding("unknown-goal", Severity.WARNING, beside["goals"], 0, message)
    yield from labels_alone(dataset, world)
    tables = (motions(dataset, world, "rates"), motions(dataset, world, "costs"))
    for words in (*tables, utensils(dataset, world)):
        for word, near in words.misspelt():
            message = f"the FOON does not know {word!r} (closest: {near})"
            yield Finding("unknown-word", Severity.WARNING, words.name, 0, message)


def labels_alone(dataset: Dataset, world: World) -> Iterator[Finding]:
    """Yield which objects the labels of a kitchen mean in a FOON; first those that mean none, or several."""
    if not dataset.kitchen.labels:
        return
    plain: list[Finding] = []
    file = dataset.sources.beside["kitchen"]
    for label in dataset.kitchen.labels:
        known, nodes = world.foon.labelled(label), labelled(world.units, label)
        if not nodes and known:
            message = (
                f"{label!r} is nothing that is at hand: units make {shortened(known, mark=';')}; name one"
            )
            yield Finding("ambiguous-label", Severity.WARNING, file, 0, message)
        elif len(nodes) > 1:
            message = f"{label!r} may be {shortened(nodes, mark=';')}; all of them are at hand"
            yield Finding("ambiguous-label", Severity.WARNING, file, 0, message)
        elif nodes and nodes[0] != ObjectNode(label):
            plain.append(Finding("label-alone", Severity.NOTE, file, 0, f"{label!r} is {nodes[0]}"))
    yield from plain


def unknown_goals(world: World) -> list[ObjectNode]:
    """Return the goals of a world that are no objects of it."""
    return [goal for goal in world.goals if world.foon.id_of(goal) is None and goal not in world.strangers]


def motions(dataset: Dataset, world: World, what: Literal["rates", "costs"]) -> Words:
    """Return the motions that have rates, or costs."""
    name, beside = _file(dataset.sources, what)
    words = dataset.kitchen.rates if what == "rates" else dataset.kitchen.costs
    return Words(name, "motions", words, world.foon.motions, beside)


def utensils(dataset: Dataset, world: World) -> Words:
    """Return the labels of utensils; those of the FOON are only looked up if there are some."""
    name, beside = _file(dataset.sources, "utensils")
    words = dataset.kitchen.utensils
    return Words(name, "labels", words, known_labels(world) if words else (), beside)


def known_labels(world: World) -> Collection[str]:
    """Return all labels that the FOON and the kitchen name."""
    return world.foon.named_labels | {label for node in world.strangers for label in node.named_labels}


def nearest(world: World, node: ObjectNode) -> str:
    """Return the closest node, looking for the label first: that is quick and what people mistype."""
    same_label = [str(other) for other in world.foon.labelled(node.label)]
    if same_label:
        return closest(str(node), same_label, 1) or f"; there is {same_label[0]}"
    return closest(node.label, world.foon.labels, 1)


def _file(sources: Sources, what: str) -> tuple[str, bool]:
    """Return the name of a file beside the FOON, and whether it was made for it."""
    name, folder = sources.beside.get(what, ""), Path(sources.folder)
    of_folder = any(folder in (Path(path), Path(path).parent) for path in sources.foon)
    return name, of_folder or Path(name) not in {folder / usual for usual in BESIDE[what]}
