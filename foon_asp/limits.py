"""Limits of what a question may take: time, memory, and a user who has seen enough.

Whoever waits or computes for long asks here. `with limited(seconds):` sets a limit for all that is done
inside, in whatever function; a limit inside another one can only be tighter, so that a question made of
several keeps that of the whole. Limits belong to the thread (or the task of asyncio) that set them.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TypeVar

MEGABYTE = 1_000_000
"""Bytes of a megabyte, the unit of limits of memory."""

_MOMENT = 0.5
"""Seconds that are always there for what takes no longer."""

SLICE = 0.1
"""Seconds that anybody waits before looking again whether to stop."""

_LEAST = 0.001
"""Seconds that anybody waits, for no time at all would be no look."""

T = TypeVar("T")


class Limit(StrEnum):
    """Which limit ended the work."""

    TIME = "time"
    """The seconds of a time limit have passed."""
    MEMORY = "memory"
    """More memory was taken than allowed."""
    INTERRUPT = "interrupt"
    """The user pressed Ctrl-C and gets the best so far."""


def ended(limit: Limit | None) -> str:
    """Say that a limit came; one that is not known is of time."""
    return _ENDED[limit or Limit.TIME]


_ENDED = {
    Limit.TIME: "the time ran out",
    Limit.MEMORY: "the memory ran out",
    Limit.INTERRUPT: "interrupted",
}


class LimitReachedError(Exception):
    """A limit was reached before there was an answer."""

    def __init__(self, limit: Limit) -> None:
        super().__init__(ended(limit))
        self.limit = limit


@dataclass(frozen=True, slots=True)
class Limits:
    """Until when (`time.monotonic` seconds) and with how much memory (bytes) one may go on.

    `grace` is how many seconds more there are for a first answer.
    """

    deadline: float = math.inf
    memory: float = math.inf
    grace: float = _MOMENT


_NONE = Limits()
_current: ContextVar[Limits] = ContextVar("limits", default=_NONE)


@contextmanager
def limited(seconds: float | None = None, megabytes: float | None = None) -> Iterator[None]:
    """Limit all that is done inside to so many seconds from now, and to so much memory; None: no limit.

    A generator must not yield inside: its caller would be limited, too.
    """
    outer = _current.get()
    deadline = math.inf if seconds is None else time.monotonic() + seconds
    memory = math.inf if megabytes is None else megabytes * MEGABYTE
    deadline, memory = min(outer.deadline, deadline), min(outer.memory, memory)
    token = _current.set(replace(outer, deadline=deadline, memory=memory))
    try:
        yield
    finally:
        _current.reset(token)


@contextmanager
def moment() -> Iterator[None]:
    """Allow half a second for all that is done inside, even where no time is left.

    It is for what is nearly always there at once: a first tree, the reason why there is none.
    """
    outer = _current.get()
    token = _current.set(replace(outer, deadline=max(outer.deadline, time.monotonic() + _MOMENT)))
    try:
        yield
    finally:
        _current.reset(token)


@contextmanager
def strictly() -> Iterator[None]:
    """Allow no moment more inside: there is something to show."""
    token = _current.set(replace(_current.get(), grace=0.0))
    try:
        yield
    finally:
        _current.reset(token)


def seconds_left() -> float:
    """Return how many seconds there are until the deadline, at least 0; infinity without one."""
    return max(0.0, _current.get().deadline - time.monotonic())


def memory_allowed() -> float:
    """Return how many bytes of memory a process may take that works on this; infinity for any number."""
    return _current.get().memory


def limited_now() -> bool:
    """Whether there is any limit at all, so that it is worth having something early."""
    now = _current.get()
    return now.deadline < math.inf or now.memory < math.inf


def careful_memory() -> float:
    """Return the same for what may take any amount: else half of what the machine has, at most 4 GB."""
    import psutil

    said = memory_allowed()
    return said if said < math.inf else min(4000 * MEGABYTE, psutil.virtual_memory().total / 2)


def reached() -> Limit | None:
    """Return the limit that was reached, if one was."""
    if _Interrupts.finish:
        return Limit.INTERRUPT
    return Limit.TIME if seconds_left() == 0 else None


def check() -> None:
    """Raise `LimitReachedError` if a limit was reached, that of time more than a moment ago.

    What is done in a moment is done even where no time is left, so that there is something to show.
    """
    limit = reached()
    now = _current.get()
    if limit is Limit.TIME and time.monotonic() < now.deadline + now.grace:
        return
    if limit is not None:
        raise LimitReachedError(limit)


def wait_for(look: Callable[[float], T | None], pid: int, deadline: float, most: float = math.inf) -> T:
    """Wait for what a process is at: `look` waits so many seconds, and returns what has come of it, or None.

    Raises `LimitReachedError` at the deadline, at a Ctrl-C, and when the process and all that it started
    take more memory than is allowed here, or than `most` bytes.
    """
    # It takes 0.1 s to import, and what is done in this process needs none.
    from foon_asp.processes import memory_taken

    while True:
        found = look(max(_LEAST, min(SLICE, deadline - time.monotonic())))
        if found is not None:
            return found
        if _Interrupts.finish:
            raise LimitReachedError(Limit.INTERRUPT)
        if time.monotonic() >= deadline:
            raise LimitReachedError(Limit.TIME)
        if memory_taken(pid) > min(most, memory_allowed()):
            raise LimitReachedError(Limit.MEMORY)


class _Interrupts:
    """Whether Ctrl-C may end a wait with the best so far, and whether it has."""

    watched = False
    allowed = False
    waits = 0
    finish = False


def watch_interrupts() -> None:
    """Say that Ctrl-C must find whoever waits at any moment: signals are handled in this process."""
    _Interrupts.watched = True


def may_end_early() -> bool:
    """Whether what waits may have to end before it is done, by a limit or by the user."""
    return _Interrupts.watched or limited_now()


def let_interrupts_finish(allowed: bool = True) -> None:
    """Let a first Ctrl-C end what waits with the best so far, instead of raising `KeyboardInterrupt`."""
    _Interrupts.allowed = allowed


def finish_if_waiting() -> bool:
    """Ask what waits to end with the best so far; say whether something does. For signal handlers."""
    if _Interrupts.allowed and _Interrupts.waits and not _Interrupts.finish:
        _Interrupts.finish = True
        return True
    return False


def interrupted() -> bool:
    """Whether a user asked for the best so far."""
    return _Interrupts.finish


@contextmanager
def waiting() -> Iterator[None]:
    """Say that inside there is a best so far, and that `reached` is asked every `SLICE`."""
    _Interrupts.waits += 1
    try:
        yield
    finally:
        _Interrupts.waits -= 1
