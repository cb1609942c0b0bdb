"""What must hold whatever the bytes of a file are; used by tests, drill and fuzzer."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from foon_asp.errors import FoonError
from foon_asp.io.document import is_json
from foon_asp.io.findings import ODDITIES, Finding
from foon_asp.io.json import write_api, write_units
from foon_asp.io.mend import OF_ROWS, mend_text
from foon_asp.io.open import FoonFiles, FoonReader, decode
from foon_asp.io.store_tables import from_tables, to_tables
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon
from foon_asp.model.node import Mark, ObjectNode, Source

MENDED = OF_ROWS | {"blank-line", "byte-order-mark", "control-character", "unit-not-closed"}
_OBJECT_OR_MOTION = re.compile(r"^([OMom])(?:\d*|(?i:none|null|n/a))(?:[\t ]|$)", re.MULTILINE)
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u206f]")
"""What the reader leaves out: control characters and marks of writing direction."""


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
    for chunk in re.split(r"^(?://.*|[/\\]+[\t ]*)$", text, flags=re.MULTILINE):
        kinds = "".join(_OBJECT_OR_MOTION.findall(chunk)).upper()
        if kinds:
            count += max(1, kinds.count("M"))
    return count


def count_json_units(text: str) -> int:
    """Count the units of a JSON text without the reader: what stands in the list of units."""
    text = text.lstrip("\ufeff").strip()
    count = place = 0
    while place < len(text):
        value, place = json.JSONDecoder(strict=False, parse_int=float).raw_decode(text, place)
        count += _listed_units(value)
        place += len(text[place:]) - len(text[place:].lstrip())
    return count


def _listed_units(value: Any) -> int:
    """Count what stands in lists; a list of something that may be a unit is a list of its own."""
    if isinstance(value, list):
        return sum(_listed_units(each) if _may_list_units(each) else 1 for each in value)
    if {"input_nodes", "motion_node", "output_nodes"} & value.keys():
        return 1
    if isinstance(value.get("functional_units"), list):
        return _listed_units(value["functional_units"])
    return sum(_listed_units(each) for each in value.values() if _may_list_units(each) and _has_object(each))


def _may_list_units(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], list | dict)


def _has_object(value: Any) -> bool:
    """Whether what stands first in lists is an object: any key may wrap units, but not all hold them."""
    while isinstance(value, list) and value:
        value = value[0]
    return isinstance(value, dict)


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


def check_storing(files: FoonFiles) -> None:
    """Keep what was read in tables; they must refuse nothing that a file can say, and lose nothing."""
    again, findings = from_tables(to_tables(files.foon, files.findings))
    assert (list(again.objects), list(again.units)) == (list(files.foon.objects), list(files.foon.units))
    assert tuple(findings) == files.findings


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


def check_reading(data: bytes) -> FoonFiles | None:
    """Read any bytes: what can be read, with every unit accounted for, or None for a `FoonError`."""
    try:
        files = read(data)
    except FoonError:
        return None
    assert all(finding.code in ODDITIES and finding.line >= 1 for finding in files.findings)
    text, _ = decode(data, "x.txt")
    if is_json(text) and any(f.code in ("broken-json", "text-around-json") for f in files.findings):
        # What is no JSON cannot be counted by a reader of JSON.
        return files
    count = count_json_units(text) if is_json(text) else count_units(text)
    assert files.units_read + files.units_reported == count
    return files


def check(data: bytes) -> FoonFiles | None:
    """Read any bytes: a FOON that survives writing and mending and has every unit, or a `FoonError`."""
    files = check_reading(data)
    if files is None:
        return None
    text, _ = decode(data, "x.txt")
    text.encode()
    if not is_json(text) and files.foon.units:
        check_mending(text, files)
    if files.foon.units:
        check_writing(files.foon)
        check_storing(files)
    return files
