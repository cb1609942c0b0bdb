"""The audit as a table."""

from __future__ import annotations

from collections import Counter

from foon_asp.audit.audit import Audit
from foon_asp.io.findings import Finding, Severity
from foon_asp.limits import ended
from foon_asp.render.table import table
from foon_asp.words import counted


def audit_text(report: Audit, least: Severity) -> str:
    """Write findings of at least a severity as a table, a line each, and count all of them."""
    shown = [finding for finding in report.findings if finding.severity >= least]
    rows = [(_place(each), each.severity.word, each.code, _sentence(each)) for each in shown]
    lines = table(rows, "<", "<7", "<")
    counts = Counter(finding.severity for finding in report.findings)
    total = ", ".join(counted(counts[severity], severity.word) for severity in reversed(Severity))
    hidden = len(report.findings) - len(shown)
    lines.append(f"{total}" + (f" ({hidden} not shown)" if hidden else ""))
    if report.limit:
        lines.append(f"{ended(report.limit)}: there may be more to find")
    return "\n".join(lines) + "\n"


def _place(finding: Finding) -> str:
    return f"{finding.file}:{finding.line}" if finding.line else finding.file


def _sentence(finding: Finding) -> str:
    return finding.message + (f"; {finding.mend}" if finding.mend else "")
