"""Goals as people write them: `LABEL [state, state] {content, content} in CONTAINER`."""

from __future__ import annotations

from foon_asp.errors import QueryError
from foon_asp.model.lookup import Pattern, likeliest, node_of, written_node
from foon_asp.model.node import ObjectNode
from foon_asp.model.notation import FORM, read_object
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
    meant = likeliest(pattern, fitting, world.goals)
    if meant is not None:
        return meant
    if fitting:
        raise QueryError(f"ambiguous goal {said(text)}: {shortened(fitting, _SHOWN, ';')}")
    raise QueryError(
        f"unknown goal {said(text)}; with this label there is {shortened(same_label, _SHOWN, ';')}"
    )


def _exactly(world: World, text: str) -> ObjectNode | None:
    """Return the object node that is just what a text says, if there is one."""
    try:
        node = world.units.stand_in(node_of(read_object(text)))
    except QueryError:
        return None
    return node if world.foon.id_of(node) is not None or node in world.strangers else None


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
    return written_node(read_object(text), text)


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
