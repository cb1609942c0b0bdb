"""Menus: several dishes at once share their steps; what that saves against cooking each of them apart."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from foon_asp.constraints import FREE, Constraints
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval, retrieve
from foon_asp.tree import TaskTree


@dataclass(frozen=True, slots=True)
class Menu:
    """One tree for all dishes, `together`, and one for each of them, `apart`.

    `dishes` says for each unit of the tree together which dishes it is for. `left_out` are goals that no
    tree makes, if these were to be left out.
    """

    together: Retrieval
    apart: tuple[Retrieval, ...]
    dishes: dict[int, tuple[ObjectNode, ...]]
    left_out: tuple[Retrieval, ...]


def plan_menu(
    domain: Domain,
    goals: Iterable[ObjectNode],
    by: str | Sequence[str] = (),
    *,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
    leave_out: bool = False,
) -> Menu:
    """Return the best task tree for all goals together, and for each of them apart.

    `leave_out` leaves out goals that cannot be made; else one such goal leaves no tree at all. `time_limit`
    (seconds) is for all trees. Raises `QueryError`.
    """
    deadline = None if time_limit is None else time.monotonic() + time_limit

    def best(wanted: ObjectNode | Sequence[ObjectNode]) -> Retrieval:
        left = None if deadline is None else max(0.0, deadline - time.monotonic())
        return retrieve(domain, wanted, "optimal", by, time_limit=left, constraints=constraints)

    wanted = list(dict.fromkeys(goals))
    apart = [best(goal) for goal in wanted]
    left_out = [each for each in apart if each.status == "unreachable"] if leave_out else []
    kept = [each for each in apart if each not in left_out]
    together = best([each.goal for each in kept] or wanted)
    dishes = _dishes(together.tree) if together.tree else {}
    return Menu(together, tuple(kept), dishes, tuple(left_out))


def _dishes(tree: TaskTree) -> dict[int, tuple[ObjectNode, ...]]:
    """Return for each unit of a tree the goals that it is for."""
    found: dict[int, list[ObjectNode]] = {unit: [] for unit in tree.units}
    for goal in tree.goals:
        for unit in tree.domain.reading.backward([goal], tree.domain.stock, tree.units):
            found[unit].append(tree.domain.node(goal))
    return {unit: tuple(goals) for unit, goals in found.items()}
