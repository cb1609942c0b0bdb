"""Where files are named and no kitchen, every command has the same one: what no unit of them makes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import foon_asp as fa
from foon_asp.io.text import write_text
from support.cli import run
from support.paths import ROOT

SOUP = [
    (["onion [whole]", "knife"], "chop", ["onion [chopped]"]),
    (["onion [chopped]", "pot [empty]"], "put", ["pot {onion}"]),
]
AT_HAND = {"onion [whole]", "knife", "pot [empty]"}
NOTE = "foon-asp: no kitchen is named: at hand is what no unit makes"


@pytest.fixture
def soup(tmp_path: Path) -> Path:
    path = tmp_path / "data" / "soup.txt"
    path.parent.mkdir()
    foon = fa.read(SOUP)
    path.write_text(write_text(foon, foon.units), encoding="utf-8")
    return path


@pytest.mark.parametrize("named", ["--foon", "--data"])
@pytest.mark.parametrize(
    "command",
    [
        ("reach",),
        ("retrieve", "pot {onion}"),
        ("plan", "pot {onion}", "--engine", "clingo"),
        ("explain", "pot {onion}"),
        ("suggest",),
        ("menu", "pot {onion}"),
        ("audit",),
        ("query", "what.lp"),
        ("batch", "--queries", "q.jsonl", "-o", "rows.jsonl", "--jobs", "1"),
    ],
    ids=lambda command: command[0],
)
def test_every_command_has_what_no_unit_makes(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    soup: Path,
    command: tuple[str, ...],
    named: str,
) -> None:
    monkeypatch.chdir(soup.parent.parent)
    Path("what.lp").write_text("there(N) :- kitchen(O), name(O,N).\n", encoding="utf-8")
    Path("q.jsonl").write_text('{"goal": "pot {onion}"}\n', encoding="utf-8")
    status, out, err = run(capsys, *command, named, soup if named == "--foon" else soup.parent)
    assert status == 0
    assert err.count(NOTE) == 1
    if command[0] == "query":
        assert all(f'"{each}"' in out or each in out for each in AT_HAND)
    if command[0] == "batch":
        assert json.loads(Path("rows.jsonl").read_text(encoding="utf-8"))["status"] == "optimal"


def test_python_has_the_same_and_a_kitchen_that_is_there_counts(soup: Path) -> None:
    for world in (fa.load(foon=[soup]), fa.load(soup.parent)):
        assert set(map(str, world.kitchen.objects)) == AT_HAND
        assert not world.kitchen.stated
    (soup.parent / "kitchen.json").write_text("[]", encoding="utf-8")
    assert fa.load(soup.parent).kitchen.objects == fa.load(soup.parent, foon=[soup]).kitchen.objects == ()
    built_in = fa.load()
    assert built_in.kitchen.stated
    assert len(fa.load(foon=[soup], kitchen=ROOT / "data" / "kitchen.json").kitchen.objects) == len(
        built_in.kitchen.objects
    )


@pytest.mark.parametrize("command", ["check", "consolidate"])
def test_a_kitchen_of_labels_is_read_for_trees_as_for_a_foon(
    capsys: pytest.CaptureFixture[str], soup: Path, command: str
) -> None:
    """What a label means is what no unit of the trees makes."""
    kitchen = soup.parent / "labels.txt"
    for labels, status in (("Onion\nknife\npot\n", 0), ("onion\npot\n", 1)):
        kitchen.write_text(labels, encoding="utf-8")
        found, out, err = run(capsys, command, soup, "--kitchen", kitchen)
        assert found == status
        assert "knife" in out
        assert NOTE not in err
        if command == "check":
            assert f"{kitchen}: 'onion' is onion [whole]" in err
