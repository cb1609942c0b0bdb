"""A file or a folder is there whole, or as it was before, whatever happens while it is written."""

from __future__ import annotations

import ctypes
import errno
import os
import re
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from foon_asp.errors import InputError
from foon_asp.io.leftovers import OLD, clear, hold, name_beside

_DESCRIPTOR = re.compile(r"/(?:dev|proc/(?:self|thread-self))/fd/(\d+)")
_STANDARD = {"/dev/stdout": 1, "/dev/stderr": 2}

_AT_FDCWD, _RENAME_EXCHANGE = -100, 2
"""What Linux calls the current folder, and the wish to exchange two names, in `renameat2`."""

_RENAME_SWAP = 2
"""The same wish in `renamex_np` of macOS."""

_O_BINARY = getattr(os, "O_BINARY", 0)
"""Windows would translate the ends of lines."""

_TRIES = 100
"""How often a folder is tried to be put where others put theirs at the same time."""


def write_text(path: Path, text: str) -> None:
    """Write a UTF-8 file, as `writing` does; raise `InputError`."""
    try:
        data = text.encode("utf-8")
    except UnicodeEncodeError as error:
        character = f"U+{ord(text[error.start]):04X}"
        raise InputError(path, None, f"cannot be written (UTF-8 has no character {character})") from None
    write_bytes(path, data)


def write_bytes(path: Path, data: bytes) -> None:
    """Write a file, as `writing` does; raise `InputError`."""
    with writing(path) as file:
        file.write(data)


def is_there(path: Path) -> bool:
    """Tell whether writing to a path would replace something: a file or a folder with something in it.

    Links are followed. What is written to as it is (a device, a pipe, an open descriptor like /dev/stdout) is
    not replaced.
    """
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            return any(path.iterdir())
    except (OSError, ValueError):
        return False
    return _descriptor(path) is None and stat.S_ISREG(mode)


@contextmanager
def writing(path: Path) -> Iterator[BinaryIO]:
    """Give a file to write to; at the end of the block what was written is the file at `path`.

    Until then, and if the block raises, that file is as it was. Links are followed, an existing file keeps
    its mode, and missing folders are made. What is no regular file (a device, a pipe, an open descriptor like
    /dev/stdout) is written to as it is. Raises `InputError` for whatever the system has against it, in the
    block, too.
    """
    with _told(path):
        mode = _mode(path)
        if _descriptor(path) is not None or not (mode is None or stat.S_ISREG(mode)):
            with _as_it_is(path) as file:
                yield file
            return
        target = Path(os.path.realpath(path))
        target.parent.mkdir(parents=True, exist_ok=True)
        clear(target)
        permissions = 0o666 if mode is None else stat.S_IMODE(mode)
        unfinished, number = _new_file(target, permissions)
        # The lock goes with the last number of the file. It is held until the file has its name, or
        # another writer could clear it in between; Windows renames no open file, and knows no locks.
        lock = None if os.name == "nt" else os.dup(number)
        try:
            with os.fdopen(number, "wb") as file:
                if mode is not None:
                    # Some of these the mask took away.
                    unfinished.chmod(permissions)
                yield file
                file.flush()
                os.fsync(number)
            unfinished.replace(target)
        except BaseException:
            with suppress(OSError):
                unfinished.unlink(missing_ok=True)
            raise
        finally:
            if lock is not None:
                os.close(lock)
        _sync_names(target.parent)


