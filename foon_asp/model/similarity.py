"""How well one label stands for another, and why: by a table, by its word vectors, by its uses in a FOON.

A likeness is a share of 1: at 1 nobody would notice. All measures but the table work both ways.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
import numpy.typing as npt

from foon_asp.model.foon import Foon

Vector = npt.NDArray[np.float64]

WORDS_ALIKE = 0.6
"""From how much on two labels are alike by their words: below, on FOON labels, most are not."""

USES_ALIKE = 0.5
"""From how much on two labels are alike by their uses."""


@dataclass(frozen=True, slots=True)
class Likeness:
    """How well a label stands for another: more than 0, at most 1; `why` says who says so."""

    value: float
    why: str


class Similarity(Protocol):
    """A measure of labels."""

    def knows(self, label: str, other: str) -> bool:
        """Tell whether this measure can judge the pair at all, be it that they have nothing in common."""

    def likeness(self, label: str, by: str) -> Likeness | None:
        """Return how well `label` is replaced by another; None if not well enough to be thought of."""


@dataclass(frozen=True, slots=True)
class Table:
    """What a person said: pairs of a label and what replaces it, one way."""

    pairs: Mapping[tuple[str, str], Likeness]

    def knows(self, label: str, other: str) -> bool:
        """Tell whether the pair is in the table."""
        return (label, other) in self.pairs

    def likeness(self, label: str, by: str) -> Likeness | None:
        """Return what the table says."""
        return self.pairs.get((label, by))


class Words:
    """Labels compared by vectors of their words: the cosine of the means.

    The vectors are those of stems (`chees` for `cheese`): the vector of a word is that of the longest stem
    that it begins with, if few letters remain. A word without a vector makes a label unknown.
    """

    def __init__(self, vectors: Mapping[str, Vector]) -> None:
        """Compare by vectors, one for each stem."""
        self._vectors = vectors
        self._known: dict[str, Vector | None] = {}

    def knows(self, label: str, other: str) -> bool:
        """Tell whether all words of both labels have vectors."""
        return self._vector(label) is not None and self._vector(other) is not None

    def likeness(self, label: str, by: str) -> Likeness | None:
        """Return the cosine, from `WORDS_ALIKE` on."""
        one, other = self._vector(label), self._vector(by)
        if one is None or other is None:
            return None
        value = min(1.0, round(float(one @ other), 3))
        return Likeness(value, "used like it in recipes") if value >= WORDS_ALIKE else None

    def _vector(self, label: str) -> Vector | None:
        if label not in self._known:
            words = re.findall(r"\w+", label)
            vectors = [self._of_word(word) for word in words]
            known = [vector for vector in vectors if vector is not None]
            self._known[label] = (
                _unit(sum(known[1:], known[0])) if known and len(known) == len(words) else None
            )
        return self._known[label]

    def _of_word(self, word: str) -> Vector | None:
        stems = [word, re.sub("y$", "i", word)]
        stems += [word[:end] for end in range(len(word) - 1, max(_STEM, len(word) - _ENDING) - 1, -1)]
        return next((_unit(self._vectors[stem]) for stem in stems if stem in self._vectors), None)


_ENDING, _STEM = 4, 3
"""How many letters a word may have behind its stem, and how many the stem has at least."""


def _unit(vector: Vector) -> Vector:
    length = float(np.linalg.norm(vector))
    return vector / length if length else vector


_Use = tuple[str, bool, tuple[str, ...]]
"""A motion, whether the label is there before it (or behind it), and in which plain states."""


class Uses:
    """Labels compared by what is done with them in a FOON: the same motions in the same states.

    Each label is a vector of its uses, in which a use counts the more the fewer labels have it (tf-idf); the
    likeness is half the cosine, since what is handled alike need not taste alike.
    """

    def __init__(self, foon: Foon, utensils: Collection[str]) -> None:
        """Look at the units of a FOON; utensils have no uses here."""
        self._foon = foon
        self._utensils = utensils

    def knows(self, label: str, other: str) -> bool:
        """Tell whether both labels have uses."""
        return label in self._weights and other in self._weights

    def likeness(self, label: str, by: str) -> Likeness | None:
        """Return half the cosine, where that is from `USES_ALIKE` on."""
        one, other = self._weights.get(label, {}), self._weights.get(by, {})
        if len(one) > len(other):
            one, other = other, one
        cosine = sum(weight * other[use] for use, weight in one.items() if use in other)
        if cosine < USES_ALIKE:
            return None
        return Likeness(round(min(1.0, cosine) / 2, 3), "same motions in the same states")

    @cached_property
    def _weights(self) -> dict[str, dict[_Use, float]]:
        """For each label its uses and their weights, a vector of length 1."""
        objects = self._foon.objects
        uses: dict[str, Counter[_Use]] = {}
        for unit in self._foon.units:
            for before, ports in ((True, unit.inputs), (False, unit.outputs)):
                for node in map(objects.__getitem__, ports):
                    if node.label not in self._utensils:
                        use = (unit.motion.rstrip("* "), before, node.plain_states)
                        uses.setdefault(node.label, Counter())[use] += 1
        common = Counter(use for counts in uses.values() for use in counts)
        weights = {}
        for label, counts in uses.items():
            row = {
                use: (1 + math.log(n)) * math.log(1 + len(uses) / common[use]) for use, n in counts.items()
            }
            length = math.hypot(*row.values())
            if length:
                weights[label] = {use: weight / length for use, weight in row.items()}
        return weights


@dataclass(frozen=True)
class Similar:
    """Several measures, the most trusted first: the first that knows a pair of labels judges it."""

    measures: Sequence[Similarity]

    def knows(self, label: str, other: str) -> bool:
        """Tell whether any measure knows the pair."""
        return any(measure.knows(label, other) for measure in self.measures)

    def likeness(self, label: str, by: str) -> Likeness | None:
        """Return what the first measure says that knows the pair."""
        for measure in self.measures:
            if measure.knows(label, by):
                return measure.likeness(label, by)
        return None

    def replacements(self, label: str, among: Iterable[str]) -> list[tuple[str, Likeness]]:
        """Return what a label may be replaced by, the likest first."""
        found = [(by, self.likeness(label, by)) for by in among if by != label]
        known = [(by, likeness) for by, likeness in found if likeness is not None]
        return sorted(known, key=lambda each: (-each[1].value, each[0]))
