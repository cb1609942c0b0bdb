"""By what data are known: results that are there, and workers elsewhere, must be of the same."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from foon_asp.io.files import MANIFEST, is_store, read_bytes
from foon_asp.io.folder import Sources


def digest(sources: Sources) -> str:
    """Return a hash of all that the answers depend on; raise `InputError` for a missing file.

    A compiled store is known by its manifest, which has the checksums of its tables.
    """
    hashes = [[path, _hash(Path(path))] for path in sources.foon]
    hashes += [[name, _hash(Path(path))] for name, path in sources.beside.items()]
    shown = dict(sources.shown)
    named = [[shown.get(path, path), found] for path, found in hashes]
    settings = [
        sources.default_rate,
        sources.default_cost,
        sources.strict_format,
        sources.strict,
        sources.match_relations,
        sources.level,
        sources.vocabulary,
    ]
    return hashlib.sha256(json.dumps([named, settings]).encode()).hexdigest()


def _hash(path: Path) -> str:
    return hashlib.sha256(read_bytes(path / MANIFEST if is_store(path) else path)).hexdigest()
