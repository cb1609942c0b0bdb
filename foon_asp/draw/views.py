"""The pictures that answers, trees, plans and FOONs show of themselves, as Python and notebooks have them."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Sized

from foon_asp.draw.checks import check_picture, side_by_side
from foon_asp.draw.comparing import Version, comparison_picture
from foon_asp.draw.foons import MOST_UNITS, around_picture, foon_picture, usual_utensils
from foon_asp.draw.formats import Drawing
from foon_asp.draw.fronts import front_picture
from foon_asp.draw.menus import menu_picture
from foon_asp.draw.missing import missing_picture
from foon_asp.draw.trees import plan_picture, tree_picture
from foon_asp.errors import QueryError
from foon_asp.limits import LimitReachedError
from foon_asp.model.consumption import Effects
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.world import World
from foon_asp.numbers import SOME
from foon_asp.planning.plan import Plan
from foon_asp.query.goals import Named, find_object
from foon_asp.retrieval.alternatives import Alternatives
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.check import Check
from foon_asp.retrieval.explain import Explanation
from foon_asp.retrieval.menu import Menu
from foon_asp.retrieval.tree import TaskTree


def tree_drawing(tree: TaskTree, against: TaskTree | None = None, dark: bool | None = None) -> Drawing:
    """Return a task tree as a picture, or two over each other."""
    if against is None:
        return Drawing(tree_picture(tree), dark)
    versions = Version.of_tree("the first", tree), Version.of_tree("the second", against)
    return Drawing(comparison_picture(*versions), dark)


def answer_drawing(answer: Answer, dark: bool | None = None) -> Drawing:
    """Return the tree of an answer as a picture; raise `QueryError` if it has none."""
    if answer.tree is None:
        why = f"no task tree: {answer.reason or answer.status}"
        raise QueryError(f"{why}; world.explain(query).draw() shows what is missing")
    return tree_drawing(answer.tree, dark=dark)


def alternatives_drawing(found: Alternatives, dark: bool | None = None) -> Drawing:
    """Return trade-offs as a plot, other trees beside each other; raise `QueryError` if there are none."""
    if found.kind == "pareto":
        return Drawing(front_picture(found), dark)
    if not found.trees:
        raise QueryError(f"no task trees: {found.reason or found.status}")
    return Drawing(side_by_side([tree_picture(tree) for tree in found.trees]), dark)


def menu_drawing(menu: Menu, dark: bool | None = None) -> Drawing:
    """Return a menu as a picture; raise `QueryError` if there is no tree for all dishes."""
    return Drawing(menu_picture(menu), dark)


def explanation_drawing(found: Explanation, dark: bool | None = None) -> Drawing:
    """Return what is missing as a picture."""
    return Drawing(missing_picture(found), dark)


def checks_drawing(checks: Sequence[Check], dark: bool | None = None) -> Drawing:
    """Return trees with their faults as a picture; raise `QueryError` if there are none."""
    if not len(checks):
        raise QueryError("no tree was looked at before the limit")
    return Drawing(side_by_side([check_picture(each) for each in checks]), dark)


def plan_drawing(plan: Plan, dark: bool | None = None) -> Drawing:
    """Return a plan as a picture."""
    return Drawing(plan_picture(plan, Effects(plan.world, plan.semantics)), dark)


def world_drawing(
    world: World, around: Named | None = None, hops: int = 1, dark: bool | None = None
) -> Drawing:
    """Return a FOON seen from a kitchen as a picture, or what is around an object of it."""
    if around is None:
        return Drawing(foon_picture(world), dark)
    hops = int(SOME.checked(hops, "hops"))
    return Drawing(around_picture(world, find_object(world, around), hops), dark)


def foon_drawing(foon: Foon, around: Named | None = None, hops: int = 1, dark: bool | None = None) -> Drawing:
    """Return a FOON as a picture, or what is around an object of it; utensils are the usual ones."""
    world = World.of(foon, Kitchen((), usual_utensils(), stated=False))
    return world_drawing(world, around, hops, dark)


def svg_unasked(units: Sized, draw: Callable[[], Drawing]) -> str | None:
    """Return what a notebook shows of so many units; None if these are too many, or cannot be drawn here."""
    if not 0 < len(units) <= MOST_UNITS:
        return None
    try:
        return draw().to_svg()
    except (QueryError, LimitReachedError):
        # A table is shown all the same.
        return None
