"""Menus: several dishes at once share their steps; what that saves against cooking each of them apart."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from foon_asp.io.wire import dumps
from foon_asp.limits import limited
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World
from foon_asp.query.checks import refuse_substitution
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import TaskTree
from foon_asp.retrieval.wire import menu_json
from foon_asp.words import counted

if TYPE_CHECKING:
    from foon_asp.draw.formats import Drawing


@dataclass(frozen=True, slots=True, repr=False)
class Menu:
    """One tree for all dishes, `together`, and one for each of them, `apart`.

    `dishes` says for each unit of the tree together which dishes it is for. `left_out` are goals that no
    tree makes, if these were to be left out. It is true if there is a tree together.
    """

    together: Answer
    apart: tuple[Answer, ...]
    dishes: Mapping[UnitId, tuple[ObjectNode, ...]]
    left_out: tuple[Answer, ...]

    def __bool__(self) -> bool:
        return bool(self.together)

    def __repr__(self) -> str:
        return f"<Menu: {counted(len(self.apart), 'goal')}, {self.status}>"

    def __str__(self) -> str:
        from foon_asp.render.menu import menu_text

        return menu_text(self).rstrip()

    def to_json(self) -> str:
        """Return the answer as the command writes it with `--format json`."""
        return dumps(menu_json(self))

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return the tree of all dishes as a picture; raise `QueryError` if there is none."""
        from foon_asp.draw.views import menu_drawing

        return menu_drawing(self, dark)

    @property
    def status(self) -> Status:
        """How the question for all dishes together ended."""
        return self.together.status


def plan_menu(world: World, query: Query, *, leave_out: bool = False) -> Menu:
    """Return the best task tree for all goals together, and for each of them apart.

    `leave_out` leaves out goals that cannot be made; else one such goal leaves no tree at all. The time limit
    is for all trees. Raises `QueryError`.
    """
    query = Query.of(query)
    refuse_substitution(query, "menus are")
    world = query.seen_in(world)
    query = query.checked(world)
    with limited(query.time_limit, query.memory_limit):
        return _menu(world, query, leave_out=leave_out)


def _menu(world: World, query: Query, *, leave_out: bool) -> Menu:
    def best(wanted: Iterable[ObjectNode]) -> Answer:
        return retrieve(world, query.replace(goals=list(wanted), time_limit=None))

    wanted = dict.fromkeys(query.nodes)
    apart = [best([goal]) for goal in wanted]
    left_out = [each for each in apart if each.status == Status.UNREACHABLE] if leave_out else []
    kept = [each for each in apart if each not in left_out]
    together = best([each.goal for each in kept] or wanted)
    dishes = _dishes(together.tree) if together.tree else {}
    return Menu(together, tuple(kept), dishes, tuple(left_out))


def _dishes(tree: TaskTree) -> dict[UnitId, tuple[ObjectNode, ...]]:
    """Return for each unit of a tree the goals that it is for."""
    found: dict[UnitId, list[ObjectNode]] = {unit: [] for unit in tree.units}
    for goal in tree.goals:
        for unit in backward(tree.world.units, [goal], tree.world.stock, tree.units):
            found[unit].append(tree.world.node(goal))
    return {unit: tuple(goals) for unit, goals in found.items()}
