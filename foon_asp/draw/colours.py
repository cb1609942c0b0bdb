"""The colours of pictures, on light paper and on dark: of letters on what is below them at least 4.5 to 1."""

from __future__ import annotations

from dataclasses import dataclass

from foon_asp.draw.picture import Edge, Role, Side


@dataclass(frozen=True, slots=True)
class Style:
    """How a node is drawn: its colours, how thick its outline is in points, and in which dashes."""

    fill: str
    ink: str
    line: str
    width: float = 1.2
    dashes: str = ""


@dataclass(frozen=True, slots=True)
class Colours:
    """All colours of a picture: paper, letters on it, arrows (usual, strong, faint), and each role."""

    name: str
    paper: str
    ink: str
    arrow: str
    strong: str
    faint: str
    roles: dict[Role, Style]
    pale: dict[bool, Style]
    """What two trees share: motions under `False`, object nodes under `True`."""


LIGHT = Colours(
    "light",
    paper="#ffffff",
    ink="#1b211b",
    arrow="#5c6b5c",
    strong="#9a3412",
    faint="#c9d1c9",
    roles={
        Role.MADE: Style("#2e7d32", "#ffffff", "#1b5e20"),
        Role.AT_HAND: Style("#e3f3e3", "#1c4a1f", "#4c9a50"),
        Role.LEFT: Style("#ffffff", "#3c5a3e", "#5c8a5f", 1.0, "2 3"),
        Role.MISSING: Style("#fff1dc", "#6b3105", "#b45309", 2.2, "6 3"),
        Role.MOTION: Style("#b71c1c", "#ffffff", "#7f1010"),
        Role.BLOCKED: Style("#fdecea", "#7f1010", "#b71c1c", 2.6, "6 3"),
        Role.DISH: Style("#2e7d32", "#ffffff", "#1b5e20"),
        Role.SHARED: Style("#e3f3e3", "#1c4a1f", "#4c9a50"),
        Role.POINT: Style("#b71c1c", "#1b211b", "#7f1010"),
        Role.NOTE: Style("#ffffff", "#1b211b", "#ffffff", 0.0),
    },
    pale={
        True: Style("#f0f3f0", "#3f4a3f", "#8a978a", 1.0),
        False: Style("#f5efef", "#4f4242", "#9c8a8a", 1.0),
    },
)

DARK = Colours(
    "dark",
    paper="#121612",
    ink="#e7ece7",
    arrow="#a3b0a3",
    strong="#fdba74",
    faint="#3a443a",
    roles={
        Role.MADE: Style("#2e7d32", "#ffffff", "#86cf8a"),
        Role.AT_HAND: Style("#1d3320", "#cfe9d0", "#5fae63"),
        Role.LEFT: Style("#121612", "#b9cfba", "#86a888", 1.0, "2 3"),
        Role.MISSING: Style("#3b2810", "#ffd9a8", "#fb9a3c", 2.2, "6 3"),
        Role.MOTION: Style("#b3261e", "#ffffff", "#f2a19c"),
        Role.BLOCKED: Style("#3a1513", "#ffd2ce", "#f2766d", 2.6, "6 3"),
        Role.DISH: Style("#2e7d32", "#ffffff", "#86cf8a"),
        Role.SHARED: Style("#1d3320", "#cfe9d0", "#5fae63"),
        Role.POINT: Style("#f2766d", "#e7ece7", "#f2a19c"),
        Role.NOTE: Style("#121612", "#e7ece7", "#121612", 0.0),
    },
    pale={
        True: Style("#232823", "#c3ccc3", "#727e72", 1.0),
        False: Style("#2c2525", "#d0c3c3", "#857575", 1.0),
    },
)

DASHES = {Side.ALONE: "", Side.BOTH: "", Side.HERE: "", Side.THERE: "7 4"}
"""The dashes of what is in one of two trees."""


def arrow_colour(colours: Colours, edge: Edge) -> str:
    """Return the colour of an arrow or a line."""
    return colours.strong if edge.strong else colours.faint if edge.line else colours.arrow


def style(colours: Colours, role: Role, side: Side) -> Style:
    """Return how a node of a role is drawn that is in one of two trees, or in both."""
    if side is Side.BOTH:
        return colours.pale[role.is_object]
    found = colours.roles[role]
    if side is Side.ALONE:
        return found
    return Style(found.fill, found.ink, found.line, 2.4, DASHES[side])
