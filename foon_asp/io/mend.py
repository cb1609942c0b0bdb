"""Mending text files where only the format is wrong and the mend is certain; meaning is never touched."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from foon_asp.characters import without_control_characters
from foon_asp.io.findings import Finding

OF_ROWS = frozenset(
    {
        *("missing-tab", "contains-in-brackets", "place-in-braces", "stray-comma", "space-in-braces"),
        *("odd-flag", "lower-case", "other-end"),
    }
)
"""The codes that a change inside of one line can mend."""

ANY_ID = r"(?:[0-9]*|(?i:none|null|n/a))"
"""An id in a pattern: digits, nothing, or a word for nothing. Ids do not count."""

_DELETED = frozenset({"blank-line", "empty-unit"})
_MENDED = OF_ROWS | _DELETED | {"byte-order-mark", "control-character", "unit-not-closed"}
_LINE_END = re.compile(r"(\r\n|\r|\n)")
# Anchored: tried at every place, what matches nowhere takes the square of its length.
_HEAD = re.compile(rf"\A([OSMosm]{ANY_ID}) +(?=[^ \t])")
_GLUED = re.compile(rf"\A([Ss]{ANY_ID}\t[^\t\[\]{{}}]*[^\t\[\]{{}} ]) *(?=[\[{{])")
_BRACES = re.compile(r"\{([^\[\]{}]*)\}")
_FLAG = re.compile(rf"\A([Oo]{ANY_ID}(?: *\t *| +)[^\t]*\t *)0+([01])(?=[ ]*(?:\t|\Z))")
_TO_BRACES = str.maketrans("[]", "{}")
_TO_BRACKETS = str.maketrans("{}", "[]")


def mend_row(row: str, codes: Collection[str]) -> str:
    """Return a line with what the codes name mended; the same line where the mend is not certain."""
    if "other-end" in codes:
        return "//"
    if "lower-case" in codes:
        row = row[:1].upper() + row[1:]
    if "missing-tab" in codes:
        row = _GLUED.sub(r"\1\t", _HEAD.sub(r"\1\t", row, count=1), count=1)
    if "contains-in-brackets" in codes:
        row = row.translate(_TO_BRACES)
    if "stray-comma" in codes or "space-in-braces" in codes:
        row = _BRACES.sub(_tidy, row)
    if "place-in-braces" in codes:
        row = row.translate(_TO_BRACKETS)
    if "odd-flag" in codes:
        row = _FLAG.sub(r"\1\2", row, count=1)
    return row


def _tidy(match: re.Match[str]) -> str:
    parts = [part.strip() for part in match[1].split(",")]
    return "{" + ",".join(part for part in parts if part) + "}"


def mend_text(text: str, findings: Iterable[Finding]) -> tuple[str, list[Finding]]:
    """Return a text with all that is certain mended, and the findings that this mends.

    `findings` are those of reading this very text, and of no other file. Order, ids and line ends are
    kept; a line that needs no mend stays as it is.
    """
    asked: dict[int, list[Finding]] = {}
    unclosed: list[Finding] = []
    for finding in findings:
        if finding.mend and finding.code in _MENDED:
            if finding.code == "unit-not-closed":
                unclosed.append(finding)
            else:
                asked.setdefault(finding.line, []).append(finding)
    parts = _LINE_END.split(text)
    mended: list[Finding] = []
    lines: list[str] = []
    for number, (row, end) in enumerate(zip(parts[::2], [*parts[1::2], ""], strict=True), 1):
        here = asked.get(number)
        new = _mend_line(row, {finding.code for finding in here}) if here else row
        if here and new != row:
            mended += here
        lines += [] if new is None else [new, end]
    closing = _closing("".join(lines), parts[1] if len(parts) > 1 else "\n") if unclosed else ""
    return "".join(lines) + closing, mended + unclosed


def _mend_line(row: str, codes: set[str]) -> str | None:
    """Return a line mended, None if it is to be deleted."""
    if "control-character" in codes:
        row = without_control_characters(row)
    if "byte-order-mark" in codes:
        row = row.lstrip("\ufeff")
    return None if codes & _DELETED else mend_row(row, codes)


def _closing(text: str, line_end: str) -> str:
    return ("" if text.endswith(("\n", "\r")) else line_end) + "//" + line_end
