"""Findings as SARIF 2.1.0, which editors and code hosts show in place."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from foon_asp.io.findings import Finding, Severity

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_LEVELS = {Severity.NOTE: "note", Severity.WARNING: "warning", Severity.ERROR: "error"}


def sarif_value(findings: Sequence[Finding], version: str) -> dict[str, Any]:
    """Return a SARIF log with one run; `version` is that of the program."""
    codes = sorted({finding.code for finding in findings})
    return {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [
            {
                "tool": {
                    "driver": {
                        "name": "foon-asp",
                        "version": version,
                        "rules": [{"id": code, "name": _pascal(code)} for code in codes],
                    }
                },
                "columnKind": "unicodeCodePoints",
                "results": [_result(finding, codes.index(finding.code)) for finding in findings],
            }
        ],
    }


def _pascal(code: str) -> str:
    return "".join(word.capitalize() for word in code.split("-"))


def _result(finding: Finding, rule: int) -> dict[str, Any]:
    text = finding.message + (f"; {finding.mend}" if finding.mend else "")
    result: dict[str, Any] = {
        "ruleId": finding.code,
        "ruleIndex": rule,
        "level": _LEVELS[finding.severity],
        "message": {"text": text},
    }
    if finding.file:
        path = PurePath(finding.file)
        uri = path.as_uri() if path.is_absolute() else quote(os.fsencode(path.as_posix()))
        place: dict[str, Any] = {"artifactLocation": {"uri": uri}}
        if finding.line:
            place["region"] = {"startLine": finding.line}
        result["locations"] = [{"physicalLocation": place}]
    return result
