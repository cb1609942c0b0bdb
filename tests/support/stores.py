"""A small compiled store, and how its seals are made new."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from foon_asp.io.open import open_files
from foon_asp.io.store import write_store

UNITS = (
    "//\nO\tegg\t1\nS\twhole\nO\tpan\t0\nS\ton\t[stove]\nM\tfry\t0:01\t0:05\trobot\t0.5\n"
    "O\tegg\t1\t!\nS\tfried\nO\tpan\nS\tcontains\t{egg,oil}\n//\n"
    "O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\nO egg\nM\tlook\nO\tegg\nS\tseen\n//\n"
)


def write_small_store(folder: Path) -> Path:
    """Write the units as a file, and the store of it beside; return the store."""
    (folder / "f.txt").write_text(UNITS)
    write_store(open_files(folder / "f.txt"), folder / "kb.foon", [folder / "f.txt"])
    return folder / "kb.foon"


def seal(folder: Path) -> None:
    """Make all seals of a store new: how that is done is no secret."""
    manifest = json.loads((folder / "manifest.json").read_text())
    for name, entry in manifest["tables"].items():
        data = (folder / f"{name}.parquet").read_bytes()
        entry |= {"bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}
    write_sealed(folder / "manifest.json", manifest)


def write_sealed(path: Path, manifest: dict[str, Any]) -> None:
    """Write a manifest with its own seal."""
    rest = {name: value for name, value in manifest.items() if name != "sha256"}
    sealed = hashlib.sha256(json.dumps(rest, sort_keys=True).encode()).hexdigest()
    path.write_text(json.dumps({**rest, "sha256": sealed}))
