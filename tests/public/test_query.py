"""The questions of docs/querying.md, answered twice on the public data."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from support.questions import PAGE, PLAIN, check_same_answer, check_skills, check_ways, unused


def test_the_page_says_what_the_kitchen_has_unused(universal: Dataset, tmp_path: Path) -> None:
    (said,) = re.findall(r"has (\d+) such objects", PAGE)
    assert unused(universal, tmp_path) == int(said)


@pytest.mark.parametrize("name", PLAIN)
def test_plain_python_gives_the_same_answer(name: str, universal_world: World, tmp_path: Path) -> None:
    assert check_same_answer(name, universal_world, tmp_path) == (name != "dirty.lp")


def test_the_ways_to_make_each_goal(universal: Dataset, tmp_path: Path) -> None:
    assert check_ways(universal, tmp_path) >= 1


def test_no_robot_does_with_fewer_skills(universal: Dataset, tmp_path: Path) -> None:
    check_skills(universal, tmp_path)
