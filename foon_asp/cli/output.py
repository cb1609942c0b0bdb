"""What a command answers, where that is written, and what must not be replaced by it."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from io import TextIOWrapper
from pathlib import Path
from typing import TextIO

from foon_asp.characters import visible
from foon_asp.cli.inputs import paths_to_read
from foon_asp.cli.messages import warn
from foon_asp.errors import InputError, QueryError
from foon_asp.io import atomic
from foon_asp.io.files import exists, is_folder
from foon_asp.io.leftovers import clear, left_beside
from foon_asp.io.overwriting import refuse_inputs
from foon_asp.query.status import Status

STDOUT = "-"
"""What `--output` calls standard output."""


@dataclass(frozen=True, slots=True)
class Reply:
    """What a command answers, in each format that it has; nothing of it is written yet.

    `text` returns pieces, which may be made only when they are written; None: the command has written its
    files itself. `value` returns what `--format json` writes, `others` the pieces of further formats.
    `statuses`, of all questions, are complete once the answer is written. `summary` is for standard error.
    `failed` is for a command that is told to fail by what it finds: then the exit status is 1. `data` is an
    answer that is no text, in the format that was asked for.
    """

    text: Callable[[], Iterable[str]] | None = None
    value: Callable[[], object] | None = None
    others: Mapping[str, Callable[[], Iterable[str]]] = field(default_factory=dict)
    statuses: Collection[Status] = ()
    summary: str = ""
    failed: bool = False
    data: bytes | None = None

    def pieces(self, form: str) -> Iterable[str]:
        """Return the answer in a format."""
        if form == "json" and self.value is not None:
            # Most answers are shown as text, and what is declared of JSON takes a while to load.
            from foon_asp.io.wire import dumps

            return [dumps(self.value())]
        write = self.others.get(form, self.text)
        pieces = () if write is None else write()
        return [pieces] if isinstance(pieces, str) else pieces

    @property
    def exit_code(self) -> int:
        """What the command ends with."""
        return 1 if self.failed else Status.worst(self.statuses).exit_code


def check(options: argparse.Namespace) -> None:
    """Raise `InputError` if the answer cannot go where it should, before anything is worked out.

    Warn of what killed writers have left beside the files that are read.
    """
    for path, left in left_beside(filter(exists, paths_to_read(options))):
        warn(
            options, f"{left} was left by a writer that was killed; the next one that writes {path} clears it"
        )
    if options.output == STDOUT:
        return
    check_targets(options, file_to_write(options.output))


def check_targets(options: argparse.Namespace, *targets: Path) -> None:
    """Raise `InputError` if writing some targets would replace what is read, or unasked what is there."""
    refuse_inputs(targets, paths_to_read(options))
    _refuse_replacing(options, *targets)


def _refuse_replacing(options: argparse.Namespace, *targets: Path) -> None:
    """Raise `InputError` if one of some targets is there, and may not be replaced."""
    for target in targets:
        # A folder that a killed writer has put aside is there, too.
        clear(target)
        if not options.overwrite and atomic.is_there(target):
            raise InputError(target, None, "this is there already", "name another one, or add --overwrite")


def file_to_write(name: str) -> Path:
    """Return the file that is to be written; raise `InputError` if a folder is there."""
    if is_folder(Path(name)):
        raise InputError(name, None, "this is a folder", "name a file")
    return Path(name)


def folder_to_write(options: argparse.Namespace) -> Path:
    """Return the folder that a command writes; raise `QueryError` if it is to be standard output."""
    if options.target == STDOUT:
        raise QueryError("a folder is written, which standard output cannot be; name one")
    return Path(options.target)


def emit(reply: Reply, options: argparse.Namespace) -> None:
    """Write an answer where the options say, in the format that they name."""
    if reply.data is not None:
        _write_data(options.output, reply.data)
        return
    pieces = reply.pieces(options.format)
    to_be_read = options.format == "text" or (options.output == STDOUT and _is_terminal(sys.stdout))
    write(options.output, map(visible, pieces) if to_be_read else pieces)


def write(target: str, pieces: Iterable[str]) -> None:
    """Write a text to standard output piece by piece, or to a file, whole or not at all."""
    if target != STDOUT:
        atomic.write_text(Path(target), "".join(pieces))
        return
    for piece in pieces:
        with told():
            sys.stdout.write(piece)
    with told():
        sys.stdout.flush()


def _write_data(target: str, data: bytes) -> None:
    """Write what is no text to standard output, which must be no terminal, or to a file."""
    if target != STDOUT:
        atomic.write_bytes(Path(target), data)
        return
    if _is_terminal(sys.stdout):
        raise InputError("standard output", None, "a terminal shows no such format", "name a file with -o")
    with told():
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()


def _is_terminal(stream: TextIO | None) -> bool:
    """Tell whether a person looks on; nobody does where a stream is closed."""
    return stream is not None and not stream.closed and stream.isatty()


@contextmanager
def told() -> Iterator[None]:
    """Raise what the system has against writing to standard output as `InputError`.

    A reader that has seen enough is no error: `BrokenPipeError` is raised as it is.
    """
    if sys.stdout is None or sys.stdout.closed:
        raise InputError("standard output", None, "this is closed", "name a file with -o")
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        abandon(sys.stdout)
        problem = f"cannot be written ({error.strerror or error})"
        raise InputError("standard output", None, problem) from None


def abandon(stream: TextIO) -> None:
    """Keep the interpreter from writing again, at its end, what could not be written."""
    with suppress(OSError, ValueError):
        number = os.open(os.devnull, os.O_WRONLY)
        os.dup2(number, stream.fileno())
        os.close(number)


def prepare_streams() -> None:
    """See to it that messages can be written whatever the three standard streams are.

    A terminal that cannot show a character of a label is no reason to stop. The numbers of streams that are
    closed are taken, for the next file to be opened would get one of them, and what a library has to say.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115 - open to the end
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
