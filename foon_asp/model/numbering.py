"""Numbers for things that recur: whatever comes again has the number that it had before.

A FOON is put together on such numbers. Words have one each; a state is a row of those of its words; an
object node is the number of its label with the set of those of its states; a unit is that of its motion with
the set of its ports.
"""

from __future__ import annotations

from array import array
from collections import defaultdict
from collections.abc import Iterable
from itertools import count, pairwise, starmap
from typing import Any, TypeVar

import numpy as np

from foon_asp.model.arrays import Mask, Numbers, Places, Rows

T = TypeVar("T")

_ITEM = 4
"""Bytes of a number in a row."""

_MANY = 1 << 18
"""How many rows are worth the time that pyarrow takes to load."""


class Numbering(defaultdict[T, int]):
    """Numbers things 0, 1, 2, … in the order in which they are first asked for, `numbering[thing]`."""

    def __init__(self, things: Iterable[T] = ()) -> None:
        """Number some things at once."""
        # Nothing written in Python runs for a number, and nothing here refers back to this dictionary.
        super().__init__(count().__next__)
        for thing in things:
            self[thing]

    def of(self, things: Iterable[T]) -> Numbers:
        """Return the number of each thing."""
        return np.fromiter(map(self.__getitem__, things), np.int32)


class RowNumbering(Numbering[bytes]):
    """Numbers rows of integers of 32 bits, by their bytes."""

    def number(self, row: Iterable[int]) -> int:
        """Return the number of a row."""
        return self[array("i", row).tobytes()]

    def numbers(self, rows: Rows[Any, Any]) -> tuple[Numbers, Mask]:
        """Return the number of each row, and which of them were never numbered before."""
        known = len(self)
        data, bounds = rows.values.tobytes(), rows.offsets * _ITEM
        if len(rows) < _MANY:
            found = self.of(map(data.__getitem__, starmap(slice, pairwise(bounds.tolist()))))
        else:
            keys, place = different(data, bounds)
            found = self.of(keys)[place]
        highest = np.maximum.accumulate(np.append(np.int32(known - 1), found))
        return found, found > highest[:-1]

    @property
    def rows(self) -> Rows[Any, Any]:
        """All rows, by their numbers."""
        return Rows.parted(np.frombuffer(b"".join(self), np.int32), (len(key) // _ITEM for key in self))


def different(data: bytes, bounds: Places, *, text: bool = False) -> tuple[list[Any], Numbers]:
    """Part some bytes. Return the different parts as they come, and for each part which of them it is."""
    # It takes a while to load, and most files are short.
    import pyarrow as pa

    buffers = [None, pa.py_buffer(bounds.astype(np.int32)), pa.py_buffer(data)]
    kind = pa.string() if text else pa.binary()
    parts = pa.Array.from_buffers(kind, len(bounds) - 1, buffers).dictionary_encode()
    return parts.dictionary.to_pylist(), parts.indices.to_numpy()


def with_set(head: int, members: Iterable[int]) -> list[int]:
    """Return a row of a head and its members, each once, in the order that they have without a sign."""
    return [head, *sorted(set(members), key=_without_sign)]


def _without_sign(member: int) -> int:
    return member & 0xFFFFFFFF
