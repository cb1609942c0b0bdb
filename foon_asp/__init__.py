"""Task trees from functional object-oriented networks: proven, checked, explained.

>>> import foon_asp as fa
>>> world = fa.load()                            # or fa.load("DIR")
>>> answer = world.retrieve("greek salad")       # or world.retrieve(fa.Query("greek salad", by="success"))
>>> answer.status, answer.tree.executable
(<Status.OPTIMAL: 'optimal'>, True)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from foon_asp.api import World, check, consolidate, load, read
    from foon_asp.draw.formats import Drawing
    from foon_asp.errors import FoonError, FoonWarning, InputError, QueryError
    from foon_asp.model.foon import Foon, merge
    from foon_asp.model.kitchen import Kitchen
    from foon_asp.model.node import FunctionalUnit, ObjectNode, State
    from foon_asp.planning.resources import Resources, Station, Worker
    from foon_asp.planning.schedule import Schedule
    from foon_asp.planning.schedule_answer import ScheduleAnswer
    from foon_asp.query.constraints import Constraints
    from foon_asp.query.method import Method
    from foon_asp.query.objective import Costs, Objective
    from foon_asp.query.query import Query
    from foon_asp.query.status import Status
    from foon_asp.query.substitution import Replacement
    from foon_asp.retrieval.adapt import Adaptation
    from foon_asp.retrieval.alternatives import Alternatives
    from foon_asp.retrieval.answer import Answer
    from foon_asp.retrieval.check import Checks
    from foon_asp.retrieval.compare import Comparison
    from foon_asp.retrieval.consolidate import Consolidation
    from foon_asp.retrieval.explain import Explanation
    from foon_asp.retrieval.menu import Menu
    from foon_asp.retrieval.suggest import Suggestions
    from foon_asp.retrieval.tree import Step, TaskTree

_HOMES = {
    "api": ("World", "check", "consolidate", "load", "read"),
    "draw.formats": ("Drawing",),
    "errors": ("FoonError", "FoonWarning", "InputError", "QueryError"),
    "model.foon": ("Foon", "merge"),
    "model.kitchen": ("Kitchen",),
    "model.node": ("FunctionalUnit", "ObjectNode", "State"),
    "planning.resources": ("Resources", "Station", "Worker"),
    "planning.schedule": ("Schedule",),
    "planning.schedule_answer": ("ScheduleAnswer",),
    "query.constraints": ("Constraints",),
    "query.method": ("Method",),
    "query.objective": ("Costs", "Objective"),
    "query.query": ("Query",),
    "query.status": ("Status",),
    "query.substitution": ("Replacement",),
    "retrieval.adapt": ("Adaptation",),
    "retrieval.alternatives": ("Alternatives",),
    "retrieval.answer": ("Answer",),
    "retrieval.check": ("Checks",),
    "retrieval.compare": ("Comparison",),
    "retrieval.consolidate": ("Consolidation",),
    "retrieval.explain": ("Explanation",),
    "retrieval.menu": ("Menu",),
    "retrieval.suggest": ("Suggestions",),
    "retrieval.tree": ("Step", "TaskTree"),
}
"""Where each public name lives; it is imported when it is first asked for (PEP 562)."""

_HOME = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "Adaptation",
    "Alternatives",
    "Answer",
    "Checks",
    "Comparison",
    "Consolidation",
    "Constraints",
    "Costs",
    "Drawing",
    "Explanation",
    "Foon",
    "FoonError",
    "FoonWarning",
    "FunctionalUnit",
    "InputError",
    "Kitchen",
    "Menu",
    "Method",
    "ObjectNode",
    "Objective",
    "Query",
    "QueryError",
    "Replacement",
    "Resources",
    "Schedule",
    "ScheduleAnswer",
    "State",
    "Station",
    "Status",
    "Step",
    "Suggestions",
    "TaskTree",
    "Worker",
    "World",
    "check",
    "consolidate",
    "load",
    "merge",
    "read",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'foon_asp' has no attribute {name!r}")
    value = getattr(import_module(f"foon_asp.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
