"""Task trees from functional object-oriented networks: proven, checked, explained.

>>> import foon_asp
>>> data = foon_asp.load()                       # or foon_asp.load("DIR")
>>> domain = data.domain()
>>> goal = foon_asp.find_goal(domain, "whipped cream", data.goals)
>>> result = foon_asp.retrieve(domain, goal)
>>> result.status, result.tree.executable
('optimal', True)
"""

from foon_asp.builder import merge
from foon_asp.dataset import Dataset, load
from foon_asp.errors import FoonError
from foon_asp.goals import find_goal
from foon_asp.graph import Foon, FunctionalUnit, ObjectNode, State
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval, retrieve
from foon_asp.tree import TaskTree

__all__ = [
    "Dataset",
    "Domain",
    "Foon",
    "FoonError",
    "FunctionalUnit",
    "Kitchen",
    "ObjectNode",
    "Retrieval",
    "State",
    "TaskTree",
    "find_goal",
    "load",
    "merge",
    "retrieve",
]
