"""What can be odd in a FOON file: every code with its severity. docs/format.md explains each."""

from __future__ import annotations

from foon_asp.findings import Finding, Severity

ODDITIES = {
    "unreadable-line": Severity.ERROR,
    "unreadable-unit": Severity.ERROR,
    "object-without-label": Severity.ERROR,
    "motion-without-label": Severity.ERROR,
    "unit-without-motion": Severity.ERROR,
    "two-motions": Severity.ERROR,
    "unit-without-inputs": Severity.WARNING,
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
    "odd-content": Severity.WARNING,
    "other-encoding": Severity.NOTE,
    "byte-order-mark": Severity.NOTE,
    "unit-not-closed": Severity.NOTE,
    "empty-unit": Severity.NOTE,
    "blank-line": Severity.NOTE,
    "missing-tab": Severity.NOTE,
    "odd-flag": Severity.NOTE,
    "contains-in-brackets": Severity.NOTE,
    "place-in-braces": Severity.NOTE,
    "state-without-brackets": Severity.NOTE,
    "stray-comma": Severity.NOTE,
    "space-in-braces": Severity.NOTE,
    "duplicate-content": Severity.NOTE,
    "duplicate-state": Severity.NOTE,
    "duplicate-input": Severity.NOTE,
    "duplicate-output": Severity.NOTE,
    "duplicate-unit": Severity.NOTE,
    "times-backwards": Severity.NOTE,
}

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
