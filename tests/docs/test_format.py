"""The page docs/format.md lists every finding of the readers."""

from __future__ import annotations

import re

from foon_asp.io.findings import ODDITIES
from support.paths import ROOT


def test_the_table_of_codes_is_complete() -> None:
    page = (ROOT / "docs" / "format.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([\w-]+)` \| (\w+) \|", page, flags=re.MULTILINE)
    assert len(rows) == len(dict(rows))
    assert dict(rows) == {code: severity.word for code, severity in ODDITIES.items()}
