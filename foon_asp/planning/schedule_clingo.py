"""Schedules by clingo and its difference constraints: within a makespan, or none is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

from foon_asp.asp.facts import facts, price_facts, schedule_facts
from foon_asp.asp.model import Model, Value
from foon_asp.asp.solver import Solver, open_solver
from foon_asp.errors import InternalError, QueryError
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.numbers import MOST
from foon_asp.planning.critical import Critical
from foon_asp.planning.durations import Durations
from foon_asp.planning.prices import RUIN, Prices
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.resources import Resources
from foon_asp.planning.schedule import Schedule, ScheduledStep, by_starts, with_hands

T = TypeVar("T")

_OPTIONS = ("--configuration=frumpy",)
"""That no shorter schedule exists is proven in half of the time that the default takes."""

NOBODY = "nobody"
"""Who does what goes by itself."""

AGAIN = 40
"""How often a unit is done in a schedule at most; what is done more often is only counted as any number."""


@dataclass(frozen=True)
class Task:
    """A problem with who can do what, where, and how long it takes."""

    problem: PlanProblem
    resources: Resources
    durations: Durations

    @classmethod
    def of(cls, problem: PlanProblem, resources: Resources, durations: Durations) -> Task:
        """Leave out of a problem what nobody can do, and all that is of no use then.

        Raises `QueryError` if it takes longer than clingo can count.
        """
        able = cls(problem, resources, durations).able
        task = cls(PlanProblem(problem.effects, problem.goals, able.keys()), resources, durations)
        hands = max((worker.hands for worker in resources.workers), default=1)
        if hands * task.longest(dict.fromkeys(task.units, AGAIN)) > MOST:
            raise QueryError("so long durations, of so many units, cannot be added; give them in minutes")
        return task

    @cached_property
    def able(self) -> dict[UnitId, list[tuple[str, int, int]]]:
        """For each unit that somebody can do: the worker's name, the hands it takes, the time."""
        found: dict[UnitId, list[tuple[str, int, int]]] = {}
        for unit in self.problem.units:
            foon_unit = self.problem.world.foon.units[unit]
            seconds, needed = self.durations.seconds[unit], self.resources.needed(foon_unit)
            if needed == 0:
                found[unit] = [(NOBODY, 0, seconds)]
            elif workers := self.resources.workers_for(foon_unit):
                found[unit] = [(each.name, needed, each.time(seconds)) for each in workers]
        return found

    @cached_property
    def critical(self) -> Critical:
        """Bounds of time, whoever does what."""
        quickest = {unit: min(seconds for *_, seconds in ways) for unit, ways in self.able.items()}
        return Critical.of(self.problem, quickest)

    @property
    def units(self) -> list[UnitId]:
        """The units that are of use, and that somebody can do, in file order."""
        return [unit for unit in self.problem.units if unit in self.critical.tails]

    @property
    def reachable(self) -> bool:
        """Whether somebody can do all that leads to the goals, if nothing is used up."""
        return all(goal in self.critical.there for goal in self.problem.goals)

    def longest(self, most: Mapping[UnitId, int]) -> int:
        """Return how long it takes if no two steps are done at once, each unit as often as it may be."""
        return sum(max(time for *_, time in self.able[unit]) * count for unit, count in most.items())

    @cached_property
    def exact(self) -> bool:
        """Whether the encodings say all that units do with what the kitchen counts.

        They ask for one that is used up even where it need not be there, and leave out what is only put back.
        """
        effects = self.problem.effects
        return not any(
            effects.restores(unit)
            or any(
                each in effects.counted and each not in effects.needs(unit) for each in effects.deletes(unit)
            )
            for unit in self.units
        )

    def often(self, makespan: int) -> dict[UnitId, int]:
        """Return how often each unit can be done within a makespan by the hands there are, or `AGAIN`."""
        if self.problem.effects.semantics == "add":
            # What is never used up need not be made twice.
            return dict.fromkeys(self.units, 1)
        return {unit: max(1, min(AGAIN, self._by_hands(unit, makespan))) for unit in self.units}

    def open_ended(self, makespan: int) -> list[UnitId]:
        """Return the units that can be done more often than that."""
        if self.problem.effects.semantics == "add":
            return []
        return [unit for unit in self.units if self._by_hands(unit, makespan) > AGAIN]

    def _by_hands(self, unit: UnitId, makespan: int) -> int:
        if any(needed == 0 for _, needed, _ in self.able[unit]):
            # What goes by itself can go any number of times at once.
            return AGAIN + 1
        hands = sum(worker.hands for worker in self.resources.workers)
        return hands * makespan // self.critical.quickest[unit]

    @cached_property
    def _common(self) -> str:
        critical, units = self.critical, self.units
        world = self.problem.world
        resources = self.resources
        return facts(self.problem) + schedule_facts(
            ((unit, *way) for unit in units for way in self.able[unit]),
            (
                (unit, station.name)
                for unit in units
                for station in resources.stations_for(world, world.foon.units[unit])
            ),
            {
                "worker": [(worker.name, worker.hands) for worker in resources.workers],
                "station": [(station.name, station.count) for station in resources.stations],
                "vessel": sorted(resources.utensils.items()),
            },
            {
                "quickest": {unit: critical.quickest[unit] for unit in units},
                "head": {unit: critical.heads[unit] for unit in units},
                "tail": {unit: critical.tails[unit] for unit in units},
                "shortest": {unit: critical.shortest(unit) for unit in units},
            },
            critical.windows(),
        )

    def _asked(self, most: Mapping[UnitId, int]) -> str:
        return self._common + schedule_facts((), (), {}, {"most": most})

    def _constants(self, **more: int) -> dict[str, str | int]:
        effects = self.problem.effects
        return {"semantics": effects.semantics, "strict": int(effects.world.strict), **more}

    def less(self, bound: int) -> Model:
        """Return how often units are done where hands are counted, but not when they are free."""
        return self._work(bound).best()

    def possible(self, bound: int) -> Model:
        """Return all that may be done within a makespan, likewise."""
        return self._work(bound).possible()

    def _work(self, bound: int) -> Solver:
        text = self._asked(self.often(bound)) + schedule_facts(
            (), (), {}, {}, open_ended=self.open_ended(bound)
        )
        return open_solver(["planning/work.lp"], text, self._constants(bound=bound), timed=True)

    def within(
        self, bound: int, most: Mapping[UnitId, int], prices: Prices | None = None, budget: int | None = None
    ) -> Model:
        """Return a schedule within a makespan; with prices the cheapest, or any within a budget."""
        text = self._asked(most)
        if prices is not None:
            text += price_facts(prices.per_unit, prices.fees, prices.once, RUIN)
        constants = self._constants(bound=bound)
        if budget is not None:
            constants |= {"budget": budget, "cheapest": 0}
        options = _OPTIONS if prices is None else ()
        return open_solver(["planning/schedule.lp"], text, constants, options, timed=True).best()

    def schedule(self, model: Model) -> Schedule:
        """Return the schedule of a model, its steps by their starts."""
        return _Decoder(self, model).schedule()


