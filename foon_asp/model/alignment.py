"""The same in other words: which labels, states and motions of several trees mean one thing.

Words are the same if they differ in blanks, hyphens and capitals alone, if one is the plural of the other, if
one looks like a misspelling of the other, or if a measure of likeness says so. Of words that are the same the
one that most trees have is kept, but for misspellings.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import combinations

from foon_asp.model.node import ObjectNode, State
from foon_asp.model.spelling import misspellings
from foon_asp.numbers import LEAST_LIKENESS

Likeness = Callable[[str, str], float]
"""How alike two labels are in meaning, from 0 to 1; it is symmetric."""

_APART = re.compile(r"[\s_-]+")


@dataclass(frozen=True, slots=True)
class Measure:
    """A measure of likeness, and how alike two labels are at least that are taken for one."""

    likeness: Likeness
    least: float = LEAST_LIKENESS


@dataclass(frozen=True, slots=True)
class Aligned:
    """A word, the one that is written instead, and why: `spelling`, `number`, `misspelling` or `likeness`."""

    word: str
    instead: str
    why: str


def align(
    used: Sequence[Counter[str]],
    beside: Iterable[str] = (),
    lexicon: Collection[str] = (),
    measure: Measure | None = None,
) -> list[Aligned]:
    """Return which words of some trees are written otherwise, sorted; `used` counts those of each tree.

    Words that stand `beside` the trees, in models, are brought to those of the trees. Words of the `lexicon`
    are spelt rightly. Two words that stand in one tree are not taken for one by likeness alone.
    """
    counts: Counter[str] = sum(used, Counter())
    words = list(dict.fromkeys([*counts, *beside]))
    classes = _Classes(words)
    misspelt = dict(_misspelt(words, counts, lexicon))
    steps = [
        ("spelling", _same_by(words, squashed)),
        ("number", _same_by(words, _Singulars(words))),
        ("misspelling", misspelt.items()),
        ("likeness", () if measure is None else _alike(counts, measure)),
    ]
    reasons: dict[tuple[str, str], str] = {}
    for why, pairs in steps:
        for one, other in pairs:
            if why != "likeness" or not any(classes.tell_apart(one, other, tree.keys()) for tree in used):
                reasons |= dict.fromkeys(classes.join(one, other), why)
    trees = Counter(word for tree in used for word in tree)
    places = {word: place for place, word in enumerate(words)}

    def common(word: str) -> tuple[bool, int, int, int]:
        return word not in misspelt, trees[word], counts[word], -places[word]

    found = []
    for members in classes.groups():
        kept = max(members, key=common)
        found += [Aligned(word, kept, reasons[word, kept]) for word in members if word != kept]
    return sorted(found, key=lambda each: each.word)


def squashed(word: str) -> str:
    """Return a word without what people write in different ways: capitals, blanks and hyphens."""
    return _APART.sub("", word.casefold())


def _same_by(words: Iterable[str], key: Callable[[str], str]) -> Iterator[tuple[str, str]]:
    """Yield each word that has the key of an earlier one, with the first of these."""
    first: dict[str, str] = {}
    for word in words:
        other = first.setdefault(key(word), word)
        if other != word:
            yield other, word


class _Singulars:
    """Brings words to a form in which a plural is as its singular, if both occur among some words."""

    def __init__(self, words: Iterable[str]) -> None:
        self._parts = {part for word in words for part in (*_parts(word), squashed(word))}
        self._singular = {
            plural: part for part in sorted(self._parts) for plural in plurals(part) if plural in self._parts
        }

    def __call__(self, word: str) -> str:
        joined = "".join(self._singular.get(part, part) for part in _parts(word))
        return self._singular.get(joined, joined)


def _parts(word: str) -> list[str]:
    return [part for part in _APART.split(word.casefold()) if part]


def plurals(word: str) -> set[str]:
    """Return what the plural of an English word may be."""
    found = {word + "s"}
    if word.endswith(("s", "x", "z", "ch", "sh", "o")):
        found.add(word + "es")
    if word.endswith("y") and word[-2:-1] not in "aeiou":
        found.add(word[:-1] + "ies")
    if word.endswith("f"):
        found.add(word[:-1] + "ves")
    if word.endswith("fe"):
        found.add(word[:-2] + "ves")
    return found


def _misspelt(
    words: Collection[str], counts: Mapping[str, int], lexicon: Collection[str]
) -> Iterator[tuple[str, str]]:
    known = set(words)
    for word, better in misspellings(counts, lexicon):
        if better in known:
            yield word, better


def _alike(words: Iterable[str], measure: Measure) -> Iterator[tuple[str, str]]:
    """Yield the words that are alike enough, the most alike first."""
    pairs = [(measure.likeness(one, other), one, other) for one, other in combinations(sorted(words), 2)]
    for _, one, other in sorted(
        (pair for pair in pairs if pair[0] >= measure.least), key=lambda pair: -pair[0]
    ):
        yield one, other


class _Classes:
    """Words that are the same."""

    def __init__(self, words: Iterable[str]) -> None:
        self._members = {word: [word] for word in words}

    def join(self, one: str, other: str) -> list[tuple[str, str]]:
        """Say that two words, and all that are the same as these, are one; return the pairs this adds."""
        ours, theirs = self._members[one], self._members[other]
        if ours is theirs:
            return []
        pairs = [pair for mine in ours for their in theirs for pair in ((mine, their), (their, mine))]
        ours += theirs
        for word in theirs:
            self._members[word] = ours
        return pairs

    def tell_apart(self, one: str, other: str, tree: Set[str]) -> bool:
        """Whether a tree has both of two words, or others that are the same as these, as two."""
        ours, theirs = self._members[one], self._members[other]
        return ours is not theirs and not tree.isdisjoint(ours) and not tree.isdisjoint(theirs)

    def groups(self) -> list[list[str]]:
        """Return the words that are the same, those that stand alone too."""
        return list({id(members): members for members in self._members.values()}.values())


@dataclass(frozen=True, slots=True)
class Alignment:
    """What is written instead of labels, states and motions."""

    labels: tuple[Aligned, ...] = ()
    states: tuple[Aligned, ...] = ()
    motions: tuple[Aligned, ...] = ()

    def rewriter(self) -> Rewriter:
        """Return what writes nodes and motions in the words that are kept."""
        return Rewriter(
            *({each.word: each.instead for each in kind} for kind in (self.labels, self.states, self.motions))
        )


@dataclass(frozen=True, slots=True)
class Rewriter:
    """Writes object nodes and motions in other words."""

    labels: Mapping[str, str]
    states: Mapping[str, str]
    motions: Mapping[str, str]

    def label(self, word: str) -> str:
        """Return what is written instead of a label."""
        return self.labels.get(word, word)

    def state(self, word: str) -> str:
        """Return what is written instead of the name of a state."""
        return self.states.get(word, word)

    def motion(self, word: str) -> str:
        """Return what is written instead of a motion."""
        return self.motions.get(word, word)

    def node(self, node: ObjectNode) -> ObjectNode:
        """Return a node in other words; its states are in their canonical order."""
        return ObjectNode.of(self.label(node.label), map(self._state, node.states))

    def _state(self, state: State) -> State:
        if state.plain:
            return State(self.state(state.name))
        relatum = None if state.relatum is None else self.label(state.relatum)
        contents = None if state.contents is None else tuple(map(self.label, state.contents))
        return State(state.name, relatum, contents)
