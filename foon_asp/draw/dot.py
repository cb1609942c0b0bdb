"""Pictures as DOT, the language of Graphviz. Labels are data: whatever they hold stays inside quotes."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from foon_asp.draw.boxes import Box, box
from foon_asp.draw.colours import LIGHT, Colours, arrow_colour, style
from foon_asp.draw.legal import legal
from foon_asp.draw.picture import Edge, Node, Picture, Role, Side

_POINTS = 72
"""Points of an inch, in which Graphviz has widths and heights."""


def dot_text(picture: Picture, colours: Colours = LIGHT, *, bare: bool = False) -> str:
    """Return a picture as DOT; `bare` leaves out all that does not matter for where things stand."""
    return "".join(f"{line}\n" for line in _lines(picture, colours, bare))


def program(picture: Picture) -> str:
    """Return which program of Graphviz lays a picture out."""
    return "nop" if picture.settled else "dot"


def _lines(picture: Picture, colours: Colours, bare: bool) -> Iterator[str]:
    yield "digraph foon {"
    yield f"  graph [{_attributes(_graph(picture, colours, bare))}];"
    yield '  node [shape="box", fixedsize="true"];'
    yield '  edge [arrowsize="0.8"];'
    height = max((node.place[1] for node in picture.nodes if node.place is not None), default=0.0)
    for node in picture.nodes:
        yield f"  {node.key} [{_attributes(_node(node, box(node), colours, bare, height))}];"
    for number, edge in enumerate(picture.edges):
        yield f"  {edge.tail} -> {edge.head} [{_attributes(_edge(number, edge, colours, bare))}];"
    yield "}"


def _graph(picture: Picture, colours: Colours, bare: bool) -> dict[str, str]:
    found = {"rankdir": "LR" if picture.sideways else "TB", "nodesep": "0.22", "ranksep": f"{picture.gap:g}"}
    if picture.settled:
        # Whatever program of Graphviz is asked leaves everything where it is.
        found |= {"layout": "nop", "splines": "line"}
    if bare:
        return found
    return {
        **found,
        "charset": "UTF-8",
        "bgcolor": colours.paper,
        "fontcolor": colours.ink,
        "fontname": "Helvetica",
        "labelloc": "t",
        "label": picture.title,
        "tooltip": picture.summary,
        "pad": "0.17",
    }


def _node(node: Node, size: Box, colours: Colours, bare: bool, height: float) -> dict[str, str]:
    found = {"width": f"{size.width / _POINTS:.4f}", "height": f"{size.height / _POINTS:.4f}"}
    if node.place is not None:
        found["pos"] = f"{node.place[0]:.2f},{height - node.place[1]:.2f}"
    if node.goal:
        found["peripheries"] = "2"
    if bare:
        return {**found, "label": ""}
    look = style(colours, node.role, node.side)
    styles = ["filled"]
    if node.role.is_object:
        styles.append("rounded")
    if look.dashes:
        styles.append("dotted" if look.dashes.startswith("2") else "dashed")
    found |= {
        "style": ",".join(styles),
        "fillcolor": look.fill,
        "color": look.line,
        "fontcolor": look.ink,
        "fontname": "Helvetica",
        "penwidth": f"{look.width:g}",
        "label": _label(size),
        "tooltip": node.title or node.head,
    }
    if node.role is Role.POINT:
        found["shape"] = "circle"
    if node.role is Role.NOTE:
        found |= {"shape": "plaintext", "style": ""}
    if node.url:
        found["URL"] = node.url
    return found


def _edge(number: int, edge: Edge, colours: Colours, bare: bool) -> dict[str, str]:
    found = {"id": f"e{number}"}
    if edge.line:
        found["arrowhead"] = "none"
    if bare:
        return found
    if edge.title:
        found["tooltip"] = edge.title
    if edge.strong:
        found["penwidth"] = "2.4"
    found["color"] = arrow_colour(colours, edge)
    if edge.side is Side.THERE:
        found["style"] = "dashed"
    return found


class _Html(str):
    """A label that is HTML already."""

    __slots__ = ()


def _label(size: Box) -> str:
    lines = []
    for line in size.lines:
        text = escape(legal(line.text), quote=False)
        bold = f"<B>{text}</B>" if line.bold else text
        lines.append(f'<FONT POINT-SIZE="{line.size:g}">{bold}</FONT>')
    return _Html("<BR/>".join(lines)) if lines else ""


def _attributes(found: dict[str, str]) -> str:
    return ", ".join(f"{name}={_value(value)}" for name, value in found.items())


def _value(text: str) -> str:
    if isinstance(text, _Html):
        return f"<{text}>"
    return quoted(text)


def quoted(text: str) -> str:
    r"""Return a text in quotes, as DOT has it: what Graphviz would read as `\N` is read as it stands."""
    found = legal(text).replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{found}"'
