"""Near-duplicate labels: words that look like a rarer misspelling of another word."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence, Set

import numpy as np
from rapidfuzz.distance import OSA
from rapidfuzz.process import cdist

_RARE = 5
"""Between two words that are no known words of the kitchen, the misspelt one is this many times rarer."""

_SHORTEST, _LONG, _LONGEST = 4, 8, 64
"""Letters of the words that are compared, and of those that may differ in two. Longer ones are no words."""

_PAIRS = 1 << 20
"""How many pairs of words are compared at once: a byte each."""


def misspellings(labels: Mapping[str, int], lexicon: Collection[str]) -> Iterator[tuple[str, str]]:
    """Yield label and likelier spelling, given how often each label is used; sorted by label.

    Words are compared one by one. A word of the lexicon is never suspected. Another word is, if it
    begins with the same letter as a word of the lexicon, or as a much commoner one of the labels, and is
    one letter away from it (inserted, left out, doubled, swapped or, in words of five letters or more,
    replaced; two letters in words of eight letters or more). Words of more than 64 letters are left alone.
    """
    words: Counter[str] = Counter()
    for label, count in labels.items():
        for word in set(label.split()):
            words[word] += count
    likelier = _likelier(words, frozenset(lexicon))
    for label in sorted(labels):
        better = " ".join(likelier.get(word, word) for word in label.split())
        if better != label:
            yield label, better


def _likelier(words: Mapping[str, int], lexicon: Set[str]) -> dict[str, str]:
    """Return the likelier spelling of each word that is suspected: of several the commonest."""
    alike: defaultdict[tuple[str, int], list[str]] = defaultdict(list)
    for word in sorted({*words, *lexicon}, key=lambda word: (words.get(word, 0), word), reverse=True):
        if _SHORTEST <= len(word) <= _LONGEST:
            alike[word[0], len(word)].append(word)
    found: dict[str, str] = {}
    for (letter, length), members in list(alike.items()):
        suspects = [word for word in members if word not in lexicon]
        for other_length in range(length - 2, length + 3):
            others = alike.get((letter, other_length), [])
            for word, other in _nearest(suspects, others, words, lexicon):
                best = found.get(word, other)
                found[word] = max(best, other, key=lambda each: (words.get(each, 0), each))
    return found


def _nearest(
    suspects: Sequence[str], others: Sequence[str], words: Mapping[str, int], lexicon: Set[str]
) -> Iterator[tuple[str, str]]:
    """Yield with each suspect the first of the others that is near and likelier; all others have one length.

    Distances are worked out for many pairs at once, for there may be millions of them.
    """
    if not suspects:
        return
    least = _RARE * min(words[word] for word in suspects)
    others = [other for other in others if other in lexicon or words[other] >= least]
    if not others:
        return
    most = 2 if min(len(suspects[0]), len(others[0])) >= _LONG else 1
    step = max(1, _PAIRS // len(others))
    for begin in range(0, len(suspects), step):
        block = suspects[begin : begin + step]
        distances = cdist(block, others, scorer=OSA.distance, score_cutoff=most, dtype=np.uint8)
        for word, row in zip(block, distances, strict=True):
            for place in np.flatnonzero(row <= most).tolist():
                other = others[place]
                if (other in lexicon or words[other] >= _RARE * words[word]) and _near(word, other):
                    yield word, other
                    break


def _near(word: str, other: str) -> bool:
    shorter = min(len(word), len(other))
    if _inflected(word, other):
        return False
    # Optimal string alignment: letters that are swapped count as one edit.
    distance = OSA.distance(word, other, score_cutoff=2)
    if distance == 1:
        return shorter >= 5 or len(word) != len(other) or sorted(word) == sorted(other)
    return distance == 2 and shorter >= _LONG


def _inflected(word: str, other: str) -> bool:
    """Singular and plural, or forms of a verb, are two words and no misspelling."""
    short, long = sorted((word, other), key=len)
    if any(long == short + ending for ending in ("s", "es", "d", "ed", "r", "er", "y", "n", "en")):
        return not long.endswith("ss")
    endings = ("d", "r", "s", "n", "y", "ed", "er", "ing")
    stems = {word.removesuffix(ending) for ending in endings if word.endswith(ending)}
    return any(other.removesuffix(ending) in stems for ending in endings if other.endswith(ending))
