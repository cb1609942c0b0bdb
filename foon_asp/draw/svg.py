"""Pictures as SVG. Every node and every arrow has a title; colours follow the reader's, light or dark."""

from __future__ import annotations

import math
from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from foon_asp.draw.boxes import FONTS, Box, text_width
from foon_asp.draw.colours import DARK, DASHES, LIGHT, Style, arrow_colour, style
from foon_asp.draw.layout import Arrow, Layout, Point, laid_out
from foon_asp.draw.legal import legal
from foon_asp.draw.picture import Edge, Node, Picture, Role, Side

_TIP_LENGTH, _TIP_WIDTH = 8.8, 3.4
_ROUND = 15.0
_BASELINE = 0.8
"""Where the letters of a line stand, in parts of their size below its top."""

_TITLE = 15.0


def svg_text(picture: Picture, *, dark: bool | None = None) -> str:
    """Return a picture as SVG: on dark paper, on light, or (None) on what the reader prefers.

    Raises `QueryError` if Graphviz cannot be had, and `LimitReachedError`.
    """
    return _Svg(picture, laid_out(picture), dark).text()


class _Svg:
    """A picture that is being written."""

    def __init__(self, picture: Picture, layout: Layout, dark: bool | None) -> None:
        self._picture = picture
        self._layout = layout
        self._colours = DARK if dark else LIGHT
        self._follows = dark is None

    def text(self) -> str:
        """Return the document."""
        picture, layout, colours = self._picture, self._layout, self._colours
        above = 2.2 * _TITLE if picture.title else 0.0
        width = max(layout.width, text_width(picture.title) * _TITLE * 1.08 + 24)
        height = layout.height + above
        size = {"width": _n(width), "height": _n(height), "viewBox": f"0 0 {_n(width)} {_n(height)}"}
        root = Element("svg", {"xmlns": "http://www.w3.org/2000/svg", **size})
        # Who listens to an image hears nothing of the links in it.
        root.set("role", "group" if any(node.url for node in picture.nodes) else "img")
        root.set("font-family", FONTS)
        if picture.title:
            SubElement(root, "title").text = legal(picture.title)
        SubElement(root, "desc").text = legal(picture.summary)
        if self._follows:
            SubElement(root, "style").text = _followed(picture)
        paper = SubElement(root, "rect", {"width": _n(width), "height": _n(height), "fill": colours.paper})
        self._named(paper, "paper")
        if picture.title:
            place = {"x": _n(width / 2), "y": _n(1.6 * _TITLE), "text-anchor": "middle"}
            letters = {"font-size": _n(_TITLE), "font-weight": "bold", "fill": colours.ink}
            head = SubElement(root, "text", {**place, **letters})
            head.text = legal(picture.title)
            self._named(head, "ink")
        shift = {"transform": f"translate({_n((width - layout.width) / 2)} {_n(above)})"}
        group = SubElement(root, "g", shift)
        for edge, arrow in zip(picture.edges, layout.arrows, strict=True):
            self._arrow(group, edge, arrow)
        for node in picture.nodes:
            self._node(group, node, layout.boxes[node.key], layout.places[node.key])
        indent(root, "")
        return tostring(root, encoding="unicode") + "\n"

    def _named(self, element: Element, name: str) -> None:
        """Give an element a class, by which dark paper gives it other colours."""
        if self._follows:
            element.set("class", f"foon-{name}")

    def _arrow(self, group: Element, edge: Edge, arrow: Arrow) -> None:
        colour = arrow_colour(self._colours, edge)
        both = SubElement(group, "g", {"fill": "none", "stroke": colour})
        both.set("stroke-width", "2.4" if edge.strong else "1.1")
        self._named(both, _arrow_class(edge))
        if edge.title:
            SubElement(both, "title").text = legal(edge.title)
        path = SubElement(both, "path", {"d": _path(arrow.curve)})
        if DASHES[edge.side]:
            path.set("stroke-dasharray", DASHES[edge.side])
        if arrow.tip is not None:
            tip = SubElement(both, "polygon", {"points": _tip(arrow.curve[-1], arrow.tip)})
            tip.set("fill", colour)
            self._named(tip, f"tip-{_arrow_class(edge)}")

    def _node(self, group: Element, node: Node, size: Box, place: Point) -> None:
        look = style(self._colours, node.role, node.side)
        whole = SubElement(group, "g")
        self._named(whole, _class(node))
        SubElement(whole, "title").text = legal(node.title or node.head)
        inside = whole
        if node.url:
            inside = SubElement(whole, "a", {"href": node.url, "target": "_blank", "rel": "noopener"})
        x, y = place
        if node.role is Role.POINT:
            circle = SubElement(inside, "circle", {"cx": _n(x), "cy": _n(y), "r": _n(size.width / 2)})
            _paint(circle, look)
        elif node.role is not Role.NOTE:
            if node.goal:
                _paint(_rectangle(inside, node, size, place, 4.0), Style("none", "", look.line, 1.6))
            _paint(_rectangle(inside, node, size, place, 0.0), look)
        top = y - sum(line.height for line in size.lines) / 2
        for line in size.lines:
            spot = {"x": _n(x), "y": _n(top + line.size * (_BASELINE + 0.22)), "text-anchor": "middle"}
            text = SubElement(inside, "text", {**spot, "font-size": _n(line.size), "fill": look.ink})
            if line.bold:
                text.set("font-weight", "bold")
            text.text = legal(line.text)
            top += line.height


