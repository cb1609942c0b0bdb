"""Misspelt labels."""

from __future__ import annotations

from foon_asp.model.spelling import misspellings


def test_misspellings_are_rare_words_near_known_or_common_ones() -> None:
    labels = {"glas": 1, "drinking glass": 3, "choocolate": 2, "raman": 9, "batter": 2, "butter": 90}
    labels |= {"flibber": 10, "fliber": 1, "egg": 4, "eggs": 1}
    assert dict(misspellings(labels, {"glass", "chocolate", "ramen", "batter", "butter"})) == {
        "glas": "glass",
        "choocolate": "chocolate",
        "raman": "ramen",
        "fliber": "flibber",
    }
