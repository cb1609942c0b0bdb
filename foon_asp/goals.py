"""Goals as people write them: `LABEL [state, state] {content, content} in CONTAINER`."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from foon_asp.errors import QueryError, closest
from foon_asp.graph import ObjectNode
from foon_asp.levels import FULL
from foon_asp.problem import Domain
from foon_asp.state_syntax import PLACES

_PART = re.compile(
    r"\s*(?:"
    r"\[(?P<states>[^\[\]]*)\]"
    r"|\{(?P<contents>[^{}]*)\}"
    r"|(?P<name>[^\[\]{}]+?)\s*(?:\[(?P<relatum>[^\[\]]*)\]|\{(?P<other>[^{}]*)\})"
    r")\s*"
)
_PLACE = re.compile(r"\s+(?P<name>" + "|".join(sorted(PLACES)) + r")\s+(?P<relatum>[^\[\]{}]+?)\s*$")
_SHOWN = 5


@dataclass(frozen=True, slots=True)
class Pattern:
    """What a goal says; a part that is None was left out."""

    label: str
    states: frozenset[str] | None = None
    contents: tuple[str, ...] | None = None
    others: frozenset[str] | None = None

    def matches(self, node: ObjectNode, *, exactly: bool) -> bool:
        """Does a node fit all parts that were said? `exactly` allows nothing more within a part."""
        if node.label != self.label:
            return False
        said: list[tuple[Iterable[str] | None, Iterable[str]]] = [
            (self.states, node.plain_states),
            (self.contents, node.contents),
            (self.others, _others(node)),
        ]
        for part, there in said:
            if part is None:
                continue
            if exactly and sorted(part) != sorted(there):
                return False
            if not (exactly or set(part) <= set(there)):
                return False
        return True


def _others(node: ObjectNode) -> list[str]:
    """Return the states of a node that are neither plain nor `contains {…}`, as they are written."""
    return [
        str(state)
        for state in node.states
        if not state.plain and (state.name != "contains" or state.contents is None)
    ]


def find_goal(domain: Domain, text: str, preferred: Iterable[ObjectNode] = ()) -> ObjectNode:
    """Return the object node that a goal names.

    Parts that are left out may be anything, as long as one node fits; if several do, one of the
    `preferred` nodes (the goals of a data folder) wins. Write `[]` or `{}` to say that a node has none.
    Raises `QueryError` for an unknown or ambiguous goal, with the closest matches.
    """
    labels = domain.foon.labels.union(node.label for node in domain.strangers)
    whole = " ".join(text.lower().split())
    if not whole:
        raise QueryError("the goal is empty; write LABEL [state] {content} in CONTAINER")
    pattern = _parse(whole, labels)
    same_label = domain.foon.labelled(pattern.label)
    same_label += [node for node in domain.strangers if node.label == pattern.label]
    if not same_label:
        begins = [label for label in labels if pattern.label.startswith(label + " ")]
        if begins:
            label = max(begins, key=len)
            rest = pattern.label.removeprefix(label).strip()
            raise QueryError(
                f"unknown goal {text!r}: no object has this label;"
                f" states go into brackets: '{label} [{rest}]'"
            )
        raise QueryError(f"unknown goal {text!r}: no object has this label{closest(pattern.label, labels)}")
    for exactly in (True, False):
        fitting = [node for node in same_label if pattern.matches(node, exactly=exactly)]
        for choice in _narrower(fitting, preferred):
            if len(choice) == 1:
                return choice[0]
        if fitting:
            raise QueryError(f"ambiguous goal {text!r}: {_listed(fitting)}")
    raise QueryError(f"unknown goal {text!r}; with this label there is {_listed(same_label)}")


def find_on_level(
    domain: Domain, text: str, goals: Iterable[ObjectNode], full: Callable[[], Domain]
) -> ObjectNode:
    """Return the goal that a text names on the level of the domain, or else on the full level, projected.

    `goals` are those of the data folder, on the full level, of which `full` returns the domain. Raises
    `QueryError`.
    """
    goals = list(goals)
    try:
        return find_goal(domain, text, [domain.project(goal) for goal in goals])
    except QueryError:
        if domain.level == FULL:
            raise
        return domain.project(find_goal(full(), text, goals))


def _narrower(fitting: list[ObjectNode], preferred: Iterable[ObjectNode]) -> Iterator[list[ObjectNode]]:
    """Yield the nodes that fit, then those among them that are more likely meant."""
    yield fitting
    yield [node for node in fitting if not node.bare]
    named = set(preferred)
    yield [node for node in fitting if node in named]


def _listed(nodes: list[ObjectNode]) -> str:
    shown = "; ".join(str(node) for node in nodes[:_SHOWN])
    return shown + (f"; and {len(nodes) - _SHOWN} more" if len(nodes) > _SHOWN else "")


def _parse(text: str, labels: set[str]) -> Pattern:
    """Split a goal into its parts. The label is the longest known one that the text begins with."""
    begins = [known for known in labels if text == known or text.startswith((known + " ", known + "["))]
    if begins:
        label = max(begins, key=len)
    else:
        match = re.match(r"[^\[\]{}]*", text)
        label = (match[0] if match else "").strip()
        place = _PLACE.search(label)
        if place:
            label = label[: place.start()].strip()
    rest = text[len(label) :]
    if begins and rest and not re.search(r"[\[\]{}]", rest) and not _readable(rest):
        # "ice cream" begins with the label "ice" but is another thing.
        label, rest = text, ""
    return _parts(label, rest, text)


def _readable(rest: str) -> bool:
    place = _PLACE.search(rest)
    if place:
        rest = rest[: place.start()]
    while rest.strip():
        match = _PART.match(rest)
        if match is None:
            return False
        rest = rest[match.end() :]
    return True


def _parts(label: str, rest: str, text: str) -> Pattern:
    states: frozenset[str] | None = None
    contents: tuple[str, ...] | None = None
    others: set[str] = set()
    place = _PLACE.search(rest)
    if place:
        others.add(f"{place['name']} [{place['relatum']}]")
        rest = rest[: place.start()]
    while rest.strip():
        match = _PART.match(rest)
        if match is None:
            raise QueryError(
                f"cannot read {rest.strip()!r} in the goal {text!r};"
                " write LABEL [state, state] {content, content} in CONTAINER"
            )
        if match["states"] is not None:
            states = frozenset(_items(match["states"]))
        elif match["contents"] is not None:
            contents = tuple(sorted(_items(match["contents"])))
        elif match["relatum"] is not None:
            others.add(f"{match['name'].strip()} [{match['relatum'].strip()}]")
        else:
            contained = ", ".join(sorted(_items(match["other"])))
            others.add(f"{match['name'].strip()} {{{contained}}}")
        rest = rest[match.end() :]
    if others and (common := [o for o in others if o.startswith("contains {")]):
        contents = tuple(sorted(_items(common[0].removeprefix("contains {").removesuffix("}"))))
        others -= set(common)
    return Pattern(label, states, contents, frozenset(others) if others else None)


def _items(text: str) -> list[str]:
    return [item.strip() for item in text.split(",") if item.strip()]
