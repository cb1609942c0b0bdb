"""A small store with a change in it and all its seals made new."""

from __future__ import annotations

import io
import json
from pathlib import Path
from random import Random
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from drill.mutate import mutated
from foon_asp.io.files import MANIFEST
from foon_asp.io.open import FoonReader
from foon_asp.io.store import open_store
from foon_asp.io.store_tables import SCHEMAS
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon
from support.reading_checks import meaning
from support.stores import seal, write_sealed, write_small_store

_VALUES: tuple[Any, ...] = (
    *(
        None,
        -1,
        0,
        1,
        99,
        2**31 - 1,
        -(2**31),
        0.5,
        -1.0,
        5.0,
        float("inf"),
        float("nan"),
        1e300,
        True,
        False,
    ),
    *("", "a", "a\nM\tb", "a\0b", "Egg", " a", "a ", "a]", "\x1b[31m", "\u202e", "fatal", "in", "contains"),
    *([], [0], [1, 0], [0, 0], [99], [-1], [None], ["b", "a"], ["a,b"]),
)


class SealedStore:
    """A small store; each change to it is undone once it was read."""

    def __init__(self, folder: Path) -> None:
        self._folder = write_small_store(folder)
        self._whole = {path.name: path.read_bytes() for path in sorted(self._folder.iterdir())}
        self._tables = {name: pq.read_table(self._folder / f"{name}.parquet") for name in SCHEMAS}

    def draw_table(self, random: Random) -> bytes:
        """Return the name of a table, and its bytes with some values exchanged."""
        name = random.choice(sorted(SCHEMAS))
        table = self._tables[name]
        columns = {each: table[each].to_pylist() for each in table.column_names}
        for _ in range(random.choice((1, 1, 2))):
            column = random.choice(table.column_names)
            values = columns[column]
            if values:
                place = random.randrange(len(values))
                values[place] = random.choice((*_VALUES, *values))
        if random.random() < 0.1 and table.num_rows:
            place = random.randrange(table.num_rows)
            columns = {each: values[:place] + values[place + 1 :] for each, values in columns.items()}
        try:
            changed = pa.table(columns, schema=SCHEMAS[name])
        except (pa.ArrowException, ValueError, TypeError, OverflowError):
            # What the type of the column does not take; another type is a change, too.
            try:
                changed = pa.table({each: pa.array(values) for each, values in columns.items()})
            except (pa.ArrowException, ValueError, TypeError, OverflowError):
                changed = table.slice(1)
        file = io.BytesIO()
        pq.write_table(changed, file)
        return f"{name}.parquet\n".encode() + file.getvalue()

    def draw_bytes(self, random: Random) -> bytes:
        """Return the name of a table, and its file with its bytes changed."""
        name = random.choice([name for name in self._whole if name != MANIFEST])
        data = self._whole[name]
        return f"{name}\n".encode() + mutated(data, (data,), random)

    def draw_manifest(self, random: Random) -> bytes:
        """Return the manifest with a change in it."""
        data = self._whole[MANIFEST]
        return f"{MANIFEST}\n".encode() + mutated(data, (data,), random)

    def read(self, data: bytes, _path: Path) -> None:
        """Open the store with one of its files exchanged: as good as what text can say, or `InputError`."""
        head, _newline, rest = data.partition(b"\n")
        name = head.decode()
        path = self._folder / name
        path.write_bytes(rest)
        try:
            if name != MANIFEST:
                seal(self._folder)
            else:
                _seal_manifest(path, rest)
            _check_sayable(open_store(self._folder).foon)
        finally:
            for changed in (name, MANIFEST):
                (self._folder / changed).write_bytes(self._whole[changed])


def _seal_manifest(path: Path, data: bytes) -> None:
    try:
        manifest = json.loads(data)
    except (ValueError, RecursionError):
        return
    if isinstance(manifest, dict):
        write_sealed(path, manifest)


def _check_sayable(foon: Foon) -> None:
    """Check that text says the same units; what no unit has, text does not say."""
    reader = FoonReader()
    reader.read_data(write_text(foon, foon.units, dialect="A").encode(), Path("written.txt"))
    assert _units(reader.finish().foon) == _units(foon)


def _units(foon: Foon) -> list[object]:
    objects, units = meaning(foon)
    return [
        (motion, [objects[each] for each in inputs], [objects[each] for each in outputs])
        for _, motion, inputs, outputs, _ in units
    ]
