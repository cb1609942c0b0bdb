"""The pictures of the pages are what the commands beside them draw."""

from __future__ import annotations

from pathlib import Path

from support.pages import Page
from support.paths import ROOT
from support.pictures import shown, skeleton

PAGE = ROOT / "docs" / "pictures.md"


def test_the_pictures_are_what_the_page_draws(tmp_path: Path) -> None:
    """All but where things stand, which `python tests/docs/rewrite.py docs/pictures.md` brings up to date."""
    Page(PAGE).run(tmp_path)
    pictures = shown(PAGE)
    assert len(pictures) == len(set(pictures)) == 6
    for picture in pictures:
        drawn = (tmp_path / "checkout" / picture.name).read_text(encoding="utf-8")
        assert skeleton(drawn) == skeleton(picture.read_text(encoding="utf-8")), picture.name


def test_every_picture_is_shown() -> None:
    there = {path.resolve() for path in (ROOT / "docs" / "pictures").iterdir()}
    assert there == {path.resolve() for page in (ROOT / "README.md", PAGE) for path in shown(page)}
