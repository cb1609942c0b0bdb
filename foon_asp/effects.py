"""What executing a unit uses up: three semantics, from retrieval's "nothing" to "everything it takes"."""

from __future__ import annotations

from functools import cached_property

from foon_asp.arrays import Ids
from foon_asp.errors import QueryError
from foon_asp.problem import Domain, Problem

SEMANTICS = ("add", "transform", "consume")


class Effects:
    """What each unit of a domain needs, adds and deletes, under one of the semantics.

    - `add`: nothing is ever used up. This is the delete relaxation, and what retrieval assumes.
    - `transform`: an input that is not among the outputs is deleted if its label is that of an output in
      another state, or among the contents of an output: it became that output, or went into it.
    - `consume`: every input that is not among the outputs is deleted.

    Implied views are deleted like all other inputs. Bare objects are tools and never deleted. What the
    kitchen holds is in stock and never used up, unless the kitchen says how many there are: `counted`.
    """

    def __init__(self, domain: Domain, semantics: str) -> None:
        if semantics not in SEMANTICS:
            raise QueryError(f"unknown semantics {semantics!r}; there are {', '.join(SEMANTICS)}")
        self.domain = domain
        self.semantics = semantics
        self._deletes: dict[int, Ids] = {}

    @cached_property
    def counted(self) -> dict[int, int]:
        """How many there are at first of each kitchen object that can be used up."""
        return {} if self.semantics == "add" else self.domain.quantities

    @cached_property
    def endless(self) -> set[int]:
        """Kitchen objects that are never used up."""
        return self.domain.stock.keys() - self.counted.keys()

    def needs(self, unit: int) -> Ids:
        return self.domain.reading.needs[unit]

    def adds(self, unit: int) -> Ids:
        return self.domain.reading.makes[unit]

    def deletes(self, unit: int) -> Ids:
        """Return the inputs that a unit uses up, in the order in which it lists them."""
        if unit not in self._deletes:
            self._deletes[unit] = () if self.semantics == "add" else self._used_up(unit)
        return self._deletes[unit]

    def _used_up(self, unit: int) -> Ids:
        domain = self.domain
        listed = domain.foon.units[unit]
        outputs = [domain.node(thing) for thing in listed.outputs]
        became = {node.label for node in outputs if not node.bare or domain.labels_only}
        became |= {content for node in outputs for content in node.contents}
        kept = self.endless | set(listed.outputs)
        return tuple(
            thing
            for thing in listed.inputs
            if thing not in kept
            and (not domain.node(thing).bare or domain.labels_only)
            and (self.semantics == "consume" or domain.node(thing).label in became)
        )


class PlanProblem(Problem):
    """A problem with the units that can matter for a plan.

    That the kitchen holds an object which it counts does not make its makers superfluous: it can run out.
    """

    def __init__(self, effects: Effects, goals: tuple[int, ...]) -> None:
        super().__init__(effects.domain, goals)
        self.effects = effects

    @cached_property
    def units(self) -> list[int]:
        """Ids of the units given to the solver, in file order.

        Other units make nothing that a goal or one of these needs, so a plan can do without them.
        """
        domain = self.domain
        return domain.reading.backward(self.goals, self.effects.endless, domain.closure.executable)
