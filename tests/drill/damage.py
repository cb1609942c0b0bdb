"""A compiled store with every byte flipped in turn, and cut at every length: an error, or the same FOON."""

from __future__ import annotations

import multiprocessing
import shutil
import tempfile
import time
import traceback
from functools import cache
from pathlib import Path
from random import Random

from drill.part import Outcome, Span, fast_folder, rate
from foon_asp.errors import FoonError
from foon_asp.io.store import open_store
from foon_asp.model.node import ObjectNode
from support.reading_checks import meaning
from support.stores import write_small_store

_MASKS = (0x01, 0xFF, 0x80, 0x20)

_TURN = 400

Damage = tuple[str, int, int]
"""The file, the place in it, and the mask of the flip; 0 cuts the file there."""


def damaged_stores(span: Span) -> Outcome:
    """Damage a store in all ways, in a random order, until the time is over."""
    with tempfile.TemporaryDirectory(prefix="drill-") as folder:
        ways = _ways(write_small_store(Path(folder)), span.seed)
    begun, done = time.monotonic(), 0
    failures: list[str] = []
    with multiprocessing.get_context("spawn").Pool(span.jobs) as pool:
        while done < len(ways) and span.goes_on(done):
            some = ways[done : done + min(_TURN, span.rounds or _TURN)]
            failures += filter(None, pool.map(_problem, some, chunksize=20))
            done += len(some)
        pool.map(_remove_store, range(span.jobs))
    line = rate("stores", done, time.monotonic() - begun)
    return Outcome([f"{line}, of {len(ways):,} flips and cuts"], failures)


def _ways(store: Path, seed: int) -> list[Damage]:
    """Return a flip of each byte and a cut at each length, and behind them flips by the other masks."""
    random = Random(seed)
    rounds = []
    for place in range(len(_MASKS)):
        ways = []
        for path in sorted(store.iterdir()):
            for number in range(path.stat().st_size):
                ways.append((path.name, number, _MASKS[(number + seed + place) % len(_MASKS)]))
                if not place:
                    ways.append((path.name, number, 0))
        random.shuffle(ways)
        rounds += ways
    return rounds


Meaning = tuple[list[ObjectNode], object]


@cache
def _store() -> tuple[Path, Meaning]:
    """Write a store for this process; it goes with the process."""
    home = tempfile.mkdtemp(prefix="drill-", dir=fast_folder())
    folder = write_small_store(Path(home))
    return folder, meaning(open_store(folder).foon)


def _remove_store(_: int) -> None:
    time.sleep(0.1)  # so that each process has one of these
    shutil.rmtree(_store()[0].parent, ignore_errors=True)


def _problem(way: Damage) -> str | None:
    name, place, mask = way
    folder, whole = _store()
    path = folder / name
    data = path.read_bytes()
    path.write_bytes(data[:place] + (bytes([data[place] ^ mask]) + data[place + 1 :] if mask else b""))
    try:
        if meaning(open_store(folder).foon) != whole:
            return f"{name}, byte {place}, mask {mask}: another FOON"
    except FoonError:
        return None
    except Exception:
        return f"{name}, byte {place}, mask {mask}: {traceback.format_exc(limit=-3)}"
    finally:
        path.write_bytes(data)
    return None
