"""Time every kind of question for every public goal, warm, in one process.

    python benchmarks/questions.py [DIR]

DIR is the folder of the public FOON data (default: FOON_PUBLIC_DATA). It takes about two minutes.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

from foon_asp.io.folder import load
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.objective import CRITERIA
from foon_asp.query.query import Query
from foon_asp.retrieval.alternatives import all_optimal_trees, best_trees, diverse_trees, pareto_trees
from foon_asp.retrieval.explain import explain
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import suggest
from foon_asp.retrieval.trace import trace


def main() -> None:
    """Print a table: median and maximum over the goals, in seconds."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else os.environ.get("FOON_PUBLIC_DATA", "../shared/foon"))
    data = load(folder / "universal")
    world = data.world()
    goals = [goal for goal in data.goals if world.id_of(goal) in world.closure.available]
    stock = world.kitchen.objects

    def under(**flags: object) -> Callable[[ObjectNode], object]:
        constraints = Constraints(**flags)  # type: ignore[arg-type]
        return lambda goal: retrieve(world, Query(goal, constraints=constraints))

    kinds: dict[str, Callable[[ObjectNode], object]] = {
        **{f"--by {name}": _by(world, name) for name in (*CRITERIA, "2*units+inputs") if name != "time"},
        "--without onion": under(without=("onion",)),
        "--without-tool blender": under(without_tools=("blender",)),
        "--avoid-motion fry": under(avoid_motions=("fry",)),
        "--max-units 20": under(max_units=20),
        "--max-depth 12": under(max_depth=12),
        "--min-success 0.001": under(min_success=0.001),
        "--human-steps 1": under(human_steps=1),
        "--human-steps 3": under(human_steps=3),
        "-n 5": lambda goal: best_trees(world, Query(goal), 5),
        "-n 5 --by success": lambda goal: best_trees(world, Query(goal, by="success"), 5),
        "--all-optimal": lambda goal: all_optimal_trees(world, Query(goal)),
        "--diverse 4": lambda goal: diverse_trees(world, Query(goal), 4),
        "--pareto units,success": lambda goal: pareto_trees(world, Query(goal, by="units,success")),
        "--pareto units,inputs,success": lambda goal: pareto_trees(
            world, Query(goal, by="units,inputs,success")
        ),
        "--pareto units,depth": lambda goal: pareto_trees(world, Query(goal, by="units,depth")),
        "explain": lambda goal: explain(world, Query(goal)),
        "--method ids --trace": lambda goal: trace(world, world.id_of(goal)),
    }
    print("| question | median (s) | max (s) | slowest goal |\n|---|---:|---:|---|")
    retrieve(world, Query(goals[0]))
    for name, ask in kinds.items():
        times = []
        for goal in goals:
            begun = time.perf_counter()
            ask(goal)
            times.append((time.perf_counter() - begun, goal.label))
        worst, label = max(times)
        print(
            f"| `{name}` | {statistics.median(t for t, _ in times):.3f} | {worst:.3f} | {label} |", flush=True
        )
    wholes: dict[str, Callable[[], object]] = {
        f"menu of all {len(goals)} goals": lambda: plan_menu(world, Query(*goals)).together,
        "the same, together only": lambda: retrieve(world, Query(*goals)),
        "suggest --using egg,milk": lambda: suggest(world, Query(), using=("egg", "milk")),
        "suggest": lambda: suggest(world, Query()),
        f"explain, {len(stock)} things in the kitchen, the unreachable goals": lambda: [
            explain(world, Query(goal)) for goal in data.goals if goal not in goals
        ],
    }
    for name, whole in wholes.items():
        begun = time.perf_counter()
        whole()
        print(f"| {name} | | {time.perf_counter() - begun:.3f} | |", flush=True)


def _by(world: World, name: str) -> Callable[[ObjectNode], object]:
    return lambda goal: retrieve(world, Query(goal, by=name))


if __name__ == "__main__":
    main()
