"""The commands that read and write files, on the public files."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from foon_asp.io.folder import read_foon
from support.cli import run, run_json
from support.text_reading import meaning


def test_convert_of_many_into_a_folder(
    capsys: pytest.CaptureFixture[str], public_data: Path, tmp_path: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("00*.txt"))[:5]
    assert run(capsys, "convert", *files, "-o", tmp_path, "--to", "api-json")[0] == 0
    for path in files:
        again = read_foon([tmp_path / f"{path.stem}.json"])
        assert meaning(again.foon) == meaning(read_foon([path]).foon)


def test_merge_counts_and_keeps_where_each_unit_comes_from(
    capsys: pytest.CaptureFixture[str], public_data: Path, tmp_path: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("*.txt"))
    out = tmp_path / "FOON.txt"
    status, text, err = run(capsys, "merge", *files, "-o", out)
    assert (status, text) == (0, "")
    assert "56 files, 1131 units read, 1 left out, 32 duplicates removed: 1099 units, 2152 objects" in err
    direct, again = read_foon(files).foon, read_foon([out]).foon
    assert meaning(again) == meaning(direct)
    assert [u.annotation for u in again.units] == [u.annotation for u in direct.units]


def test_stats_count_units_before_and_after_merging(
    capsys: pytest.CaptureFixture[str], public_data: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("*.txt"))
    value = run_json(capsys, "stats", *files)
    # Counted without the reader: every M line is a unit, but for the one unit that has none.
    motions = sum(path.read_text().count("\nM") for path in files)
    assert value["units_read"] == motions == 1131
    assert (value["units"], value["objects"]) == independent_count(files)
    assert value["levels"]["3"] == {"units": 1099, "objects": 2152}
    assert value["findings"]["unit-without-motion"] == 1


def independent_count(files: list[Path]) -> tuple[int, int]:
    """Count distinct units and objects by plain text handling, knowing nothing of the reader."""
    units: set[object] = set()
    objects: set[object] = set()
    for path in files:
        for chunk in re.split(r"^//.*$", path.read_text(), flags=re.MULTILINE):
            sides: list[list[tuple[str, set[str]]]] = [[], []]
            motion = ""
            for line in chunk.splitlines():
                fields = [field.strip() for field in line.split("\t")]
                if line.startswith("O"):
                    sides[bool(motion)].append((fields[1], set()))
                elif line.startswith("M"):
                    motion = fields[1].rstrip("*")
                elif line.startswith("S"):
                    sides[bool(motion)][-1][1].add(plain_state(fields[1:]))
            if motion:
                frozen = [frozenset((label, frozenset(states)) for label, states in s) for s in sides]
                units.add((frozen[0], motion, frozen[1]))
                objects |= frozen[0] | frozen[1]
    return len(units), len(objects)


def plain_state(fields: list[str]) -> str:
    name = fields[0]
    text = " ".join(fields[1:])
    inner = text.strip("{}[]")
    items = sorted(item.strip() for item in inner.split(",") if item.strip())
    if not items:
        return name
    braces = "{" in text
    if name == "contains":
        braces = True
    elif braces and len(items) == 1 and name in ("in", "on", "under", "with"):
        braces = False
    return f"{name} {items if braces else [inner.strip()]}"


def test_every_public_file_is_audited_with_exit_0(
    capsys: pytest.CaptureFixture[str], public_data: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("*.txt"))
    for path in [*files, public_data / "universal" / "FOON.txt"]:
        value = run_json(capsys, "audit", path)
        beside = {str(path.with_name(name)) for name in ("kitchen.json", "utensils.txt")}
        assert {finding["file"] for finding in value["findings"]} - beside == {str(path)}
