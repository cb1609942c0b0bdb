"""Why a goal cannot be made, by plain graph search: said in one sentence, before any solver is asked."""

from __future__ import annotations

from foon_asp.errors import shortened
from foon_asp.problem import Domain, Problem


def unreachable_reason(problem: Problem) -> str:
    """Say in one sentence why no task tree can exist, or return nothing if one can."""
    domain = problem.domain
    makers = domain.reading.makers
    for goal in problem.goals:
        if goal in domain.stock:
            continue
        node = domain.node(goal)
        if goal not in makers:
            return f"no unit makes {node}" + (
                "; it is bare (has no states), so only the kitchen can have it"
                if node.bare and not domain.labels_only
                else ""
            )
        if problem.founded and goal not in domain.closure.available:
            return _locked(domain, goal)
    return ""


def _locked(domain: Domain, goal: int) -> str:
    """Say what stands in the way of a goal that units make, but none that can be executed."""
    reading = domain.reading
    available = domain.closure.available
    units = reading.backward([goal], available)
    lacking = {thing for unit in units for thing in reading.needs[unit] if thing not in available}
    nobody = sorted(thing for thing in lacking if thing not in reading.makers)
    if nobody:
        names = shortened([domain.node(thing) for thing in nobody])
        it = "it" if len(nobody) == 1 else "them"
        return f"the kitchen lacks {names}, and no unit makes {it}"
    inner, units_round = circle(domain, goal)
    places = ", ".join(str(domain.foon.units[unit].source) for unit in units_round)
    return f"locked in a circle: {domain.node(inner)} is needed to make itself ({places})"


def circle(domain: Domain, goal: int) -> tuple[int, list[int]]:
    """Follow what is lacking from the goal, first maker first, until an object comes again.

    Return that object and the units of the circle.
    """
    reading = domain.reading
    available = domain.closure.available
    path: dict[int, int] = {}
    thing = goal
    while thing not in path:
        unit = reading.makers[thing][0]
        path[thing] = unit
        thing = next(need for need in reading.needs[unit] if need not in available)
    things = list(path)
    return thing, [path[each] for each in things[things.index(thing) :]]
