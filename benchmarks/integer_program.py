"""The delete relaxation as an integer program, for the MIP solvers of OR-tools.

It is the program of Rankooh and Rintanen (AAAI 2022), which Fast Downward's operator-counting heuristic calls
`delete_relaxation_rr_constraints(acyclicity_type=vertex_elimination, use_integer_vars=true)`: a variable for
each unit, each object and each way of making an object, and edges between objects that are kept acyclic by
eliminating one object after the other. Solved once, from the kitchen, with integers, it gives the optimum
itself. A* with that heuristic would solve it again at each step of the plan.

SCIP takes 12.1 ms on the 23 public goals that can be made (geometric mean, as in cp_sat.py), HiGHS 12.7.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from typing import Any

from proof import Proof, Slice, Stopwatch, posed

from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.retrieval.tree import TaskTree

# Not all of it is typed.
model_builder: Any = importlib.import_module("ortools.linear_solver.python.model_builder")
Variable = Any

SOLVERS = ("scip", "highs")


def solve(
    world: World, goal: ObjectNode, limit: float, *, reduced: bool = False, solver: str = "scip"
) -> Proof:
    """Find a least task tree, or prove within `limit` seconds that there is none."""
    watch = Stopwatch()
    problem = posed(watch, world, goal, reduced=reduced)
    if isinstance(problem, Proof):
        return problem
    program = _Program(Slice.of(problem))
    watch.lap("build")
    engine = model_builder.Solver(solver)
    engine.set_time_limit_in_seconds(limit)
    status = engine.solve(program.model)
    found = status in (model_builder.SolveStatus.OPTIMAL, model_builder.SolveStatus.FEASIBLE)
    units = [unit for unit, use in program.use.items() if found and engine.value(use) > 0.5]
    watch.lap("solve")
    tree = TaskTree.of(world, problem.goals, units) if found else None
    watch.lap("replay")
    words = {
        model_builder.SolveStatus.OPTIMAL: "optimal",
        model_builder.SolveStatus.INFEASIBLE: "unreachable",
    }
    return watch.proof(words.get(status, "limit"), tree)


class _Program:
    """Builds the program; `use` has the variable of each unit."""

    def __init__(self, part: Slice) -> None:
        self.part = part
        self.model = model_builder.Model()
        self.use = {unit: self._variable() for unit in part.needs}
        self._edges: dict[tuple[ObjectId, ObjectId], Variable] = {}
        made = {thing: self._variable() for thing in part.makers}
        for thing, units in part.makers.items():
            self.model.add(_sum(self._way(thing, unit) for unit in units) >= made[thing])
        for unit, things in part.needs.items():
            for thing in things:
                self.model.add(self.use[unit] <= made[thing])
        for goal in part.goals:
            self.model.add(made[goal] >= 1)
        self._eliminate()
        self.model.minimize(_sum(self.use.values()))

    def _variable(self) -> Variable:
        return self.model.new_bool_var("")

    def _way(self, thing: ObjectId, unit: UnitId) -> Variable:
        """Return the variable that a unit makes an object after all that it needs of the same circle."""
        before = self.part.before(thing, unit)
        if not before:
            return self.use[unit]
        way = self._variable()
        self.model.add(way <= self.use[unit])
        for need in before:
            self.model.add(way <= self._edge(need, thing))
        return way

    def _edge(self, before: ObjectId, behind: ObjectId) -> Variable:
        if (before, behind) not in self._edges:
            self._edges[before, behind] = self._variable()
        return self._edges[before, behind]

    def _eliminate(self) -> None:
        """Forbid circles: take out object after object, the fewest neighbours first, and shortcut edges."""
        after: dict[ObjectId, set[ObjectId]] = {thing: set() for thing in self.part.circles}
        before: dict[ObjectId, set[ObjectId]] = {thing: set() for thing in self.part.circles}
        for first, second in self._edges:
            after[first].add(second)
            before[second].add(first)
        while after:
            middle = min(after, key=lambda thing: (len(after[thing] | before[thing]), thing))
            behind, ahead = after.pop(middle), before.pop(middle)
            for first in ahead:
                after[first].discard(middle)
            for second in behind:
                before[second].discard(middle)
            for first in ahead:
                for second in behind:
                    both = self._edge(first, middle) + self._edge(middle, second)
                    if first == second:
                        self.model.add(both <= 1)
                        continue
                    self.model.add(both - 1 <= self._edge(first, second))
                    after[first].add(second)
                    before[second].add(first)


def _sum(variables: Iterable[Variable]) -> Any:
    return model_builder.LinearExpr.sum(list(variables))
