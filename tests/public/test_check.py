"""Trees that a language model wrote: what docs/checking.md says of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import foon_asp as fa
from support.paths import ROOT

PAGE = " ".join((ROOT / "docs" / "checking.md").read_text(encoding="utf-8").split())


@pytest.fixture(scope="module")
def files(public_data: Path) -> list[Path]:
    return sorted((public_data / "llm_trees").glob("sample-*/*.json"))


@pytest.mark.filterwarnings("ignore")
def test_the_figures_of_the_page(files: list[Path]) -> None:
    [said] = re.findall(
        r"Of the (\d+) trees of (\d+) drinks .*?, (\d+) can be executed if nothing is used up, and (\d+) have"
        r" something that is missing or doubtful\. .*?, (\d+) can\.",
        PAGE,
    )
    checks = fa.check(*files)
    broken = sum(any(step.missing or step.doubtful for step in each.steps) for each in checks)
    used_up = fa.check(*files, semantics="transform")
    counts = (len(checks), len({file.name for file in files}), sum(map(bool, checks)), broken)
    assert tuple(map(int, said)) == (*counts, sum(map(bool, used_up)))


@pytest.mark.filterwarnings("ignore")
def test_faults_found_by_hand(public_data: Path) -> None:
    """Read in the files by a person: which step lacks or doubts what."""
    by_hand = {
        # The first is made by the step after, the second by the last one.
        "sample-3/00a9331933": {(4, "bowl {banana}"), (9, "blender [empty]")},
        # The banana was put into a bowl, and never into the blender.
        "sample-1/00a9331933": {(11, "banana [sliced] in [blender]")},
        # Poured in by the step before, which lists all but the strawberries.
        "sample-1/3633264877": {(4, "strawberries [sliced] in [blender]")},
        # Spooned in by the step before, which lists only what the blender has.
        "sample-3/19d03d9e2b": {(7, "yogurt [creamy] in [blender]")},
        "sample-1/2b146a3ee4": {(5, "banana [cubed, peeled] in [blender]")},
    }
    for name, faults in by_hand.items():
        [found] = fa.check(public_data / "llm_trees" / f"{name}.json")
        said = {
            (step.place, str(lack.node)) for step in found.steps for lack in (*step.missing, *step.doubtful)
        }
        assert faults <= said, (name, said)
