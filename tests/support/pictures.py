"""Pictures of the pages, and what of an SVG is the same on all machines."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

PLACES = {"x", "y", "d", "points", "transform", "width", "height", "viewBox"}
"""Attributes that say where something stands. Another version of Graphviz may put it elsewhere."""

SVG = "{http://www.w3.org/2000/svg}"


def shown(page: Path) -> list[Path]:
    """Return the pictures that a page shows."""
    text = page.read_text(encoding="utf-8")
    return [page.parent / name for name in re.findall(r"!\[[^\]]*\]\(([^)]+\.svg)\)", text)]


def skeleton(svg: str) -> list[tuple[str, dict[str, str], str]]:
    """Return the elements of an SVG in their order: tag, attributes, text; where they stand is left out."""
    return [
        (
            each.tag.removeprefix(SVG),
            {name: value for name, value in each.attrib.items() if name not in PLACES},
            (each.text or "").strip(),
        )
        for each in ElementTree.fromstring(svg).iter()
    ]


def titles(svg: str) -> list[str]:
    """Return the titles of all nodes and arrows of an SVG, not that of the whole."""
    return [each.findtext(f"{SVG}title", "") for each in ElementTree.fromstring(svg).iter(f"{SVG}g")][1:]
