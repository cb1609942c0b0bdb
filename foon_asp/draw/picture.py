"""A picture as data: object nodes, motions and what leads where, before anybody says where they stand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum


class Role(StrEnum):
    """What a node of a picture is; each has its own shape, colours and outline."""

    MADE = "made"
    """An object node that a drawn unit makes."""
    AT_HAND = "at-hand"
    """An object node of the kitchen, or one that nothing drawn makes."""
    LEFT = "left"
    """An object node that is made and that nothing drawn needs."""
    MISSING = "missing"
    """An object node that is needed, and is not there."""
    MOTION = "motion"
    """A functional unit: its motion, its step and its tools."""
    BLOCKED = "blocked"
    """A functional unit that cannot be executed, or of which something is wrong."""
    DISH = "dish"
    """A dish of an overview."""
    SHARED = "shared"
    """What several dishes of an overview share."""
    POINT = "point"
    """A point of a plot."""
    NOTE = "note"
    """Words beside the rest."""

    @property
    def is_object(self) -> bool:
        """Whether it is drawn round, as the field draws object nodes."""
        return self in (Role.MADE, Role.AT_HAND, Role.LEFT, Role.MISSING, Role.SHARED, Role.DISH)


class Side(StrEnum):
    """In which of two trees something is, where two are drawn over each other."""

    ALONE = "alone"
    """There is only one tree."""
    BOTH = "both"
    HERE = "here"
    """Only in the first one."""
    THERE = "there"
    """Only in the second one."""


@dataclass(frozen=True, slots=True)
class Node:
    """A node: `head` in bold, `details` below it, a `mark` above it in small letters.

    `key` names it in its picture: a letter and a number. `title` is all that there is to say of it, its whole
    label first. `url` leads to where it was filmed, http or https, or is empty. A `goal` has a double line
    around it. `place` is where its middle stands, in points from the top left, if that is settled.
    """

    key: str
    role: Role
    head: str
    details: tuple[str, ...] = ()
    mark: str = ""
    title: str = ""
    url: str = ""
    goal: bool = False
    side: Side = Side.ALONE
    place: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class Edge:
    """An arrow from the node with the key `tail` to that with `head`.

    `strong` ones are drawn thick: they are what the picture is about. A `line` has no head: it leads nowhere.
    """

    tail: str
    head: str
    title: str = ""
    side: Side = Side.ALONE
    strong: bool = False
    line: bool = False


@dataclass(frozen=True, slots=True)
class Picture:
    """What is drawn. `title` is said above it, `summary` is all in a sentence for who cannot see it.

    If every node has a place, it is drawn there; else Graphviz finds places: in rows from cause to effect,
    from the top to the bottom, or with `sideways` from left to right, with a `gap` of so many inches between
    two rows.
    """

    title: str
    summary: str
    nodes: Sequence[Node]
    edges: Sequence[Edge]
    sideways: bool = False
    gap: float = 0.32

    @property
    def settled(self) -> bool:
        """Whether every node has its place."""
        return bool(self.nodes) and all(node.place is not None for node in self.nodes)
