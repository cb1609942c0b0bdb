"""The encodings: where they lie, what each includes, and which predicates it looks at."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from foon_asp import resources

_INCLUDE = re.compile(r'^#include "([^"]+)"\.$', re.MULTILINE)
_LEFT_OUT = re.compile(r'%\*.*?\*%|%[^\n]*|"(?:[^"\\]|\\.)*"', re.DOTALL)
_NAME = re.compile(r"(?<![#\w])_*[a-z]\w*")
_READINGS = frozenset({"units.lp", "vocabulary.lp"})
"""Files that only say what needs/2 and makes/2 are: what they look at need not be said if these are given."""


def encoding_path(name: str) -> Path:
    """Return the path of an encoding, e.g. of `units.lp` or `criteria/units.lp`."""
    return resources.folder("encodings") / name


def encoding_names() -> list[str]:
    """Return the names of all encodings, sorted."""
    root = resources.folder("encodings")
    return sorted(path.relative_to(root).as_posix() for path in root.rglob("*.lp"))


@cache
def looked_at(name: str) -> frozenset[str]:
    """Return the names in an encoding and all that it includes, but for the readings of units.

    These are its predicates, and beside them its functions and constants. Comments and texts name nothing.
    clingo's own parser would tell them apart, in a tenth of the time that a small question takes.
    """
    texts = (encoding_text(file) for file in encoding_files([name]) if file not in _READINGS)
    return frozenset(name for text in texts for name in _NAME.findall(_LEFT_OUT.sub(" ", text)))


def encoding_files(names: Iterable[str]) -> list[str]:
    """Return encodings and all that they include, each once, and each behind what it includes.

    clingo would look for an included file in the current folder first, and take what bears its name there.
    """
    found: dict[str, None] = {}

    def visit(name: str) -> None:
        if name not in found:
            for included in _read(name)[0]:
                visit(included)
            found[name] = None

    for name in names:
        visit(name)
    return list(found)


def encoding_text(name: str) -> str:
    """Return the text of an encoding, its includes left out and all other lines where they were."""
    return _read(name)[1]


@cache
def _read(name: str) -> tuple[tuple[str, ...], str]:
    """Return the names of the files that an encoding includes, and the rest of its text."""
    text = encoding_path(name).read_text(encoding="utf-8")
    folder = posixpath.dirname(name)
    included = (posixpath.normpath(posixpath.join(folder, other)) for other in _INCLUDE.findall(text))
    return tuple(included), _INCLUDE.sub("", text)
