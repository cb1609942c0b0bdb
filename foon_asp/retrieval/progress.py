"""Who is told of better trees while better ones are still looked for.

As with limits, that belongs to what is done, not to functions: whoever finds a tree says so here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from foon_asp.retrieval.tree import TaskTree

OnBetter = Callable[[TaskTree], object]
"""Is told of a tree that is better than those before it."""

_told: ContextVar[OnBetter | None] = ContextVar("told", default=None)


@contextmanager
def telling(on_better: OnBetter | None) -> Iterator[None]:
    """Tell somebody of the better trees that are found inside."""
    token = _told.set(on_better)
    try:
        yield
    finally:
        _told.reset(token)


def better(tree: TaskTree) -> None:
    """Say that a tree is better than those before it, and that the search goes on."""
    told = _told.get()
    if told is not None:
        told(tree)
