"""The command line: `foon-asp COMMAND`. Reads files, writes answers to standard output, messages to stderr.

Exit status: 0 found, 1 no task tree exists, 2 bad input or usage, 3 a limit was hit, 130 Ctrl-C, 143 SIGTERM.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence

from foon_asp import limits
from foon_asp.cli import output
from foon_asp.cli.commands import COMMANDS
from foon_asp.cli.messages import note, tell, warn
from foon_asp.cli.parser import BAD_USAGE, Parser, Version
from foon_asp.errors import FoonError, InternalError
from foon_asp.limits import Limit, LimitReachedError, ended
from foon_asp.query.status import Status

INTERRUPTED = 130
"""The exit status of a command that Ctrl-C ended."""

_NO_ROOM = "failed to map segment"
"""What the system says of a library for which it has no memory left."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status."""
    output.prepare_streams()
    try:
        return _run(_parser().parse_args(arguments))
    except FoonError as error:
        tell(f"error: {error}")
        return BAD_USAGE
    except LimitReachedError as error:
        tell(f"{error} before there was an answer")
        return INTERRUPTED if error.limit is Limit.INTERRUPT else Status.LIMIT.exit_code
    except (MemoryError, ImportError) as error:
        if isinstance(error, ImportError) and _NO_ROOM not in str(error):
            raise
        tell(f"{ended(Limit.MEMORY)} before there was an answer")
        return Status.LIMIT.exit_code
    except InternalError as error:
        tell(f"internal error, please report it: {error}")
        return 70
    except BrokenPipeError:
        # The reader (a pager, `head`) has seen enough; keep the interpreter from complaining at exit.
        output.abandon(sys.stdout)
        return 0
    except KeyboardInterrupt:
        return INTERRUPTED


def _run(options: argparse.Namespace) -> int:
    started = time.monotonic()
    options.cut_off = False
    for renamed in options.renamed:
        warn(options, renamed)
    output.check(options)
    # Only what knows limits can say that its answer is not the whole one.
    limits.let_interrupts_finish(hasattr(options, "time_limit"))
    reply = options.run(options)
    output.emit(reply, options)
    if reply.summary:
        note(options, reply.summary)
    if options.verbose:
        note(options, f"{options.command} took {time.monotonic() - started:.2f} s")
    return INTERRUPTED if limits.interrupted() else int(reply.exit_code) or int(options.cut_off)


def _parser() -> Parser:
    parser = Parser(
        prog="foon-asp",
        description="Task trees from functional object-oriented networks: proven, checked, explained.",
        epilog="exit status: 0 found, 1 no task tree exists, 2 bad input or usage, 3 a limit was hit,"
        " 130 Ctrl-C, 143 SIGTERM",
    )
    parser.add_argument("--version", action=Version, help="show program's version number and exit")
    parser.add_commands(COMMANDS, "command")
    return parser
