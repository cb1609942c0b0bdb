"""Integer arrays behind the graph: rows of numbers, the inverse of a table of rows, and rounds.

Rows are kept as in a compressed sparse row matrix: all numbers in one array, and where each row begins.
To Python they are sequences and mappings of plain integers; `values` and `offsets` are there for numpy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, Generic, TypeVar, cast, overload

import numpy as np
import numpy.typing as npt

K = TypeVar("K", bound=int)
V = TypeVar("V", bound=int)
T = TypeVar("T")

Numbers = npt.NDArray[np.int32]
Places = npt.NDArray[np.int64]
Integers = npt.NDArray[np.integer[Any]]
N = TypeVar("N", bound=np.integer[Any])
Mask = npt.NDArray[np.bool_]


class Rows(Sequence[tuple[V, ...]], Generic[K, V]):
    """Rows of integers: row i is `values[offsets[i]:offsets[i + 1]]`.

    K is what the rows are numbered by, V what is in them: mypy tells a unit's number from an object's.
    """

    __slots__ = ("_begins", "_numbers", "offsets", "values")

    def __init__(self, offsets: Places, values: Numbers) -> None:
        self.offsets = offsets
        self.values = values
        # A memoryview hands out single integers several times as fast as a numpy array.
        self._begins = memoryview(cast(Any, offsets))
        self._numbers = cast(Sequence[V], memoryview(cast(Any, values)))

    @classmethod
    def of(cls, owners: Numbers, values: Numbers, count: int) -> Rows[K, V]:
        """Return `count` rows: the values of each owner (0, 1, …), in their order."""
        order = np.argsort(owners, kind="stable")
        return cls(_offsets(np.bincount(owners, minlength=count)), values[order])

    @classmethod
    def parted(cls, values: Numbers, lengths: Iterable[int]) -> Rows[K, V]:
        """Return rows of the values, one behind the other, of the given lengths."""
        if not isinstance(lengths, np.ndarray):
            lengths = np.fromiter(lengths, dtype=np.int64)
        return cls(_offsets(lengths), values)

    @classmethod
    def headed(cls, heads: Sequence[Numbers], rest: Rows[Any, V]) -> Rows[K, V]:
        """Return rows with further values at their front: columns, a value for each row."""
        offsets = rest.offsets + np.arange(len(rest) + 1) * len(heads)
        values = np.empty(offsets[-1], np.int32)
        is_rest = np.ones(len(values), dtype=np.bool_)
        for place, column in enumerate(heads):
            values[offsets[:-1] + place] = column
            is_rest[offsets[:-1] + place] = False
        values[is_rest] = rest.values
        return cls(offsets, values)

    @classmethod
    def joined(cls, front: Rows[Any, V], back: Rows[Any, V]) -> Rows[K, V]:
        """Return rows of both values: those of `front`, and behind them those of `back`."""
        values = np.empty(len(front.values) + len(back.values), np.int32)
        values[np.arange(len(front.values)) + np.repeat(back.offsets[:-1], front.lengths)] = front.values
        values[np.arange(len(back.values)) + np.repeat(front.offsets[1:], back.lengths)] = back.values
        return cls(front.offsets + back.offsets, values)

    def split(self, count: int) -> tuple[list[Numbers], Rows[K, V]]:
        """Return the first `count` values of each row as columns, and rows of the rest."""
        heads = [self.offsets[:-1] + place for place in range(count)]
        is_rest = np.ones(len(self.values), dtype=np.bool_)
        for places in heads:
            is_rest[places] = False
        rest: Rows[K, V] = Rows(self.offsets - np.arange(len(self) + 1) * count, self.values[is_rest])
        return [self.values[places] for places in heads], rest

    def __len__(self) -> int:
        return len(self._begins) - 1

    # Narrower than that of a sequence: not any integer is a number of these rows.
    @overload  # type: ignore[override]
    def __getitem__(self, place: K) -> tuple[V, ...]: ...
    @overload
    def __getitem__(self, place: slice) -> list[tuple[V, ...]]: ...
    def __getitem__(self, place: K | slice) -> tuple[V, ...] | list[tuple[V, ...]]:
        if isinstance(place, slice):
            return [self[cast(K, each)] for each in range(len(self))[place]]
        begin: int = place
        if begin < 0:
            begin += len(self)
            if begin < 0:
                raise IndexError(begin - len(self))
        return tuple(self._numbers[self._begins[begin] : self._begins[begin + 1]])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[type[Rows[K, V]], tuple[Places, Numbers]]:
        # Memoryviews cannot be copied to another process.
        return Rows, (self.offsets, self.values)

    @property
    def lengths(self) -> Places:
        """How many values each row has."""
        # As numpy.diff, which takes longer for few rows.
        return self.offsets[1:] - self.offsets[:-1]

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

    def repeated(self) -> Mask:
        """Say of each value whether it stood in its row before."""
        again = np.zeros(len(self.values), dtype=np.bool_)
        several, keys = self._keys_of_several()
        order = np.argsort(keys, kind="stable")
        again[several[order[1:]]] = keys[order[1:]] == keys[order[:-1]]
        return again

    def as_sets(self) -> Rows[K, V]:
        """Return rows with the same values, each once, in the order that they have without a sign."""
        several, keys = self._keys_of_several()
        keys.sort()
        values = self.values.copy()
        values[several] = keys.astype(np.uint32).view(np.int32)
        again = np.zeros(len(values), dtype=np.bool_)
        again[several[1:]] = keys[1:] == keys[:-1]
        return Rows(self.offsets, values).where(~again)

    def _keys_of_several(self) -> tuple[Places, npt.NDArray[np.int64]]:
        """Return where the values are in rows of more than one: first the row as a number, then the value."""
        several = np.flatnonzero(np.repeat(self.lengths > 1, self.lengths))
        return several, self.owners[several].astype(np.int64) << 32 | self.values[several].view(np.uint32)

    def chosen(self, rows: Mask) -> Rows[Any, V]:
        """Return only those rows that are chosen, one behind the other."""
        if rows.all():
            return self
        keep = np.repeat(rows, self.lengths)
        return Rows(_offsets(self.lengths[rows]), self.values[keep])

    def where(self, keep: Mask) -> Rows[K, V]:
        """Return the rows with only those values that are to be kept."""
        if keep.all():
            return self
        kept = np.concatenate(([0], np.cumsum(keep)))
        return Rows(kept[self.offsets], self.values[keep])


_KEPT = 1 << 17
"""How many values are kept once they were made."""


class Kept(dict[K, T]):
    """What a function makes of numbers, each made once, for where the same ones are looked up all the time.

    A dictionary hands out what it has several times as fast as it is made, be it only a row of `Rows`.
    """

    def __init__(self, make: Callable[[K], T]) -> None:
        super().__init__()
        self._make = make

    def __reduce__(self) -> tuple[type[Kept[K, T]], tuple[Callable[[K], T]]]:
        # Another process makes what it needs.
        return Kept, (self._make,)

    def __missing__(self, number: K) -> T:
        if len(self) >= _KEPT:
            self.clear()
        value = self[number] = self._make(number)
        return value


class Index(Mapping[K, tuple[V, ...]]):
    """For each value of a table of rows, the rows that it is in, ascending; rows of nothing are left out."""

    __slots__ = ("rows",)

    def __init__(self, table: Rows[V, K], size: int) -> None:
        """Turn a table around whose values are below `size`."""
        self.rows: Rows[K, V] = Rows.of(table.values, table.owners, size)

    def __getitem__(self, value: K) -> tuple[V, ...]:
        if value not in self:
            raise KeyError(value)
        return self.rows[value]

    def of(self, value: K) -> tuple[V, ...]:
        """Return the rows that a value is in, which may be none."""
        return self.rows[value] if 0 <= value < len(self.rows) else ()

    def __contains__(self, value: object) -> bool:
        return isinstance(value, int) and bool(self.of(cast(K, value)))

    def __iter__(self) -> Iterator[K]:
        return cast(Iterator[K], iter(np.flatnonzero(self.rows.lengths).tolist()))

    def __len__(self) -> int:
        return int(np.count_nonzero(self.rows.lengths))


class Rounds(Mapping[K, int]):
    """For each number the round in which it is reached; those that never are, at -1, are left out."""

    __slots__ = ("_numbers", "rounds")

    def __init__(self, rounds: Numbers) -> None:
        self.rounds = rounds
        self._numbers = memoryview(cast(Any, rounds))

    def __reduce__(self) -> tuple[type[Rounds[K]], tuple[Numbers]]:
        return Rounds, (self.rounds,)

    def __getitem__(self, number: K) -> int:
        if 0 <= number < len(self._numbers) and self._numbers[number] >= 0:
            return int(self._numbers[number])
        raise KeyError(number)

    def __contains__(self, number: object) -> bool:
        return isinstance(number, int) and 0 <= number < len(self._numbers) and self._numbers[number] >= 0

    def __iter__(self) -> Iterator[K]:
        return cast(Iterator[K], iter(np.flatnonzero(self.rounds >= 0).tolist()))

    def __len__(self) -> int:
        return int(np.count_nonzero(self.rounds >= 0))


def distinct(values: npt.NDArray[N]) -> npt.NDArray[N]:
    """Return some integers ascending, each once.

    `np.unique` would do the same, but imports `numpy.ma` first: a tenth of a question on the command line.
    """
    ordered = np.sort(values)
    return ordered[_firsts(ordered)]


def counts(values: npt.NDArray[N]) -> tuple[npt.NDArray[N], Places]:
    """Return some integers ascending, each once, and how often each is there."""
    ordered = np.sort(values)
    first = _firsts(ordered)
    begins = np.flatnonzero(first)
    return ordered[first], np.diff(begins, append=len(ordered))


def places(values: Integers, ascending: Integers) -> tuple[Places, Mask]:
    """Return the place of each value among some that ascend, each once, and whether it is there at all."""
    found = np.searchsorted(ascending, values)
    there = found < len(ascending)
    there[there] = ascending[found[there]] == values[there]
    return found, there


def _firsts(ordered: Integers) -> Mask:
    """Say of each of some ascending integers whether it is the first of its kind."""
    first = np.ones(len(ordered), dtype=np.bool_)
    np.not_equal(ordered[1:], ordered[:-1], out=first[1:])
    return first


def numbers(items: Iterable[int]) -> Numbers:
    """Return integers as an array."""
    return np.fromiter(items, dtype=np.int32)


def rows(items: Iterable[Sequence[V]]) -> Rows[K, V]:
    """Return rows of integers as arrays."""
    table = list(items)
    return Rows.parted(numbers(chain.from_iterable(table)), map(len, table))


def _offsets(lengths: npt.NDArray[np.integer[Any]]) -> Places:
    return np.concatenate(([0], np.cumsum(lengths, dtype=np.int64)))
