"""Ctrl-C and requests to end: a command ends soon, with all that it started, whatever it is at.

Python runs a handler only between two of its own instructions, which takes as long as clingo grounds. So a
thread watches, too, and ends what does not end by itself.
"""

from __future__ import annotations

import _thread
import os
import select
import signal
import sys
import threading
import time
from types import FrameType
from typing import NoReturn

from foon_asp import limits

_SOON = 1.0
"""Seconds within which a handler runs, unless the interpreter is stuck in a library."""

_PATIENCE = 10.0
"""Seconds that a command has to end once it was told to."""

_AGAIN = 0.05
"""Seconds after which a signal is sent again, if what its handler raised was lost."""

_ENDING = [signal.SIGTERM, *([signal.SIGHUP] if hasattr(signal, "SIGHUP") else [])]


class _Seen:
    """What the handlers have seen."""

    interrupts = 0
    handled = threading.Event()
    lost = False


def catch_signals() -> None:
    """Let Ctrl-C end with the best so far where there is one, and else raise `KeyboardInterrupt`.

    A second one leaves at once. A request to end raises `SystemExit`. For the main thread alone.
    """
    limits.watch_interrupts()
    signal.signal(signal.SIGINT, _interrupted)
    for number in _ENDING:
        # What `nohup` told to be ignored still is.
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _told_to_end)
    sys.unraisablehook = _lost
    if os.name == "posix":
        reader, writer = os.pipe()
        os.set_blocking(writer, False)
        signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
        threading.Thread(target=_watch, args=(reader,), daemon=True).start()


def _interrupted(_number: int, _frame: FrameType | None) -> None:
    _Seen.handled.set()
    _Seen.interrupts += 1
    if _Seen.interrupts > 1:
        _leave(128 + signal.SIGINT)
    if not limits.finish_if_waiting():
        raise KeyboardInterrupt


def _told_to_end(number: int, _frame: FrameType | None) -> None:
    _Seen.handled.set()
    raise SystemExit(128 + number)


def _lost(what: sys.UnraisableHookArgs) -> None:
    """Note that what a handler raised came in the middle of a finalizer, which cannot pass it on."""
    if issubclass(what.exc_type, KeyboardInterrupt | SystemExit):
        _Seen.interrupts = 0
        _Seen.lost = True
    else:
        sys.__unraisablehook__(what)


def _watch(reader: int) -> None:
    """Read the numbers of signals as they come, before any handler runs."""
    ending = {signal.SIGINT, *_ENDING}
    while True:
        number = os.read(reader, 1)[0]
        if number in ending:
            break
    if not _Seen.handled.wait(_SOON):
        _leave(128 + number)
    end = time.monotonic() + _PATIENCE
    while time.monotonic() < end:
        if _Seen.lost:
            _Seen.lost = False
            _thread.interrupt_main(signal.Signals(number))
        if select.select([reader], [], [], _AGAIN)[0] and os.read(reader, 1)[0] in ending:
            # Told again: its handler leaves, if it runs.
            end = min(end, time.monotonic() + _SOON)
    _leave(128 + number)


def _leave(status: int) -> NoReturn:
    """End this process now, and all that it started."""
    from foon_asp.processes import end_family

    end_family(os.getpid(), itself=False)
    os._exit(status)
