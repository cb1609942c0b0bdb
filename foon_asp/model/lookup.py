"""What a text that names an object may mean: the node that it describes, or those that fit what it says."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectNode, State, contains
from foon_asp.model.notation import FORM, PLACES, Parts, tidy
from foon_asp.values import said


@dataclass(frozen=True, slots=True)
class Pattern:
    """What a goal says; a part that is None was left out."""

    label: str
    states: frozenset[str] | None
    contents: tuple[str, ...] | None
    others: frozenset[State] | None

    @classmethod
    def of(cls, parts: Parts) -> Pattern:
        """Take what a text says."""
        return cls(
            parts.label,
            None if parts.states is None else frozenset(parts.states),
            None if parts.contents is None else tuple(sorted(chain.from_iterable(parts.contents))),
            frozenset(State(*other) for other in parts.others) or None,
        )

    def of_label(self, label: str) -> Pattern:
        """Return the same of another label."""
        return replace(self, label=label)

    def matches(self, node: ObjectNode, *, exactly: bool) -> bool:
        """Does a node fit all parts that were said? `exactly` allows nothing more within a part."""
        states, contents = frozenset(node.plain_states), node.contents
        others = frozenset(state for state in node.states if not state.plain and not state.in_braces)
        if node.label != self.label:
            return False
        if exactly:
            return (
                self.states in (None, states)
                and self.contents in (None, contents)
                and self.others in (None, others)
            )
        return (
            (self.states or frozenset()) <= states
            and set(self.contents or ()) <= set(contents)
            and (self.others or frozenset()) <= others
        )


def likeliest(
    pattern: Pattern, fitting: Sequence[ObjectNode], named: Iterable[ObjectNode] = ()
) -> ObjectNode | None:
    """Return the one node that is meant, of those that fit, or None if it may be several.

    Those that are `named`, as goals of the data, are the likelier ones; then those that have no part more
    than is said; then those that are not bare.
    """
    return next((each[0] for each in _narrower(pattern, fitting, set(named)) if len(each) == 1), None)


def _narrower(
    pattern: Pattern, fitting: Sequence[ObjectNode], named: set[ObjectNode]
) -> Iterator[list[ObjectNode]]:
    """Yield the nodes that are more likely meant; the likeliest first."""
    for nodes in ([node for node in fitting if node in named], list(fitting)):
        exact = [node for node in nodes if pattern.matches(node, exactly=True)]
        for each in (exact, nodes):
            yield each
            yield [node for node in each if not node.bare]


def node_of(parts: Parts) -> ObjectNode:
    """Return the object node that has these parts and no others."""
    states = [State(name) for name in parts.states or ()]
    states += [contains(*each) for each in parts.contents or ()]
    return ObjectNode.of(parts.label, (*states, *(State(*other) for other in parts.others)))


def written_node(parts: Parts, text: str) -> ObjectNode:
    """Return the object node that a text describes, with the brackets of files; raise `QueryError`."""
    if not parts.label:
        raise QueryError(f"{said(text)} names no object; write {FORM}")
    node = node_of(parts)
    return ObjectNode.of(node.label, map(_as_in_files, node.states))


def _as_in_files(state: State) -> State:
    """Return a state with the brackets that it has in files: a place in `[]`, contents in `{}`."""
    if state.name == "contains" and state.relatum is not None and state.contents is None:
        return contains(*filter(None, map(tidy, state.relatum.split(","))))
    if state.name in PLACES and state.relatum is None and state.contents and len(state.contents) == 1:
        return State(state.name, state.contents[0])
    return state
