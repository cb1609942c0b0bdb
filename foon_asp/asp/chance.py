"""Chances of success, exactly: clingo adds rounded logarithms, and a limit may lie between two of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import clingo

from foon_asp.model.kitchen import chance_of, exact

_NEAR = 1e-9
"""What sums of logarithms may lose: what is nearer to the limit is multiplied exactly."""


@dataclass(frozen=True, slots=True)
class LeastChance:
    """The constraint `name`: units with these rates succeed at least with this chance.

    A human does so many steps, the likeliest to fail, unless it is open who does what.
    """

    rates: Mapping[int, float]
    least: float
    name: str
    human_steps: int

    def holds(self, units: Iterable[int], human_steps: int) -> bool:
        """Whether units are likely enough to succeed, multiplied exactly where it matters."""
        rates = sorted(self.rates[unit] for unit in units)[human_steps:]
        if 0 not in rates:
            near = math.fsum(map(math.log, rates)) - math.log(self.least)
            if abs(near) > _NEAR:
                return near > 0
        return chance_of(rates) >= exact(self.least)


class ExactChance(clingo.Propagator):
    """Forbids task trees whose chance is too low by less than costs are rounded.

    `constraints.lp` forbids the others, and says what a human takes over. A tree that is told to break the
    constraint (`violated/2`), to find out what stands in the way, is let through.
    """

    def __init__(self, asked: LeastChance) -> None:
        self._asked = asked
        self._use: dict[int, int] = {}
        self._human: dict[int, int] = {}
        self._broken: list[int] = []
        self._human_steps = 0

    def init(self, init: clingo.PropagateInit) -> None:
        """Look up what a model will say of units."""
        atoms = init.symbolic_atoms

        def literals(name: str, arity: int) -> list[tuple[clingo.Symbol, int]]:
            found = atoms.by_signature(name, arity)
            return [(atom.symbol.arguments[0], init.solver_literal(atom.literal)) for atom in found]

        rates = self._asked.rates
        use = [(symbol.number, literal) for symbol, literal in literals("use", 1)]
        self._use = {unit: literal for unit, literal in use if rates.get(unit, 1) < 1}
        self._human = {symbol.number: literal for symbol, literal in literals("human", 1)}
        name = clingo.String(self._asked.name)
        self._broken = [literal for broken, literal in literals("violated", 2) if broken == name]
        is_open = any(True for _ in atoms.by_signature("open_to_human", 1))
        self._human_steps = 0 if is_open else self._asked.human_steps

    def check(self, control: clingo.PropagateControl) -> None:
        """Forbid a model that is too unlikely to succeed, with all that are so for the same steps."""
        true = control.assignment.is_true
        if any(map(true, self._broken)):
            return
        robot = [
            unit
            for unit, literal in self._use.items()
            if true(literal) and not (unit in self._human and true(self._human[unit]))
        ]
        if self._asked.holds(robot, self._human_steps):
            return
        mine = [-self._human[unit] for unit in robot if unit in self._human]
        control.add_nogood([*(self._use[unit] for unit in robot), *mine, *(-each for each in self._broken)])
