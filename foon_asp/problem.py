"""A problem: a FOON, a kitchen and goals, brought onto one numbering."""

from __future__ import annotations

import copy
import itertools
from collections.abc import Iterable, Sequence, Set
from dataclasses import replace
from functools import cached_property

from foon_asp.constraints import FREE, Constraints
from foon_asp.errors import QueryError, closest
from foon_asp.graph import Foon, FunctionalUnit, ObjectNode
from foon_asp.kitchen import Kitchen
from foon_asp.levels import FULL, check_level, planning_view, project, project_kitchen
from foon_asp.reading import Closure, Reading


class Domain:
    """A FOON seen from a kitchen; everything that does not depend on the goal is worked out once.

    Kitchen objects that the FOON does not know get the ids after the FOON's own.

    Below level 3 the domain is a view: what units need and make is read on level 3 and then projected,
    and so is the kitchen. `foon` is the FOON of that view, with unit and object ids of its own; `images`
    says for each unit of the full FOON which unit of the view it becomes.
    """

    def __init__(self, foon: Foon, kitchen: Kitchen, *, strict: bool = False, level: int = FULL) -> None:
        self.level = check_level(level)
        self.strict = strict
        self.images: Sequence[int] = range(len(foon.units))
        if level != FULL:
            # A FOON without any state was cut down to its labels before: nothing in it is a tool by that.
            cut = level == 1 and all(node.bare for node in foon.objects)
            reading = Reading(foon, kitchen.utensils, strict=strict, labels_only=cut)
            foon, self.images = planning_view(foon, reading, level)
            kitchen = project_kitchen(kitchen, level)
        self.foon = foon
        self._take_stock(kitchen)

    def _take_stock(self, kitchen: Kitchen) -> None:
        foon = self.foon
        self.kitchen = kitchen
        stock = list(dict.fromkeys(kitchen.objects))
        known = foon.objects.find(stock)
        self.strangers = [node for node, number in zip(stock, known, strict=True) if number is None]
        new = itertools.count(len(foon.objects))
        self.stock = {next(new) if number is None else number: None for number in known}

    def with_stock(self, objects: Iterable[ObjectNode]) -> Domain:
        """See the same FOON from a kitchen with other objects at hand.

        What units need and make is worked out once for both; of objects that are counted here there are as
        many.
        """
        listed = dict.fromkeys(map(self.project, objects))
        counts = {node: count for node, count in self.kitchen.quantities.items() if node in listed}
        reading = self.reading
        other = copy.copy(self)
        vars(other).pop("closure", None)
        vars(other).pop("quantities", None)
        other.reading = reading
        kitchen = replace(self.kitchen, objects=tuple(listed), quantities=counts)
        other._take_stock(kitchen)
        return other

    @property
    def labels_only(self) -> bool:
        """Whether nodes are labels alone, so that a bare one may well be made."""
        return self.level == 1

    def project(self, node: ObjectNode) -> ObjectNode:
        """Return what the level of this domain shows of an object node."""
        return project(node, self.level)

    @cached_property
    def quantities(self) -> dict[int, int]:
        """How many there are of the objects in stock of which there are not plenty."""
        ids = zip(self.stock, dict.fromkeys(self.kitchen.objects), strict=True)
        counts = self.kitchen.quantities
        return {number: counts[node] for number, node in ids if node in counts}

    @cached_property
    def reading(self) -> Reading:
        return Reading(self.foon, self.kitchen.utensils, strict=self.strict, labels_only=self.labels_only)

    @cached_property
    def closure(self) -> Closure:
        """All that the kitchen can make, and all units that it can execute."""
        return self.reading.forward(self.stock)

    def node(self, number: int) -> ObjectNode:
        known = len(self.foon.objects)
        return self.foon.objects[number] if number < known else self.strangers[number - known]

    def id_of(self, node: ObjectNode) -> int:
        """Return the id of an object node, seen on this level.

        Raises `QueryError` if neither FOON nor kitchen has it.
        """
        node = self.project(node)
        number = self.foon.id_of(node)
        if number is None:
            if node in self.strangers:
                return len(self.foon.objects) + self.strangers.index(node)
            same_label = [str(other) for other in self.foon.labelled(node.label)]
            hint = closest(str(node), same_label) or closest(node.label, self.foon.labels)
            raise QueryError(f"unknown goal {str(node)!r}{hint}")
        return number

    def is_tool(self, node: ObjectNode) -> bool:
        """Whether a node is bare, or a utensil that contains nothing."""
        return node.bare or (node.label in self.kitchen.utensils and not node.contents)

    def handled(self, unit: FunctionalUnit) -> Set[str]:
        """Return the utensils that a unit handles: what it lists, and what that is in or on."""
        nodes = self._listed(unit)
        related = {state.relatum for node in nodes for state in node.states if state.relatum is not None}
        return self.kitchen.utensils & ({node.label for node in nodes} | related)

    def filled(self, unit: FunctionalUnit) -> Set[str]:
        """Return the utensils that hold something in a unit, before or after its motion."""
        nodes = self._listed(unit)
        vessels = {vessel for node in nodes for vessel in node.containers}
        return self.kitchen.utensils & ({node.label for node in nodes if node.contents} | vessels)

    def _listed(self, unit: FunctionalUnit) -> list[ObjectNode]:
        return [self.node(number) for number in (*unit.inputs, *unit.outputs)]

    def problem(
        self, goals: Iterable[ObjectNode], *, founded: bool = True, constraints: Constraints = FREE
    ) -> Problem:
        ids = tuple(self.id_of(goal) for goal in goals)
        return Problem(self, ids, founded=founded, constraints=constraints)


class Problem:
    """What the solver is asked: goals over a domain, with only the units that can matter for them.

    `founded` keeps the units that the kitchen can execute; without it (the reading of the published
    programs) every unit that leads to a goal stays, even in circles. Units that the constraints demand
    are there, too, with what leads to them.
    """

    def __init__(
        self,
        domain: Domain,
        goals: tuple[int, ...],
        *,
        founded: bool = True,
        whole: bool = False,
        constraints: Constraints = FREE,
    ) -> None:
        self.domain = domain
        self.goals = goals
        self.founded = founded
        self.whole = whole
        self.constraints = constraints

    @cached_property
    def units(self) -> list[int]:
        """Ids of the units given to the solver, in file order."""
        domain = self.domain
        if self.whole:
            return list(range(len(domain.foon.units)))
        allowed = domain.closure.executable if self.founded else None
        required = [unit for unit in self.constraints.use_units if allowed is None or unit in allowed]
        wanted = [*self.goals, *(need for unit in required for need in domain.reading.needs[unit])]
        return sorted({*required, *domain.reading.backward(wanted, domain.stock, allowed)})

    @cached_property
    def objects(self) -> list[int]:
        """Ids of the objects given to the solver, sorted."""
        domain = self.domain
        if self.whole:
            return list(range(len(domain.foon.objects) + len(domain.strangers)))
        seen = set(self.goals)
        for number in self.units:
            unit = domain.foon.units[number]
            seen.update(unit.inputs, unit.outputs)
        return sorted(seen)
