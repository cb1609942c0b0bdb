"""A clingo control in a process of its own, which can be ended at any moment, and can die alone.

It is for what may take long to ground, which clingo cannot be stopped at, and for rules of the user's own,
which may crash clingo or fill the memory. A process is kept for the next question: starting one takes about
0.1 s, asking it nearly nothing.
"""

from __future__ import annotations

import atexit
import math
import os
import queue
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, BinaryIO

import psutil

from foon_asp import limits
from foon_asp.asp import messages
from foon_asp.asp.control import Look, Program
from foon_asp.asp.model import Model, Models, ProgramError
from foon_asp.asp.terms import Row
from foon_asp.limits import Limit, LimitReachedError

_GRACE = 0.5
"""Seconds that a process gets to end its search at a deadline by itself, with what it has proven."""

_KEPT = 2
"""How many processes wait for the next question."""

_KEPT_MEMORY = 500_000_000
"""Bytes above which a process is ended, not kept."""


class ProcessControl:
    """The same as `Control`, in another process.

    Its limits of time and memory are kept while it grounds, too: then the process is ended, and what is
    asked of it afterwards raises `LimitReachedError`.
    """

    def __init__(self, program: Program, memory: float = math.inf) -> None:
        """Ground the base part, with so many bytes of memory at most.

        Raises `ProgramError`, also if the process dies, and `LimitReachedError`.
        """
        limits.check()
        self._process = _taken()
        self._process.most = memory
        weakref.finalize(self, _given_back, self._process)
        self._ask("open", messages.packed_program(program), grace=0.0)

    def ground(self, part: str, *numbers: int) -> None:
        """Ground a part of the program with integer parameters."""
        self._ask("ground", part, *numbers, grace=0.0)

    def extend(self, part: str, text: str) -> None:
        """Add a part to the program, and ground it."""
        self._ask("extend", part, text, grace=0.0)

    def watch(self, rates: Iterable[tuple[int, float]], least: float, name: str, human_steps: int) -> None:
        """Let only models pass that succeed with a chance."""
        self._ask("watch", [list(each) for each in rates], least, name, human_steps)

    def switch(self, external: str, number: int, value: bool) -> None:
        """Set the external atom `external(number)`."""
        self._ask("switch", external, number, value)

    def first(self) -> Model:
        """Return a first model, whatever it costs, without proving anything of it."""
        with limits.moment():
            return self._model("first")

    def best(self) -> Model:
        """Return the best model, or the best until a limit."""
        return self._model("best")

    def possible(self) -> Model:
        """Return what some model shows, all such atoms together; `proven` says that these are all."""
        return self._model("possible")

    def all_best(self, distinct: str, most: int | None = None) -> Models:
        """Return all best models, as `Control.all_best` does; at a limit of memory none."""
        try:
            return messages.models(self._ask("all_best", distinct, most))
        except LimitReachedError as error:
            return Models((), False, error.limit)

    def look(self, predicates: Sequence[tuple[str, int]]) -> Look:
        """Look at the best models, as `Control.look` does."""
        try:
            return messages.look(self._ask("look", [list(each) for each in predicates]))
        except LimitReachedError as error:
            return Look(None, (), False, False, False, error.limit)

    def derived(self, predicates: Sequence[tuple[str, int]]) -> tuple[tuple[Row, ...], ...]:
        """Return the rows of some predicates that can be true in some model."""
        return messages.tables(self._ask("derived", [list(each) for each in predicates]))

    def _model(self, method: str) -> Model:
        limit = limits.reached()
        if limit is not None:
            return Model(None, False, limit=limit)
        try:
            return messages.model(self._ask(method))
        except LimitReachedError as error:
            return replace(self._process.best or Model(None, False), limit=error.limit)

    def _ask(self, method: str, *arguments: Any, grace: float = _GRACE) -> Any:
        return self._process.ask(method, list(arguments), grace)


