"""Findings: what is odd or wrong in a file, each with code, severity and place."""

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
