"""The command line and other processes on stores."""

from __future__ import annotations

import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from foon_asp.cli.main import main
from foon_asp.io.folder import load
from foon_asp.io.open import open_files
from foon_asp.io.store import open_store, write_store
from foon_asp.io.store_tables import SCHEMAS
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.paths import BUILT_IN

TABLES = sorted(f"{name}.parquet" for name in SCHEMAS)


def test_every_command_takes_a_store(store: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def ask(*arguments: str) -> str:
        assert main(list(arguments)) == 0, arguments
        return capsys.readouterr().out

    kitchen = ["--data", str(BUILT_IN.parent), "--foon"]
    for command in (
        ["retrieve", "whipped cream", "--format", "foon", *kitchen],
        ["explain", "whipped cream", *kitchen],
        ["plan", "whipped cream", "--format", "foon", *kitchen],
        ["menu", "ice", "macaroni", "--format", "foon", *kitchen],
        ["suggest", *kitchen],
        ["reach", *kitchen],
        ["facts", *kitchen],
        ["goals", *kitchen],
        ["stats"],
        ["merge"],
    ):
        assert ask(*command, str(store)) == ask(*command, str(BUILT_IN)), command
    for out in ("text.txt", "api.json"):
        for name in (BUILT_IN, store):
            ask("convert", str(name), "-o", str(tmp_path / f"{name.name}-{out}"))
        assert (tmp_path / f"FOON.txt-{out}").read_bytes() == (tmp_path / f"kb.foon-{out}").read_bytes()
    assert "0 units" not in ask("stats", str(store))
    assert main(["audit", str(store), "--fix"]) == 0
    assert "repair the files that it was compiled from" in capsys.readouterr().err


def test_findings_of_the_files_are_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    odd = tmp_path / "odd.txt"
    odd.write_text("O egg\nS\twhole\nM\tfry\nO\tegg\nS\tfried\n")
    assert main(["compile", str(odd), "-o", str(tmp_path / "odd.foon")]) == 0
    assert open_store(tmp_path / "odd.foon") == open_files(odd)
    assert main(["retrieve", "egg [fried]", "--foon", str(tmp_path / "odd.foon"), "--strict-format"]) == 2
    assert f"{tmp_path}/odd.foon:1: no tab" in capsys.readouterr().err


def test_compile_says_what_it_wrote(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "kb.foon"
    for again in ([], ["--overwrite"]):
        assert main(["compile", str(BUILT_IN), "-o", str(target), *again]) == 0
        out, err = capsys.readouterr()
        foon = load().foon
        assert out == ""
        assert err.startswith(f"foon-asp: {target}: {len(foon.units)} units, {len(foon.objects)} objects, ")
        assert sorted(path.name for path in tmp_path.iterdir()) == ["kb.foon"]
    assert sorted(path.name for path in target.iterdir()) == sorted([*TABLES, "manifest.json"])


def test_compile_replaces_stores_only(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "papers").mkdir()
    (tmp_path / "papers" / "thesis.tex").write_text("years of work")
    assert main(["compile", str(BUILT_IN), "-o", str(tmp_path / "papers")]) == 2
    assert "'thesis.tex' in it, which no store has" in capsys.readouterr().err
    (tmp_path / "web").mkdir()
    (tmp_path / "web" / "manifest.json").write_text('{"name": "web app"}')
    assert main(["compile", str(BUILT_IN), "-o", str(tmp_path / "web")]) == 2
    assert "'manifest.json' in it, which no store has" in capsys.readouterr().err
    assert main(["compile", str(BUILT_IN), "-o", str(BUILT_IN)]) == 2
    assert "replace an input" in capsys.readouterr().err
    assert (tmp_path / "papers" / "thesis.tex").read_text() == "years of work"


def test_a_store_with_files_of_others_is_not_replaced(
    store: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (store / "kitchen.json").write_text('[{"label": "egg"}]')
    assert main(["compile", str(BUILT_IN), "-o", str(store)]) == 2
    assert "'kitchen.json' in it, which no store has" in capsys.readouterr().err
    assert load(store).kitchen.objects == (ObjectNode("egg"),)


def test_an_empty_folder_becomes_a_store(tmp_path: Path) -> None:
    (tmp_path / "kb.foon").mkdir()
    assert main(["compile", str(BUILT_IN), "-o", str(tmp_path / "kb.foon")]) == 0
    assert open_store(tmp_path / "kb.foon").foon == load().foon


def test_values_and_tables_go_to_other_processes(store: Path) -> None:
    """What multiprocessing sends there is found in sets there: the hash of a text is another one."""
    world = load(foon=[store]).world()
    assert world.closure is not None
    code = (
        "import pickle, sys; node, domain = pickle.load(sys.stdin.buffer);"
        "assert node in set(domain.kitchen.objects); assert domain.id_of(node) in domain.closure.available"
    )
    sent = pickle.dumps((world.kitchen.objects[0], world))
    subprocess.run([sys.executable, "-c", code], input=sent, check=True)


def test_a_store_does_not_replace_itself(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compile", str(store), str(BUILT_IN), "-o", str(store)]) == 2
    assert "replace an input" in capsys.readouterr().err
    open_store(store)


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-7])


def _flip(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)


def _empty(path: Path) -> None:
    path.write_bytes(b"")


@pytest.mark.parametrize("name", [*TABLES, "manifest.json"])
@pytest.mark.parametrize("damage", [_cut, _flip, _empty, Path.unlink])
def test_a_damaged_store_is_never_read(
    store: Path, name: str, damage: Callable[[Path], None], capsys: pytest.CaptureFixture[str]
) -> None:
    damage(store / name)
    assert main(["retrieve", "whipped cream", "--foon", str(store)]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert str(store) in told
    if name != "manifest.json":
        assert f"a damaged store: {name}" in told


def test_a_compile_that_is_killed_leaves_the_store_as_it_was(store: Path, tmp_path: Path) -> None:
    """Kill compiling at many moments: the old store or the new one is there, and always whole."""
    before = open_store(store)
    other = tmp_path / "other.txt"
    other.write_text("O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\n")
    after = open_files(other)
    command = [sys.executable, "-m", "foon_asp", "compile", str(other), "-o", str(store), "--overwrite"]
    started = time.perf_counter()
    subprocess.run(command, check=True, capture_output=True)
    whole = time.perf_counter() - started
    write_store(before, store, [BUILT_IN])
    seen = []
    for part in np.linspace(0.3, 1.0, 8):
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(whole * float(part))
        child.send_signal(signal.SIGKILL)
        child.wait()
        # Between two renames the old store has another name.
        found = open_store(store if store.exists() else next(store.parent.glob(".*.old")))
        seen.append(found in (before, after))
    assert all(seen)


def test_another_stock_shares_the_readings() -> None:
    data = load()
    world = data.world()
    egg = [node for node in data.kitchen.objects if node.label != "tomato"]
    fresh = World.of(data.foon, replace(data.kitchen, objects=tuple(egg)))
    shared = world.with_stock(egg)
    assert shared.units is world.units
    assert shared.closure.available.keys() == fresh.closure.available.keys()
    assert shared.closure.available.keys() < world.closure.available.keys()
    for goal in data.goals:
        one, other = retrieve(shared, Query(goal)), retrieve(fresh, Query(goal))
        assert (one.status, one.tree and one.tree.units) == (other.status, other.tree and other.tree.units)
