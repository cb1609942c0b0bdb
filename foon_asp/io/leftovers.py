"""What a writer that was killed leaves behind: found, cleared or put back by the next one, named by readers.

What is being written lies beside its place under a name that tells which place that is, and is locked as
long as its writer lives. The system takes the lock away with the process, however that ends.
"""

from __future__ import annotations

import os
import re
import shutil
import stat
from collections import defaultdict
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # pragma: no cover - Windows has none, and there nothing is known to be left behind
    fcntl = None  # type: ignore[assignment]

PART, OLD = "part", "old"
"""The ends of the names of what is not finished, and of a folder that is about to be replaced."""

_LONGEST = 200
"""How many bytes of a name stand in that of its leftovers, which has 24 more; 255 are allowed."""

_NAME = re.compile(rf"\.(?P<key>.+)\.[0-9a-f]{{16}}\.(?P<end>{PART}|{OLD})", re.DOTALL)


def name_beside(target: Path, end: str = PART) -> Path:
    """Return a name beside a target that nothing else has, whoever writes there at the same time."""
    return target.with_name(f".{_key(target.name)}.{os.urandom(8).hex()}.{end}")


def _key(name: str) -> str:
    """Return what names of leftovers begin with: that of the target, cut and made unique if it is long."""
    data = os.fsencode(name)
    if len(data) <= _LONGEST:
        return name
    # It loads OpenSSL, and hardly any name is so long.
    import hashlib

    return f"{name[:40]}-{hashlib.sha256(data).hexdigest()[:16]}"


def hold(number: int) -> None:
    """Lock an open file or folder until it is closed; where locks are unknown, nothing is ever cleared."""
    if fcntl is not None:
        with suppress(OSError):
            fcntl.flock(number, fcntl.LOCK_EX)


def left_beside(targets: Iterable[Path]) -> Iterator[tuple[Path, Path]]:
    """Yield targets, and what killed writers have left of each. Each folder is looked through once."""
    folders: defaultdict[Path, dict[str, Path]] = defaultdict(dict)
    for target in targets:
        place = Path(os.path.realpath(target))
        folders[place.parent].setdefault(_key(place.name), place)
    for folder, keys in folders.items():
        try:
            names = sorted(path.name for path in folder.iterdir() if path.name.startswith("."))
        except (OSError, ValueError):
            continue
        for name in names:
            match = _NAME.fullmatch(name)
            if match and match["key"] in keys:
                with _abandoned(folder / name) as abandoned:
                    if abandoned:
                        yield keys[match["key"]], folder / name


@contextmanager
def _abandoned(path: Path) -> Iterator[bool]:
    """Tell whether no writer holds a file or folder; in the block none else takes it for abandoned."""
    number = None
    try:
        if fcntl is not None:
            with suppress(OSError):
                number = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        yield number is not None and _locked(number)
    finally:
        if number is not None:
            os.close(number)


def _locked(number: int) -> bool:
    try:
        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def clear(target: Path) -> None:
    """Remove what killed writers have left of a target; a folder that was there before is put back."""
    with suppress(OSError):
        for place, left in left_beside([target]):
            if left.suffix == f".{OLD}" and not os.path.lexists(place):
                left.rename(place)
            elif stat.S_ISDIR(left.lstat().st_mode):
                shutil.rmtree(left, ignore_errors=True)
            else:
                left.unlink(missing_ok=True)


def told_of(target: Path) -> str:
    """Return what to say of leftovers where a target is missing; nothing if there are none."""
    for _, left in left_beside([target]):
        if left.suffix == f".{OLD}":
            return f"a writer was killed; what was here is {left}, rename it back or write anew"
        return f"a writer was killed; {left} is the unfinished rest, which the next one clears"
    return ""
