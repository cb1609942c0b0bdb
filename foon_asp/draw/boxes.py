"""How large a node is: its lines of text, measured without any font, so that all machines agree."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from functools import lru_cache

from foon_asp.draw.picture import Node, Role

HEAD, SMALL = 13.0, 11.0
"""Sizes of letters, in points."""

FONTS = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
"""Fonts in the order in which they are tried."""

_LEADING = 1.25
_MARGIN_X, _MARGIN_Y = 11.0, 6.0
_LEAST = 30.0

_WIDTHS = {
    **dict.fromkeys("il'|", 0.29),
    **dict.fromkeys("jI.,:; ", 0.33),
    **dict.fromkeys("ftr()[]-/!", 0.41),
    **dict.fromkeys("ckszvxy", 0.58),
    **dict.fromkeys("mMW%@", 1.0),
    **dict.fromkeys("wGOQDHNU", 0.82),
}
"""Widths of letters in parts of their size, those of DejaVu Sans, which is wider than most."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a node: its text, the size of its letters in points, and how heavy they are."""

    text: str
    size: float
    bold: bool = False

    @property
    def height(self) -> float:
        """How high it is, with the space to the next one, in points."""
        return self.size * _LEADING

    @property
    def width(self) -> float:
        """How wide it is at most, in points."""
        return text_width(self.text) * self.size * (1.08 if self.bold else 1.0)


@dataclass(frozen=True, slots=True)
class Box:
    """A node as it is drawn: lines of text, and its width and height in points."""

    lines: tuple[Line, ...]
    width: float
    height: float


@lru_cache(maxsize=4096)
def text_width(text: str) -> float:
    """Return how wide a text is at most, in parts of the size of its letters."""
    return sum(_letter_width(letter) for letter in text)


def _letter_width(letter: str) -> float:
    if letter in _WIDTHS:
        return _WIDTHS[letter]
    if unicodedata.combining(letter):
        return 0.0
    if unicodedata.east_asian_width(letter) in "WF":
        return 1.05
    return 0.74 if letter.isupper() else 0.64


def box(node: Node) -> Box:
    """Return a node as it is drawn."""
    if node.role is Role.POINT:
        return Box((), 12.0, 12.0)
    small = [Line(text, SMALL) for text in node.details]
    lines = ([Line(node.mark, SMALL)] if node.mark else []) + [Line(node.head, HEAD, True), *small]
    if not node.head:
        lines = [line for line in lines if line.text]
    width = max((line.width for line in lines), default=0.0)
    height = sum(line.height for line in lines)
    if node.role is Role.NOTE:
        return Box(tuple(lines), round(width + 4), round(height + 2))
    # Round ends take room from the first and the last line.
    margin = _MARGIN_X + (5.0 if node.role.is_object else 0.0)
    width = max(width + 2 * margin, _LEAST)
    return Box(tuple(lines), float(round(width)), float(round(max(height + 2 * _MARGIN_Y, _LEAST))))
