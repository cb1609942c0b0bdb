"""The schemas name the findings of docs/audit.md."""

from __future__ import annotations

import re

from foon_asp.io.findings import ODDITIES
from support.paths import ROOT
from support.schemas import schema


def test_schemas_name_the_codes_of_all_findings() -> None:
    page = (ROOT / "docs" / "audit.md").read_text(encoding="utf-8")
    codes = re.findall(r"^\| `([a-z-]+)` \| (?:note|warning|error)\b", page, re.MULTILINE)
    assert schema("stats")["properties"]["findings"]["propertyNames"]["enum"] == list(ODDITIES)
    assert schema("audit")["$defs"]["finding"]["properties"]["code"]["enum"] == [*ODDITIES, *codes]
