"""The paper's retrieval in plain Python: its two heuristics, and the first unit, which its search prints.

The transcription of the published pseudocode is that of the tests. It picks a unit for each object that is
wanted and never asks whether the units can be executed.
"""

from __future__ import annotations

import sys
from pathlib import Path

from proof import Proof, Stopwatch

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.retrieval.tree import TaskTree

sys.path.append(str(Path(__file__).resolve().parent.parent / "tests"))

from support import paper_pseudocode

HEURISTICS = ("success", "inputs", "first")


def solve(world: World, goal: ObjectNode, heuristic: str = "success") -> Proof:
    """Retrieve a set of units; it is `found` even where no order of it can be executed."""
    watch = Stopwatch()
    units = paper_pseudocode.retrieve(world, goal, heuristic)
    watch.lap("search")
    tree = TaskTree.of(world, [world.id_of(goal)], units)
    watch.lap("replay")
    return watch.proof("found", tree)
