"""Bytes, text and JSON of files, with one clear error each; and how a compiled store is told."""

from __future__ import annotations

import json
import os
import re
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

from foon_asp.errors import InputError
from foon_asp.io.leftovers import told_of

MANIFEST = "manifest.json"
"""The file of a compiled store that describes the others."""


STORE_FORMAT = "foon-asp store"

_LONGEST_STREAM = 1 << 30
"""How many bytes are read of what is no regular file: it may never end."""

STORE_FILES = ("units.parquet", "objects.parquet")
"""Tables that tell a store whose manifest is missing."""


_LONGEST_NUMBER = 300
_LINE_END = re.compile(r"\r\n|\r|\n")


def is_store(path: Path) -> bool:
    """Tell whether a path is meant as a compiled store: a folder that is named or filled like one."""
    return is_folder(path) and (
        path.suffix == ".foon" or has_store_manifest(path) or exists(path / STORE_FILES[0])
    )


def exists(path: Path) -> bool:
    """Tell whether something is there; nothing can be where the system cannot look."""
    return os.path.exists(path)  # noqa: PTH110 - Path.exists raises for names that are too long


def is_folder(path: Path) -> bool:
    """Tell whether a folder is there; nothing can be where the system cannot look."""
    return os.path.isdir(path)  # noqa: PTH112 - Path.is_dir raises for names that are too long


def has_store_manifest(folder: Path) -> bool:
    """Tell whether the manifest of a folder says that it is a store; other programs have manifests, too."""
    path = folder / MANIFEST
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            return False
        with path.open("rb") as file:
            return f'"format": "{STORE_FORMAT}"'.encode() in file.read(200)
    except (OSError, ValueError):
        return False


def read_bytes(path: Path) -> bytes:
    """Return the bytes of a file; every way this can fail is an `InputError`."""
    try:
        with path.open("rb") as file:
            return _whole(file, path)
    except FileNotFoundError:
        raise InputError(path, None, "no such file", told_of(path) or "check the path") from None
    except IsADirectoryError:
        raise InputError(path, None, "this is a folder", "name a file in it") from None
    except OSError as error:
        raise InputError(path, None, f"cannot be read ({error.strerror})") from None
    except ValueError:
        # A NUL in the name, which no file can have.
        raise InputError(repr(str(path)), None, "this is no file name", "check the path") from None


def _whole(file: BinaryIO, path: Path) -> bytes:
    """Return all bytes of an open file; raise `InputError` if it may never end."""
    kind = os.fstat(file.fileno()).st_mode
    if stat.S_ISREG(kind):
        try:
            return file.read()
        except (MemoryError, OverflowError):
            raise InputError(path, None, "too large to be read into memory", "split it") from None
    if stat.S_ISCHR(kind) and not (file.isatty() or _is_null(file)):
        raise InputError(path, None, "this is a device, which has no end", "name a file")
    data = file.read(_LONGEST_STREAM + 1)
    if len(data) > _LONGEST_STREAM:
        problem = f"more than {_LONGEST_STREAM >> 20} MB come from here"
        raise InputError(path, None, problem, "save them in a file")
    return data


def _is_null(file: BinaryIO) -> bool:
    """Tell whether a device is the one that is always empty."""
    return os.fstat(file.fileno()).st_rdev == Path(os.devnull).stat().st_rdev


def read_string(path: Path) -> str:
    """Return the text of a UTF-8 file."""
    data = read_bytes(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        byte = data[error.start]
        raise InputError(path, line, f"byte 0x{byte:02x} is not UTF-8", "save the file as UTF-8") from None


def rows(text: str) -> Iterator[tuple[int, str]]:
    """Yield the lines of a text with their numbers, but for empty ones and those that begin with `#`."""
    for line, row in enumerate(_LINE_END.split(text), 1):
        if row.strip() and not row.startswith("#"):
            yield line, row


def parse_json(text: str, path: Path) -> Any:
    """Return the value of a JSON text; raise `InputError` with the line of what is wrong."""
    try:
        return json.loads(text, parse_int=read_whole)
    except json.JSONDecodeError as error:
        raise InputError(path, error.lineno, f"not JSON: {error.msg}") from None
    except ValueError as error:
        raise InputError(path, None, f"not JSON that can be read: {error}") from None
    except RecursionError:
        raise InputError(path, 1, "not JSON that can be read: nested too deeply") from None


def read_whole(text: str) -> int | float:
    """Read a whole number; one of hundreds of digits, which Python may refuse, as a float."""
    return int(text) if len(text) < _LONGEST_NUMBER else float(text)


def kind_of(value: object) -> str:
    """Return what a JSON value is, in a word or two."""
    kinds = {dict: "an object", list: "a list", str: "a text", bool: "true or false", type(None): "null"}
    return kinds.get(type(value), "a number")
