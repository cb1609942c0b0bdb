"""What a kitchen can make, as clingo derives it and plain graph search confirms."""

from __future__ import annotations

from foon_asp.asp.program import solver
from foon_asp.errors import InternalError
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem


def reach(world: World) -> tuple[list[ObjectId], list[UnitId]]:
    """Return the ids of all available objects and all executable units, as clingo derives them.

    Raises `InternalError` if the plain graph search does not agree.
    """
    problem = Problem(world, (), whole=True)
    answer = solver(problem, ["reachability.lp"], {}).best()
    available = list(map(ObjectId, answer.column("available")))
    executable = list(map(UnitId, answer.column("executable")))
    if world.closure.available.keys() != set(available):
        raise InternalError("reachability.lp and the graph search disagree on what is available")
    if world.closure.executable.keys() != set(executable):
        raise InternalError("reachability.lp and the graph search disagree on what is executable")
    return available, executable
