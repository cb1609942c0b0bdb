"""The numbers that people give, each kind once: range, whole or not. For flags, files, JSON and Python."""

from __future__ import annotations

import re
from dataclasses import dataclass
from numbers import Integral, Real
from typing import cast

from foon_asp.errors import QueryError
from foon_asp.values import said

_WRITTEN = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,9})?")
_LONGEST = 1000


@dataclass(frozen=True, slots=True)
class Number:
    """A kind of number: from `least`, or above it, to `most`; `words` is what messages call it.

    True and False are no numbers, nor are infinity and NaN. Numbers of numpy are.
    """

    words: str
    least: int
    most: int
    whole: bool = False
    above: bool = False

    def fits(self, value: object) -> bool:
        """Tell whether a value is a number of this kind."""
        if isinstance(value, bool) or not isinstance(value, Integral if self.whole else Real):
            return False
        number = cast(float, value)
        # NaN compares false.
        return bool(self.least <= number <= self.most and not (self.above and number == self.least))

    def checked(self, value: object, name: str) -> int | float:
        """Return a value as Python's own number; raise `QueryError` with its name if it is another kind."""
        if not self.fits(value):
            raise QueryError(f"{name!r} is {self.words}, not {said(value)}")
        assert isinstance(value, Real)
        return int(value) if isinstance(value, Integral) else float(value)

    def read(self, text: str) -> int | float:
        """Read a number of this kind; raise `ValueError` if the text is none."""
        if len(text) > _LONGEST or not _WRITTEN.fullmatch(text.strip()):
            raise ValueError(text)
        value = int(text) if self.whole else float(text)
        if not self.fits(value):
            raise ValueError(text)
        return value


MOST = 2**31 - 1
"""The largest integer of clingo."""

_ANY = 10**18
"""More than can be of anything: limits are taken up to here, and hold for what there is."""

COUNT = Number("a whole number from 0", 0, _ANY, whole=True)
"""How many there may be of something: units, rounds, steps."""
SOME = Number("a whole number from 1", 1, _ANY, whole=True)
"""How many are asked for: trees, dishes, processes."""
QUANTITY = Number("a whole number from 0 to 1000000", 0, 1_000_000, whole=True)
"""How many of an object the kitchen holds; more is as good as plenty."""
RATE = Number("a chance between 0 and 1", 0, 1)
"""How likely a motion succeeds."""
COST = Number("a number from 0 to 1000000", 0, 1_000_000)
"""What a motion costs."""
LEAST_SUCCESS = Number("a chance above 0 and at most 1", 0, 1, above=True)
"""How likely a tree must succeed; 0 would be no constraint."""
LIKENESS = Number("a likeness above 0 and at most 1", 0, 1, above=True)
"""How well one thing stands for another; at 1 nobody would notice."""
LEAST_LIKENESS = 0.8
"""How alike two labels are at least that are taken for one, where nobody says it."""
SHARE = Number("a likeness from 0 to 1", 0, 1)
"""How well a dish does without something; at 0 that is missed as much as can be."""
SECONDS = Number("a number of seconds from 0", 0, _ANY)
"""How long an answer may take."""
MEGABYTES = Number("a number of megabytes above 0 and at most 1000000000", 0, 1_000_000_000, above=True)
"""How much memory an answer may take."""
FACTOR = Number("a number of at least 1 and at most 1000000", 1, 1_000_000)
"""How much dearer than the best a tree may be."""
SPEED = Number("a number above 0 and at most 1000", 0, 1000, above=True)
"""How much faster than the videos somebody works."""
DURATION = Number("a number of seconds above 0 and at most 1000000", 0, 1_000_000, above=True)
"""How long a motion takes."""
