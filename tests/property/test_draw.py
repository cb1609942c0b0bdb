"""Pictures: whatever a label holds stays a label in every format, and nothing of a FOON is lost."""

from __future__ import annotations

import html
import itertools
import re
from collections import Counter
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pygraphviz import AGraph

from foon_asp.draw.boxes import box
from foon_asp.draw.dot import dot_text
from foon_asp.draw.formats import Drawing
from foon_asp.draw.legal import legal
from foon_asp.draw.mermaid import mermaid_text
from foon_asp.draw.picture import Edge, Node, Picture, Role, Side
from foon_asp.draw.units import Drawn, Scene, drawn
from foon_asp.draw.words import video_url
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, FunctionalUnit, Interval, Source, UnitId
from foon_asp.model.world import World
from support.drawn_foons import foons
from support.examples import many
from support.pictures import SVG

ODD = st.text(st.characters(exclude_categories=("Cc", "Cs")), max_size=12)
TEXTS = ODD | st.sampled_from(
    [
        '"><script>alert(1)</script>',
        "]]>--></style><a href='javascript:x'>",
        "\\N \\G \\",
        'x"]; node [label="',
        "&lt;b&gt; &#60; &amp;",
        '"] --> b["',
        "end; click u0 callback",
        "`*_~#quot;",
        "1. one",
        "\ufffe\uffff",
        "<BR/><IMG SRC='/etc/passwd'/>",
    ]
)
NODES = st.lists(
    st.builds(
        Node,
        st.just(""),
        st.sampled_from([role for role in Role if role is not Role.POINT]),
        TEXTS,
        st.lists(TEXTS, max_size=2).map(tuple),
        TEXTS,
        TEXTS,
        st.sampled_from(["", "https://example.org/?a=1&b=%22#t=3"]),
        st.booleans(),
        st.sampled_from(list(Side)),
    ),
    min_size=1,
    max_size=4,
)


def _picture(nodes: list[Node], title: str) -> Picture:
    placed = [
        Node(
            f"o{number}",
            each.role,
            each.head,
            each.details,
            each.mark,
            each.title,
            each.url,
            each.goal,
            each.side,
            (100.0 * number, 50.0),
        )
        for number, each in enumerate(nodes)
    ]
    edges = [
        Edge(before.key, after.key, f"{before.title} → {after.title}", after.side, after.goal)
        for before, after in itertools.pairwise(placed)
    ]
    return Picture(title, title, placed, edges)


PICTURES = st.builds(_picture, NODES, TEXTS)

TAGS = {
    *("svg", "title", "desc", "style", "rect", "circle", "g", "path", "polygon", "text", "a"),
}
WRITTEN = {
    *("width", "height", "viewBox", "role", "font-family", "class", "fill", "stroke", "stroke-width", "rx"),
    *("stroke-dasharray", "x", "y", "cx", "cy", "r", "d", "points", "transform", "text-anchor", "font-size"),
    *("font-weight", "href", "target", "rel"),
}


@many(150)
@given(PICTURES, st.sampled_from([None, True, False]))
def test_labels_stay_labels_in_svg(picture: Picture, dark: bool | None) -> None:
    root = ElementTree.fromstring(Drawing(picture, dark).to_svg())
    everything = list(root.iter())
    assert {each.tag for each in everything} <= {SVG + tag for tag in TAGS}
    assert {name for each in everything for name in each.attrib} <= WRITTEN
    groups = list(root.iter(f"{SVG}g"))[1:]
    arrows, nodes = groups[: len(picture.edges)], groups[len(picture.edges) :]
    assert [each.findtext(f"{SVG}title") for each in arrows] == [legal(edge.title) for edge in picture.edges]
    assert [each.findtext(f"{SVG}title") for each in nodes] == [
        legal(node.title or node.head) for node in picture.nodes
    ]
    for node, group in zip(picture.nodes, nodes, strict=True):
        assert [each.text or "" for each in group.iter(f"{SVG}text")] == [
            legal(each.text) for each in box(node).lines
        ]
        assert [each.get("href") for each in group.iter(f"{SVG}a")] == [node.url] * bool(node.url)
    # Style sheets hold what we say of colours, and nothing else.
    assert all("<" not in (each.text or "") for each in root.iter(f"{SVG}style"))


def _unquoted(text: str | None) -> str:
    return re.sub(r"\\(.)", lambda match: "\n" if match[1] == "n" else match[1], text or "")


