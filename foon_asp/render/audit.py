"""The audit as a table for people and as a JSON value."""

from __future__ import annotations

from collections import Counter
from typing import Any

from foon_asp.audit import Audit
from foon_asp.errors import counted
from foon_asp.findings import Finding, Severity
from foon_asp.state_syntax import object_to_json


def audit_text(report: Audit, least: Severity) -> str:
    """Write findings of at least a severity as a table, a line each, and count all of them."""
    shown = [finding for finding in report.findings if finding.severity >= least]
    places = [_place(finding) for finding in shown]
    width = max(map(len, places), default=0)
    code_width = max((len(finding.code) for finding in shown), default=0)
    lines = [
        f"{place:{width}}  {finding.severity.word:7}  {finding.code:{code_width}}  {_sentence(finding)}"
        for place, finding in zip(places, shown, strict=True)
    ]
    counts = Counter(finding.severity for finding in report.findings)
    total = ", ".join(counted(counts[severity], severity.word) for severity in reversed(Severity))
    hidden = len(report.findings) - len(shown)
    lines.append(f"{total}" + (f" ({hidden} not shown)" if hidden else ""))
    return "\n".join(lines) + "\n"


def _place(finding: Finding) -> str:
    return f"{finding.file}:{finding.line}" if finding.line else finding.file


def _sentence(finding: Finding) -> str:
    return finding.message + (f"; {finding.mend}" if finding.mend else "")


def audit_value(report: Audit) -> dict[str, Any]:
    """Return the value that `audit --format json` writes."""
    return {
        "findings": [
            {
                "code": finding.code,
                "severity": finding.severity.word,
                "file": finding.file,
                "line": finding.line,
                "message": finding.message,
                "mend": finding.mend or None,
            }
            for finding in report.findings
        ],
        "locks": [
            {
                "unit": lock.unit.id,
                "file": lock.unit.source.file,
                "line": lock.unit.source.line,
                "need": object_to_json(lock.need),
                "replacement": object_to_json(lock.replacement) if lock.replacement else None,
                "circle": [unit.id for unit in lock.circle],
                "opens": [unit.id for unit in lock.opens],
                "unlocks": [object_to_json(node) for node in lock.unlocks],
            }
            for lock in report.locks
        ],
        "locked_goals": [
            {
                "goal": object_to_json(locked.goal),
                "missing": None
                if locked.missing is None
                else [object_to_json(node) for node in locked.missing],
            }
            for locked in report.locked_goals
        ],
    }
