"""Plans: units in the order of execution, where objects are used up and units may come again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from foon_asp import limits
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.problem import PlanProblem
from foon_asp.retrieval.tree import Replay
from foon_asp.words import counted

if TYPE_CHECKING:
    import pandas as pd

    from foon_asp.draw.formats import Drawing

T = TypeVar("T")

_State = tuple[frozenset[ObjectId], frozenset[tuple[ObjectId, int]]]
"""What was made and is still there, and how many there are left of what the kitchen counts."""


@dataclass(frozen=True, slots=True, repr=False)
class Plan:
    """Units in the order of execution; a unit may occur several times.

    `steps` says for each occurrence in which parallel step it is done, from 1: all units of a step can be
    executed in any order, or at once. `replay` is how executing the plan ends, under `semantics`.
    """

    world: World
    goals: tuple[ObjectId, ...]
    semantics: str
    units: tuple[UnitId, ...]
    steps: tuple[int, ...]
    replay: Replay

    @classmethod
    def of(
        cls, effects: Effects, goals: Iterable[ObjectId], units: Iterable[UnitId], steps: Iterable[int] = ()
    ) -> Plan:
        """Replay units in the given order; without `steps` each is put into the earliest step it fits in."""
        goals, units = tuple(goals), tuple(units)
        placed = tuple(steps) or tuple(_earliest(effects, units))
        return cls(effects.world, goals, effects.semantics, units, placed, replay_plan(effects, goals, units))

    @property
    def executable(self) -> bool:
        """Whether the replay reaches the goals."""
        return self.replay.executable

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return the plan as a picture, each object node as often as it is made."""
        from foon_asp.draw.views import plan_drawing

        return plan_drawing(self, dark)

    def to_frame(self) -> pd.DataFrame:
        """Return the steps as a table, a row each: parallel step, motion, takes, makes, gone, unit."""
        from foon_asp.render.frames import plan_frame

        return plan_frame(self)

    def __str__(self) -> str:
        from foon_asp.render.plan import plan_text

        return plan_text(self, Effects(self.world, self.semantics)).rstrip()

    def __repr__(self) -> str:
        goals = "; ".join(str(self.world.node(goal)) for goal in self.goals)
        broken = "" if self.executable else ", NOT EXECUTABLE"
        return f"<Plan: {goals}, {counted(len(self.units), 'step')}{broken}>"

    def _repr_html_(self) -> str:
        from foon_asp.render.notebook import plan_html

        return plan_html(self)

    def _repr_svg_(self) -> str | None:
        from foon_asp.draw.views import svg_unasked

        return svg_unasked(self.units, self.draw)

    @property
    def makespan(self) -> int:
        """How many parallel steps it takes."""
        return max(self.steps, default=0)


def replay_plan(effects: Effects, goals: Iterable[ObjectId], units: Iterable[UnitId]) -> Replay:
    """Execute units one by one from the kitchen; plain Python, knows no planner."""
    supply = Supply(effects)
    node = effects.world.node
    for place, unit in enumerate(units):
        lacking = supply.execute(unit)
        if lacking:
            return Replay(False, place, tuple(map(node, lacking)))
    lacking = [goal for goal in goals if not supply.has(goal)]
    return Replay(not lacking, None, tuple(map(node, lacking)))


def unreachable_by_search(problem: PlanProblem, states: int) -> bool:
    """Say whether executing units one by one, in whatever order, is certain never to reach the goals.

    Every state of the supply is visited, up to so many, or until a limit;
    if there are more it is not certain. To have more never hurts. So units that use up nothing that matters
    are executed as soon as they can be, and a unit that makes nothing new is not executed.
    """
    effects, units = problem.effects, problem.units
    goals = set(problem.goals) - effects.endless
    needs = {unit: frozenset(effects.needs(unit)) - effects.endless for unit in units}
    wanted = goals.union(*needs.values())
    adds = {unit: wanted.intersection(effects.adds(unit)) for unit in units}
    restores = {unit: wanted.intersection(effects.restores(unit)) for unit in units}
    deletes = {unit: wanted.intersection(effects.deletes(unit)) for unit in units}
    costly = [unit for unit in units if deletes[unit]]
    free = [unit for unit in units if not deletes[unit]]

    def settled(made: set[ObjectId], left: Mapping[ObjectId, int]) -> _State:
        size = -1
        while size < len(made):
            size = len(made)
            for unit in free:
                if needs[unit] <= made | left.keys():
                    made |= adds[unit] | restores[unit] - left.keys()
        return frozenset(made), frozenset(left.items())

    start = settled(
        set(), {object_id: count for object_id, count in effects.counted.items() if object_id in wanted}
    )
    queue, seen = [start], {start}
    for made, counts in queue:
        at_hand = made.union(object_id for object_id, _ in counts)
        if goals <= at_hand or len(queue) > states or limits.reached():
            return False
        for unit in costly:
            fresh = adds[unit] | restores[unit] - at_hand
            if needs[unit] <= at_hand and not fresh <= made:
                left = {
                    object_id: count - (object_id in deletes[unit] and object_id not in made)
                    for object_id, count in counts
                }
                after = settled(
                    set(made - deletes[unit]) | fresh,
                    {object_id: n for object_id, n in left.items() if n > 0},
                )
                if after not in seen:
                    seen.add(after)
                    queue.append(after)
    return True


def orderings(effects: Effects, units: Iterable[UnitId]) -> list[tuple[int, int]]:
    """Return pairs of places in a plan: the first must be executed before the second.

    Two units may be swapped unless one makes what the other needs or takes away, or one takes away what the
    other needs, takes away or makes.
    """
    order = list(units)
    needs = [set(effects.needs(unit)) - effects.endless for unit in order]
    adds = [{*effects.adds(unit), *effects.restores(unit)} - effects.endless for unit in order]
    return held_in_order(needs, adds, [set(effects.deletes(unit)) for unit in order])


def held_in_order(
    needs: Sequence[Set[T]], adds: Sequence[Set[T]], deletes: Sequence[Set[T]]
) -> list[tuple[int, int]]:
    """Return the pairs of places of which the first must come before the second.

    What is needed, made and taken away at each place may be of any kind.
    """
    return [
        (before, after)
        for after in range(len(needs))
        for before in range(after)
        if adds[before] & (needs[after] | deletes[after])
        or deletes[before] & (needs[after] | deletes[after] | adds[after])
        or needs[before] & deletes[after]
    ]


def _earliest(effects: Effects, units: tuple[UnitId, ...]) -> list[int]:
    """Return for each occurrence the earliest parallel step that keeps all orderings."""
    steps = [1] * len(units)
    for before, after in orderings(effects, units):
        steps[after] = max(steps[after], steps[before] + 1)
    return steps
