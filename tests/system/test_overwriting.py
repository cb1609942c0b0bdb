"""No command writes over anything that it reads, whatever the names by which the two are called."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from foon_asp.io.open import open_files
from foon_asp.io.store import write_store
from support.cli import run
from support.paths import BUILT_IN
from support.writers import snapshot

OBJECT = '[{"label": "egg"}]'


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A folder of everything that commands read."""
    folder = tmp_path / "house"
    shutil.copytree(BUILT_IN.parent, folder / "data")
    foon = BUILT_IN.read_text()
    (folder / "f.txt").write_text(foon)
    write_store(open_files(folder / "f.txt"), folder / "kb.foon", [])
    (folder / "k.json").write_text(OBJECT)
    (folder / "g.json").write_text('[{"label": "ice", "states": ["crushed"]}]')
    (folder / "labels.txt").write_text("egg\n")
    (folder / "rates.txt").write_text("chop\t0.5\n")
    (folder / "swaps.tsv").write_text("egg\ttofu\t0.3\n")
    (folder / "rule.lp").write_text("violated(never,1) :- use(U), U < 0.\n")
    (folder / "ask.lp").write_text("one(U) :- unit(U).\n")
    (folder / "q.jsonl").write_text('{"goal": "ice"}\n')
    (folder / "q2.jsonl.partial").write_text('{"goal": "ice"}\n')
    return folder


READS: list[tuple[list[str], str]] = [
    (["retrieve", "ice", "--foon", "f.txt"], "f.txt"),
    (["retrieve", "ice", "--foon", "kb.foon"], "kb.foon/units.parquet"),
    (["retrieve", "ice", "--foon", "kb.foon"], "kb.foon/new"),
    (["retrieve", "ice", "--data", "data"], "data/FOON.txt"),
    (["retrieve", "ice", "--data", "data"], "data/kitchen.json"),
    (["retrieve", "ice", "--data", "data"], "data/motion.txt"),
    (["reach", "--kitchen", "k.json"], "k.json"),
    (["goals", "--data", "data"], "data/goal_nodes.json"),
    (["compare", "--goals", "g.json"], "g.json"),
    (["retrieve", "ice", "--rates", "rates.txt"], "rates.txt"),
    (["retrieve", "ice", "--utensils", "labels.txt"], "labels.txt"),
    (["retrieve", "ice", "--diet", "labels.txt"], "labels.txt"),
    (["retrieve", "ice", "--only-motions", "labels.txt"], "labels.txt"),
    (["retrieve", "ice", "--substitute", "swaps.tsv", "--substitute", "foon"], "swaps.tsv"),
    (["explain", "ice", "--constraint", "rule.lp"], "rule.lp"),
    (["query", "ask.lp"], "ask.lp"),
    (["stats", "f.txt"], "f.txt"),
    (["stats", "--data", "data"], "data/FOON.txt"),
    (["audit", "data/FOON.txt"], "data/kitchen.json"),
    (["audit", "f.txt", "--goals", "g.json"], "g.json"),
    (["merge", "f.txt", "kb.foon"], "kb.foon/objects.parquet"),
    (["convert", "f.txt", "--to", "text"], "f.txt"),
    (["convert", "kb.foon", "--to", "text"], "kb.foon/x.txt"),
    (["convert", "f.txt", "--to", "text"], "kb.foon/x.txt"),
    (["compile", "f.txt"], "kb.foon/nested.foon"),
    (["compile", "kb.foon"], "kb.foon/nested.foon"),
    (["compile", "kb.foon/"], "kb.foon"),
    (["pddl", "export", "ice", "--foon", "kb.foon"], "kb.foon/export"),
    (["batch", "--jobs", "1", "--queries", "q.jsonl"], "q.jsonl"),
    (["batch", "--jobs", "1", "--queries", "q2.jsonl.partial"], "q2.jsonl"),
    (["batch", "--jobs", "1", "--queries", "q.jsonl", "--foon", "f.txt"], "f.txt"),
    (["batch", "--jobs", "1", "--queries", "q.jsonl", "--foon", "kb.foon"], "kb.foon/rows.jsonl"),
    (["batch", "--jobs", "1", "--queries", "q.jsonl", "--data", "data"], "data/kitchen.json"),
    (["audit", "data/FOON.txt", "--fix", "--kitchen", "data/FOON.fixed.txt"], "x.txt"),
]


def _plainly(_: Path, target: str) -> Path:
    return Path(target)


def _by_link(house: Path, target: str) -> Path:
    (house / "link").symlink_to(house / target)
    return Path("link")


def _by_folder(house: Path, target: str) -> Path:
    """Name it through a link to the folder that it is in, with steps that lead back."""
    (house / "through").symlink_to((house / target).parent)
    return house / "data" / ".." / "through" / Path(target).name


@pytest.mark.parametrize("way", [_plainly, _by_link, _by_folder])
@pytest.mark.parametrize(("command", "target"), READS)
def test_what_is_read_is_never_replaced(
    house: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    command: list[str],
    target: str,
    way: Callable[[Path, str], Path],
) -> None:
    monkeypatch.chdir(house)
    if "--fix" in command:
        # The repaired copy would be the kitchen.
        (house / "data" / "FOON.txt").write_text("O egg\nM\tfry\nO\tegg\nS\tfried\n//\n")
        (house / "data" / "FOON.fixed.txt").write_text(OBJECT)
    output = way(house, target)
    before = snapshot(house)
    status, out, err = run(capsys, *command, "-o", output, "--overwrite", "--quiet")
    assert (status, out) == (2, ""), err
    assert err.count("\n") == 1
    assert "would replace an input" in err or "this lies in the store" in err
    assert snapshot(house) == before


def test_another_name_of_the_same_file_is_known(house: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A hard link stands for what systems do that do not tell `FOON.txt` from `foon.txt`."""
    os.link(house / "f.txt", house / "F.TXT")
    status, _, err = run(capsys, "merge", house / "f.txt", "-o", house / "F.TXT", "--overwrite")
    assert (status, "would replace an input" in err) == (2, True)


def test_what_lies_beside_an_input_may_be_written(
    house: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(house)
    before = snapshot(house)
    for command, target in (
        (["retrieve", "ice", "--data", "data"], "data/tree.text"),
        (["retrieve", "ice [crushed, frozen] in [drinking glass]", "--foon", "f.txt"], "f.txt.tree"),
        (["compile", "f.txt", "kb.foon"], "kb.foon2"),
        (["convert", "kb.foon"], "kb.txt"),
        (["batch", "--queries", "q.jsonl", "--jobs", "1"], "rows.jsonl"),
    ):
        status, _, err = run(capsys, *command, "-o", target)
        assert status == 0, err
        assert Path(target).exists()
    assert {name: snapshot(house)[name] for name in before} == before
