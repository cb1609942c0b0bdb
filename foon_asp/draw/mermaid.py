"""Pictures as flow charts of Mermaid, which many pages draw from text. Labels are data, as in all formats."""

from __future__ import annotations

from collections.abc import Iterator

from foon_asp.draw.boxes import box
from foon_asp.draw.colours import LIGHT, Colours, style
from foon_asp.draw.picture import Node, Picture, Role, Side

_PLAIN = frozenset(" ,.:()[]{}'+/")
"""What stands for itself in a label, beside letters and digits."""


def mermaid_text(picture: Picture, colours: Colours = LIGHT) -> str:
    """Return a picture as a flow chart of Mermaid."""
    return "".join(f"{line}\n" for line in _lines(picture, colours))


def _lines(picture: Picture, colours: Colours) -> Iterator[str]:
    if picture.title:
        # YAML: a text in quotes, in which all that is odd is escaped as in JSON.
        yield from ("---", f'title: "{_yaml(picture.title)}"', "---")
    yield f"flowchart {'LR' if picture.sideways else 'TB'}"
    for node in picture.nodes:
        left, right = _SHAPES.get(node.role, ("([", "])") if node.role.is_object else ("[", "]"))
        yield f'  {node.key}{left}"{_label(node)}"{right}'
    for edge in picture.edges:
        arrow = "---" if edge.line else "-.->" if edge.side is Side.THERE else "==>" if edge.strong else "-->"
        yield f"  {edge.tail} {arrow} {edge.head}"
    for node in picture.nodes:
        if node.url:
            yield f'  click {node.key} href "{_url(node.url)}" "{escaped(node.title)}" _blank'
    groups: dict[str, list[str]] = {}
    for node in picture.nodes:
        look = style(colours, node.role, node.side)
        width = max(look.width, 4.0 if node.goal else 0.0)
        dashes = f",stroke-dasharray:{look.dashes}" if look.dashes else ""
        words = f"fill:{look.fill},color:{look.ink},stroke:{look.line},stroke-width:{width:g}px{dashes}"
        groups.setdefault(words, []).append(node.key)
    for number, (words, keys) in enumerate(groups.items()):
        yield f"  classDef look{number} {words}"
        yield f"  class {','.join(keys)} look{number}"


_SHAPES = {Role.POINT: ("((", "))")}


def _label(node: Node) -> str:
    # Markdown would make a list of what begins with `1.`.
    return "<br/>".join(escaped(line.text) for line in box(node).lines) or " "


def escaped(text: str) -> str:
    """Return a text as it can stand in quotes: all that might mean something is a number of a character."""
    return "".join(
        letter if letter.isalnum() or letter in _PLAIN else " " if letter == "\n" else f"#{ord(letter)};"
        for letter in text
    )


def _url(url: str) -> str:
    return url.replace('"', "%22").replace("<", "%3C").replace(">", "%3E").replace(" ", "%20")


def _yaml(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
