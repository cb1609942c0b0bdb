"""What runs in the process of Graphviz: DOT on standard input, a layout or a picture on standard output."""

from __future__ import annotations

import ctypes
import signal
import sys
from typing import Any

ABSENT = 3
"""The exit status where pygraphviz cannot be imported; why is on standard error."""


NO_FONT = 4
"""The exit status where letters are to be drawn, and the machine has no font."""

_DRAWN = ("png", "pdf")
"""The formats in which letters are drawn, not written."""

_ON_DEATH_OF_PARENT = 1
"""What Linux calls, in `prctl`, the signal that a process gets when its parent ends."""

_DPI = "144"
"""Points of an inch in a bitmap."""


def main() -> None:
    """Lay out and write what comes in, by the program and in the format that the arguments name."""
    program, form = sys.argv[1:3]
    _end_with_parent()
    try:
        from pygraphviz import AGraph
    except ImportError as error:
        sys.stderr.write(" ".join(str(error).split()))
        sys.exit(ABSENT)
    if form in _DRAWN and not _has_font(AGraph):
        sys.exit(NO_FONT)
    graph = AGraph(string=sys.stdin.buffer.read().decode())
    if form == "png":
        graph.graph_attr["dpi"] = _DPI
    sys.stdout.buffer.write(graph.draw(format=form, prog=program))


def _end_with_parent() -> None:
    """Have the system end this process with the one that started it, however that ends.

    A thread that looks for it would wait as long as Graphviz takes. Only Linux knows such a wish.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_ON_DEATH_OF_PARENT, signal.SIGKILL)


def _has_font(graph: Any) -> bool:
    """Tell whether wide letters are wide; without any font each is a narrow gap. Nothing else tells it."""
    probe = graph(string='digraph { node [fontname="Helvetica", fontsize=72]; a [label="WWWWWWWWWW"]; }')
    probe.layout(prog="dot")
    return float(probe.get_node("a").attr["width"]) > _WIDE


_WIDE = 3.0
"""Inches that ten wide letters take at least, an inch high as they are."""
