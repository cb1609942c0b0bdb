"""One question: what is wanted, how, at what price, within which limits. The same object everywhere."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Unpack

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.checks import check_in_world, check_query
from foon_asp.query.constraints import ConstraintKeys, Constraints
from foon_asp.query.goals import Named, check_named, find_object
from foon_asp.query.kitchen_change import AS_IT_IS, KitchenChange
from foon_asp.query.method import DEFAULTS, Method
from foon_asp.query.objective import SUCCESS, Objective
from foon_asp.query.substitution import Given, Substitution
from foon_asp.values import a_list, said

_CONSTRAINTS = frozenset(ConstraintKeys.__annotations__)


@dataclass(frozen=True, slots=True, init=False, repr=False)
class Query:
    """A question about task trees.

    `goals`: object nodes, or texts as on the command line; several goals are made by one tree and share its
    steps. `by`: the objective as it was asked for; `objective` fills in the method's own where it is empty.
    `founded`: the tree can be executed; without it units are read as the published programs do, and the tree
    may go in circles. `time_limit`: seconds for the whole question. `memory_limit`: megabytes that a process
    may take which solves it. `kitchen`: how the kitchen differs from that of the data. `substitute`: what may
    be replaced where there is no tree otherwise.
    """

    goals: tuple[Named, ...]
    method: Method
    by: Objective
    founded: bool
    constraints: Constraints
    time_limit: float | None
    memory_limit: float | None
    kitchen: KitchenChange
    substitute: Substitution | None

    def __init__(
        self,
        *goals: Named,
        by: str | Iterable[str] | Objective = (),
        method: str = Method.OPTIMAL,
        founded: bool = True,
        constraints: Constraints | None = None,
        time_limit: float | None = None,
        memory_limit: float | None = None,
        kitchen: Iterable[Named] | KitchenChange | None = None,
        add: Iterable[Named] = (),
        remove: Iterable[Named] = (),
        substitute: bool | str | Iterable[Given] | Substitution | None = None,
        **keys: Unpack[ConstraintKeys],
    ) -> None:
        """Ask for goals; constraints are given by their keys (`max_depth=3`, `avoid_motions=["fry"]`).

        `kitchen` replaces the objects of the data, `add` and `remove` change them. `substitute` names what
        tells which labels are alike ("foon", "vectors"), and replacements that may be made. Raises
        `QueryError` for whatever can be told wrong before any data are looked at.
        """
        if unknown := keys.keys() - _CONSTRAINTS:
            # What Python itself would say of a misspelt argument.
            raise TypeError(f"Query() got an unexpected keyword argument {min(unknown)!r}")
        for goal in goals:
            check_named(goal, "a goal")
        if not isinstance(founded, bool):
            raise QueryError(f"'founded' is True or False, not {said(founded)}")
        if not isinstance(constraints, Constraints | None):
            raise QueryError(f"'constraints' are Constraints, not {said(constraints)}")
        change = kitchen if isinstance(kitchen, KitchenChange) else KitchenChange.of(kitchen, add, remove)
        values = {
            "goals": goals,
            "method": Method.named(method),
            "by": Objective.parse(by),
            "founded": founded,
            "constraints": Constraints.of(keys) if constraints is None else constraints,
            "time_limit": time_limit,
            "memory_limit": memory_limit,
            "kitchen": change,
            "substitute": Substitution.of(substitute),
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)
        check_query(self)

    @classmethod
    def of(cls, question: Query | Named) -> Query:
        """Return a question; one that is only a goal, as a text or an object node, asks for the best tree.

        Raises `QueryError` for what is no question, or asks for nothing.
        """
        if isinstance(question, str | ObjectNode):
            return cls(question)
        if not isinstance(question, Query):
            raise QueryError(f"a question is a Query, a text or an ObjectNode, not {said(question)}")
        if not question.goals:
            raise QueryError("no goal is named; write Query('whipped cream')")
        return question

    @property
    def objective(self) -> Objective:
        """What the tree is best by: as asked, else the method's own."""
        if self.by:
            return self.by
        if self.method == Method.OPTIMAL and self.constraints.human_steps is not None:
            return SUCCESS
        return DEFAULTS[self.method]

    def replace(self, **changes: Any) -> Query:
        """Return the same question with some arguments of the constructor changed; `goals` are a list."""
        keys = {name: changes.pop(name) for name in list(changes) if name in _CONSTRAINTS}
        if keys:
            changed = Constraints.of(keys)  # type: ignore[arg-type]
            changes["constraints"] = replace(
                self.constraints, **{name: getattr(changed, name) for name in keys}
            )
        same = {
            "by": self.by,
            "method": self.method,
            "founded": self.founded,
            "constraints": self.constraints,
            "time_limit": self.time_limit,
            "memory_limit": self.memory_limit,
            "kitchen": self.kitchen,
            "substitute": self.substitute,
        }
        goals = a_list(changes.pop("goals", self.goals), "goals", "objects")
        return Query(*goals, **{**same, **changes})

    @property
    def nodes(self) -> tuple[ObjectNode, ...]:
        """The goals as object nodes, which all of them are once the question is checked."""
        return tuple(goal for goal in self.goals if isinstance(goal, ObjectNode))

    def seen_in(self, world: World) -> World:
        """Return the world that the question is about: that of the data, with the kitchen changed."""
        return self.kitchen.applied(world)

    def checked(self, world: World) -> Query:
        """Return the question with every goal as an object node of a world; its kitchen is that of the world.

        Raises `QueryError` for whatever does not fit the data.
        """
        check_in_world(self, world)
        return self._copied(goals=tuple(find_object(world, goal) for goal in self.goals), kitchen=AS_IT_IS)

    def _copied(self, **changes: Any) -> Query:
        """Return the same question with some fields changed, none of which needs to be checked."""
        copy = object.__new__(Query)
        for name in Query.__slots__:
            object.__setattr__(copy, name, changes[name] if name in changes else getattr(self, name))
        return copy

    def __repr__(self) -> str:
        parts = [repr(str(goal)) for goal in self.goals]
        if self.by:
            parts.append(f"by={str(self.by)!r}")
        if self.method != Method.OPTIMAL:
            parts.append(f"method={str(self.method)!r}")
        if not self.founded:
            parts.append("founded=False")
        parts += [f"<{name}>" for name in self.constraints.names]
        if self.time_limit is not None:
            parts.append(f"time_limit={self.time_limit:g}")
        if self.memory_limit is not None:
            parts.append(f"memory_limit={self.memory_limit:g}")
        if self.kitchen:
            parts.append("<another kitchen>")
        if self.substitute is not None:
            parts.append("<substitution>")
        return f"Query({', '.join(parts)})"
