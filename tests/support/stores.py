"""A small compiled store, and how its seals are made new."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from foon_asp.io.open import open_files
from foon_asp.io.store import write_store
from foon_asp.io.store_tables import FIRST_SCHEMAS

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


def as_first_version(folder: Path) -> None:
    """Make a store of one whose units have one interval at most what the first version of stores was."""
    units, times = (pq.read_table(folder / f"{name}.parquet") for name in ("units", "times"))
    columns = {name: units[name].to_pylist() for name in units.column_names}
    known = {row["unit"]: row for row in times.to_pylist()}
    for name in ("start", "end"):
        columns[name] = [known.get(unit, {}).get(name) for unit in columns["unit"]]
    pq.write_table(pa.table(columns, schema=FIRST_SCHEMAS["units"]), folder / "units.parquet")
    (folder / "times.parquet").unlink()
    manifest = json.loads((folder / "manifest.json").read_text())
    del manifest["tables"]["times"]
    (folder / "manifest.json").write_text(json.dumps({**manifest, "version": 1}))
    seal(folder)


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
