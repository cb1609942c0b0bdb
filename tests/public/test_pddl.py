"""PDDL exports of the public data."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.io.folder import read_foon
from foon_asp.model.consumption import Effects
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectId
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.planning.pddl.plansys2 import for_plansys2
from foon_asp.planning.pddl.styles import document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.query.problem import Problem
from support.paths import PUBLIC_DATA
from support.pddl_by_others import check_others, check_readers, check_up
from support.pddl_exports import assert_descriptions_match_one_object_only, exported

# The translator of Fast Downward leaves its files open; the others warn of what is theirs alone.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")


# Reading back


def subgraph_files() -> list[str]:
    return sorted(path.name for path in (PUBLIC_DATA / "subgraphs").glob("*.txt")) or ["none"]


@pytest.mark.parametrize("name", subgraph_files())
def test_public_subgraphs_parse(public_data: Path, tmp_path: Path, name: str) -> None:
    foon = read_foon([public_data / "subgraphs" / name]).foon
    makers = Units(foon, ()).makers
    kitchen = [node for number, node in enumerate(foon.objects) if number not in makers]
    where = World.of(foon, Kitchen(tuple(kitchen)))
    [last] = foon.units[-1:]
    goals = foon.marked_goals() or [foon.objects[last.outputs[-1]]]
    written = exported(where, goals[:1], "consume", "units", "objects")
    check_readers(written, tmp_path)
    lifted = exported(where, goals[:1], "consume", "units", "lifted")
    check_others(lifted, tmp_path)
    if len(lifted.actions) < 8:
        # unified_planning takes seconds for the descriptions of a large one.
        check_up(lifted)
        check_up(exported(where, goals[:1], "transform", None, "objects", durative=True))


# The lifted style


def test_public_descriptions_match_one_object_only(universal_world: World) -> None:
    problem = Problem(universal_world, (ObjectId(0),), whole=True)
    written = document(planning_task(problem, Effects(universal_world, "consume")), "lifted")
    assert_descriptions_match_one_object_only(written)


def test_public_goals_are_written_for_plansys2(universal_world: World) -> None:
    for goal in universal_world.goals:
        written = exported(universal_world, [goal], style="lifted", durative=True)
        assert len(for_plansys2(written).actions) == len(written.actions)
