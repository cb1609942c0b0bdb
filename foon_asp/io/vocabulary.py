"""Words that older FOON files have for what newer ones say otherwise, and how to leave them as they are.

The FOON of 2017 says in a word of its own what newer files say as a relation or as contents. Only words with
one current meaning are here; one that says two things at once, as `ingredients mixed inside`, stays as it is.
docs/format.md shows the table.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from foon_asp.errors import QueryError
from foon_asp.io.syntax import Report
from foon_asp.model.notation import PLACES
from foon_asp.values import said

VocabularyName = Literal["current", "as-written"]
"""How words of older files are read: as the current ones, or as they stand."""

_PLACED = re.compile(rf"({'|'.join(sorted(PLACES))}) +([^\[\]{{}}]+)")
_BRACES = re.compile(r"\{[^\[\]{}]*\}")


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """Which words are read as which others.

    `states` are names of states, `motions` labels of motions; an empty text means that there is nothing.
    `places` tells whether a relation may have braces behind what it names: `in foil {cheese}`.
    """

    states: Mapping[str, str]
    motions: Mapping[str, str]
    places: bool

    def state(self, name: str, detail: str, report: Report) -> tuple[str, str]:
        """Return the name of a state, and what stands behind it, in current words; no name for no state."""
        current, behind = self.states.get(name, name), detail.strip()
        if self.places and _BRACES.fullmatch(behind) and (placed := _PLACED.fullmatch(name)):
            current, behind = placed[1], f"[{placed[2].strip()}] {behind}"
        if (current, behind) == (name, detail.strip()):
            return name, detail
        _report(report, f"{name} {detail}".strip(), f"{current} {behind}".strip() if current else "")
        return current, behind if current else ""

    def motion(self, label: str, report: Report) -> str:
        """Return the label of a motion in current words."""
        current = self.motions.get(label, label)
        if current != label:
            _report(report, label, current)
        return current


def _report(report: Report, word: str, current: str) -> None:
    report("older-word", f"{word!r} is read as {repr(current) if current else 'no state'}")


_VOCABULARIES: Mapping[VocabularyName, Vocabulary] = {
    "current": Vocabulary(
        {
            "ingredients inside": "contains",
            "ingredients on top": "contains",
            "no state": "",
            "none": "",
        },
        {"pick + place": "pick-and-place"},
        places=True,
    ),
    "as-written": Vocabulary({}, {}, places=False),
}

VOCABULARIES = tuple(_VOCABULARIES)
"""The names of the vocabularies, the usual one first."""

CURRENT = _VOCABULARIES["current"]
"""The words of today."""


def vocabulary(name: str) -> Vocabulary:
    """Return the vocabulary of a name; raise `QueryError` if there is none."""
    for known, words in _VOCABULARIES.items():
        if name == known:
            return words
    raise QueryError(f"no vocabulary {said(name)}; there are {', '.join(VOCABULARIES)}")
