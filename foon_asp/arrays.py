"""Integer arrays behind the graph: rows of numbers, the inverse of a table of rows, and rounds.

Rows are kept as in a compressed sparse row matrix: all numbers in one array, and where each row begins.
To Python they are sequences and mappings of plain integers; `values` and `offsets` are there for numpy.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, cast, overload

import numpy as np
import numpy.typing as npt

Ids = tuple[int, ...]
Numbers = npt.NDArray[np.int32]
Places = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]


class Rows(Sequence[Ids]):
    """Rows of integers: row i is `values[offsets[i]:offsets[i + 1]]`."""

    __slots__ = ("_begins", "_numbers", "offsets", "values")

    def __init__(self, offsets: Places, values: Numbers) -> None:
        self.offsets = offsets
        self.values = values
        # A memoryview hands out single integers several times as fast as a numpy array.
        self._begins = memoryview(cast(Any, offsets))
        self._numbers = memoryview(cast(Any, values))

    @classmethod
    def of(cls, owners: Numbers, values: Numbers, count: int) -> Rows:
        """Return `count` rows: the values of each owner (0, 1, …), in their order."""
        order = np.argsort(owners, kind="stable")
        return cls(_offsets(np.bincount(owners, minlength=count)), values[order])

    def __len__(self) -> int:
        return len(self._begins) - 1

    @overload
    def __getitem__(self, place: int) -> Ids: ...
    @overload
    def __getitem__(self, place: slice) -> list[Ids]: ...
    def __getitem__(self, place: int | slice) -> Ids | list[Ids]:
        if isinstance(place, slice):
            return [self[each] for each in range(len(self))[place]]
        if place < 0:
            place += len(self)
            if place < 0:
                raise IndexError(place - len(self))
        return tuple(self._numbers[self._begins[place] : self._begins[place + 1]])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[type[Rows], tuple[Places, Numbers]]:
        # Memoryviews cannot be copied to another process.
        return Rows, (self.offsets, self.values)

    @property
    def lengths(self) -> Places:
        return np.diff(self.offsets)

    @property
    def owners(self) -> Numbers:
        """Say for each value in which row it is."""
        return np.repeat(np.arange(len(self), dtype=np.int32), self.lengths)

    def gather(self, rows: npt.NDArray[np.integer[Any]]) -> Numbers:
        """Return the values of some rows, one row after the other."""
        begins = self.offsets[rows]
        lengths = self.offsets[rows + 1] - begins
        ends = np.cumsum(lengths)
        total = int(ends[-1]) if len(ends) else 0
        return self.values[np.repeat(begins - ends + lengths, lengths) + np.arange(total)]

    def where(self, keep: Mask) -> Rows:
        """Return the rows with only those values that are to be kept."""
        if keep.all():
            return self
        kept = np.concatenate(([0], np.cumsum(keep)))
        return Rows(kept[self.offsets], self.values[keep])


class Index(Mapping[int, Ids]):
    """For each value of a table of rows, the rows that it is in, ascending; rows of nothing are left out."""

    __slots__ = ("rows",)

    def __init__(self, table: Rows, size: int) -> None:
        """Turn a table around whose values are below `size`."""
        self.rows = Rows.of(table.values, table.owners, size)

    def __getitem__(self, value: int) -> Ids:
        if value not in self:
            raise KeyError(value)
        return self.rows[value]

    def of(self, value: int) -> Ids:
        """Return the rows that a value is in, which may be none."""
        return self.rows[value] if 0 <= value < len(self.rows) else ()

    def __contains__(self, value: object) -> bool:
        return isinstance(value, int) and bool(self.of(value))

    def __iter__(self) -> Iterator[int]:
        return iter(np.flatnonzero(self.rows.lengths).tolist())

    def __len__(self) -> int:
        return int(np.count_nonzero(self.rows.lengths))


class Rounds(Mapping[int, int]):
    """For each number the round in which it is reached; those that never are, at -1, are left out."""

    __slots__ = ("_numbers", "rounds")

    def __init__(self, rounds: Numbers) -> None:
        self.rounds = rounds
        self._numbers = memoryview(cast(Any, rounds))

    def __reduce__(self) -> tuple[type[Rounds], tuple[Numbers]]:
        return Rounds, (self.rounds,)

    def __getitem__(self, number: int) -> int:
        if 0 <= number < len(self._numbers) and self._numbers[number] >= 0:
            return int(self._numbers[number])
        raise KeyError(number)

    def __contains__(self, number: object) -> bool:
        return isinstance(number, int) and 0 <= number < len(self._numbers) and self._numbers[number] >= 0

    def __iter__(self) -> Iterator[int]:
        return iter(np.flatnonzero(self.rounds >= 0).tolist())

    def __len__(self) -> int:
        return int(np.count_nonzero(self.rounds >= 0))


def numbers(items: Iterable[int]) -> Numbers:
    """Return integers as an array."""
    return np.fromiter(items, dtype=np.int32)


def rows(items: Iterable[Sequence[int]]) -> Rows:
    """Return rows of integers as arrays."""
    table = list(items)
    values = numbers(number for row in table for number in row)
    return Rows(_offsets(np.fromiter(map(len, table), dtype=np.int64)), values)


def _offsets(lengths: npt.NDArray[np.integer[Any]]) -> Places:
    return np.concatenate(([0], np.cumsum(lengths, dtype=np.int64)))
