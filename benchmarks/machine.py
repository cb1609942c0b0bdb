"""What the figures were measured on, and where data and results lie."""

from __future__ import annotations

import os
import platform
import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("FOON_PUBLIC_DATA", ROOT.parent / "shared" / "foon")) / "universal"
RESULTS = ROOT / "benchmarks" / "results"

_LIBRARIES = ("foon-asp", "clingo", "numpy", "pyarrow")


@dataclass(frozen=True, slots=True)
class Machine:
    """Cores, memory in GiB, system, versions, and the day of the measurement.

    `loop` is how many seconds a loop of five million steps takes in Python: shared machines have slow hours,
    and with it figures of different hours can be compared. `load` is how many processes wanted to run in the
    minute before, what was measured among them: beside others it waits for its turn.
    """

    cores: int
    memory: float
    system: str
    python: str
    libraries: Mapping[str, str]
    date: str
    loop: float
    load: float | None = None

    @classmethod
    def here(cls, more: Sequence[str] = ()) -> Machine:
        """Describe this machine; `more` are further libraries that matter."""
        pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        libraries = {}
        for name in (*_LIBRARIES, *more):
            try:
                libraries[name] = version(name)
            except PackageNotFoundError:
                continue
        return cls(
            os.cpu_count() or 1,
            round(pages / 2**30, 1),
            f"{platform.system()} {platform.machine()}",
            platform.python_version(),
            libraries,
            datetime.now(UTC).date().isoformat(),
            round(statistics.median(_loop() for _ in range(5)), 3),
            round(os.getloadavg()[0], 1),
        )

    @classmethod
    def of(cls, row: Mapping[str, Any]) -> Machine:
        return cls(**row)

    def __str__(self) -> str:
        libraries = ", ".join(f"{name} {number}" for name, number in self.libraries.items())
        load = "" if self.load is None else f", the load was {self.load:g}"
        return (
            f"{self.cores} cores, {self.memory:g} GiB, {self.system}, Python {self.python}, {libraries}; "
            f"{self.date}; a loop of 5·10⁶ steps in Python took {self.loop:.2f} s{load}"
        )


def _loop() -> float:
    begun = time.perf_counter()
    total = 0
    for number in range(5_000_000):
        total += number * number
    return time.perf_counter() - begun
