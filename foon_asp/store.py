"""The compiled store: a FOON as a folder of Parquet tables, checked and opened in a second or two.

`manifest.json` says which version of the tables it is, from which files they were made, and what the bytes
of each table hash to. Nothing of a store is used before all of that is checked.
"""

from __future__ import annotations

import hashlib
import json
import mmap
import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from foon_asp.errors import InputError
from foon_asp.files import (
    MANIFEST,
    STORE_FORMAT,
    FoonFiles,
    has_store_manifest,
    is_store,
    parse_json,
    read_string,
)
from foon_asp.store_tables import SCHEMAS, from_tables, to_tables

VERSION = 1

_COMPILE_AGAIN = "compile it again: foon-asp compile FOON.txt -o KB.foon"


def write_store(files: FoonFiles, folder: Path, sources: Iterable[Path]) -> dict[str, Any]:
    """Write a FOON as a store, in place of the store that is there, and return its manifest.

    `sources` are the files that the FOON was read from. The store is there whole or, whatever happens, as it
    was before. Raises `InputError`.
    """
    target = Path(os.path.realpath(folder))
    sources = list(sources)
    try:
        _check_target(folder, target, sources)
        target.parent.mkdir(parents=True, exist_ok=True)
        unfinished = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".part", dir=target.parent))
        try:
            manifest = _write_tables(files, unfinished, [_source(path) for path in sources])
            unfinished.chmod(0o777 & ~_umask())
            _replace(target, unfinished)
        finally:
            shutil.rmtree(unfinished, ignore_errors=True)
    except OSError as error:
        raise InputError(folder, None, f"cannot be written ({error.strerror})") from None
    except UnicodeEncodeError:
        raise InputError(folder, None, "a source has a name that is not UTF-8", "rename it") from None
    return manifest


def _check_target(folder: Path, target: Path, sources: Sequence[Path]) -> None:
    """Raise `InputError` if a store at this place would replace anything but a store, or an input."""
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
    for source in sources:
        if target in (Path(os.path.realpath(source)), *Path(os.path.realpath(source)).parents):
            raise InputError(folder, None, f"this would replace the input {source}", "name another folder")


def _umask() -> int:
    """Return the permissions that new files do not get: temporary folders have hardly any."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _write_tables(files: FoonFiles, folder: Path, sources: list[dict[str, Any]]) -> dict[str, Any]:
    tables: dict[str, Any] = {}
    for name, table in to_tables(files.foon, files.findings).items():
        path = folder / f"{name}.parquet"
        # Uncompressed tables are read three times as fast, and lists of numbers hardly shrink.
        pq.write_table(table, path, compression="none", write_statistics=False)
        _sync(path)
        tables[name] = {"file": path.name, "rows": len(table), **_digest(path)}
    manifest = {
        "format": STORE_FORMAT,
        "version": VERSION,
        "program": f"foon-asp {version('foon-asp')}",
        "units_read": files.units_read,
        "units_reported": files.units_reported,
        "sources": sources,
        "tables": tables,
    }
    manifest["sha256"] = _seal(manifest)
    path = folder / MANIFEST
    path.write_text(json.dumps(manifest, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    _sync(path)
    return manifest


def _replace(folder: Path, unfinished: Path) -> None:
    """Put a finished store where it belongs, in the place of what is there.

    A folder cannot take the place of another one at once. Between two renames there is none; whoever stops
    the program in that instant finds the old one beside, as `.NAME….old`.
    """
    if not folder.exists():
        unfinished.rename(folder)
        _sync(folder.parent)
        return
    before = unfinished.with_suffix(".old")
    folder.rename(before)
    try:
        unfinished.rename(folder)
    except OSError:
        before.rename(folder)
        raise
    _sync(folder.parent)
    shutil.rmtree(before, ignore_errors=True)


def _source(path: Path) -> dict[str, Any]:
    if is_store(path):
        return {"file": path.name, **_digest(path / MANIFEST)}
    return {"file": path.name, **_digest(path)}


def open_store(folder: Path) -> FoonFiles:
    """Open a store. Raises `InputError` if it is damaged, or of another version."""
    manifest = read_manifest(folder)
    tables = {name: _read_table(folder, name, manifest["tables"][name]) for name in SCHEMAS}
    try:
        foon, findings = from_tables(tables)
    except (ValueError, pa.ArrowException) as error:
        raise _damaged(folder, str(error)) from None
    read = manifest["units_read"]
    foon = replace(foon, duplicates=read - len(foon.units))
    return FoonFiles(foon, tuple(findings), read, manifest["units_reported"])


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return what a store says of itself. Raises `InputError` if that is damaged, or of another version."""
    path = folder / MANIFEST
    if not path.exists():
        raise _damaged(folder, f"{MANIFEST} is missing")
    manifest = parse_json(read_string(path), path)
    if not isinstance(manifest, dict) or manifest.get("format") != STORE_FORMAT:
        raise InputError(path, None, "this does not describe a store of foon-asp", _COMPILE_AGAIN)
    if manifest.get("version") != VERSION:
        raise InputError(
            folder,
            None,
            f"a store of version {manifest.get('version')!r}, and this program reads version {VERSION}",
            "update foon-asp, or " + _COMPILE_AGAIN,
        )
    if manifest.get("sha256") != _seal(manifest):
        raise _damaged(folder, f"{MANIFEST} was changed")
    return manifest


def _read_table(folder: Path, name: str, entry: Mapping[str, Any]) -> pa.Table:
    path = folder / f"{name}.parquet"
    try:
        if _digest(path) != {"bytes": entry["bytes"], "sha256": entry["sha256"]}:
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


def _sync(path: Path) -> None:
    """Wait until a file, or the names in a folder, are on disk: nothing must be named before it is there."""
    with suppress(OSError):
        number = os.open(path, os.O_RDONLY)
        try:
            os.fsync(number)
        finally:
            os.close(number)
