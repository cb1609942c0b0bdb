"""Steps that bring a thing into a state or place, or do something to it, that no given order allows.

`encodings/retrieval/transitions.lp` says which; here are its facts, and its answer in words.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from foon_asp.asp.facts import facts
from foon_asp.asp.solver import open_solver
from foon_asp.asp.terms import quote
from foon_asp.io.transitions import Orders
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem

Aspect = Literal["state", "location", "motion"]
"""What an order is about."""

ASPECTS: tuple[Aspect, ...] = ("state", "location", "motion")


@dataclass(frozen=True, slots=True)
class Models:
    """Which words may come behind which; a model without orders judges nothing.

    `adjacent`: a thing goes on to the next word of an order, else to any later one.
    """

    orders: Mapping[Aspect, Orders]
    adjacent: bool = False

    def __bool__(self) -> bool:
        return any(self.orders.values())


@dataclass(frozen=True, slots=True, order=True)
class Refusal:
    """What is wrong with a step, by its place (0, 1, …) among all: it brings the label to the word."""

    step: int
    aspect: Aspect
    label: str
    word: str


def refusals(world: World, trees: Sequence[Sequence[UnitId]], models: Models) -> list[Refusal]:
    """Return the transitions of some trees that models do not allow, in the order of the steps."""
    if not models:
        return []
    lines = [*_listed(models), *_steps(world, trees)]
    text = facts(Problem(world, (), whole=True)) + "\n".join(lines) + "\n"
    constants = {"adjacent": int(models.adjacent)}
    answer = open_solver(["retrieval/transitions.lp"], text, constants).best()
    found = []
    for step, aspect, label, word in answer.rows("refused"):
        assert isinstance(step, int)
        assert isinstance(label, str)
        assert isinstance(word, str)
        [known] = [each for each in ASPECTS if each == aspect]
        found.append(Refusal(step, known, label, word))
    return sorted(found)


def _listed(models: Models) -> Iterator[str]:
    for aspect, orders in models.orders.items():
        for number, order in enumerate(orders):
            for place, word in enumerate(order):
                yield f"listed({quote(aspect)},{number},{place},{quote(word)})."


def _steps(world: World, trees: Sequence[Sequence[UnitId]]) -> Iterator[str]:
    """Yield the steps, and from which earlier one of its tree each takes something that is no utensil."""
    number = 0
    for place, units in enumerate(trees):
        maker: dict[ObjectId, int] = {}
        for unit in units:
            yield f"step({number},{place},{unit})."
            for need in world.units.needs[unit]:
                label = world.node(need).label
                if need in maker and label not in world.kitchen.utensils:
                    yield f"handed({maker[need]},{number},{quote(label)})."
            maker |= dict.fromkeys(world.units.makes[unit], number)
            number += 1
