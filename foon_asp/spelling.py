"""Near-duplicate labels: words that look like a rarer misspelling of another word."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping

_RARE = 5
"""Between two words that are no known words of the kitchen, the misspelt one is this many times rarer."""


def misspellings(labels: Mapping[str, int], lexicon: Collection[str]) -> Iterator[tuple[str, str]]:
    """Yield label and likelier spelling, given how often each label is used; sorted by label.

    Words are compared one by one. A word of the lexicon is never suspected. Another word is, if it
    begins with the same letter as a word of the lexicon, or as a much commoner one of the labels, and is
    one letter away from it (inserted, left out, doubled, swapped or, in words of five letters or more,
    replaced; two letters in words of eight letters or more).
    """
    words: Counter[str] = Counter()
    for label, count in labels.items():
        for word in set(label.split()):
            words[word] += count
    by_first: dict[str, list[str]] = {}
    for word in sorted({*words, *lexicon}):
        by_first.setdefault(word[0], []).append(word)
    likelier: dict[str, str] = {}
    for word in words.keys() - set(lexicon):
        found = [
            other
            for other in by_first[word[0]]
            if (other in lexicon or words[other] >= _RARE * words[word]) and _near(word, other)
        ]
        if found:
            likelier[word] = max(found, key=lambda other: (words[other], other))
    for label in sorted(labels):
        better = " ".join(likelier.get(word, word) for word in label.split())
        if better != label:
            yield label, better


def _near(word: str, other: str) -> bool:
    shorter = min(len(word), len(other))
    if shorter < 4 or abs(len(word) - len(other)) > 2 or _inflected(word, other):
        return False
    # Two edits bring in two new letters and remove two others, at the most.
    if len(set(word) ^ set(other)) > 4:
        return False
    distance = _distance(word, other)
    if distance == 1:
        return shorter >= 5 or len(word) != len(other) or sorted(word) == sorted(other)
    return distance == 2 and shorter >= 8


def _inflected(word: str, other: str) -> bool:
    """Singular and plural, or forms of a verb, are two words and no misspelling."""
    short, long = sorted((word, other), key=len)
    if any(long == short + ending for ending in ("s", "es", "d", "ed", "r", "er", "y", "n", "en")):
        return not long.endswith("ss")
    endings = ("d", "r", "s", "n", "y", "ed", "er", "ing")
    stems = {word.removesuffix(ending) for ending in endings if word.endswith(ending)}
    return any(other.removesuffix(ending) in stems for ending in endings if other.endswith(ending))


def _distance(a: str, b: str) -> int:
    """Return the Damerau-Levenshtein distance (optimal string alignment): swaps count as one."""
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        last, row, older = row, [i], before
        for j, y in enumerate(b, 1):
            cost = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and a[i - 2] == y:
                cost = min(cost, older[j - 2] + 1)
            row.append(cost)
        before = last
    return row[-1]