def counts_of(model: Model) -> dict[UnitId, int]:
    """Return how often each unit is done in a model at most."""
    counts: dict[UnitId, int] = {}
    for unit, times in model.rows("do"):
        assert isinstance(unit, int)
        assert isinstance(times, int)
        counts[UnitId(unit)] = max(times, counts.get(UnitId(unit), 0))
    return counts


@dataclass(slots=True)
class _Decoder:
    task: Task
    model: Model
    numbers: dict[Value, int] = field(default_factory=dict)

    def schedule(self) -> Schedule:
        model, task = self.model, self.task
        begins = {row[0][0]: row[1] for row in model.rows("dl") if isinstance(row[0], tuple)}
        done = model.rows("do")
        self.numbers = {step: number for number, step in enumerate(done)}
        workers = {row[:2]: str(row[2]) for row in model.rows("by")}
        stations = self.grouped("stands", lambda row: (str(row[1]), int(str(row[2]))))
        vessels = self.grouped("keeps", lambda row: (str(row[1]), int(str(row[2]))))
        origins: dict[int, list[tuple[ObjectId, int]]] = {}
        for step, object_id, maker in model.rows("made_from"):
            if step in self.numbers and maker in self.numbers:
                taken = (ObjectId(int(str(object_id))), self.numbers[maker])
                origins.setdefault(self.numbers[step], []).append(taken)
        steps = {}
        for step, number in self.numbers.items():
            assert isinstance(step, tuple)
            unit, worker = UnitId(int(str(step[0]))), workers[step]
            seconds = next(time for name, _, time in task.able[unit] if name == worker)
            start = begins.get(step)
            if not isinstance(start, int):
                raise InternalError(f"a schedule does not say when unit {unit} begins")
            steps[number] = ScheduledStep(
                unit,
                start,
                start + seconds,
                "" if worker == NOBODY else worker,
                (),
                tuple(sorted(stations.get(number, ()))),
                tuple(sorted(vessels.get(number, ()))),
                tuple(origins.get(number, ())),
            )
        effects = task.problem.effects
        ordered = with_hands(effects.world, by_starts(steps), task.resources)
        return Schedule(effects.world, task.problem.goals, effects.semantics, ordered)

    def grouped(self, predicate: str, read: Callable[[tuple[Value, ...]], T]) -> dict[int, list[T]]:
        """Return what the rows of a predicate say of each step, by the number of the step."""
        found: dict[int, list[T]] = {}
        for row in self.model.rows(predicate):
            found.setdefault(self.numbers[row[0]], []).append(read(row))
        return found
