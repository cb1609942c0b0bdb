"""From facts and encodings to a control that answers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Union

from foon_asp import limits
from foon_asp.asp.control import Control, Program
from foon_asp.asp.encodings import encoding_files, encoding_text

if TYPE_CHECKING:
    from foon_asp.asp.process import ProcessControl

Solver = Union[Control, "ProcessControl"]
"""What is asked: a program that is grounded, here or in a process of its own."""

_LARGE = 200_000
"""Characters of a program above which it may take more than a tenth of a second to ground; one that is ground
already is taken in ten times as fast."""


def open_solver(
    encodings: Sequence[str],
    facts: str,
    constants: Mapping[str, str | int] | None = None,
    options: Sequence[str] = (),
    *,
    guarded: bool = False,
    timed: bool = False,
) -> Solver:
    """Ground encodings with some facts; `timed` ones have difference constraints.

    It is done in a process of its own where it could break a limit, and if it is `guarded`: with rules of the
    user's own, which may crash clingo; these get `limits.careful_memory`. Raises `ProgramError`, and
    `LimitReachedError`.
    """
    texts = (*map(encoding_text, encoding_files(encodings)), facts)
    program = Program(texts, constants or {}, tuple(options), timed=timed)
    return open_program(program, guarded=guarded)


def open_program(program: Program, *, guarded: bool = False) -> Solver:
    """Ground a program, or take one that is ground, in a process where `open_solver` would."""
    limited = limits.memory_allowed() < math.inf or (limits.seconds_left() < math.inf and _large(program))
    if not guarded and not limited:
        return Control(program)
    # It takes a process, beside which this import is nothing, and most questions need none.
    from foon_asp.asp.process import ProcessControl

    return ProcessControl(program, limits.careful_memory() if guarded else math.inf)


def _large(program: Program) -> bool:
    """Say whether a program may take long to ground."""
    if program.ground:
        return len(program.texts[-1]) > 10 * _LARGE
    rounds = program.constants.get("horizon", 1)
    assert isinstance(rounds, int)
    if program.timed:
        # Any two steps may be in each other's way.
        return len(program.texts[-1]) > _LARGE / 20
    # Facts are grounded once, and what is counted by rounds once a round.
    return len(program.texts[-1]) * max(1, rounds // 10) > _LARGE
