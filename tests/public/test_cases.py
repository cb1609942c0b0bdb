"""Small inputs of which each has a fault of public files: what must come out of each."""

from __future__ import annotations

import pytest

from foon_asp.io.trees import TreeBuilder
from support.cli import run
from support.paths import PUBLIC_DATA
from support.reading_checks import read

CASES = PUBLIC_DATA.parent / "cases"
pytestmark = pytest.mark.skipif(not CASES.exists(), reason=f"no {CASES}")

EGG = {"egg [raw]", "egg [boiled]"}
WATER = {"cup {water}", "bowl [empty]", "cup [empty]", "bowl {water} on [table]"}


@pytest.mark.parametrize(
    ("name", "objects", "code"),
    [
        ("none-container.json", EGG, "word-for-none"),
        ("fenced.json", EGG, "text-around-json"),
        ("trailing.json", EGG, "text-around-json"),
        ("truncated.json", {"a [b]", "a [c]"}, "broken-json"),
        ("units.jsonl", WATER, "duplicate-unit"),
        ("wrapped-task-tree.json", WATER, "state-without-brackets"),
        ("wrapped-units.json", WATER, "state-without-brackets"),
        ("nested-lists.json", WATER, "duplicate-unit"),
        ("json-states-contains.json", WATER, "state-without-brackets"),
        ("empty.json", set(), "no-units"),
    ],
)
def test_what_is_read_and_found(name: str, objects: set[str], code: str) -> None:
    files = read((CASES / name).read_bytes(), name)
    assert set(map(str, files.foon.objects)) == objects
    assert code in {finding.code for finding in files.findings}


@pytest.mark.parametrize(("name", "trees"), [("nested-lists.json", 2), ("units.jsonl", 1), ("empty.json", 1)])
def test_several_trees_stay_several(name: str, trees: int) -> None:
    assert len(TreeBuilder().read_file(CASES / name).parts) == trees


@pytest.mark.parametrize("command", [("check",), ("convert", "-o", "-", "--to", "text")])
def test_what_is_cut_off_is_told_by_the_status(
    capsys: pytest.CaptureFixture[str], command: tuple[str, ...]
) -> None:
    status, out, err = run(capsys, command[0], CASES / "truncated.json", *command[1:])
    assert status == 1
    assert out
    assert "the rest is left out" in err


def test_an_empty_file_among_good_ones(capsys: pytest.CaptureFixture[str]) -> None:
    files = [CASES / name for name in ("empty.json", "trailing.json")]
    status, _, err = run(capsys, "convert", *files, "-o", "-", "--to", "text")
    assert (status, "1 unit " in err) == (0, True)
