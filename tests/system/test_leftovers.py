"""What a killed writer leaves: readers name it, the next writer clears it or puts it back."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from foon_asp.errors import InputError
from foon_asp.io import atomic
from foon_asp.io.files import read_bytes
from foon_asp.io.open import open_files
from foon_asp.io.store import open_store, write_store
from support.cli import run
from support.paths import BUILT_IN
from support.writers import snapshot

FILE = "with atomic.writing(path) as file: file.write(b'half'); file.flush(); wait()"
FOLDER = "with atomic.writing_folder(path) as folder: (folder / 'a').write_text('half'); wait()"
NAMES = ["kb.foon", "ü" * 127, "a" * 255, ".hidden", "a\nb"]


@contextmanager
def half_way(path: Path, block: str) -> Iterator[subprocess.Popen[str]]:
    """Start a writer that stops half way until it is told to go on."""
    code = (
        "import sys; from pathlib import Path; from foon_asp.io import atomic\n"
        "def wait(): print('half', flush=True); sys.stdin.readline()\n"
        f"path = Path({str(path)!r})\n{block}\n"
    )
    command = [sys.executable, "-c", code]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "half\n"
        yield process
        process.kill()


def hidden(folder: Path) -> list[Path]:
    return [path for path in folder.iterdir() if path.name.endswith((".part", ".old"))]


def write(path: Path, block: str) -> None:
    if block == FILE:
        atomic.write_bytes(path, b"whole")
    else:
        with atomic.writing_folder(path) as folder:
            (folder / "a").write_text("whole")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("block", [FILE, FOLDER])
def test_the_next_writer_clears_what_a_killed_one_left(tmp_path: Path, name: str, block: str) -> None:
    path = tmp_path / name
    with half_way(path, block):
        pass
    (left,) = hidden(tmp_path)
    with pytest.raises(InputError, match=r"(?s)no such file; a writer was killed; .* is the unfinished rest"):
        read_bytes(path)
    other = tmp_path / (name[:-1] + "z")
    write(other, block)
    assert left.exists(), "another target is none of its business"
    write(path, block)
    assert sorted(tmp_path.iterdir()) == sorted([path, other])


@pytest.mark.parametrize("block", [FILE, FOLDER])
def test_a_writer_that_lives_is_left_alone(tmp_path: Path, block: str) -> None:
    path = tmp_path / "target"
    with half_way(path, block) as process:
        before = hidden(tmp_path)
        write(path, block)
        assert hidden(tmp_path) == before
        process.communicate("go on\n", timeout=60)
        assert process.returncode == 0
    assert sorted(tmp_path.iterdir()) == [path]
    text = (path if block == FILE else path / "a").read_text()
    assert text == "half"


@pytest.mark.parametrize("block", [FILE, FOLDER])
@pytest.mark.parametrize("step", ["os.fsync", "os.rename", "os.replace", "os.chmod", "os.close"])
def test_what_is_finished_is_held_until_it_has_its_name(tmp_path: Path, step: str, block: str) -> None:
    """Another writer may look at it before and after each step."""
    path = tmp_path / "target"
    interrupted = (
        "import os, sys; from pathlib import Path; from foon_asp.io import atomic\n"
        "from foon_asp.io.leftovers import clear\n"
        f"path, step, inside = Path({str(path)!r}), {step}, []\n"
        "def step_between(*arguments, **named):\n"
        "    if not inside:\n"
        "        inside.append(0); clear(path); inside.pop()\n"
        "    result = step(*arguments, **named)\n"
        "    if not inside:\n"
        "        inside.append(0); clear(path); inside.pop()\n"
        "    return result\n"
        f"{step} = step_between\ndef wait(): pass\n"
    )
    write(path, block)
    subprocess.run([sys.executable, "-c", interrupted + block], check=True, timeout=60)
    assert sorted(tmp_path.iterdir()) == [path]
    assert (path if block == FILE else path / "a").read_text() == "half"


def test_a_store_that_was_put_aside_is_put_back(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As on a system that cannot exchange two folders, when it is killed between two renames."""
    before = snapshot(store)
    aside = store.with_name(f".{store.name}.0123456789abcdef.old")
    store.rename(aside)
    status, _, err = run(capsys, "stats", store)
    assert (status, err.count("\n")) == (2, 1)
    assert f"a writer was killed; what was here is {aside}, rename it back or write anew" in err
    status, _, err = run(capsys, "compile", BUILT_IN, "-o", store)
    assert (status, "this is there already" in err) == (2, True)
    assert snapshot(store) == before
    store.rename(aside)
    assert run(capsys, "compile", BUILT_IN, "-o", store, "--overwrite")[0] == 0
    open_store(store)
    assert not hidden(store.parent)


def test_readers_name_what_is_left(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    usual = run(capsys, "stats", store)
    with half_way(store, FOLDER) as process:
        assert run(capsys, "stats", store) == usual
        process.kill()
    (left,) = hidden(store.parent)
    status, out, err = run(capsys, "stats", store)
    assert (status, out) == usual[:2]
    assert f"warning: {left} was left by a writer that was killed; the next one that writes {store}" in err


@pytest.mark.parametrize("kind", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_kills_at_any_moment_leave_the_old_store_or_the_new_one(tmp_path: Path, kind: signal.Signals) -> None:
    """The two differ in a unit; a killed run may leave other names, and the last run leaves none."""
    old, new = tmp_path / "old.txt", tmp_path / "new.txt"
    old.write_text("O\tegg\nM\tfry\nO\tegg\nS\tfried\n//\n")
    new.write_text(old.read_text() + "O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\n")
    target = tmp_path / "kb.foon"
    write_store(open_files(old), target, [old])
    drawn = random.Random(kind)
    code = (
        "from pathlib import Path\nfrom foon_asp.io.open import open_files\n"
        "from foon_asp.io.store import write_store\n"
        "files = open_files(Path('new.txt'))\nprint(flush=True)\n"
        "while True: write_store(files, Path('kb.foon'), [])\n"
    )
    sizes = set()
    for _ in range(6):
        with subprocess.Popen(
            [sys.executable, "-c", code],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=tmp_path,
            text=True,
        ) as process:
            assert process.stdout is not None
            process.stdout.readline()
            time.sleep(drawn.random() / 10)
            while process.poll() is None:
                # An interrupt in the middle of a finalizer is lost: Python says so, and goes on.
                process.send_signal(kind)
                time.sleep(0.2)
        sizes.add(len(open_store(target).foon.units))
        write_store(open_files(old), target, [old])
        assert not hidden(tmp_path)
    assert sizes <= {1, 2}
