"""Findings: what is odd or wrong in a file, every code with its severity; docs/format.md explains each."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Severity(IntEnum):
    """How much a finding matters: a note loses nothing, a warning is doubtful, an error loses data."""

    NOTE = 0
    WARNING = 1
    ERROR = 2

    @property
    def word(self) -> str:
        """The word that texts and JSON use."""
        return self.name.lower()


@dataclass(frozen=True, slots=True)
class Finding:
    """One sentence about one place; `mend` says what to write instead, where that is certain."""

    code: str
    severity: Severity
    file: str
    line: int
    message: str
    mend: str = ""

    def __str__(self) -> str:
        mend = f"; {self.mend}" if self.mend else ""
        return f"{self.file}:{self.line}: {self.severity.word}: {self.message} [{self.code}]{mend}"


ODDITIES = {
    "unreadable-line": Severity.ERROR,
    "unreadable-unit": Severity.ERROR,
    "object-without-label": Severity.ERROR,
    "motion-without-label": Severity.ERROR,
    "unit-without-motion": Severity.ERROR,
    "unit-without-inputs": Severity.ERROR,
    "two-motions": Severity.ERROR,
    "broken-json": Severity.ERROR,
    "unit-without-outputs": Severity.WARNING,
    "state-of-motion": Severity.WARNING,
    "state-without-name": Severity.WARNING,
    "contains-without-braces": Severity.WARNING,
    "empty-brackets": Severity.WARNING,
    "empty-braces": Severity.WARNING,
    "comma-in-brackets": Severity.WARNING,
    "unbalanced-brackets": Severity.WARNING,
    "stray-text": Severity.WARNING,
    "stray-field": Severity.WARNING,
    "tab-in-label": Severity.WARNING,
    "broken-time": Severity.WARNING,
    "broken-rate": Severity.WARNING,
    "not-utf8": Severity.WARNING,
    "control-character": Severity.WARNING,
    "duplicate-key": Severity.WARNING,
    "unknown-key": Severity.WARNING,
    "odd-content": Severity.WARNING,
    "text-around-json": Severity.WARNING,
    "no-units": Severity.WARNING,
    "other-rate": Severity.WARNING,
    "other-encoding": Severity.NOTE,
    "byte-order-mark": Severity.NOTE,
    "unit-not-closed": Severity.NOTE,
    "empty-unit": Severity.NOTE,
    "blank-line": Severity.NOTE,
    "missing-tab": Severity.NOTE,
    "odd-flag": Severity.NOTE,
    "lower-case": Severity.NOTE,
    "other-end": Severity.NOTE,
    "older-word": Severity.NOTE,
    "contains-in-brackets": Severity.NOTE,
    "place-in-braces": Severity.NOTE,
    "state-without-brackets": Severity.NOTE,
    "word-for-none": Severity.NOTE,
    "stray-comma": Severity.NOTE,
    "space-in-braces": Severity.NOTE,
    "duplicate-content": Severity.NOTE,
    "duplicate-state": Severity.NOTE,
    "duplicate-input": Severity.NOTE,
    "duplicate-output": Severity.NOTE,
    "duplicate-unit": Severity.NOTE,
    "times-backwards": Severity.NOTE,
}


CUT_OFF = "broken-json"
"""The code of a file that ends before its end."""

OF_WHOLE_FILES = frozenset({"text-around-json", "no-units"})
"""The codes of what is odd about a file as a whole, so that it is told at once."""

USUAL = frozenset({"empty-unit", "duplicate-unit"})
"""What well-formed files have, too: the `//` at their top, and units that other files have as well."""


_LONGEST = 240


def oddity(code: str, file: str, line: int, message: str, mend: str = "") -> Finding:
    """Make the finding of a code; the message is cut, as lines can be a megabyte long."""
    if len(message) > _LONGEST:
        message = message[:_LONGEST] + "…"
    if len(mend) > _LONGEST:
        mend = mend[:_LONGEST] + "…"
    return Finding(code, ODDITIES[code], file, line, message, mend)
