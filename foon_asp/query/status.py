"""How a question ended: one word for the user, one exit status for the shell."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


class Status(StrEnum):
    """How a question ended. The value is the word that texts and JSON use."""

    OPTIMAL = "optimal"
    """There is an answer, and none is better: proven."""
    FOUND = "found"
    """There is an answer, by a method that does not optimise."""
    SOLVED = "solved"
    """A planner found a plan and says nothing of its cost."""
    REACHABLE = "reachable"
    """There is a task tree, and it is explained."""
    UNREACHABLE = "unreachable"
    """No task tree exists; the reason is said."""
    CONSTRAINED = "constrained"
    """A task tree exists, but none that keeps the constraints."""
    UNSOLVABLE = "unsolvable"
    """No plan exists."""
    NONE = "none"
    """The user's own rules have no model."""
    LIMIT = "limit"
    """A limit was hit first; the best so far is there, if there is one."""
    GAVE_UP = "gave up"
    """A planner ended without an answer, and says nothing of why."""
    FAILED = "failed"
    """Something outside this program failed: a planner that crashed."""

    @property
    def exit_code(self) -> int:
        """What a command ends with: 0 found, 1 there is none, 2 something failed, 3 a limit was hit."""
        if self in (Status.LIMIT, Status.GAVE_UP):
            return 3
        if self is Status.FAILED:
            return 2
        return 1 if self in _NOTHING else 0

    @property
    def found(self) -> bool:
        """Whether the question has a positive answer."""
        return self.exit_code == 0

    @classmethod
    def worst(cls, statuses: Iterable[Status]) -> Status:
        """Return the status of several answers together: a limit outweighs a failure to find, that the rest.

        Without any answer the status is `FOUND`.
        """
        return max(statuses, key=lambda status: status.exit_code, default=cls.FOUND)


_NOTHING = frozenset({Status.UNREACHABLE, Status.CONSTRAINED, Status.UNSOLVABLE, Status.NONE})
