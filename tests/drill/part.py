"""What a part of the drill is given, and what it hands back."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Span:
    """How much of a part is done: until some moment (`time.monotonic` seconds) or a number of rounds.

    What is done first, second, … depends on the seed alone.
    """

    seed: int
    end: float
    rounds: int | None = None
    jobs: int = 1

    @classmethod
    def of(cls, seed: int, seconds: float, rounds: int | None = None, jobs: int = 1) -> Span:
        return cls(seed, time.monotonic() + seconds, rounds, jobs)

    def goes_on(self, done: int) -> bool:
        """Say whether there is one more round; a part that has a number of rounds has one at least."""
        if self.rounds is not None and done >= self.rounds:
            return False
        return done == 0 or time.monotonic() < self.end


@dataclass(slots=True)
class Outcome:
    """What a part did, line by line, and what failed."""

    lines: list[str] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)

    def add(self, other: Outcome) -> None:
        self.lines += other.lines
        self.failures += other.failures


Part = Callable[[Span], Outcome]


def fast_folder() -> str | None:
    """Return a folder in memory, where the system has one, for what is written thousands of times."""
    return "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


def rate(name: str, count: int, seconds: float) -> str:
    """Say how many of something were done, and how many a second."""
    return f"{name:<22}{count:>12,}{count / seconds if seconds else 0:>12,.0f}/s"
