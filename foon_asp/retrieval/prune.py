"""Task trees without superfluous units: what a search had not yet left out when its time was up."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.reachability import backward, within
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.retrieval.tree import TaskTree, first_makers, likeliest_to_fail


def pruned(problem: Problem, tree: TaskTree, objective: Objective) -> TaskTree:
    """Return a tree without the units that it can do without.

    It is no worse by the objective, breaks no constraint, and none of its units can be left out any more.
    Units that the constraints demand stay. What rules of the user's own ask for is not known here: under such
    a tree stays as it is.
    """
    if problem.constraints.rules:
        return tree
    if not tree.executable:
        return tree_of(problem, _leading_in_circles(problem, tree.units), objective, tree.human)
    kept = leading(problem, tree.units) or tree.units
    best = tree_of(problem, kept, objective, tree.human)
    while (fewer := _without_one(problem, best, objective)) is not None:
        best = fewer
    return best


def _without_one(problem: Problem, tree: TaskTree, objective: Objective) -> TaskTree | None:
    """Return a tree that does without some unit, the last that can be left out, or None if all are needed."""
    costs = objective.costs(tree.costs)
    most = problem.constraints.max_depth
    for unit in _doubtful(problem, tree):
        kept = leading(problem, [other for other in tree.units if other != unit])
        if kept is None:
            continue
        fewer = tree_of(problem, kept, objective, tree.human)
        if objective.costs(fewer.costs) <= costs and (most is None or (fewer.depth or 0) <= most):
            return fewer
    return None


def _doubtful(problem: Problem, tree: TaskTree) -> Iterable[UnitId]:
    """Yield the units, the last one first, of which everything that is wanted has another maker, too."""
    world = tree.world
    makes = world.units.made
    wanted = {need for unit in tree.units for need in world.units.needed[unit]}.union(tree.goals)
    times: dict[ObjectId, int] = {}
    for unit in tree.units:
        for object_id in makes[unit]:
            times[object_id] = times.get(object_id, 0) + 1
    for unit in reversed(tree.units):
        sole = [o for o in makes[unit] if times[o] == 1 and o in wanted and o not in world.stock]
        if not sole and unit not in problem.constraints.use_units:
            yield unit


def leading(problem: Problem, units: Iterable[UnitId]) -> set[UnitId] | None:
    """Return those of some units by which the goals, and what is demanded, are made first.

    None if they are not made. Each object is taken from the unit that makes it in the earliest round, so no
    unit that is kept is executed in a later round than before.
    """
    reading, stock = problem.world.units, problem.world.stock
    executable = within(reading, stock, units).executable
    maker = first_makers(reading, executable)
    demanded = set(problem.constraints.use_units)
    kept = set(demanded)
    wanted = [*problem.goals, *(need for unit in demanded for need in reading.needed[unit])]
    while wanted:
        object_id = wanted.pop()
        if object_id in stock:
            continue
        unit = maker.get(object_id)
        if unit is None:
            return None
        if unit not in kept:
            kept.add(unit)
            wanted += reading.needed[unit]
    return kept if kept <= executable.keys() else None


def _leading_in_circles(problem: Problem, units: Collection[UnitId]) -> set[UnitId]:
    """Return those of some units that lead to the goals, or to what is demanded, be it in circles."""
    world, demanded = problem.world, problem.constraints.use_units
    wanted = [*problem.goals, *(need for unit in demanded for need in world.units.needed[unit])]
    return {*demanded, *backward(world.units, wanted, world.stock, units)}


def tree_of(
    problem: Problem, units: Collection[UnitId], objective: Objective, human: Collection[UnitId] = ()
) -> TaskTree:
    """Return the tree of some units, with the steps of a human among them: these, or what is best."""
    most = problem.constraints.human_steps
    if most is not None and "human" not in objective.names:
        human = likeliest_to_fail(problem.world, units, most)
    return TaskTree.of(problem.world, problem.goals, units, set(human).intersection(units))
