"""Plan every public goal by several engines under all semantics, and print the tables of docs/planning.md.

    python benchmarks/planning.py [DIR] [--time-limit S]

DIR is the folder of the public FOON data (default: FOON_PUBLIC_DATA). It takes about a quarter of an hour.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from foon_asp.errors import FoonError
from foon_asp.io.folder import load, read_foon
from foon_asp.io.kitchen import read_labels
from foon_asp.model.consumption import SEMANTICS
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectNode
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve


def main() -> None:
    """Print the tables, row by row."""
    parser = argparse.ArgumentParser(description="Plan every public goal and print the tables.")
    parser.add_argument("folder", nargs="?", default=os.environ.get("FOON_PUBLIC_DATA", "../shared/foon"))
    parser.add_argument("--time-limit", type=float, default=60.0, help="seconds for each plan (default: 60)")
    options = parser.parse_args()
    folder = Path(options.folder)
    for table in (_add, _used_up, _subgraphs):
        for line in table(folder, options.time_limit):
            print(line, flush=True)
        print()


def _row(cells: Sequence[object]) -> str:
    return "| " + " | ".join(map(str, cells)) + " |"


def _head(*names: str) -> Iterator[str]:
    yield _row(names)
    yield _row(["---", *("---:" for _ in names[1:])])


def _cell(answer: PlanAnswer) -> str:
    if answer.plan is None:
        return {"limit": "time", "unsolvable": "none"}.get(answer.status, answer.status)
    return str(len(answer.plan.units))


def _add(folder: Path, limit: float) -> Iterator[str]:
    """Compare optima: ours against A* with LM-cut on the exported problem."""
    data = load(folder / "universal")
    world = data.world()
    yield "Nothing is used up (`add`): `optimal` against Fast Downward's `astar(lmcut())`.\n"
    yield from _head("goal", "units", "ms", "A*: units", "s", "success", "ms", "A*: success", "s", "same")
    engine, agree, finished = "fast-downward-opt", 0, 0
    for goal in data.goals:
        cells: list[object] = [goal.label]
        same = []
        for by in ("units", "success"):
            ours = retrieve(world, Query(goal, by=by))
            cost = ours.tree.costs if ours.tree else None
            mine = None if cost is None else float(cost.units if by == "units" else cost.success or 0)
            theirs = plan(world, PlanQuery(Query(goal, by=by, time_limit=limit), engine, "add"))
            cells += ["none" if mine is None else f"{mine:.4g}", f"{ours.seconds * 1000:.0f}"]
            cells += [_cell(theirs) if theirs.cost is None else f"{theirs.cost:.4g}", f"{theirs.seconds:.1f}"]
            if theirs.status in ("optimal", "unsolvable"):
                finished += 1
                fits = (mine is None) == (theirs.cost is None) and (
                    mine is None or theirs.cost is None or abs(mine - theirs.cost) <= 1e-4 * max(mine, 1e-12)
                )
                same.append(fits)
                agree += fits
        yield _row([*cells, "yes" if all(same) else "NO"])
    yield f"\n{agree} of {finished} that A* finished within {limit:g} s agree."


def _used_up(folder: Path, limit: float) -> Iterator[str]:
    """Plan with things being used up."""
    data = load(folder / "universal")
    world = data.world()
    yield "Things are used up: `fast-downward` (LAMA) and `clingo` (fewest parallel steps, then units).\n"
    heads = ["goal"]
    for semantics in SEMANTICS[1:]:
        heads += [f"{semantics}: lama", "s", "clingo: parallel", "units", "s"]
    yield from _head(*heads)
    solved = {(semantics, engine): 0 for semantics in SEMANTICS[1:] for engine in ("fast-downward", "clingo")}
    for goal in data.goals:
        cells: list[object] = [goal.label]
        for semantics in SEMANTICS[1:]:
            query = Query(goal, time_limit=limit)
            lama = plan(world, PlanQuery(query, "fast-downward", semantics))
            own = plan(world, PlanQuery(query, "clingo", semantics))
            cells += [_cell(lama), f"{lama.seconds:.1f}", own.plan.makespan if own.plan else "-"]
            cells += [
                _cell(own) + ("" if own.status in ("optimal", "unsolvable") else "?"),
                f"{own.seconds:.1f}",
            ]
            solved[semantics, "fast-downward"] += lama.plan is not None
            solved[semantics, "clingo"] += own.plan is not None
        yield _row(cells)
    counts = ", ".join(f"{engine} {count} under {semantics}" for (semantics, engine), count in solved.items())
    yield f"\nPlans found within {limit:g} s each, of {len(data.goals)}: {counts}. `?`: not proven cheapest."


def _subgraphs(folder: Path, limit: float) -> Iterator[str]:
    """Plan the marked goal of each subgraph from what no unit of its file makes."""
    yield "Each subgraph alone: the kitchen is what no unit of the file makes, the goal the marked object.\n"
    yield from _head(
        "subgraph", "units", "reachable", "optimum", "lama, add", "lama, transform", "lama, consume"
    )
    totals = {"reachable": 0, "add": 0, "transform": 0, "consume": 0}
    reasons = []
    paths = sorted((folder / "subgraphs").glob("*.txt"))
    utensils = read_labels(folder / "universal" / "utensils.txt")
    for path in paths:
        world, goals = alone(path, utensils)
        best = retrieve(world, Query(goals[-1])) if goals else None
        if best is None:
            yield _row([path.stem, len(world.foon.units), "no goal", "-", "-", "-", "-"])
            continue
        cells: list[object] = [path.stem, len(world.foon.units), "yes" if best.tree else "no"]
        cells.append(len(best.tree.units) if best.tree else "-")
        for semantics in SEMANTICS:
            answer = plan(world, PlanQuery(Query(goals[-1], time_limit=limit), "fast-downward", semantics))
            totals[semantics] += answer.plan is not None
            cells.append(_cell(answer))
        totals["reachable"] += best.tree is not None
        if best.tree is None:
            reasons.append(f"- {path.stem}: {best.reason.replace(str(folder / 'subgraphs') + '/', '')}")
        yield _row(cells)
    counts = ", ".join(f"{count} {name}" for name, count in totals.items())
    yield f"\nOf {len(paths)} subgraphs: {counts}. Not reachable:\n"
    yield from reasons


def alone(path: Path, utensils: frozenset[str]) -> tuple[World, list[ObjectNode]]:
    """Return a file as a domain whose kitchen is what no unit of it makes, and its marked goals."""
    files = read_foon([path])
    foon = files.foon
    makers = Units(foon, utensils).makers
    raw = {number for unit in foon.units for number in unit.inputs if number not in makers}
    kitchen = Kitchen(tuple(foon.objects[number] for number in sorted(raw)), utensils, default_rate=1.0)
    return World.of(foon, kitchen), foon.marked_goals()


if __name__ == "__main__":
    try:
        main()
    except FoonError as error:
        raise SystemExit(f"error: {error}") from None
