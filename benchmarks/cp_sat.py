"""The least task tree as a constraint program, for CP-SAT of OR-tools.

A Boolean for each unit and for each object that several units make, and in each circle of objects a level
that rises along every chosen way of making. The sum of the units is minimised.

What was tried, on the 23 public goals that can be made: geometric means over the goals of the median of 3 or
5 runs, in ms, from the loaded problem to the checked tree (two shared cores, OR-tools 9.15). First, written
with the methods of `CpModel`:

| foundedness in the circles | parameters | ms |
|---|---|---:|
| levels | one worker, the rest as it comes | 6.8 |
| loop formulas, all | the same | 7.3 |
| loop formulas, those that a solution violates, then again | the same | 5.2 |
| vertex elimination | the same | 7.2 |
| levels | two workers | 10.4 |
| levels | no presolve | 7.4 |
| levels | core-guided | 7.6 |
| levels | no linear relaxation; a strong one | 5.7; 8.2 |
| levels | no probing, no symmetries, one round of presolve, no linear relaxation | 4.7 |
| lazy loop formulas | the same | 7.6 |

Then written straight as a protocol buffer, with one conjunction for all needs of a unit and no variable for
an object that one unit makes: 2.8 to 3.4 ms for the last but one, which is what stands here. Side by side
with it, in a busier hour in which it took 4.7 to 4.8 ms: a hint (for each object the unit that can be
executed first) 4.9, core-guided 4.8, with the linear relaxation 4.9, three rounds of presolve 5.2, probing
and symmetries 5.3, no presolve 5.6 (at most 78 instead of 15), two workers 7.3. To settle beforehand what is
in every tree made no difference either: presolve does that.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ortools.sat.python import cp_model
from proof import Proof, Slice, Stopwatch, posed

from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.retrieval.tree import TaskTree


def solve(world: World, goal: ObjectNode, limit: float, *, reduced: bool = False) -> Proof:
    """Find a least task tree, or prove within `limit` seconds that there is none."""
    watch = Stopwatch()
    problem = posed(watch, world, goal, reduced=reduced)
    if isinstance(problem, Proof):
        return problem
    model = Model.of(Slice.of(problem))
    watch.lap("build")
    solver = _solver(limit)
    status = solver.solve(model.model)
    found = status in (cp_model.OPTIMAL, cp_model.FEASIBLE)
    values = solver.response_proto.solution if found else ()
    units = [unit for unit, variable in model.units.items() if found and values[variable]]
    watch.lap("solve")
    tree = TaskTree.of(world, problem.goals, units) if found else None
    watch.lap("replay")
    words = {cp_model.OPTIMAL: "optimal", cp_model.INFEASIBLE: "unreachable"}
    return watch.proof(words.get(status, "limit"), tree)


def _solver(limit: float) -> cp_model.CpSolver:
    solver = cp_model.CpSolver()
    parameters = solver.parameters
    parameters.num_workers = 1
    parameters.cp_model_probing_level = 0
    parameters.symmetry_level = 0
    parameters.max_presolve_iterations = 1
    parameters.linearization_level = 0
    parameters.max_time_in_seconds = limit
    return solver


@dataclass(frozen=True, slots=True)
class Model:
    """The constraint program, and the number of the variable of each unit."""

    model: cp_model.CpModel
    units: dict[UnitId, int]

    @classmethod
    def of(cls, part: Slice) -> Model:
        """Build the program of a slice."""
        builder = _Builder(part)
        return cls(builder.model, builder.use)


class _Builder:
    """Writes the protocol buffer itself: the methods of `CpModel` take longer than the solver.

    A literal is the number of its variable, and -1-number if it is negated.
    """

    def __init__(self, part: Slice) -> None:
        self.part = part
        self.model = cp_model.CpModel()
        proto = self.model.proto
        self._variables, self._constraints = proto.variables, proto.constraints
        self._count = 0
        self.use = {unit: self._variable(1) for unit in part.needs}
        self._made = {thing: self._maker(thing) for thing in part.makers}
        sizes: dict[int, int] = {}
        for circle in part.circles.values():
            sizes[circle] = sizes.get(circle, 0) + 1
        self._sizes = sizes
        self._level = {thing: self._variable(sizes[circle] - 1) for thing, circle in part.circles.items()}
        for thing, units in part.makers.items():
            if thing in part.circles:
                self._clause([-1 - self._made[thing], *(self._way(thing, unit) for unit in units)])
            elif len(units) > 1:
                self._clause([-1 - self._made[thing], *(self.use[unit] for unit in units)])
        for unit, things in part.needs.items():
            if things:
                self._both(self.use[unit], [self._made[thing] for thing in things])
        for goal in part.goals:
            self._clause([self._made[goal]])
        proto.objective.vars.extend(self.use.values())
        proto.objective.coeffs.extend([1] * len(self.use))

    def _variable(self, largest: int) -> int:
        self._variables.add().domain.extend((0, largest))
        self._count += 1
        return self._count - 1

    def _maker(self, thing: ObjectId) -> int:
        """Return the variable that says that an object is made: that of its only maker, where it has one."""
        units = self.part.makers[thing]
        if thing not in self.part.circles and len(units) == 1:
            return self.use[next(iter(units))]
        return self._variable(1)

    def _way(self, thing: ObjectId, unit: UnitId) -> int:
        """Return the literal that a unit makes an object after all that it needs of the same circle."""
        before = self.part.before(thing, unit)
        if not before:
            return self.use[unit]
        way = self._variable(1)
        self._clause([-1 - way, self.use[unit]])
        size = self._sizes[self.part.circles[thing]]
        for need in before:
            above = self._constraints.add()
            above.enforcement_literal.append(way)
            above.linear.vars.extend((self._level[thing], self._level[need]))
            above.linear.coeffs.extend((1, -1))
            above.linear.domain.extend((1, size))
        return way

    def _clause(self, literals: Iterable[int]) -> None:
        self._constraints.add().bool_or.literals.extend(literals)

    def _both(self, condition: int, literals: Iterable[int]) -> None:
        implied = self._constraints.add()
        implied.enforcement_literal.append(condition)
        implied.bool_and.literals.extend(literals)