@many(150)
@given(PICTURES)
def test_labels_stay_labels_in_dot(picture: Picture) -> None:
    graph = AGraph(string=dot_text(picture))
    assert [str(name) for name in graph.nodes()] == [node.key for node in picture.nodes]
    assert sorted(map(tuple, graph.edges())) == sorted((edge.tail, edge.head) for edge in picture.edges)
    for node in picture.nodes:
        found = graph.get_node(node.key).attr
        assert _unquoted(found["tooltip"]) == legal(node.title or node.head)
        assert (found["URL"] or "") == node.url
        # The label is HTML: what was written is between its tags, and there are no others.
        assert re.sub(r"</?(FONT|B|BR)\b[^<>]*>", "", found["label"] or "").count("<") == 0
        texts = (found["label"] or "").split("<BR/>")
        plain = [html.unescape(re.sub("<[^<>]*>", "", text)) for text in texts]
        assert [text for text in plain if text] == [legal(each.text) for each in box(node).lines if each.text]


_MERMAID = re.compile(
    r'  (?P<key>\w+)(?:\(\[|\[)"(?P<label>(?:[^"<>`\\#;&]|#\d+;|<br/>)*)"(?:\]\)|\])'
    r"|  \w+ (?:-->|-\.->|==>|---) \w+"
    r'|  click \w+ href "https?://[^" <>]+" "(?:[^"<>`\\#;&]|#\d+;)*" _blank'
    r"|  classDef look\d+ [-\w:#,. ]+|  class [\w,]+ look\d+|flowchart TB|---"
    r'|title: "(?:[^"\\]|\\\\|\\")*"'
)


@many(150)
@given(PICTURES)
def test_labels_stay_labels_in_mermaid(picture: Picture) -> None:
    lines = [_MERMAID.fullmatch(line) for line in mermaid_text(picture).splitlines()]
    labels = {}
    for match in lines:
        assert match
        if match["key"]:
            plain = re.sub(
                r"#(\d+);", lambda number: chr(int(number[1])), match["label"].replace("<br/>", "\n")
            )
            labels[match["key"]] = [text for text in plain.split("\n") if text.strip()]
    wanted = {
        node.key: [line.text for line in box(node).lines if line.text.strip()] for node in picture.nodes
    }
    assert labels == wanted


@many(100)
@given(foons())
def test_nothing_of_a_foon_is_lost(foon: Foon) -> None:
    """Every unit is a node whose title has all of it; no object has two nodes; arrows are needs and makes."""
    world = World.of(foon, Kitchen(()))
    nodes, edges = drawn(Scene(world, [Drawn(unit) for unit in foon.units.ids]))
    motions = [node for node in nodes if node.role is Role.MOTION]
    objects = {node.key: node.title.split("\n")[0] for node in nodes if node.role.is_object}
    assert len(motions) == len(foon.units)
    assert len(set(objects.values())) == len(objects) == len(nodes) - len(motions)
    known = Counter(str(node) for node in foon.objects)
    assert set(objects.values()) <= set(known)
    for node, unit in zip(motions, foon.units, strict=True):
        lines = node.title.split("\n")
        for word, side in (("takes", unit.inputs), ("makes", unit.outputs)):
            names = "; ".join(str(foon.objects[number]) for number in side)
            assert not names or f"{word}: {names}" in lines
        into = {objects[edge.tail] for edge in edges if edge.head == node.key}
        out = {objects[edge.head] for edge in edges if edge.tail == node.key}
        needs = {str(foon.objects[number]) for number in world.units.needs[unit.id]}
        makes = {str(foon.objects[number]) for number in world.units.makes[unit.id]}
        assert into <= needs
        assert out <= makes
        # What is made and needed is drawn at both ends.
        drawn_names = set(objects.values())
        assert needs & {name for each in foon.units for name in _makes(world, each.id)} <= into
        assert out >= makes & drawn_names & {name for each in foon.units for name in _needs(world, each.id)}


def _makes(world: World, unit: UnitId) -> set[str]:
    return {str(world.node(number)) for number in world.units.makes[unit]}


def _needs(world: World, unit: UnitId) -> set[str]:
    return {str(world.node(number)) for number in world.units.needs[unit]}


@pytest.mark.parametrize(
    ("video", "start", "url"),
    [
        ("https://www.youtube.com/watch?v=x", 70.4, "https://www.youtube.com/watch?v=x&t=70s"),
        ("http://youtu.be/x", 5.0, "http://youtu.be/x?t=5s"),
        ("https://example.org/a.mp4", 12.0, "https://example.org/a.mp4#t=12"),
        ("https://example.org/a.mp4", None, "https://example.org/a.mp4"),
        ("whipped cream, shaken in a jar", 3.0, ""),
        ("javascript:alert(1)//https://x", 3.0, ""),
        ("https:no-host", 3.0, ""),
        ('https://x/"onclick="y', 3.0, ""),
        ("https://x/ y", 3.0, ""),
        ("http://[bad", 3.0, ""),
        ("data:text/html,<b>", None, ""),
    ],
)
def test_only_addresses_of_the_web_are_links(video: str, start: float | None, url: str) -> None:
    times = () if start is None else (Interval(start),)
    note = Annotation((Source("a.txt", 1, video),), times=times)
    assert video_url(FunctionalUnit(UnitId(0), "mix", (), (), note)) == url
