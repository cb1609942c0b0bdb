"""mypy tells the number of a unit from that of an object, whatever they are looked up in."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

from support.paths import ROOT

LOOK_UPS = {
    "world.units.needs[{}]": "unit",
    "world.units.makes[{}]": "unit",
    "world.units.makers[{}]": "made",
    "world.units.users.of({})": "made",
    "world.foon.units[{}]": "unit",
    "world.foon.units.inputs[{}]": "unit",
    "world.foon.objects[{}]": "made",
    "world.node({})": "made",
    "world.closure.available[{}]": "made",
    "world.closure.executable[{}]": "unit",
    "FunctionalUnit({}, 'pour', (made,), (made,))": "unit",
    "FunctionalUnit(unit, 'pour', ({},), (made,))": "made",
}
"""What is looked up, and by what."""

HEAD = """\
from foon_asp.model.node import FunctionalUnit, ObjectId, UnitId
from foon_asp.model.world import World


def look_up(world: World, unit: UnitId, made: ObjectId) -> None:
"""


def complaints(tmp_path: Path, lines: list[str]) -> list[int]:
    """Return the places of the lines that mypy complains of, from 0."""
    path = tmp_path / "look_ups.py"
    path.write_text(HEAD + "".join(f"    {line}\n" for line in lines), encoding="utf-8")
    # With the cache of `make test`, which has all of the package but this file.
    command = [sys.executable, "-m", "mypy", "--strict", str(path)]
    found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert found.returncode in (0, 1), found.stderr
    numbers = re.findall(r"look_ups\.py:(\d+): error:", found.stdout)
    return sorted({int(number) - HEAD.count("\n") - 1 for number in numbers})


def test_ids_cannot_be_swapped(tmp_path: Path) -> None:
    right = [text.format(key) for text, key in LOOK_UPS.items()]
    swapped = [text.format({"unit": "made", "made": "unit"}[key]) for text, key in LOOK_UPS.items()]
    plain = [text.format("7") for text in LOOK_UPS]
    wrong = range(len(right), len(right) + len(swapped) + len(plain))
    assert complaints(tmp_path, [*right, *swapped, *plain]) == list(wrong)
