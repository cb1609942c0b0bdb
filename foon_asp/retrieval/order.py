"""Whether another order of the steps of a tree would do: each is done as often as the tree lists it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from typing import cast

from foon_asp import limits
from foon_asp.asp.facts import facts, times_facts
from foon_asp.asp.model import Model
from foon_asp.asp.solver import open_solver
from foon_asp.errors import InternalError
from foon_asp.limits import LimitReachedError, limited
from foon_asp.model.consumption import Effects
from foon_asp.model.node import UnitId
from foon_asp.model.supply import Supply
from foon_asp.query.problem import Problem

_PATIENCE = 5.0
"""How many seconds an order is looked for where objects are used up; that can take long."""


def other_order(effects: Effects, units: Sequence[UnitId]) -> tuple[int, ...] | None:
    """Return places of units in an order that can be executed; None if there is none, or none was found.

    Of the units that can be executed the one comes next that stands first. Where objects are used up that may
    not do, though another order does; then `encodings/retrieval/order.lp` is asked.
    """
    order = _first_come(effects, units)
    if order is not None or effects.semantics == "add":
        return order
    if _first_come(Effects(effects.world, "add"), units) is None:
        return None
    return _searched(effects, units)


def _first_come(effects: Effects, units: Sequence[UnitId]) -> tuple[int, ...] | None:
    supply = Supply(effects)
    waiting = list(range(1, len(units) + 1))
    order = []
    while waiting:
        ready = next((place for place in waiting if not supply.lacks(units[place - 1])), None)
        if ready is None:
            return None
        supply.execute(units[ready - 1])
        waiting.remove(ready)
        order.append(ready)
    return tuple(order)


def _searched(effects: Effects, units: Sequence[UnitId]) -> tuple[int, ...] | None:
    """Ask the solver for an order, and replay it; raise `InternalError` if it cannot be executed."""
    world = effects.world
    problem = Problem(world, (), among=tuple(sorted(set(units))))
    text = facts(problem) + times_facts(Counter(units))
    constants: dict[str, str | int] = {"semantics": effects.semantics, "strict": int(world.strict)}
    model = Model(None, False)
    with suppress(LimitReachedError), limited(_PATIENCE):
        solver = open_solver(["retrieval/order.lp"], text, constants)
        for step in range(1, len(units) + 1):
            solver.ground("step", step)
        solver.ground("whole", len(units))
        model = solver.best()
    limits.check()
    if model.atoms is None:
        return None
    done = cast(list[tuple[UnitId, int]], model.rows("do"))
    waiting = {unit: [place for place, other in enumerate(units, 1) if other == unit] for unit in set(units)}
    supply = Supply(effects)
    order = []
    for unit, _ in sorted(done, key=lambda each: each[1]):
        if supply.execute(unit):
            raise InternalError(f"unit {unit} cannot be executed where order.lp says it can")
        order.append(waiting[unit].pop(0))
    return tuple(order)
