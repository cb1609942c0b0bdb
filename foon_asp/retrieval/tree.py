"""Task trees: order, costs, and the replay that every tree must pass. Plain Python, knows no ASP."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from foon_asp.model.kitchen import chance_of
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, Source, UnitId
from foon_asp.model.reachability import within
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.query.objective import Costs
from foon_asp.query.substitution import Replacement
from foon_asp.words import counted

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    from foon_asp.draw.formats import Drawing


@dataclass(frozen=True, slots=True)
class Replay:
    """How executing units in order from the kitchen ended.

    `failed_at` is the place (0, 1, …) of the first unit that lacked something, or None; `missing` is
    what it lacked, or the goals that were not there in the end.
    """

    executable: bool
    failed_at: int | None
    missing: tuple[ObjectNode, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """A functional unit at its place in a task tree, with object nodes instead of ids.

    `place` counts from 1; `round` is that of parallel execution, 0 if it can never be done. `takes` are all
    objects that the unit lists before its motion, `origins` says of each the place of the step that makes it,
    None if it is from the kitchen. `makes` is what the unit brings about. `outputs` are all objects that it
    lists behind its motion, bare tools too.
    """

    place: int
    round: int
    unit: UnitId
    motion: str
    takes: tuple[ObjectNode, ...]
    origins: tuple[int | None, ...]
    makes: tuple[ObjectNode, ...]
    outputs: tuple[ObjectNode, ...]
    source: Source
    human: bool = False

    def __str__(self) -> str:
        takes, makes = ("; ".join(map(str, nodes)) for nodes in (self.takes, self.makes))
        return f"{self.place}. {self.motion}: {takes} → {makes}"


@dataclass(frozen=True, slots=True)
class Record:
    """What another world knows of a task tree: the ids of its units there, its costs and its depth."""

    units: tuple[UnitId, ...]
    costs: Costs
    depth: int | None


@dataclass(frozen=True, repr=False)
class TaskTree:
    """Functional units in the order of execution, made and checked by `TaskTree.of`.

    `goals` and `units` are ids of the world; `steps` says the same in object nodes. `rounds` says for each
    unit in which round of parallel execution it is done (0 if never); `executable` says how the replay ended.
    `human` are the units that a human does and never fails at. A tree that was read back from JSON has a
    small world of its own, and a `record` of what only the world that it was made in could tell. So has one
    in which something was replaced: `replacements` are those that its steps are shown with, `brought` what is
    in its kitchen and not in that of the question.
    """

    world: World
    goals: tuple[ObjectId, ...]
    units: tuple[UnitId, ...]
    rounds: tuple[int, ...]
    replay: Replay
    human: frozenset[UnitId] = frozenset()
    record: Record | None = None
    replacements: tuple[Replacement, ...] = ()
    brought: tuple[ObjectNode, ...] = ()

    @classmethod
    def of(
        cls, world: World, goals: Iterable[ObjectId], units: Collection[UnitId], human: Iterable[UnitId] = ()
    ) -> TaskTree:
        """Bring units into an order that can be executed, if there is one, and replay it.

        Steps that lead to the same object stand together. Units that can never be executed come last,
        in file order.
        """
        goals = tuple(goals)
        executable = within(world.units, world.stock, units).executable
        order = _order(world, goals, executable)
        order += sorted(set(units) - executable.keys())
        rounds = tuple(executable.get(unit, 0) for unit in order)
        return cls(world, goals, tuple(order), rounds, replay(world, goals, order), frozenset(human))

    @property
    def executable(self) -> bool:
        """Whether the replay reaches the goals."""
        return self.replay.executable

    @cached_property
    def functional_units(self) -> tuple[FunctionalUnit, ...]:
        """The functional units themselves, in the order of execution."""
        return tuple(self.world.foon.units[unit] for unit in self.units)

    @property
    def numbers(self) -> tuple[UnitId, ...]:
        """The ids of the units, in the order of execution, in the FOON that they come from."""
        return self.units if self.record is None else self.record.units

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The steps, in the order of execution."""
        world, makes = self.world, self.world.units.made
        rows = zip(self.functional_units, self.numbers, self.rounds, origins(self), strict=True)
        return tuple(
            Step(
                place,
                round_,
                number,
                unit.motion,
                tuple(map(world.node, unit.inputs)),
                tuple(origin.get(world.units.read(number)) for number in unit.inputs),
                tuple(map(world.node, makes[unit.id])),
                tuple(map(world.node, unit.outputs)),
                unit.source,
                unit.id in self.human,
            )
            for place, (unit, number, round_, origin) in enumerate(rows, 1)
        )

    def to_frame(self) -> pd.DataFrame:
        """Return the steps as a table, a row each: round, motion, takes, makes, unit, source, human."""
        from foon_asp.render.frames import tree_frame

        return tree_frame(self)

    def to_networkx(self) -> nx.DiGraph:
        """Return the tree as a directed graph: object nodes, and steps between them."""
        from foon_asp.render.graphs import tree_graph

        return tree_graph(self)

    def draw(self, against: TaskTree | None = None, *, dark: bool | None = None) -> Drawing:
        """Return the tree as a picture, or this one and another one over each other."""
        from foon_asp.draw.views import tree_drawing

        return tree_drawing(self, against, dark)

    def __str__(self) -> str:
        from foon_asp.render.tree import steps_text

        return "\n".join(steps_text(self))

    def __repr__(self) -> str:
        goals = "; ".join(str(self.world.node(goal)) for goal in self.goals)
        broken = "" if self.executable else ", NOT EXECUTABLE"
        return f"<TaskTree: {goals}, {counted(len(self.units), 'step')}{broken}>"

    def _repr_html_(self) -> str:
        from foon_asp.render.notebook import tree_html

        return tree_html(self)

    def _repr_svg_(self) -> str | None:
        from foon_asp.draw.views import svg_unasked

        return svg_unasked(self.units, self.draw)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def __len__(self) -> int:
        return len(self.units)

    def __bool__(self) -> bool:
        # A tree without any step is a tree: the kitchen has the goal.
        return True

    @property
    def depth(self) -> int | None:
        """How many rounds it takes to execute all units if everything possible is done at once."""
        if self.record is not None:
            return self.record.depth
        return max(self.rounds, default=0) if self.executable else None

    @cached_property
    def costs(self) -> Costs:
        """What the tree costs by each criterion."""
        if self.record is not None:
            return self.record.costs
        rates = [
            self.world.kitchen.known_rate(unit) for unit in self.functional_units if unit.id not in self.human
        ]
        known = [rate for rate in rates if rate is not None]
        return Costs(
            units=len(self.units),
            inputs=sum(len(unit.inputs) for unit in self.functional_units),
            success=float(chance_of(known)) if len(known) == len(rates) else None,
            depth=self.depth,
            tools=len(self.world.handled(*self.functional_units)),
            dirty=len(self.world.filled(*self.functional_units)),
            motions=len({unit.motion for unit in self.functional_units}),
            time=sum(unit.duration or 0 for unit in self.functional_units),
            human=len(self.human),
            cost=self.world.cost_of(self.functional_units),
        )


