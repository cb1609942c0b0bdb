"""README.md and the pages of docs/: what they show is what happens (`support/pages.py` says how)."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.pages import PAGES, Page, page_name


@pytest.mark.parametrize("path", PAGES, ids=page_name)
def test_the_page_shows_what_happens(path: Path, tmp_path: Path) -> None:
    failures = Page(path).run(tmp_path)
    assert not failures, "\n\n".join(failures)
