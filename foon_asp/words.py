"""How messages are worded: counted, listed, the closest known word."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePath
from textwrap import wrap

WIDTH = 100
"""How many characters a line of output has, where names allow."""

LONGEST = 200
"""How many characters of a name or of what was given a message holds."""


_LOOKED_AT = 20
"""How many words that resemble another are looked at more closely."""

_AT_ONCE = 100
"""How many words are compared with all others at once: the table has a row for each."""


def counted(number: int, word: str) -> str:
    """Return `1 step`, `2 steps`."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def cut(text: str, most: int = LONGEST) -> str:
    """Return a text as a message can hold it: its beginning and `…` if it is longer than so much."""
    return text if len(text) <= most else text[: most - 1] + "…"


def chance_text(chance: float, digits: int = 3) -> str:
    """Return a chance with so many digits, or as many as it takes to tell it from certainty."""
    texts = (f"{chance:.{enough}g}" for enough in range(digits, 18))
    return next(text for text in texts if (float(text) < 1) == (chance < 1))


def shortened(names: Sequence[object], shown: int = 3, mark: str = ",") -> str:
    """Return `a, b, c and 4 more`; with the mark `;`, for names with commas, `a; b; c; and 4 more`."""
    more = f"{mark.strip(',')} and {len(names) - shown} more" if len(names) > shown else ""
    return f"{mark} ".join(cut(str(name)) for name in names[:shown]) + more


def listed(names: Sequence[object], shown: int = 3) -> str:
    """Return `a, b and c`, or `a, b, c and 4 more`."""
    if 1 < len(names) <= shown:
        return f"{shortened(names[:-1], shown)} and {names[-1]}"
    return shortened(names, shown)


def short_source(file: str, line: int) -> str:
    """Return a place in a file without its folders, `FOON.txt:7`; without a line where it is 0."""
    name = PurePath(file).name
    return f"{name}:{line}" if line else name


def wrapped(text: str, first: str, rest: str) -> list[str]:
    """Break a text into lines that begin with `first` and then with `rest`; no word is broken."""
    return wrap(
        text,
        WIDTH,
        initial_indent=first,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )


def alike(word: str, known: Iterable[str], count: int, least: float = 0.6) -> list[str]:
    """Return at most so many known words that resemble a word at least so much, of 1; the likest first.

    Words resemble each other by the letters that they share in order, as twice their number by that of all.
    """
    # It takes 10 ms to import, of 250 for a whole question, and only a wrong word needs it.
    from rapidfuzz import fuzz, process

    # Sorted: of several that are equally near the first ones are named.
    choices = sorted(set(known))
    found = process.extract(word, choices, scorer=fuzz.ratio, limit=count, score_cutoff=100 * least)
    return [match for match, _, _ in found]


def likest(words: Sequence[str], known: Iterable[str], least: float) -> Iterator[tuple[str, str]]:
    """Yield each word that resembles a known one at least so much, of 1, with the likest, as `alike` does."""
    from rapidfuzz import fuzz, process

    choices = sorted(set(known))
    for start in range(0, len(words) if choices else 0, _AT_ONCE):
        some = words[start : start + _AT_ONCE]
        shares = process.cdist(some, choices, scorer=fuzz.ratio, score_cutoff=100 * least, dtype=float)
        for word, row, best in zip(some, shares, shares.argmax(axis=1), strict=True):
            if row[best]:
                yield word, choices[best]


def closest(word: str, known: Iterable[str], count: int = 3) -> str:
    """Return `; closest: a, b, c`, or nothing when no known word is near."""
    matches = likely_meant(word, known, count)
    return "; closest: " + ", ".join(map(cut, matches)) if matches else ""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return `; did you mean a?`, or nothing when no known word is near."""
    matches = likely_meant(word, known, 1)
    return f"; did you mean {matches[0]}?" if matches else ""


def likely_meant(word: str, known: Iterable[str], count: int) -> list[str]:
    """Return at most so many known words that may be meant by one that is mistyped; the likest first.

    A word may be meant if it resembles the one that was typed, and one of three letters of it or of one of
    its parts is wrong at most, or one begins with the other. None is for one that no message holds whole.
    """
    if len(word) > LONGEST:
        return []
    from rapidfuzz.distance import OSA

    def mistyped(said: str, meant: str) -> bool:
        return OSA.distance(said, meant) <= max(1, len(said) // 3)

    def may_be(other: str) -> bool:
        if other.startswith(word) or word.startswith(other) or mistyped(word, other):
            return True
        # Of what is very long a few parts will do.
        parts = other[:LONGEST].split()
        return any(mistyped(said, meant) for said in word[:LONGEST].split() for meant in parts)

    return [match for match in alike(word, known, _LOOKED_AT) if may_be(match)][:count]
