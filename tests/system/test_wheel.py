"""The wheel works where there is no checkout, with what it requires and nothing else."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Iterable
from importlib.metadata import Distribution, distribution
from pathlib import Path

from packaging.requirements import Requirement

from support.paths import ROOT


def required(by: Iterable[str], found: dict[str, Distribution]) -> dict[str, Distribution]:
    """Return what is installed here of some requirements, and what that requires, by its name."""
    for requirement in map(Requirement, by):
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        here = distribution(requirement.name)
        assert here.version in requirement.specifier
        if here.name not in found:
            found[here.name] = here
            required(here.requires or (), found)
    return found


def test_wheel_contains_encodings_and_data_and_works(tmp_path: Path) -> None:
    subprocess.run(
        [sys.executable, "-m", "build", "--wheel", "--outdir", tmp_path / "dist", ROOT],
        check=True,
        capture_output=True,
    )
    [wheel] = (tmp_path / "dist").glob("*.whl")
    names = set(zipfile.ZipFile(wheel).namelist())
    for folder in ("encodings", "data"):
        for path in (ROOT / folder).rglob("*"):
            if path.is_file():
                assert f"foon_asp/{folder}/{path.relative_to(ROOT / folder)}" in names
    for path in (ROOT / "foon_asp" / "explorer").iterdir():
        assert f"foon_asp/explorer/{path.name}" in names
    environment = tmp_path / "env"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", environment], check=True)
    pip = [sys.executable, "-m", "pip", "--python", str(environment / "bin" / "python")]
    subprocess.run([*pip, "install", "--quiet", "--no-deps", str(wheel)], check=True)
    [site] = environment.glob("lib/python*/site-packages")
    [metadata] = Distribution.discover(name="foon-asp", path=[str(site)])
    # What is here already need not be fetched and unpacked again, which takes half a minute.
    for each in required(metadata.requires or (), {}).values():
        for top in {file.parts[0] for file in each.files or () if file.parts[0] != ".."}:
            if not (site / top).exists():
                (site / top).symlink_to(Path(str(each.locate_file(top))))
    result = subprocess.run(
        [environment / "bin" / "foon-asp", "retrieve", "whipped cream"],
        check=True,
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert "proven optimal" in result.stdout
