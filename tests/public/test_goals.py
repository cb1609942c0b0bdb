"""Whatever is printed can be typed."""

from __future__ import annotations

from foon_asp.io.folder import Dataset
from support.goal_checks import check_whatever_is_printed_can_be_typed


def test_whatever_is_printed_of_the_public_data_can_be_typed(universal: Dataset) -> None:
    check_whatever_is_printed_can_be_typed(universal)