class _Process:
    """A process that solves, seen from here."""

    def __init__(self) -> None:
        # The same modules are found there, whatever made them found here.
        start = "import sys; sys.path[:] = sys.argv[1:]; from foon_asp.asp.worker import main; main()"
        self._child = subprocess.Popen(
            [sys.executable, "-c", start, *sys.path],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # Ctrl-C is for the process that asks.
            start_new_session=True,
        )
        assert self._child.stdin is not None
        assert self._child.stdout is not None
        self._requests: BinaryIO = self._child.stdin  # type: ignore[assignment]
        self._replies: queue.SimpleQueue[list[Any] | None] = queue.SimpleQueue()
        reader = threading.Thread(target=_read_replies, args=(self._child.stdout, self._replies), daemon=True)
        reader.start()
        self._limit: Limit | None = None
        self.best: Model | None = None
        self.parent = os.getpid()
        self.most = math.inf

    def ask(self, method: str, arguments: list[Any], grace: float) -> Any:
        """Let it do something, and return what comes of it.

        Raises `ProgramError`, also if the process dies, and `LimitReachedError`.
        """
        if self._limit is not None:
            raise LimitReachedError(self._limit)
        seconds = limits.seconds_left()
        self.best = None
        try:
            messages.send(self._requests, [method, arguments, None if seconds == math.inf else seconds])
            with limits.waiting():
                return self._answer(time.monotonic() + seconds + grace)
        except OSError:
            raise ProgramError(self._how_it_died()) from None
        except ProgramError:
            raise
        except BaseException as error:
            # It is still at work on what nobody waits for.
            self._limit = error.limit if isinstance(error, LimitReachedError) else Limit.INTERRUPT
            self.end()
            raise

    def _answer(self, deadline: float) -> Any:
        while True:
            kind, value = limits.wait_for(self._reply, self._child.pid, deadline, self.most)
            if kind == "better":
                self.best = messages.model(value)
            elif kind == "error":
                raise ProgramError(value)
            else:
                return value

    def _reply(self, seconds: float) -> list[Any] | None:
        """Return the next reply, or None if it does not come so soon."""
        try:
            reply = self._replies.get(timeout=seconds)
        except queue.Empty:
            return None
        if reply is None:
            raise ProgramError(self._how_it_died())
        return reply

    def _how_it_died(self) -> str:
        """Say how the process died."""
        self.end()
        code = self._child.returncode
        how = f"signal {-code}" if code is not None and code < 0 else f"exit status {code}"
        return f"clingo died of them ({how})"

    def memory(self) -> int:
        """Return how many bytes of memory it takes; it has started nothing."""
        with suppress(psutil.NoSuchProcess):
            return int(psutil.Process(self._child.pid).memory_info().rss)
        return 0

    def alive(self) -> bool:
        """Whether it can be asked."""
        return self._limit is None and self._child.poll() is None

    def end(self) -> None:
        """End the process, whatever it is at."""
        self._limit = self._limit or Limit.INTERRUPT
        self._child.kill()
        self._child.wait()
        with suppress(OSError):
            self._requests.close()


def _read_replies(stream: BinaryIO, replies: queue.SimpleQueue[list[Any] | None]) -> None:
    with suppress(EOFError, OSError, ValueError):
        while True:
            replies.put(messages.receive(stream))
    replies.put(None)
    stream.close()


_idle: list[_Process] = []


def _taken() -> _Process:
    """Return a process that waits, or a new one."""
    with suppress(IndexError):
        while True:
            process = _idle.pop()
            # A fork must not talk to what its parent started.
            if process.parent == os.getpid() and process.alive():
                return process
    return _Process()


def _given_back(process: _Process) -> None:
    """Keep a process for the next question, unless it is of no use any more."""
    if process.parent != os.getpid():
        return
    if process.alive() and process.memory() < _KEPT_MEMORY and len(_idle) < _KEPT:
        # No lock: this may come at any moment, even while a process is taken.
        _idle.append(process)
    else:
        process.end()


@atexit.register
def _end_idle() -> None:
    """End what waits for a question that never comes."""
    while _idle:
        _idle.pop().end()
