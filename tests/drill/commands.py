"""Commands that write: what each reads and writes, and what is there before and behind."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from support.batch_runs import many, program, write_queries
from support.foon_texts import UNIT
from support.paths import BUILT_IN
from support.writers import snapshot

Files = dict[str, bytes]
"""The files of a folder, and what they hold."""


@dataclass(frozen=True, slots=True)
class Command:
    """A command that writes into `out`; its words name what it reads in `now`.

    `before`: what is in `out` when it starts; `behind`: what is there once it is done; `seconds`: how long it
    takes. It goes on where it was if it `resumes`.
    """

    name: str
    words: tuple[object, ...]
    before: Files
    behind: Files
    seconds: float
    resumes: bool = False

    def run(self, folder: Path) -> subprocess.CompletedProcess[str]:
        """Run it undisturbed."""
        return subprocess.run(
            program(*self.words), cwd=folder, capture_output=True, text=True, timeout=300, check=False
        )


_WORDS: dict[str, tuple[object, ...]] = {
    "compile": ("compile", "now/big.txt", "-o", "out/kb.foon", "--overwrite"),
    "convert": ("convert", "now/big.txt", "-o", "out/big.json", "--overwrite"),
    "merge": ("merge", "now/big.txt", "now/small.txt", "-o", "out/merged.txt", "--overwrite"),
    "audit --fix": ("audit", "now/odd.txt", "--fix-dir", "out", "--overwrite"),
    "batch": ("batch", "--queries", "now/q.jsonl", "-o", "out/o.jsonl", "--jobs", "2"),
}


def commands(folder: Path, size: int) -> Iterator[Command]:
    """Prepare a folder, with `size` times the built-in FOON, and run each command once on other inputs."""
    for name, words in _WORDS.items():
        resumes = name == "batch"
        shutil.rmtree(folder / "out", ignore_errors=True)
        before: Files = {}
        if not resumes:
            _write_inputs(folder / "now", 1)
            _done(folder, words)
            before = snapshot(folder / "out")
        _write_inputs(folder / "now", size)
        begun = time.monotonic()
        _done(folder, words)
        seconds = time.monotonic() - begun
        yield Command(name, words, before, snapshot(folder / "out"), seconds, resumes)


def _done(folder: Path, words: Sequence[object]) -> None:
    (folder / "out").mkdir(exist_ok=True)
    done = subprocess.run(
        program(*words), cwd=folder, capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stderr


def restore(folder: Path, files: Files) -> None:
    """Put a folder into a state of before."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)


def _write_inputs(folder: Path, size: int) -> None:
    folder.mkdir(exist_ok=True)
    text = BUILT_IN.read_text(encoding="utf-8")
    copies = [re.sub(r"^(O\t[^\t\n]+)", rf"\1 {number}", text, flags=re.MULTILINE) for number in range(size)]
    (folder / "big.txt").write_text("".join(copies), encoding="utf-8")
    (folder / "odd.txt").write_text("\ufeff" + "\n\n".join(copies), encoding="utf-8")
    (folder / "small.txt").write_text(UNIT, encoding="utf-8")
    write_queries(folder / "q.jsonl", [*many(10 * size), json.dumps({"goal": "unicorn"})])
