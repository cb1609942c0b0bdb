"""The page docs/scale.md names all tables and columns."""

from __future__ import annotations

import re

from foon_asp.io.store_tables import SCHEMAS
from support.paths import ROOT

PAGE = (ROOT / "docs" / "scale.md").read_text(encoding="utf-8")


def test_the_page_names_all_tables_and_columns() -> None:
    rows = [row for row in PAGE.splitlines() if row.startswith("| `")]
    for name, schema in SCHEMAS.items():
        (row,) = [row for row in rows if f"`{name}`" in row.split("|")[1]]
        named = re.findall(r"`(\w+)`", row.split("|")[3])
        assert [column for column in named if column in schema.names] == schema.names, name
