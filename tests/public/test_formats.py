"""Public files are read whole, written back and mended."""

from __future__ import annotations

from pathlib import Path

from foon_asp.io.mend import mend_text
from foon_asp.io.open import decode
from support.reading_checks import MENDED, check_writing, count_units, read

# Mending


def test_public_files_can_be_mended(public_data: Path) -> None:
    for path in public_files(public_data):
        text, _ = decode(path.read_bytes(), str(path))
        files = read(path.read_bytes())
        mended, done = mend_text(text, files.findings)
        left = read(mended).findings
        assert not {f.code for f in left} & (MENDED - {"empty-unit"})
        assert [f.code for f in left if f.code == "empty-unit"] in ([], ["empty-unit"])
        changed = {finding.line for finding in done}
        rows = text.splitlines(keepends=True)
        kept = [row for number, row in enumerate(rows, 1) if number not in changed]
        rest = iter(mended.splitlines(keepends=True))
        assert all(row in rest for row in kept), path


# Public data and the round trips


def public_files(public_data: Path) -> list[Path]:
    return [public_data / "universal" / "FOON.txt", *sorted((public_data / "subgraphs").glob("*.txt"))]


def test_public_files_have_every_unit_and_survive_writing(public_data: Path) -> None:
    for path in public_files(public_data):
        files = read(path.read_bytes())
        assert files.units_read + files.units_reported == count_units(path.read_text()), path
        check_writing(files.foon)
