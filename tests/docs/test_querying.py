"""The page docs/querying.md: how many questions it asks, and what its rules may speak of."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from foon_asp.errors import InputError
from foon_asp.io.folder import Dataset
from foon_asp.model.world import World
from support.pages import Page, asked
from support.paths import ROOT
from support.questions import FILES, PAGE, ask, unused


def test_the_page_asks_as_many_questions_as_it_says() -> None:
    questions = PAGE[PAGE.index("## Eleven questions") :]
    assert sum(f"% {name}: " in questions for name in FILES) == 11
    commands = asked(Page(ROOT / "docs" / "querying.md"))
    assert {name for name in FILES if any(name in command.split() for command in commands)} == set(FILES)


def test_the_built_in_kitchen_has_nothing_unused(built_in: Dataset, tmp_path: Path) -> None:
    assert unused(built_in, tmp_path) == 0


def test_the_page_names_every_predicate_that_rules_may_use(tmp_path: Path, kitchen: World) -> None:
    """The helpers of units.lp are there, too, but nobody needs to know them."""
    with pytest.raises(InputError) as error:
        ask(tmp_path, kitchen, "p :- use(1).")
    there = set(re.findall(r"(\w+)/\d", str(error.value).split("there are ")[1]))
    explained = set(re.findall(r"`(\w+)\(", PAGE[: PAGE.index("## What is shown")]))
    assert (
        there - {"stateful", "sole_content", "implied", "listed_again", "takes", "gives", "place"}
        == explained
    )
