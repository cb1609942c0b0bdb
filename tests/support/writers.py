"""Writers of a file or a folder; a process of its own can import them."""

from __future__ import annotations

from pathlib import Path

from foon_asp.io import atomic


def write_folder(path: Path, text: str, files: int = 3) -> None:
    with atomic.writing_folder(path) as folder:
        for number in range(files):
            (folder / str(number)).write_text(text)


def text_of(letter: str) -> str:
    """Return a text that takes several calls of the system to write."""
    return letter * 100_000


def write_on(path: Path, letter: str, folder: bool) -> None:
    """Write the same thing until this process is killed."""
    while True:
        if folder:
            write_folder(path, text_of(letter))
        else:
            atomic.write_text(path, text_of(letter))


def snapshot(folder: Path) -> dict[str, bytes]:
    """Return all files below a folder, and what they hold."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