@contextmanager
def writing_folder(path: Path) -> Iterator[Path]:
    """Give an empty folder to fill; at the end of the block it is the one at `path`, in place of any other.

    Until then, and if the block raises, that folder is as it was. Links are followed, an existing folder
    keeps its mode, and missing folders are made. Raises `InputError` for whatever the system has against it,
    in the block, too.

    Linux and macOS exchange the two folders at once. Where the system cannot, there is none between two
    renames; if the program is killed in that instant, the next writer puts the old one back, and readers
    say where it is.
    """
    with _told(path):
        mode = _mode(path)
        if mode is not None and not stat.S_ISDIR(mode):
            raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR))
        target = Path(os.path.realpath(path))
        target.parent.mkdir(parents=True, exist_ok=True)
        clear(target)
        unfinished, number = _new_folder(target)
        try:
            yield unfinished
            for folder, _, files in os.walk(unfinished):
                for name in files:
                    _sync(Path(folder, name))
                _sync_names(Path(folder))
            if mode is not None:
                unfinished.chmod(stat.S_IMODE(mode))
            _put_folder(unfinished, target)
        finally:
            shutil.rmtree(unfinished, ignore_errors=True)
            if number is not None:
                os.close(number)
        _sync_names(target.parent)


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Raise what the system has against writing a file as `InputError`."""
    try:
        yield
    except OSError as error:
        raise InputError(path, None, f"cannot be written ({error.strerror or error})") from None


def _mode(path: Path) -> int | None:
    """Return what a path is, and who may do what with it; None if nothing is there."""
    try:
        return path.stat().st_mode
    except FileNotFoundError:
        return None
    except ValueError:
        # A NUL in the name, which no file can have.
        raise InputError(repr(str(path)), None, "this is no file name", "check the path") from None


def _descriptor(path: Path) -> int | None:
    """Return which open file of this process a path names; None for all other paths."""
    name = os.path.abspath(path)  # noqa: PTH100 - Path.absolute keeps `..`
    match = _DESCRIPTOR.fullmatch(name)
    return int(match[1]) if match else _STANDARD.get(name)


@contextmanager
def _as_it_is(path: Path) -> Iterator[BinaryIO]:
    """Give what is written to right away. An open file goes on where it is; opened anew it would be empty."""
    number = _descriptor(path)
    with path.open("wb") if number is None else os.fdopen(os.dup(number), "wb") as file:
        yield file


def _new_file(target: Path, permissions: int) -> tuple[Path, int]:
    """Make an empty file beside a target; return its name, and its number, by which it is held."""
    while True:
        path = name_beside(target)
        number = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | _O_BINARY, permissions)
        hold(number)
        if os.fstat(number).st_nlink:
            return path, number
        # Another writer has cleared it between the two.
        os.close(number)


def _new_folder(target: Path) -> tuple[Path, int | None]:
    """Make an empty folder beside a target; return its name, and its number where folders have one."""
    while True:
        path = name_beside(target)
        path.mkdir()
        try:
            number = os.open(path, os.O_RDONLY)
        except PermissionError:
            # Windows opens no folders.
            return path, None
        except FileNotFoundError:
            continue
        hold(number)
        if path.exists():
            return path, number
        os.close(number)


def _put_folder(unfinished: Path, target: Path) -> None:
    """Put a folder in the place of what is there; that is then under the name `unfinished`, or gone."""
    before = unfinished.with_suffix(f".{OLD}")
    for _ in range(_TRIES):
        if _exchange(unfinished, target) or _renamed(unfinished, target):
            return
        try:
            with suppress(FileNotFoundError):
                target.rename(before)
            if _renamed(unfinished, target):
                return
        except BaseException:
            with suppress(OSError):
                before.rename(target)
            raise
        finally:
            # If another writer was quicker now, what was there is older than what it put there.
            shutil.rmtree(before, ignore_errors=True)
    raise InputError(target, None, "others write here all the time", "wait for their end")


def _renamed(folder: Path, target: Path) -> bool:
    """Give a folder another name; false if something else has it."""
    try:
        folder.rename(target)
    except OSError as error:
        if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
            raise
        return False
    return True


def _exchange(one: Path, other: Path) -> bool:
    """Let two paths change places at once; false if the system cannot, or one of them is not there."""
    if os.name != "posix":
        return False
    library = ctypes.CDLL(None)
    paths = (os.fsencode(one), os.fsencode(other))
    if rename := getattr(library, "renameat2", None):
        return bool(rename(_AT_FDCWD, paths[0], _AT_FDCWD, paths[1], _RENAME_EXCHANGE) == 0)
    if rename := getattr(library, "renamex_np", None):
        return bool(rename(*paths, _RENAME_SWAP) == 0)
    return False


def _sync(path: Path) -> None:
    """Wait until a file is on the disk: nothing must be named before it is there."""
    with path.open("r+b") as file:
        os.fsync(file.fileno())


def _sync_names(folder: Path) -> None:
    """See to it that a file that was made or renamed keeps its name if the machine fails.

    Not every system can do that, and the file is written all the same.
    """
    with suppress(OSError):
        number = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(number)
        finally:
            os.close(number)
