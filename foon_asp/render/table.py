"""Tables: cells in columns, each as wide as its widest cell."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import zip_longest

Cell = str | int


def table(rows: Iterable[Sequence[Cell]], *columns: str, gap: str = "  ") -> list[str]:
    """Write rows of cells as lines.

    `columns` say of each column to which side its cells go, and how wide it is at least: `<` to the left,
    `>9` to the right, `=` numbers to the right and texts to the left. Columns beyond those are not filled.
    """
    lines = [[*row] for row in rows]
    widths = [max((len(str(line[place])) for line in lines), default=0) for place in range(len(columns))]
    return [
        gap.join(
            _filled(cell, column, width)
            for cell, column, width in zip_longest(line, columns, widths, fillvalue="")
        )
        for line in lines
    ]


def _filled(cell: Cell, column: str, width: int | str) -> str:
    if not column:
        return str(cell)
    side = column[0]
    if side == "=":
        side = ">" if isinstance(cell, int) else "<"
    return f"{cell!s:{side}{max(int(width), int(column[1:] or 0))}}"
