"""Menus as pictures: one tree for several dishes, each step marked with the dishes that it is for."""

from __future__ import annotations

from foon_asp.draw.picture import Picture
from foon_asp.draw.trees import tree_picture
from foon_asp.errors import QueryError
from foon_asp.retrieval.menu import Menu
from foon_asp.words import cut, listed

_NAME = 20
"""How many letters of a dish are said above a step."""


def menu_picture(menu: Menu) -> Picture:
    """Return the tree of all dishes together; raise `QueryError` if there is none."""
    tree = menu.together.tree
    if tree is None:
        raise QueryError(f"no task tree for all of them together: {menu.together.reason or menu.status}")
    goals = list(tree.goals)
    several = len(goals) > 1
    marks = {}
    for unit, dishes in menu.dishes.items():
        if several and len(dishes) == len(goals):
            marks[unit] = "for all"
        elif several and dishes:
            marks[unit] = f"for {listed([cut(dish.label, _NAME) for dish in dishes])}"
    return tree_picture(tree, marks)