def makers(made: Units, units: Iterable[UnitId], at_hand: Container[ObjectId] = ()) -> dict[ObjectId, int]:
    """Return for each object that units make and that is not at hand the place (1, 2, …) of its maker."""
    found: dict[ObjectId, int] = {}
    for place, unit in enumerate(units, 1):
        for number in made.made[unit]:
            if number not in at_hand:
                found.setdefault(number, place)
    return found


def first_makers(made: Units, executable: Mapping[UnitId, int]) -> dict[ObjectId, UnitId]:
    """Return for each object the unit that makes it first, given the rounds in which units are executed."""
    order = sorted(executable, key=lambda unit: (executable[unit], unit))
    return {object_id: order[place - 1] for object_id, place in makers(made, order).items()}


def origins(tree: TaskTree) -> list[dict[ObjectId, int]]:
    """Return for each step of a tree the places of the steps before it that make what it takes.

    Objects are those that their relations are read as: `Units.read`.
    """
    units = tree.world.units
    made = makers(units, tree.units, tree.world.stock)
    return [
        {number: made[number] for number in units.takes[unit] if made.get(number, place) < place}
        for place, unit in enumerate(tree.units, 1)
    ]


def likeliest_to_fail(world: World, units: Iterable[UnitId], count: int) -> list[UnitId]:
    """Return the units, at most so many, that are likeliest to fail; never one that cannot fail."""
    rates = {unit: world.kitchen.known_rate(world.foon.units[unit]) for unit in units}
    fallible = [(rate, unit) for unit, rate in rates.items() if rate is not None and rate < 1]
    return [unit for _, unit in sorted(fallible)[:count]]


def replay(world: World, goals: Iterable[ObjectId], units: Iterable[UnitId]) -> Replay:
    """Execute units one by one from the kitchen; nothing is used up."""
    reading = world.units
    stock = world.stock
    at_hand: set[ObjectId] = set()
    for place, unit in enumerate(units):
        lacking = [
            object_id
            for object_id in reading.needed[unit]
            if not (object_id in at_hand or object_id in stock)
        ]
        if lacking:
            return Replay(False, place, tuple(world.node(object_id) for object_id in lacking))
        at_hand.update(reading.made[unit])
    lacking = [goal for goal in goals if not (goal in at_hand or goal in stock)]
    return Replay(not lacking, None, tuple(world.node(goal) for goal in lacking))


def _order(world: World, goals: Iterable[ObjectId], executable: Mapping[UnitId, int]) -> list[UnitId]:
    """Order executable units so that each stands behind the makers of its needs, depth first."""
    reading = world.units
    rest = sorted(executable, key=lambda unit: (executable[unit], unit))
    maker = first_makers(reading, executable)
    order: list[UnitId] = []
    placed: set[UnitId] = set()
    first = [maker[goal] for goal in goals if goal in maker]
    stack = [*reversed(rest), *reversed(first)]
    while stack:
        unit = stack[-1]
        before = [
            maker[object_id]
            for object_id in reading.needed[unit]
            if object_id not in world.stock and maker[object_id] not in placed
        ]
        if before and unit not in placed:
            stack += reversed(before)
            continue
        stack.pop()
        if unit not in placed:
            placed.add(unit)
            order.append(unit)
    return order
