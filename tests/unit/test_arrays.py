"""Integers ascending, each once: numpy says the same, but takes longer to be there."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.model.arrays import counts, distinct, places

_INTEGERS = st.lists(st.integers(-5, 5) | st.integers(-(2**40), 2**40), max_size=30).map(
    lambda values: np.array(values, dtype=np.int64)
)


@given(_INTEGERS)
def test_what_is_there_ascends_and_is_counted(values: npt.NDArray[np.int64]) -> None:
    once, times = np.unique(values, return_counts=True)
    assert distinct(values).tolist() == once.tolist()
    assert [part.tolist() for part in counts(values)] == [once.tolist(), times.tolist()]


@given(_INTEGERS, _INTEGERS)
def test_values_are_found_among_others(values: npt.NDArray[np.int64], others: npt.NDArray[np.int64]) -> None:
    ascending = distinct(others)
    found, there = places(values, ascending)
    assert there.tolist() == np.isin(values, others).tolist()
    assert ascending[found[there]].tolist() == values[there].tolist()
