"""Better trees are told of while better ones are looked for."""

from __future__ import annotations

import sys

import pytest

import foon_asp as fa
from foon_asp.cli.commands import retrieve as command
from support.cli import run
from support.small_foons import foon, nodes

CHAINS = [
    *(f"a -mix-> long{place}" if place == 0 else f"long{place - 1} -mix-> long{place}" for place in range(5)),
    "a -cut-> b",
    "a -cut-> c",
    "b + c + long1 -put-> dish",
    "long4 -put-> dish",
    "a -fry-> d",
    "d + long0 -put-> long1",
]


@pytest.fixture
def world() -> fa.World:
    return fa.World(foon(*CHAINS), nodes("a"))


def test_each_tree_that_is_told_is_better_than_those_before(world: fa.World) -> None:
    told: list[fa.TaskTree] = []
    answer = world.retrieve(fa.Query("dish", time_limit=60), on_better=told.append)
    assert answer.status == "optimal"
    assert told
    counts = [len(tree) for tree in told]
    assert counts == sorted(set(counts), reverse=True)
    assert all(tree.executable for tree in told)
    assert answer.tree is not None
    assert told[-1].units == answer.tree.units


def test_nobody_is_told_of_what_others_ask(world: fa.World) -> None:
    told: list[fa.TaskTree] = []

    def ask_again(tree: fa.TaskTree) -> None:
        told.append(tree)
        world.retrieve(fa.Query("dish", time_limit=60))

    world.retrieve(fa.Query("dish", time_limit=60), on_better=ask_again)
    world.retrieve(fa.Query("dish", time_limit=60))
    assert len(told) == len({tree.units for tree in told})


def test_what_a_listener_raises_ends_the_search(world: fa.World) -> None:
    def enough(_: fa.TaskTree) -> None:
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        world.retrieve(fa.Query("dish", time_limit=60), on_better=enough)


@pytest.mark.parametrize("quiet", [False, True])
def test_a_person_at_a_terminal_sees_what_there_is_so_far(
    quiet: bool, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "_LONG", 0)
    arguments = ["retrieve", "greek salad", "--time-limit", 60, *(["--quiet"] if quiet else [])]
    assert "so far" not in run(capsys, *arguments)[2]
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    _, out, err = run(capsys, *arguments)
    assert ("so far: " in err) == (not quiet)
    assert "so far: " not in out
