"""Public files as text."""

from __future__ import annotations

from pathlib import Path

from foon_asp.io.folder import Dataset, read_foon
from foon_asp.io.text import TextReader, write_text
from support.plain_reader import PlainReader
from support.text_reading import meaning, outcome, read


def test_universal_foon_survives_writing(universal: Dataset) -> None:
    again, _ = read(write_text(universal.foon, universal.foon.units))
    assert meaning(again) == meaning(universal.foon)


def test_subgraphs_merge_into_a_universal_foon(public_data: Path) -> None:
    files = read_foon(sorted((public_data / "subgraphs").glob("*.txt")))
    motions = sum(path.read_text().count("\nM") for path in (public_data / "subgraphs").glob("*.txt"))
    assert files.units_read == len(files.foon.units) + files.foon.duplicates == motions
    assert [f.code for f in files.findings].count("unit-without-motion") == files.units_reported == 1
    assert len(files.foon.marked_goals()) == 56


def test_every_file_is_read_as_line_by_line(public_data: Path) -> None:
    for path in [*sorted((public_data / "subgraphs").glob("*.txt")), public_data / "universal" / "FOON.txt"]:
        texts = [path.read_text(encoding="utf-8")]
        assert outcome(TextReader, texts) == outcome(PlainReader, texts), path.name
