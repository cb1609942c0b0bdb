"""The audit suspects just the words that a comparison of every pair, letter by letter, does."""

from __future__ import annotations

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.model.spelling import _inflected, misspellings
from support.examples import many


def distance(one: str, other: str) -> int:
    """Return the distance of optimal string alignment, by its definition."""
    rows = [[i + j if not i * j else 0 for j in range(len(other) + 1)] for i in range(len(one) + 1)]
    for i in range(1, len(one) + 1):
        for j in range(1, len(other) + 1):
            same = one[i - 1] == other[j - 1]
            rows[i][j] = min(rows[i - 1][j] + 1, rows[i][j - 1] + 1, rows[i - 1][j - 1] + (not same))
            if i > 1 and j > 1 and one[i - 1] == other[j - 2] and one[i - 2] == other[j - 1]:
                rows[i][j] = min(rows[i][j], rows[i - 2][j - 2] + 1)
    return rows[-1][-1]


def near(word: str, other: str) -> bool:
    shorter = min(len(word), len(other))
    if shorter < 4 or word[0] != other[0] or _inflected(word, other):
        return False
    edits = distance(word, other)
    if edits == 1:
        return shorter >= 5 or len(word) != len(other) or sorted(word) == sorted(other)
    return edits == 2 and shorter >= 8


WORDS = st.text("abs", min_size=1, max_size=4).map(lambda text: "a" + text + "bab" * (len(text) % 3))


@many(300)
@given(st.dictionaries(WORDS, st.integers(1, 30), max_size=15), st.sets(WORDS, max_size=5))
def test_as_a_comparison_of_all_pairs(counts: dict[str, int], lexicon: set[str]) -> None:
    expected = []
    for word in sorted(counts):
        found = [
            other
            for other in {*counts, *lexicon}
            if word not in lexicon
            and near(word, other)
            and (other in lexicon or counts[other] >= 5 * counts[word])
        ]
        if found:
            expected.append((word, max(found, key=lambda other: (counts.get(other, 0), other))))
    assert list(misspellings(Counter(counts), lexicon)) == expected
