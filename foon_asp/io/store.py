"""The compiled store: a FOON as a folder of Parquet tables, checked and opened in a second or two.

`manifest.json` says which version of the tables it is, from which files they were made, and what the bytes
of each table hash to. Nothing of a store is used before all of that is checked.
"""

from __future__ import annotations

import hashlib
import json
import mmap
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pyarrow as pa
import pyarrow.parquet as pq

from foon_asp.errors import InputError
from foon_asp.io import atomic
from foon_asp.io.files import (
    MANIFEST,
    STORE_FORMAT,
    exists,
    has_store_manifest,
    is_store,
    parse_json,
    read_string,
)
from foon_asp.io.open import FoonFiles
from foon_asp.io.overwriting import refuse_inputs
from foon_asp.io.store_tables import FIRST_SCHEMAS, SCHEMAS, from_tables, to_tables
from foon_asp.io.wire import Count, JsonObject, converted
from foon_asp.resources import program_version

VERSION = 2

_READ = (1, VERSION)
"""The versions that this program reads: in the first one a unit had but one interval."""

_COMPILE_AGAIN = "compile it again: foon-asp compile FOON.txt -o KB.foon"


class _SourceEntry(JsonObject):
    file: str
    bytes: Count
    sha256: str


class _TableEntry(JsonObject):
    file: str
    rows: Count
    bytes: Count
    sha256: str


class _Manifest(JsonObject):
    """What a manifest says."""

    format: str
    version: int
    program: str
    units_read: Count
    units_reported: Count
    sources: list[_SourceEntry]
    tables: dict[str, _TableEntry]
    sha256: str


def write_store(files: FoonFiles, folder: Path, sources: Iterable[Path]) -> dict[str, Any]:
    """Write a FOON as a store, in place of the store that is there, and return its manifest.

    `sources` are the files that the FOON was read from. The store is there whole or, whatever happens, as it
    was before. Raises `InputError`.
    """
    sources = list(sources)
    try:
        check_target(folder, sources)
        with atomic.writing_folder(folder) as unfinished:
            return _write_tables(files, unfinished, [_source(path) for path in sources])
    except OSError as error:
        raise InputError(folder, None, f"cannot be written ({error.strerror})") from None
    except UnicodeEncodeError:
        raise InputError(folder, None, "a source has a name that is not UTF-8", "rename it") from None


def check_target(folder: Path, sources: Sequence[Path]) -> None:
    """Raise `InputError` if a store at this place would replace anything but a store, or an input."""
    try:
        refuse_inputs([folder], sources)
        _check_target(folder, Path(os.path.realpath(folder)))
    except OSError as error:
        raise InputError(folder, None, f"cannot be written ({error.strerror})") from None


def _check_target(folder: Path, target: Path) -> None:
    if not target.exists():
        return
    if not target.is_dir():
        raise InputError(folder, None, "this is there already, and no store", "name another folder")
    there = {path.name for path in target.iterdir()}
    others = sorted(there - {MANIFEST, *(f"{name}.parquet" for name in SCHEMAS)})
    if others or (there == {MANIFEST} and not has_store_manifest(target)):
        found = others[0] if others else MANIFEST
        problem = f"this folder is there already, with {found!r} in it, which no store has"
        raise InputError(folder, None, problem, "name another folder")


