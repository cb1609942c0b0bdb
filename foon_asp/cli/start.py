"""Where `foon-asp` starts and ends: signals first, for the rest takes a moment to import."""

from __future__ import annotations

import os
import signal
import sys
from contextlib import suppress
from typing import NoReturn


def main() -> NoReturn:
    """Run the command line, and end with its exit status."""
    # Nothing is there yet that would have to be put in order.
    signal.signal(signal.SIGINT, _leave)
    status = _run()
    signal.signal(signal.SIGINT, _leave)
    for stream in (sys.stdout, sys.stderr):
        # What cannot be written was said, or is nobody's loss.
        with suppress(OSError, ValueError, AttributeError):
            stream.flush()
    # Taking the interpreter apart takes as long as a small question, and stumbles over threads of clingo.
    os._exit(status)


def _run() -> int:
    try:
        from foon_asp.cli.main import main as run
        from foon_asp.cli.signals import catch_signals

        catch_signals()
        return run()
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except SystemExit as error:
        # clingo wraps what comes in the middle of its callbacks into another one of the same kind.
        code = error.code.code if isinstance(error.code, SystemExit) else error.code
        return code if isinstance(code, int) else int(code is not None)
    except BaseException:
        sys.excepthook(*sys.exc_info())
        return 70


def _leave(number: int, _frame: object) -> NoReturn:
    os._exit(128 + number)
