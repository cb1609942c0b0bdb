"""The wheel works where there is no checkout."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

from conftest import ROOT


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
    environment = tmp_path / "env"
    subprocess.run([sys.executable, "-m", "venv", environment], check=True)
    python = environment / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", wheel], check=True)
    result = subprocess.run(
        [environment / "bin" / "foon-asp", "retrieve", "whipped cream"],
        check=True,
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert "proven optimal" in result.stdout
