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

import foon_asp
from foon_asp.alternatives import all_optimal_trees, best_trees, diverse_trees, pareto_trees
from foon_asp.constraints import Constraints
from foon_asp.criteria import CRITERIA
from foon_asp.explain import explain
from foon_asp.graph import ObjectNode
from foon_asp.menu import plan_menu
from foon_asp.retrieve import retrieve
from foon_asp.suggest import suggest
from foon_asp.trace import trace


def main() -> None:
    """Print a table: median and maximum over the goals, in seconds."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else os.environ.get("FOON_PUBLIC_DATA", "../shared/foon"))
    data = foon_asp.load(folder / "universal")
    domain = data.domain()
    goals = [goal for goal in data.goals if domain.id_of(goal) in domain.closure.available]
    stock = domain.kitchen.objects

    def under(**flags: object) -> Callable[[ObjectNode], object]:
        constraints = Constraints(**flags)  # type: ignore[arg-type]
        return lambda goal: retrieve(domain, goal, constraints=constraints)

    kinds: dict[str, Callable[[ObjectNode], object]] = {
        **{f"--by {name}": _by(domain, name) for name in (*CRITERIA, "2*units+inputs") if name != "time"},
        "--without onion": under(without=("onion",)),
        "--without-tool blender": under(without_tools=("blender",)),
        "--avoid-motion fry": under(avoid_motions=("fry",)),
        "--max-units 20": under(max_units=20),
        "--max-depth 12": under(max_depth=12),
        "--min-success 0.001": under(min_success=0.001),
        "--human-steps 1": under(human_steps=1),
        "--human-steps 3": under(human_steps=3),
        "-k 5": lambda goal: best_trees(domain, goal, 5),
        "-k 5 --by success": lambda goal: best_trees(domain, goal, 5, "success"),
        "--all-optimal": lambda goal: all_optimal_trees(domain, goal),
        "--diverse 4": lambda goal: diverse_trees(domain, goal, 4),
        "--pareto units,success": lambda goal: pareto_trees(domain, goal, "units,success"),
        "--pareto units,inputs,success": lambda goal: pareto_trees(domain, goal, "units,inputs,success"),
        "--pareto units,depth": lambda goal: pareto_trees(domain, goal, "units,depth"),
        "explain": lambda goal: explain(domain, goal),
        "--method ids --trace": lambda goal: trace(domain, domain.id_of(goal)),
    }
    print("| question | median (s) | max (s) | slowest goal |\n|---|---:|---:|---|")
    retrieve(domain, goals[0])
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
        f"menu of all {len(goals)} goals": lambda: plan_menu(domain, goals).together,
        "the same, together only": lambda: retrieve(domain, goals),
        "suggest --using egg,milk": lambda: suggest(domain, data.goals, using=("egg", "milk")),
        "suggest": lambda: suggest(domain, data.goals),
        f"explain, {len(stock)} things in the kitchen, the unreachable goals": lambda: [
            explain(domain, goal) for goal in data.goals if goal not in goals
        ],
    }
    for name, whole in wholes.items():
        begun = time.perf_counter()
        whole()
        print(f"| {name} | | {time.perf_counter() - begun:.3f} | |", flush=True)


def _by(domain: foon_asp.problem.Domain, name: str) -> Callable[[ObjectNode], object]:
    return lambda goal: retrieve(domain, goal, by=name)


if __name__ == "__main__":
    main()
