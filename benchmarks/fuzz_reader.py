"""Fuzz the readers of FOON files, guided by coverage, with atheris.

    pip install atheris
    python benchmarks/fuzz_reader.py CORPUS -max_total_time=600 -max_len=4096 -print_final_stats=1

CORPUS is a folder, filled with seeds if it is empty; the options are libFuzzer's. Any bytes must give a
FOON or a `FoonError`; a FOON must survive writing in every form and mending, with every unit accounted
for (tests/support/reading_checks.py). docs/fuzzing.md reports a run.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent


def _fill(corpus: Path, seeds: Iterable[str | bytes]) -> None:
    """Write the seeds into an empty corpus."""
    corpus.mkdir(parents=True, exist_ok=True)
    if any(corpus.iterdir()):
        return
    for number, seed in enumerate(seeds):
        if isinstance(seed, bytes):
            (corpus / f"seed{number}").write_bytes(seed)
            continue
        for encoding in ("utf-8", "utf-16"):
            (corpus / f"seed{number}-{encoding}").write_bytes(seed.encode(encoding))


def main() -> int:
    try:
        atheris: Any = importlib.import_module("atheris")
    except ImportError:
        print("fuzz_reader: atheris is not installed; pip install atheris", file=sys.stderr)
        return 2
    sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
    texts = importlib.import_module("support.foon_texts")
    for argument in sys.argv[1:2]:
        if not argument.startswith("-"):
            _fill(Path(argument), [*texts.DIALECTS.values(), *texts.EXAMPLES.values()])
    with atheris.instrument_imports(include=["foon_asp"]):
        check = importlib.import_module("support.reading_checks").check
    atheris.Setup(sys.argv, check)
    atheris.Fuzz()
    return 0


if __name__ == "__main__":
    sys.exit(main())
