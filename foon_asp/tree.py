"""Task trees: order, costs, and the replay that every tree must pass. Plain Python, knows no ASP."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from foon_asp.criteria import Costs
from foon_asp.graph import FunctionalUnit, ObjectNode
from foon_asp.problem import Domain


@dataclass(frozen=True, slots=True)
class Replay:
    """How executing units in order from the kitchen ended.

    `failed_at` is the place (0, 1, …) of the first unit that lacked something, or None; `missing` is
    what it lacked, or the goals that were not there in the end.
    """

    executable: bool
    failed_at: int | None
    missing: tuple[ObjectNode, ...]


@dataclass(frozen=True, slots=True)
class TaskTree:
    """Functional units in the order of execution, made and checked by `TaskTree.of`.

    `rounds` says for each unit in which round of parallel execution it is done (0 if never);
    `executable` says how the replay ended. `human` are the units that a human does and never fails at.
    """

    domain: Domain
    goals: tuple[int, ...]
    units: tuple[int, ...]
    rounds: tuple[int, ...]
    replay: Replay
    human: frozenset[int] = frozenset()

    @classmethod
    def of(
        cls, domain: Domain, goals: Iterable[int], units: Collection[int], human: Iterable[int] = ()
    ) -> TaskTree:
        """Bring units into an order that can be executed, if there is one, and replay it.

        Steps that lead to the same object stand together. Units that can never be executed come last,
        in file order.
        """
        goals = tuple(goals)
        executable = domain.reading.execute(domain.stock, units).executable
        order = _order(domain, goals, executable)
        order += sorted(set(units) - executable.keys())
        rounds = tuple(executable.get(unit, 0) for unit in order)
        return cls(domain, goals, tuple(order), rounds, replay(domain, goals, order), frozenset(human))

    @property
    def executable(self) -> bool:
        return self.replay.executable

    @property
    def steps(self) -> list[FunctionalUnit]:
        """The functional units themselves, in the order of execution."""
        return [self.domain.foon.units[unit] for unit in self.units]

    @property
    def depth(self) -> int | None:
        """How many rounds it takes to reach the goals if everything possible is done at once."""
        if not self.executable:
            return None
        reached = self.domain.reading.execute(self.domain.stock, self.units).available
        return max((reached.get(goal, 0) for goal in self.goals), default=0)

    @property
    def costs(self) -> Costs:
        rates = [self.domain.kitchen.known_rate(unit) for unit in self.steps if unit.id not in self.human]
        known = [rate for rate in rates if rate is not None]
        return Costs(
            units=len(self.units),
            inputs=sum(len(unit.inputs) for unit in self.steps),
            success=math.prod(known) if len(known) == len(rates) else None,
            depth=self.depth,
            tools=len({label for unit in self.steps for label in self.domain.handled(unit)}),
            dirty=len({label for unit in self.steps for label in self.domain.filled(unit)}),
            motions=len({unit.motion for unit in self.steps}),
            time=sum(unit.duration or 0 for unit in self.steps),
            human=len(self.human),
        )


def likeliest_to_fail(domain: Domain, units: Iterable[int], count: int) -> list[int]:
    """Return the units, at most so many, that are likeliest to fail; never one that cannot fail."""
    rates = {unit: domain.kitchen.known_rate(domain.foon.units[unit]) for unit in units}
    fallible = [(rate, unit) for unit, rate in rates.items() if rate is not None and rate < 1]
    return [unit for _, unit in sorted(fallible)[:count]]


def replay(domain: Domain, goals: Iterable[int], units: Iterable[int]) -> Replay:
    """Execute units one by one from the kitchen; nothing is used up."""
    reading = domain.reading
    stock = domain.stock
    at_hand: set[int] = set()
    for place, unit in enumerate(units):
        lacking = [thing for thing in reading.needs[unit] if not (thing in at_hand or thing in stock)]
        if lacking:
            return Replay(False, place, tuple(domain.node(thing) for thing in lacking))
        at_hand.update(reading.makes[unit])
    lacking = [goal for goal in goals if not (goal in at_hand or goal in stock)]
    return Replay(not lacking, None, tuple(domain.node(goal) for goal in lacking))


def _order(domain: Domain, goals: Iterable[int], executable: Mapping[int, int]) -> list[int]:
    """Order executable units so that each stands behind the makers of its needs, depth first."""
    reading = domain.reading
    maker: dict[int, int] = {}
    for unit in sorted(executable, key=lambda unit: (executable[unit], unit)):
        for thing in reading.makes[unit]:
            maker.setdefault(thing, unit)
    order: list[int] = []
    placed: set[int] = set()
    first = [maker[goal] for goal in goals if goal in maker]
    rest = sorted(executable, key=lambda unit: (executable[unit], unit))
    stack = [*reversed(rest), *reversed(first)]
    while stack:
        unit = stack[-1]
        before = [
            maker[thing]
            for thing in reading.needs[unit]
            if thing not in domain.stock and maker[thing] not in placed
        ]
        if before and unit not in placed:
            stack += reversed(before)
            continue
        stack.pop()
        if unit not in placed:
            placed.add(unit)
            order.append(unit)
    return order
