"""Schedule every public goal and a menu of five, side by side with CP-SAT, and print a table.

    python benchmarks/schedules.py [DIR] [--time-limit S] [--semantics add,…]

DIR is the folder of the public FOON data (default: FOON_PUBLIC_DATA). It takes about ten minutes.

CP-SAT is given the same task where nothing is used up (`add`): an optional interval for each unit, a choice
of the maker of each need, which has ended before, and a cumulative constraint for the hands.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ortools.sat.python import cp_model

from foon_asp.io.folder import load
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.planning.durations import durations
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.resources import Resources, Worker
from foon_asp.planning.schedule import Schedule
from foon_asp.planning.schedule_answer import ScheduleAnswer
from foon_asp.planning.schedule_clingo import Task
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.planning.scheduler import schedule
from foon_asp.query.query import Query

HANDS = (1, 2, 4)
MENU = ("greek salad", "macaroni", "onigiri", "vinaigrette", "coleslaw")


@dataclass(frozen=True, slots=True)
class Found:
    """A makespan, None if there is no schedule (or none was found), and the bound that is proven of it."""

    makespan: int | None
    bound: int
    seconds: float

    @property
    def proven(self) -> bool:
        """Whether the makespan is the least."""
        return self.makespan == self.bound


def by_cp_sat(task: Task, limit: float) -> Found:
    """Schedule a task of one worker by CP-SAT, where nothing is used up."""
    began = time.perf_counter()
    [worker] = task.resources.workers
    model = cp_model.CpModel()
    times = {unit: task.able[unit][0][2] for unit in task.units}
    horizon = sum(times.values())
    end = model.new_int_var(0, horizon, "makespan")
    done = {unit: model.new_bool_var(f"do {unit}") for unit in task.units}
    starts = {unit: model.new_int_var(0, horizon, f"start {unit}") for unit in task.units}
    spans = [
        model.new_optional_fixed_size_interval_var(starts[unit], times[unit], done[unit], f"span {unit}")
        for unit in task.units
    ]
    model.add_cumulative(spans, [task.able[unit][0][1] for unit in task.units], worker.hands)
    effects = task.problem.effects
    makers: dict[ObjectId, list[UnitId]] = {}
    for unit in task.units:
        model.add(starts[unit] + times[unit] <= end).only_enforce_if(done[unit])
        for object_id in effects.adds(unit):
            makers.setdefault(object_id, []).append(unit)
    for unit in task.units:
        for need in effects.needs(unit):
            if need in effects.endless:
                continue
            links = []
            for maker in makers.get(need, ()):
                link = model.new_bool_var(f"{maker} for {unit}")
                model.add_implication(link, done[maker])
                model.add(starts[maker] + times[maker] <= starts[unit]).only_enforce_if(link)
                links.append(link)
            model.add(sum(links) == 1).only_enforce_if(done[unit])
    for goal in task.problem.goals:
        if goal not in effects.endless:
            model.add_bool_or(done[maker] for maker in makers.get(goal, ()))
    model.minimize(end)
    solver = cp_model.CpSolver()
    solver.parameters.max_time_in_seconds = limit
    solver.parameters.num_workers = 2
    status = solver.solve(model)
    found = status in (cp_model.OPTIMAL, cp_model.FEASIBLE)
    least = round(solver.objective_value) if found else None
    bound = max(0, round(solver.best_objective_bound))
    return Found(least, bound, time.perf_counter() - began)


def task_of(world: World, goals: Sequence[ObjectNode], hands: int, semantics: str = "add") -> Task:
    """Return what both are asked."""
    problem = PlanProblem(Effects(world, semantics), tuple(map(world.id_of, goals)))
    return Task.of(problem, cooks(hands), durations(world, problem.units, {}))


def cooks(hands: int) -> Resources:
    """Return one cook with so many hands."""
    return Resources((Worker("cook", hands),))


def ours(
    world: World,
    goals: Sequence[ObjectNode],
    hands: int,
    semantics: str,
    limit: float,
    known: Schedule | None = None,
) -> ScheduleAnswer:
    """Schedule by clingo."""
    asked = ScheduleQuery(Query(*goals, time_limit=limit), cooks(hands), semantics)
    return schedule(world, asked, known)


def _cell(found: Found) -> str:
    if found.makespan is None:
        return "none"
    return f"{found.makespan}" if found.proven else f"{found.makespan} (≥ {found.bound})"


def main() -> None:
    """Print the tables, row by row."""
    parser = argparse.ArgumentParser(description="Schedule every public goal and print the tables.")
    parser.add_argument("folder", nargs="?", default=os.environ.get("FOON_PUBLIC_DATA", "../shared/foon"))
    parser.add_argument("--time-limit", type=float, default=10.0, help="seconds for each (default: 10)")
    parser.add_argument("--semantics", default="add,transform,consume", help="separated by commas")
    options = parser.parse_args()
    data = load(Path(options.folder) / "universal")
    world = data.world()
    rows = [[goal] for goal in data.goals]
    rows.append([goal for goal in data.goals if goal.label in MENU])
    for semantics in options.semantics.split(","):
        beside = semantics == "add"
        heads = [f"{name}{hands} | s" for hands in HANDS for name in ("", *(["CP-SAT: "] if beside else []))]
        print(f"\n`{semantics}`: makespans with {', '.join(map(str, HANDS))} hands.\n")
        print(f"| goal | {' | '.join(heads)} |")
        print(f"| --- |{' ---: |' * (2 * len(heads))}")
        proven = asked = 0
        for goals in rows:
            cells, known = [], None
            for hands in HANDS:
                answer = ours(world, goals, hands, semantics, options.time_limit, known)
                known = answer.schedule
                found = Found(answer.makespan, answer.bound, answer.seconds)
                cells += [_cell(found), f"{found.seconds:.1f}"]
                asked, proven = asked + bool(answer), proven + found.proven
                if beside and answer:
                    other = by_cp_sat(task_of(world, goals, hands), options.time_limit)
                    cells += [_cell(other), f"{other.seconds:.1f}"]
                elif beside:
                    cells += ["", ""]
            name = goals[0].label if len(goals) == 1 else "all five"
            print(f"| {name} | {' | '.join(cells)} |", flush=True)
        print(f"\n{proven} of {asked} proven.")


if __name__ == "__main__":
    main()
