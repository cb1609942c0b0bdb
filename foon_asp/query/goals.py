"""Goals as people write them: `LABEL [state, state] {content, content} in CONTAINER`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectNode, State, contains
from foon_asp.model.notation import FORM, PLACES, Parts, read_object, tidy
from foon_asp.model.world import World
from foon_asp.values import said
from foon_asp.words import closest, cut, shortened

_SHOWN = 5
_REMEMBERED = 10_000
"""How many goal texts a world remembers."""
_LONGEST = 1_000
"""How many characters a goal text has at most that a world remembers."""

Named = ObjectNode | str
"""An object, or a text that names one as on the command line."""


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


def find_goal(world: World, text: str) -> ObjectNode:
    """Return the object node that a goal names.

    An object that is just what the text says is meant. Else parts that are left out may be anything, as long
    as one node fits; if several do, one of the goals of the world (those of a data folder) wins. Write `[]`
    or `{}` to say that a node has none. Raises `QueryError` for an unknown or ambiguous goal, with the
    closest matches.
    """
    if not text.strip():
        raise QueryError(f"the goal is empty; write {FORM}")
    exact = _exactly(world, text)
    if exact is not None:
        return exact
    pattern = Pattern.of(read_object(text, world.labels))
    same_label = world.foon.labelled(pattern.label)
    same_label += [node for node in world.strangers if node.label == pattern.label]
    if not same_label:
        raise _unknown_label(world, text, pattern.label)
    fitting = [node for node in same_label if pattern.matches(node, exactly=False)]
    for choice in _narrower(world, pattern, fitting):
        if len(choice) == 1:
            return choice[0]
    if fitting:
        raise QueryError(f"ambiguous goal {said(text)}: {shortened(fitting, _SHOWN, ';')}")
    raise QueryError(
        f"unknown goal {said(text)}; with this label there is {shortened(same_label, _SHOWN, ';')}"
    )


def _exactly(world: World, text: str) -> ObjectNode | None:
    """Return the object node that is just what a text says, if there is one."""
    try:
        node = world.units.stand_in(_node(read_object(text)))
    except QueryError:
        return None
    return node if world.foon.id_of(node) is not None or node in world.strangers else None


def _node(parts: Parts) -> ObjectNode:
    states = [State(name) for name in parts.states or ()]
    states += [contains(*each) for each in parts.contents or ()]
    return ObjectNode.of(parts.label, (*states, *(State(*other) for other in parts.others)))


def _narrower(world: World, pattern: Pattern, fitting: list[ObjectNode]) -> Iterator[list[ObjectNode]]:
    """Yield the nodes that are more likely meant, of those that fit; the likeliest first."""
    named = set(world.goals)
    for nodes in ([node for node in fitting if node in named], fitting):
        exact = [node for node in nodes if pattern.matches(node, exactly=True)]
        for each in (exact, nodes):
            yield each
            yield [node for node in each if not node.bare]


def _unknown_label(world: World, text: str, label: str) -> QueryError:
    """Say that no object has a label, and what may be meant."""
    begins = [known for known in world.labels if label.startswith(known + " ")]
    if begins:
        known = max(begins, key=len)
        rest = label.removeprefix(known).strip()
        hint = f"; states go into brackets: '{cut(f'{known} [{rest}]')}'"
    else:
        hint = closest(label, world.labels)
    return QueryError(f"unknown goal {said(text)}: no object has this label{hint}")


def written_object(text: str) -> ObjectNode:
    """Return the object node that a text describes, whether a FOON knows it or not.

    Parts that are left out are not there: `onion` has no state. Raises `QueryError`.
    """
    check_named(text)
    parts = read_object(text)
    if not parts.label:
        raise QueryError(f"{said(text)} names no object; write {FORM}")
    node = _node(parts)
    return ObjectNode.of(node.label, map(_as_in_files, node.states))


def _as_in_files(state: State) -> State:
    """Return a state with the brackets that it has in files: a place in `[]`, contents in `{}`."""
    if state.name == "contains" and state.relatum is not None and state.contents is None:
        return contains(*filter(None, map(tidy, state.relatum.split(","))))
    if state.name in PLACES and state.relatum is None and state.contents and len(state.contents) == 1:
        return State(state.name, state.contents[0])
    return state


def find_object(world: World, named: Named) -> ObjectNode:
    """Return the object that is meant, seen on the level of a world: a node is itself, a text names one.

    A text may name an object of the level, or else one of the full level. Raises `QueryError`.
    """
    if isinstance(named, ObjectNode):
        return world.project(named)
    check_named(named)
    found = world.remembered.get(named)
    if found is None:
        try:
            found = find_goal(world, named)
        except QueryError:
            if world.full is world:
                raise
            found = world.project(find_goal(world.full, named))
        if len(world.remembered) >= _REMEMBERED:
            world.remembered.clear()
        if len(named) <= _LONGEST:
            world.remembered[named] = found
    return found


def check_named(named: object, what: str = "an object") -> None:
    """Raise `QueryError` if a value is neither an object node nor a text."""
    if not isinstance(named, ObjectNode | str):
        raise QueryError(f"{what} is a text or an ObjectNode, not {said(named)}")
