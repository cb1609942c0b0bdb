"""Reading what stands beside a FOON: objects at hand, goals, labels. One clear error each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foon_asp.characters import is_label
from foon_asp.errors import InputError
from foon_asp.io.document import Document
from foon_asp.io.files import read_string, rows
from foon_asp.io.findings import Finding, Severity
from foon_asp.io.listed import Listed, read_listed
from foon_asp.io.motions import read_costs, read_rates
from foon_asp.io.vocabulary import VocabularyName
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.lookup import Pattern, likeliest
from foon_asp.model.node import ObjectNode
from foon_asp.model.notation import read_object
from foon_asp.numbers import QUANTITY
from foon_asp.values import said
from foon_asp.words import shortened


@dataclass(frozen=True, slots=True)
class KitchenFiles:
    """The files that say what is at hand, which labels are utensils, and what is known of motions."""

    kitchen: str | None = None
    utensils: str | None = None
    rates: str | None = None
    costs: str | None = None
    default_rate: float | None = None
    default_cost: float | None = None
    vocabulary: VocabularyName = "current"

    def read(self, foon: Foon) -> tuple[Kitchen, tuple[Finding, ...]]:
        """Read the kitchen of a FOON, and what was odd in the list of objects; raise `InputError`."""
        listed = None if self.kitchen is None else read_listed(Path(self.kitchen), self.vocabulary)
        named = [] if listed is None else list(listed.named_in(foon))
        stock = _stock((node, each) for each, node in named if isinstance(node, ObjectNode))
        kitchen = Kitchen(
            objects=tuple(stock),
            utensils=read_labels(Path(self.utensils)) if self.utensils else frozenset(),
            rates=read_rates(Path(self.rates)) if self.rates else {},
            default_rate=self.default_rate,
            costs=read_costs(Path(self.costs)) if self.costs else {},
            default_cost=self.default_cost,
            quantities={node: quantity for node, quantity in stock.items() if quantity is not None},
            stated=listed is not None,
            labels=tuple(dict.fromkeys(label for _, label in named if isinstance(label, str))),
        )
        return kitchen, () if listed is None else listed.findings


def _stock(listed: Iterable[tuple[ObjectNode, Listed]]) -> dict[ObjectNode, int | None]:
    """Return how many there are of each object, None for plenty.

    The quantities of an object that is listed twice add up; of an object with the quantity 0 there is none.
    """
    stock: dict[ObjectNode, int | None] = {}
    for node, each in listed:
        before = stock.get(node, 0)
        # What is more than the largest quantity is plenty.
        total = None if before is None or each.quantity is None else before + each.quantity
        stock[node] = total if total is None or QUANTITY.fits(total) else None
    return {node: quantity for node, quantity in stock.items() if quantity != 0}


def read_goals(
    name: str | None, foon: Foon, vocabulary: VocabularyName = "current"
) -> tuple[tuple[ObjectNode, ...], tuple[Finding, ...]]:
    """Read the goals of a FOON from a file, if there is one, and what was odd; raise `InputError`.

    A label, or an object without some of its parts, means what it does on the command line. One that may mean
    several objects is left out, with a finding; what the FOON does not know is a goal that it cannot make.
    """
    if name is None:
        return (), ()
    file = read_listed(Path(name), vocabulary)
    goals: list[ObjectNode] = []
    findings = list(file.findings)
    for each, named in file.named_in(foon):
        node = named if isinstance(named, ObjectNode) else ObjectNode(named)
        if isinstance(each.named, str) and foon.id_of(node) is None:
            pattern = Pattern.of(read_object(each.named, foon.labels))
            fitting = [other for other in foon.labelled(node.label) if pattern.matches(other, exactly=False)]
            meant = likeliest(pattern, fitting)
            if fitting and meant is None:
                message = f"ambiguous goal {said(each.named)}: {shortened(fitting, mark=';')}; it is left out"
                findings.append(Finding("ambiguous-goal", Severity.ERROR, name, each.line, message))
                continue
            node = meant or node
        goals.append(node)
    return tuple(goals), tuple(findings)


def read_labels(path: Path) -> frozenset[str]:
    """Read labels, one a line or a JSON list: utensils, motions, what a diet forbids."""
    text = read_string(path)
    found = set()
    for line, label in _json_items(text, path) if text.lstrip()[:1] in ("[", "{") else rows(text):
        if not is_label(label):
            why = " has a character that no label may have" if isinstance(label, str) else ""
            raise InputError(path, line, f"no label: {said(label)}{why}", "write a label a line")
        found.add(label.strip().lower())
    return frozenset(found)


def _json_items(text: str, path: Path) -> Iterator[tuple[int, Any]]:
    document = Document(text, path)
    document.read_objects()
    for line, _, message in document.oddities:
        raise InputError(path, line, message, 'write ["a label", …]')
    for item in document.items:
        yield item.line, item.value