def _write_tables(files: FoonFiles, folder: Path, sources: list[dict[str, Any]]) -> dict[str, Any]:
    tables: dict[str, Any] = {}
    for name, table in to_tables(files.foon, files.findings).items():
        path = folder / f"{name}.parquet"
        # Uncompressed tables are read three times as fast, and lists of numbers hardly shrink.
        pq.write_table(table, path, compression="none", write_statistics=False)
        tables[name] = {"file": path.name, "rows": len(table), **_digest(path)}
    manifest = {
        "format": STORE_FORMAT,
        "version": VERSION,
        "program": f"foon-asp {program_version()}",
        "units_read": files.units_read,
        "units_reported": files.units_reported,
        "sources": sources,
        "tables": tables,
    }
    manifest["sha256"] = _seal(manifest)
    path = folder / MANIFEST
    path.write_text(json.dumps(manifest, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return manifest


def _source(path: Path) -> dict[str, Any]:
    if is_store(path):
        return {"file": path.name, **_digest(path / MANIFEST)}
    return {"file": path.name, **_digest(path)}


def open_store(folder: Path) -> FoonFiles:
    """Open a store. Raises `InputError` if it is damaged, or of another version."""
    manifest = read_manifest(folder)
    try:
        entries = converted(manifest, _Manifest).tables
    except msgspec.ValidationError as error:
        raise _damaged(folder, f"{MANIFEST}: {error}") from None
    schemas = SCHEMAS if manifest["version"] == VERSION else FIRST_SCHEMAS
    if missing := [name for name in schemas if name not in entries]:
        raise _damaged(folder, f"{MANIFEST} does not name the table {missing[0]!r}")
    tables = {name: _read_table(folder, name, entries[name]) for name in schemas}
    try:
        foon, findings = from_tables(tables)
    except (ValueError, pa.ArrowException) as error:
        raise _damaged(folder, str(error)) from None
    read = manifest["units_read"]
    if read < len(foon.units):
        raise _damaged(folder, f"{len(foon.units)} units, and only {read} were read")
    foon = replace(foon, duplicates=read - len(foon.units))
    return FoonFiles(foon, tuple(findings), read, manifest["units_reported"])


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return what a store says of itself. Raises `InputError` if that is damaged, or of another version."""
    path = folder / MANIFEST
    if not exists(path):
        raise _damaged(folder, f"{MANIFEST} is missing")
    manifest = parse_json(read_string(path), path)
    if not isinstance(manifest, dict) or manifest.get("format") != STORE_FORMAT:
        raise InputError(path, None, "this does not describe a store of foon-asp", _COMPILE_AGAIN)
    if manifest.get("version") not in _READ:
        raise InputError(
            folder,
            None,
            f"a store of version {manifest.get('version')!r}, and this program reads version"
            f" {' and '.join(map(str, _READ))}",
            "update foon-asp, or " + _COMPILE_AGAIN,
        )
    if manifest.get("sha256") != _seal(manifest):
        raise _damaged(folder, f"{MANIFEST} was changed")
    return manifest


def _read_table(folder: Path, name: str, entry: _TableEntry) -> pa.Table:
    path = folder / f"{name}.parquet"
    if exists(path) and not path.is_file():
        raise _damaged(folder, f"{path.name} is no regular file")
    try:
        if _digest(path) != {"bytes": entry.bytes, "sha256": entry.sha256}:
            raise _damaged(folder, f"{path.name} was changed or cut off")
        table = pq.read_table(path, memory_map=True)
    except FileNotFoundError:
        raise _damaged(folder, f"{path.name} is missing") from None
    except (OSError, pa.ArrowException) as error:
        raise InputError(path, None, f"cannot be read ({error})") from None
    return table.replace_schema_metadata(None)


def _damaged(folder: Path, what: str) -> InputError:
    return InputError(folder, None, f"a damaged store: {what}", _COMPILE_AGAIN)


def _digest(path: Path) -> dict[str, Any]:
    """Return the size of a file and the SHA-256 of its bytes."""
    with path.open("rb") as file:
        size = os.fstat(file.fileno()).st_size
        digest = hashlib.sha256()
        if size:
            with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                digest.update(data)
    return {"bytes": size, "sha256": digest.hexdigest()}


def _seal(manifest: Mapping[str, Any]) -> str:
    """Return the SHA-256 of all else that a manifest says."""
    rest = {name: value for name, value in manifest.items() if name != "sha256"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True).encode()).hexdigest()
