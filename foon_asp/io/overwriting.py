"""What is to be written must never take the place of what is read."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable
from pathlib import Path

from foon_asp.errors import InputError
from foon_asp.io.files import STORE_FILES, exists, has_store_manifest, is_store

_ADVICE = "name another output"

_Identity = tuple[int, int]
"""The device and the number of a file: the same for all names that it has."""


def refuse_inputs(targets: Iterable[Path], sources: Iterable[Path]) -> None:
    """Raise `InputError` if writing the targets would replace a source, one target another, or harm a store.

    Links are followed, and files are known by more than their names. A target that is a folder must not hold
    a source, and none may lie in a store.
    """
    kept = list(sources)
    places = {os.path.realpath(source) for source in kept}
    files = {found for source in kept if (found := _identity(source)) is not None}
    stores = {_identity(source) for source in kept if is_store(source)}
    seen: set[str] = set()
    for target in targets:
        place = os.path.realpath(target)
        if place in places or _identity(target) in files or any(_inside(each, place) for each in places):
            raise InputError(target, None, "this would replace an input", _ADVICE)
        for folder in Path(place).parents:
            if _identity(folder) in stores or is_filled_store(folder):
                raise InputError(target, None, f"this lies in the store {folder}", _ADVICE)
        if place in seen:
            raise InputError(target, None, "two inputs would be written here", "convert them one by one")
        seen.add(place)


def is_filled_store(folder: Path) -> bool:
    """Tell whether a folder has what only a store has; its name alone says nothing."""
    return has_store_manifest(folder) or all(exists(folder / name) for name in STORE_FILES)


def _identity(path: Path) -> _Identity | None:
    """Return what a file or a folder is known by; None for what is neither, as two may share a device."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):
        return None
    return found.st_dev, found.st_ino


def _inside(place: str, folder: str) -> bool:
    """Tell whether a real path lies below another one."""
    return place.startswith(folder.rstrip(os.sep) + os.sep)
