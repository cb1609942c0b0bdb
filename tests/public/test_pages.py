"""What the pages show of the public data is what happens; tests/docs runs the rest of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.pages import PAGES, Page, page_name

PUBLIC = [path for path in PAGES if any(block.public for block in Page(path).blocks)]


@pytest.mark.parametrize("path", PUBLIC, ids=page_name)
def test_the_page_shows_what_happens(path: Path, public_data: Path, tmp_path: Path) -> None:
    failures = Page(path).run(tmp_path, public=public_data)
    assert not failures, "\n\n".join(failures)
