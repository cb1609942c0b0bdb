"""What is installed with the program, the encodings and the built-in data, and which version it is.

They lie inside an installed package, beside it in a checkout.

Both are folders at the root that the wheel takes along as package data. An editable install cannot
map a folder without `__init__.py` into a package, and `encodings/__init__.py` would hide Python's own
`encodings` from anyone who runs Python in a checkout; so the two places are looked up plainly.
"""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).parent


def folder(name: str) -> Path:
    """Return a folder that comes with the program: `data` or `encodings`."""
    installed = _PACKAGE / name
    return installed if installed.is_dir() else _PACKAGE.parent / name


def built_in_data() -> Path:
    """Return the folder of the data that comes with the program."""
    return folder("data")


def diets() -> dict[str, Path]:
    """Return the diets that come with the program: a name, and a file of the labels that it forbids."""
    return {path.stem: path for path in sorted((folder("data") / "diets").glob("*.txt"))}


def lexicon() -> frozenset[str]:
    """Return the words of the kitchen in their usual spelling."""
    lines = (folder("data") / "words.txt").read_text(encoding="utf-8").splitlines()
    return frozenset(line for line in lines if not line.startswith("#"))


def program_version() -> str:
    """Return the version of the installed program."""
    # It takes 15 ms to import, of 250 for a whole question, and few commands ask.
    from importlib.metadata import version

    return version("foon-asp")
