"""What a process that solves does: ground and solve what it is told, until nobody tells it anything.

It is told on standard input and answers on standard output; `foon_asp.asp.messages` has the form.
"""

from __future__ import annotations

import os
import queue
import sys
import threading
import time
from typing import Any, BinaryIO

from foon_asp.asp import messages
from foon_asp.asp.control import Control, Progress
from foon_asp.asp.model import Model, ProgramError
from foon_asp.limits import SLICE, limited


def main() -> None:
    """Serve until standard input ends."""
    requests: queue.SimpleQueue[list[Any]] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, requests), daemon=True).start()
    # Whatever prints must not come between the messages.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    control: Control | None = None
    while True:
        method, arguments, seconds = requests.get()
        if method == "open":
            # What was there before makes room first.
            control = None
        try:
            with limited(seconds):
                if control is None:
                    control, value = Control(messages.program(arguments[0])), None
                else:
                    value = _done(control, method, arguments, _progress(answers))
            messages.send(answers, ["done", messages.packed(value)])
        except ProgramError as error:
            messages.send(answers, ["error", str(error)])
        except MemoryError:
            messages.send(answers, ["error", "there is not enough memory"])
        except RecursionError:
            messages.send(answers, ["error", "a term is nested too deep"])


def _done(control: Control, method: str, arguments: list[Any], progress: Progress) -> Any:
    if method == "best":
        return control.best(progress)
    if method == "look":
        return control.look([(name, arity) for name, arity in arguments[0]])
    return getattr(control, method)(*arguments)


def _progress(answers: BinaryIO) -> Progress:
    """Return what sends better models, but none right after another one."""
    said = 0.0

    def better(model: Model) -> None:
        nonlocal said
        if time.monotonic() - said >= SLICE:
            messages.send(answers, ["better", messages.packed(model)])
            said = time.monotonic()

    return better


def _listen(stream: BinaryIO, requests: queue.SimpleQueue[list[Any]]) -> None:
    """Take requests while clingo is at work, and end with the process that sends them, however it ends."""
    try:
        while True:
            requests.put(messages.receive(stream))
    except EOFError:
        os._exit(0)
