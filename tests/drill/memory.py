"""Many warm questions in one process: its memory stays flat."""

from __future__ import annotations

import gc
import time
from collections.abc import Iterator
from contextlib import suppress
from random import Random

import psutil

import foon_asp as fa
from drill.part import Outcome, Span, rate
from foon_asp.errors import FoonError

_QUESTIONS = 2000
"""Of less than half of these nothing is told: all that is kept was not yet asked for."""
_SAMPLES = 16
"""How often the memory is looked at; it goes up and down by some megabytes."""
_MOST = 4_000_000
"""How many bytes may be taken more at the end."""

_METHODS = ("optimal", "greedy", "ids", "first")
_RULE = ':- use(U), motion(U,"shake").'


def warm_questions(span: Span) -> Outcome:
    """Ask questions over the built-in data, and look at the memory from the first quarter on."""
    world = fa.load()
    goals = [str(goal) for goal in world.goals]
    asked, begun = 0, time.monotonic()
    taken = [_taken()]
    count = span.rounds or _QUESTIONS
    for query in _queries(Random(span.seed), goals, count):
        with suppress(FoonError):
            world.retrieve(query)
        asked += 1
        if asked % max(1, count // _SAMPLES) == 0:
            taken.append(_taken())
            if not span.goes_on(asked):
                break
    more = growth(taken)
    line = f"{rate('warm questions', asked, time.monotonic() - begun)}, {more / 1e6:+.1f} MB"
    failures = []
    if asked >= _QUESTIONS // 2 and more > _MOST:
        failures.append(f"{asked} questions take {more / 1e6:.1f} MB more")
    return Outcome([line], failures)


def growth(taken: list[int]) -> int:
    """Return by how much the least of the last quarter is above the most of the second quarter.

    What grows with the questions is seen by this, what only goes up and down is not.
    """
    quarter = max(1, len(taken) // 4)
    return min(taken[-quarter:]) - max(taken[quarter : 2 * quarter] or taken)


def _queries(random: Random, goals: list[str], count: int) -> Iterator[fa.Query]:
    for _ in range(count):
        query = fa.Query(random.choice(goals), method=random.choice(_METHODS))
        chance = random.random()
        if chance < 0.2:
            query = query.replace(time_limit=0.05)
        elif chance < 0.3:
            query = query.replace(method="optimal", by="units,success", remove=["salt"])
        elif chance < 0.33:
            # Under a limit, rules of the user's own are grounded in a process of its own.
            query = query.replace(method="optimal", rules=[_RULE], time_limit=5)
        yield query


def _taken() -> int:
    gc.collect()
    return int(psutil.Process().memory_info().rss)
