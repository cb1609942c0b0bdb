"""Where the nodes of a picture stand, and which way its arrows go: Graphviz works it out.

It does so in a process of its own. Layouts can take very long, and nothing else stops Graphviz.
"""

from __future__ import annotations

import json
import math
import queue
import re
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from foon_asp import limits
from foon_asp.draw.boxes import Box, box
from foon_asp.draw.dot import dot_text
from foon_asp.draw.picture import Picture
from foon_asp.draw.worker import ABSENT, NO_FONT
from foon_asp.errors import InternalError, QueryError

_NO_FONT = (
    "png and pdf need a font, and this machine has none: install one (apt-get install fonts-dejavu-core),"
    " or write svg"
)

Point = tuple[float, float]

_MARGIN = 12.0
"""Points around a picture."""

_HELP = (
    "pip install pygraphviz, and on a slim Linux also libglib2.0-0 libx11-6 libxext6 libxrender1 libexpat1;"
    " the formats dot and mermaid need none of it"
)


@dataclass(frozen=True, slots=True)
class Arrow:
    """The way of an arrow: points of a curve of Bézier, three for each further piece, and its tip."""

    curve: Sequence[Point]
    tip: Point | None


@dataclass(frozen=True, slots=True)
class Layout:
    """Where everything stands, in points from the top left: middles of nodes by key, arrows in order."""

    width: float
    height: float
    boxes: Mapping[str, Box]
    places: Mapping[str, Point]
    arrows: Sequence[Arrow]


def laid_out(picture: Picture) -> Layout:
    """Return where everything in a picture stands.

    Raises `QueryError` if Graphviz cannot be had, and `LimitReachedError`.
    """
    boxes = {node.key: box(node) for node in picture.nodes}
    if picture.settled:
        return _settled(picture, boxes)
    if not picture.nodes:
        return Layout(2 * _MARGIN, 2 * _MARGIN, boxes, {}, ())
    return _read(picture, boxes, json.loads(graphviz(dot_text(picture, bare=True), "json0")))


def _settled(picture: Picture, boxes: Mapping[str, Box]) -> Layout:
    places = {node.key: node.place for node in picture.nodes if node.place is not None}
    width = max(x + boxes[key].width / 2 for key, (x, _) in places.items()) + _MARGIN
    height = max(y + boxes[key].height / 2 for key, (_, y) in places.items()) + _MARGIN
    arrows = [Arrow((places[edge.tail], places[edge.head]), None) for edge in picture.edges]
    return Layout(width, height, boxes, places, arrows)


def _read(picture: Picture, boxes: Mapping[str, Box], found: Any) -> Layout:
    """Read what Graphviz has worked out; it counts from the bottom left."""
    left, bottom, right, top = map(float, found["bb"].split(","))

    def point(text: str) -> Point:
        x, y = text.split(",")
        return round(float(x) - left + _MARGIN, 2), round(top - float(y) + _MARGIN, 2)

    places = {each["name"]: point(each["pos"]) for each in found["objects"] if "pos" in each}
    ways: dict[str, Arrow] = {}
    for each in found.get("edges", ()):
        tip, points = re.fullmatch(r"(?:e,(\S+) )?(.*)", each["pos"]).groups()  # type: ignore[union-attr]
        ways[each["id"]] = Arrow([point(text) for text in points.split()], point(tip) if tip else None)
    arrows = [ways[f"e{number}"] for number in range(len(picture.edges))]
    return Layout(right - left + 2 * _MARGIN, top - bottom + 2 * _MARGIN, boxes, places, arrows)


def graphviz(text: str, form: str, program: str = "dot") -> bytes:
    """Let Graphviz lay out what a DOT text says, and return it in a format of Graphviz.

    Raises `QueryError` if it cannot be had, and `LimitReachedError`: then its process is ended.
    """
    start = "import sys; sys.path[:] = sys.argv[3:]; from foon_asp.draw.worker import main; main()"
    answers: queue.SimpleQueue[tuple[bytes, bytes]] = queue.SimpleQueue()

    def look(seconds: float) -> tuple[bytes, bytes] | None:
        try:
            return answers.get(timeout=seconds)
        except queue.Empty:
            return None

    seconds = limits.seconds_left()
    deadline = math.inf if seconds == math.inf else time.monotonic() + seconds
    with subprocess.Popen(
        [sys.executable, "-c", start, program, form, *sys.path],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        # fontconfig and Pango complain there of what is no matter here.
        stderr=subprocess.PIPE,
        # Ctrl-C is for the process that asks.
        start_new_session=True,
    ) as child:
        # A thread of its own: `communicate` with a timeout forgets what of the input it has not written yet.
        asking = threading.Thread(target=lambda: answers.put(child.communicate(text.encode())), daemon=True)
        asking.start()
        try:
            with limits.waiting():
                data, said = limits.wait_for(look, child.pid, deadline)
        finally:
            child.kill()
            asking.join()
    return _checked(child.returncode, data, said)


def _checked(status: int, data: bytes, said: bytes) -> bytes:
    """Return what a process of Graphviz has written; raise `QueryError` if it had none."""
    lines = said.decode(errors="replace").strip().splitlines() or ["it says nothing"]
    if status == ABSENT:
        raise QueryError(f"Graphviz is not there ({lines[-1]}): {_HELP}")
    if status == NO_FONT:
        raise QueryError(_NO_FONT)
    if status:
        raise InternalError(f"Graphviz ended with status {status}: {lines[-1]}")
    return data