def _n(number: float) -> str:
    """Return a number as short as a picture needs it."""
    return f"{number:.2f}".rstrip("0").rstrip(".")


def _class(node: Node) -> str:
    if node.side is Side.BOTH:
        return "pale-object" if node.role.is_object else "pale-motion"
    return node.role.value


def _arrow_class(edge: Edge) -> str:
    return "strong" if edge.strong else "faint" if edge.line else "arrow"


def _rectangle(parent: Element, node: Node, size: Box, place: Point, wider: float) -> Element:
    width, height = size.width + 2 * wider, size.height + 2 * wider
    corner = {"x": _n(place[0] - width / 2), "y": _n(place[1] - height / 2)}
    found = SubElement(parent, "rect", {**corner, "width": _n(width), "height": _n(height)})
    if node.role.is_object:
        found.set("rx", _n(min(height / 2, _ROUND + wider)))
    return found


def _paint(element: Element, look: Style) -> None:
    element.set("fill", look.fill)
    element.set("stroke", look.line)
    element.set("stroke-width", _n(look.width))
    if look.dashes:
        element.set("stroke-dasharray", look.dashes)


def _path(curve: Sequence[Point]) -> str:
    def spot(point: Point) -> str:
        return f"{_n(point[0])} {_n(point[1])}"

    first, *rest = curve
    kind = "C" if len(rest) % 3 == 0 else "L"
    return f"M{spot(first)}{kind}{' '.join(map(spot, rest))}"


def _tip(behind: Point, tip: Point) -> str:
    """Return the head of an arrow that ends at a tip, coming from behind."""
    angle = math.atan2(tip[1] - behind[1], tip[0] - behind[0])
    along, across = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    base = (tip[0] - _TIP_LENGTH * along[0], tip[1] - _TIP_LENGTH * along[1])
    corners = [tip, *((base[0] + s * across[0], base[1] + s * across[1]) for s in (_TIP_WIDTH, -_TIP_WIDTH))]
    return " ".join(f"{_n(x)},{_n(y)}" for x, y in corners)


def _followed(picture: Picture) -> str:
    """Return the rules that give all elements that there are their colours on dark paper."""
    rules = [
        _rule(".foon-paper", f"fill:{DARK.paper}"),
        _rule(".foon-ink", f"fill:{DARK.ink}"),
        *_arrow_rules("arrow", DARK.arrow),
        *_arrow_rules("strong", DARK.strong),
        *_arrow_rules("faint", DARK.faint),
    ]
    looks = {_class(node): style(DARK, node.role, node.side) for node in picture.nodes}
    for name, look in sorted(looks.items()):
        shape = f"fill:{look.fill};stroke:{look.line}"
        rules += [
            _rule(f".foon-{name} rect,.foon-{name} circle", shape),
            _rule(f".foon-{name} rect[fill=none]", "fill:none"),
            _rule(f".foon-{name} text", f"fill:{look.ink}"),
        ]
    return "@media (prefers-color-scheme:dark){" + "".join(rules) + "}"


def _arrow_rules(name: str, colour: str) -> list[str]:
    return [_rule(f".foon-{name}", f"stroke:{colour}"), _rule(f".foon-tip-{name}", f"fill:{colour}")]


def _rule(selector: str, words: str) -> str:
    return f"{selector}{{{words}}}"
