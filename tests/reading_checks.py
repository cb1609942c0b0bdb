"""What must hold whatever the bytes of a file are; used by the tests and by benchmarks/fuzz_reader.py."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from foon_asp.errors import FoonError
from foon_asp.files import FoonFiles
from foon_asp.findings import Finding
from foon_asp.foon_json import write_api, write_units
from foon_asp.graph import Foon, Mark, ObjectNode, Source
from foon_asp.mend import OF_ROWS, mend_text
from foon_asp.oddities import ODDITIES
from foon_asp.open_foon import FoonReader, decode, is_json
from foon_asp.text import write_text

MENDED = OF_ROWS | {"blank-line", "byte-order-mark", "control-character", "unit-not-closed"}
_OBJECT_OR_MOTION = re.compile(r"^([OM])\d*(?:[\t ]|$)", re.MULTILINE)
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


def read(data: bytes | str, name: str = "x.txt", *, strict: bool = False) -> FoonFiles:
    reader = FoonReader(strict=strict)
    reader.read_data(data.encode() if isinstance(data, str) else data, Path(name))
    return reader.finish()


def codes(findings: tuple[Finding, ...]) -> list[tuple[str, int]]:
    return [(finding.code, finding.line) for finding in findings if finding.code != "empty-unit"]


def count_units(text: str) -> int:
    """Count the units of a text without the reader: what stands between `//` lines, once a motion."""
    text = _CONTROL.sub("", text.replace("\r\n", "\n").replace("\r", "\n"))
    text = re.sub(r"^\ufeff+", "", text, flags=re.MULTILINE)
    count = 0
    for chunk in re.split(r"^//.*$", text, flags=re.MULTILINE):
        kinds = _OBJECT_OR_MOTION.findall(chunk)
        if kinds:
            count += max(1, kinds.count("M"))
    return count


def meaning(foon: Foon) -> tuple[list[ObjectNode], list[tuple[Any, ...]]]:
    """Return all nodes in order, and all units in order without their annotation."""
    units = [(u.id, u.motion, u.inputs, u.outputs, u.annotation.composite) for u in foon.units]
    return list(foon.objects), units


def notes(foon: Foon, *, goals: bool = True, sources: bool = False) -> list[object]:
    """Return the units' annotations, as far as a format can say them."""
    found: list[object] = []
    for unit in foon.units:
        note = unit.annotation
        marks = note.marks if goals else tuple(Mark(mark.moves) for mark in note.marks)
        kept = note.sources if sources else (Source(video=unit.source.video),)
        found.append(replace(note, sources=kept, marks=marks if any(m != Mark() for m in marks) else ()))
    return found


def check_writing(foon: Foon) -> None:
    """Write a FOON in every form; each must bring the graph back, and writing it again the same text."""
    for provenance in (False, True):
        annotated = write_text(foon, foon.units, ["by hand"], "A", provenance=provenance)
        again = read(annotated).foon
        assert meaning(again) == meaning(foon)
        assert notes(again, sources=provenance) == notes(foon, sources=provenance)
        second = write_text(again, again.units, ["by hand"], "A", provenance=provenance)
        assert second == annotated
    plain = write_text(foon, foon.units)
    again = read(plain).foon
    assert meaning(again) == meaning(foon)
    assert write_text(again, again.units) == plain
    objects = write_units(foon, foon.units)
    again = read(objects).foon
    assert meaning(again) == meaning(foon)
    assert write_units(again, again.units) == objects
    api = write_api(foon, foon.units)
    again = read(api).foon
    assert meaning(again) == meaning(foon)
    assert notes(again, goals=False) == notes(foon, goals=False)
    assert write_api(again, again.units) == api


def check_mending(text: str, files: FoonFiles) -> str:
    """Mend a text; it must say the same as before, without what was mended. Return the mended text."""
    mended, done = mend_text(text, files.findings)
    assert {id(finding) for finding in done} <= {id(f) for f in files.findings if f.mend}
    if not done:
        assert mended == text
        return mended
    again = read(mended)
    assert meaning(again.foon) == meaning(files.foon)
    assert notes(again.foon) == notes(files.foon)
    left, _ = mend_text(mended, again.findings)
    assert left == mended, "a mended text needs no second mending"
    return mended


def check(data: bytes) -> FoonFiles | None:
    """Read any bytes: a FOON that survives writing and mending and has every unit, or a `FoonError`."""
    try:
        files = read(data)
    except FoonError:
        return None
    assert all(finding.code in ODDITIES and finding.line >= 1 for finding in files.findings)
    text, _ = decode(data, "x.txt")
    text.encode()
    if not is_json(text):
        assert files.units_read + files.units_reported == count_units(text)
        if files.foon.units:
            check_mending(text, files)
    if files.foon.units:
        check_writing(files.foon)
    return files
