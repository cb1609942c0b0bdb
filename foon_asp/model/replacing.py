"""Labels replaced in object nodes, and which nodes may become the same by that."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from foon_asp.model.node import ObjectNode, State

Replaced = Mapping[str, str | None]
"""What replaces each label; None: it is left out."""

Differences = frozenset[tuple[str, str]]
"""Pairs of labels, of one node and of another, that differ where the nodes are otherwise the same."""


def replaced(node: ObjectNode, labels: Replaced) -> ObjectNode | None:
    """Return what a node becomes; None if it is itself left out.

    What is left out is no longer among contents, and nothing is in or on it.
    """
    label = labels.get(node.label, node.label)
    if label is None:
        return None
    if labels.keys().isdisjoint(node.named_labels):
        return node
    return ObjectNode.of(label, _states(node.states, labels))


def _states(states: Iterable[State], labels: Replaced) -> Iterator[State]:
    for state in states:
        relatum = state.relatum and labels.get(state.relatum, state.relatum)
        if relatum is None and state.relatum is not None:
            continue
        contents = state.contents
        if contents is not None:
            kept = (labels.get(content, content) for content in contents)
            contents = tuple(content for content in kept if content is not None)
        yield State(state.name, relatum, contents)


@dataclass(frozen=True, slots=True)
class Changes:
    """What becomes of object nodes: labels replaced, and others added beside some that stay.

    What is added beside a label goes the same way: it is among the contents wherever that is, and has nodes
    of its own wherever that has. `at_hand` tells what nobody has made yet: what is added is no content of
    that, but lies in a vessel of its own.
    """

    labels: Replaced
    beside: Mapping[str, Sequence[str]]
    at_hand: Callable[[ObjectNode], bool]

    def of(self, node: ObjectNode, *, view: bool = False) -> list[ObjectNode]:
        """Return what a node becomes; nothing if it is left out.

        A `view` shows from the vessel's side what another node shows; so does that of what is added.
        """
        found = replaced(node, self.labels)
        if found is None:
            return []
        if self.beside.keys().isdisjoint(found.named_labels):
            return [found]
        apart = view or self.at_hand(found)
        own = [found.label, *self.beside.get(found.label, ())]
        vessels = [found.states, *self._own_vessels(found)] if apart else [self._joined(found)]
        return [ObjectNode.of(label, states) for label in own for states in vessels]

    def _joined(self, node: ObjectNode) -> tuple[State, ...]:
        """Return the states of a node with what is added among its contents."""
        return tuple(
            state
            if state.contents is None
            else State(state.name, state.relatum, (*state.contents, *self._added(state.contents)))
            for state in node.states
        )

    def _own_vessels(self, node: ObjectNode) -> Iterator[tuple[State, ...]]:
        """Yield the states of vessels of what is added, each for itself."""
        for state in node.states:
            rest = tuple(other for other in node.states if other is not state)
            for label in self._added(state.contents or ()):
                yield (*rest, State(state.name, state.relatum, (label,)))

    def _added(self, contents: Iterable[str]) -> list[str]:
        listed = list(contents)
        found = dict.fromkeys(label for each in listed for label in self.beside.get(each, ()))
        return [label for label in found if label not in listed]


Shape = tuple[tuple[str, bool, int], ...]
"""Of each state its name, whether it has a relatum, and how many contents (-1 for none in braces)."""


def shape(node: ObjectNode) -> Shape | None:
    """Return what two nodes have in common that may become the same.

    None for a node with two states of one name, which becomes no other.
    """
    found = tuple(
        (state.name, state.relatum is not None, -1 if state.contents is None else len(state.contents))
        for state in node.states
    )
    return None if len({name for name, *_ in found}) < len(found) else tuple(sorted(found))


def matches(one: ObjectNode, other: ObjectNode, may_unite: Callable[[str, str], bool]) -> set[Differences]:
    """Return the ways in which two nodes of one shape may become the same, if some labels may be united.

    Each is the pairs of labels that must become the same; what both have in common needs nothing.
    """
    ways: list[list[Differences]] = []
    for mine, theirs in zip(_parts(one), _parts(other), strict=True):
        left, right = Counter(mine), Counter(theirs)
        rest, wanted = list((left - right).elements()), list((right - left).elements())
        found = set(_pairings(rest, wanted, may_unite))
        if not found:
            return set()
        ways.append(sorted(found, key=sorted))
    return {frozenset().union(*way) for way in product(*ways)}


def _parts(node: ObjectNode) -> Iterator[tuple[str, ...]]:
    """Yield the labels that a node names, together what has the same place in it."""
    yield (node.label,)
    for state in sorted(node.states, key=lambda state: state.name):
        yield () if state.relatum is None else (state.relatum,)
        yield state.contents or ()


def _pairings(
    left: list[str], right: list[str], may_unite: Callable[[str, str], bool]
) -> Iterator[Differences]:
    """Yield the ways to pair all of some labels with all of as many others."""
    if not left:
        yield frozenset()
        return
    first, *rest = left
    for place, other in enumerate(right):
        if may_unite(first, other):
            for pairs in _pairings(rest, right[:place] + right[place + 1 :], may_unite):
                yield pairs | {(first, other)}
