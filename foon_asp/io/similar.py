"""Reading what says which labels are alike: a table of the user's, and the vectors of another package."""

from __future__ import annotations

import gzip
import zlib
from functools import cache
from pathlib import Path

import numpy as np

from foon_asp.errors import InputError, QueryError
from foon_asp.io.files import read_bytes
from foon_asp.model.similarity import Vector

_PACKAGE = "ingredient-parser-nlp"
_VECTORS = "glove.txt.gz"


@cache
def ingredient_vectors() -> dict[str, Vector]:
    """Return the vectors of words that the package `ingredient-parser-nlp` has in its wheel (MIT).

    The package is not imported: that reaches for the network. Raises `QueryError` if it is not installed.
    """
    # Looked up only where it is asked for: it takes a while to load.
    from importlib import metadata

    try:
        files = metadata.files(_PACKAGE) or []
    except metadata.PackageNotFoundError:
        files = []
    paths = [Path(str(file.locate())) for file in files if file.name.endswith(_VECTORS)]
    if not paths:
        raise QueryError("no vectors of ingredients are installed; pip install 'foon-asp[similar]'")
    return _read_vectors(paths[0])


def _read_vectors(path: Path) -> dict[str, Vector]:
    """Read a gzipped text in the format of word2vec: how many and how long, then a word and its numbers."""
    try:
        # The head says how many words there are, too, one less than there are.
        head, *lines = gzip.decompress(read_bytes(path)).decode("utf-8").strip().split("\n")
        words, numbers = zip(*(line.rstrip().split(" ", 1) for line in lines), strict=True)
        table = np.array(" ".join(numbers).split(), dtype=np.float64).reshape(
            len(words), int(head.split()[1])
        )
    except (OSError, EOFError, zlib.error, ValueError, IndexError) as error:
        advice = f"install {_PACKAGE} again"
        raise InputError(path, None, f"no vectors can be read ({error})", advice) from None
    return dict(zip(words, table, strict=True))
