"""Put measured tables into pages, each between two comments that bear its name and stand nowhere else.

<!-- table: NAME -->
…
<!-- end of table: NAME -->
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path


def with_table(page: str, name: str, lines: Iterable[str]) -> str:
    """Return a page with a table put in its place; raise `ValueError` if there is not exactly one."""
    if not re.fullmatch(r"[\w-]+", name):
        raise ValueError(f"{name!r} is no name of a table; use letters, digits and hyphens")
    start, end = f"<!-- table: {name} -->", f"<!-- end of table: {name} -->"
    rows = page.splitlines()
    starts, ends = ([place for place, row in enumerate(rows) if row == mark] for mark in (start, end))
    if (len(starts), len(ends)) != (1, 1) or starts > ends:
        raise ValueError(f"not exactly one place for the table {name!r}: a line {start}, and below it {end}")
    return "\n".join([*rows[: starts[0] + 1], "", *lines, "", *rows[ends[0] :]]) + "\n"


def put_table(path: Path, name: str, lines: Iterable[str]) -> None:
    """Write a table into a page; raise `ValueError` if the page has not exactly one place for it."""
    path.write_text(with_table(path.read_text(encoding="utf-8"), name, lines), encoding="utf-8")
