"""Schedules: which units are done from when until when, by whom, and with what; judged in plain Python."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.planning.durations import Durations
from foon_asp.planning.plan import Plan
from foon_asp.planning.resources import Resources

Place = tuple[str, int]
"""One of several stations or utensils with a name: the first is 1."""


@dataclass(frozen=True, slots=True)
class ScheduledStep:
    """A unit from `start` to `end`, in whole seconds (or steps).

    `worker` does it with `hands`, each a number from 1; nobody (an empty name) where it goes by itself.
    `stations` and `vessels` are what it takes meanwhile; a vessel that it fills is in use until the last step
    that takes from it has ended. `origins`: for objects that it takes, the place of the step that makes them;
    what is not there comes from the kitchen.
    """

    unit: UnitId
    start: int
    end: int
    worker: str = ""
    hands: tuple[int, ...] = ()
    stations: tuple[Place, ...] = ()
    vessels: tuple[Place, ...] = ()
    origins: tuple[tuple[ObjectId, int], ...] = ()


@dataclass(frozen=True, slots=True)
class Schedule:
    """Steps by their starts, for some goals, under semantics of what is used up."""

    world: World
    goals: tuple[ObjectId, ...]
    semantics: str
    steps: tuple[ScheduledStep, ...]

    @property
    def makespan(self) -> int:
        """When the last step ends."""
        return max((step.end for step in self.steps), default=0)

    @property
    def units(self) -> list[UnitId]:
        """The units, by their starts."""
        return [step.unit for step in self.steps]

    def plan(self, effects: Effects) -> Plan:
        """Return the units as a plan, one after the other by their starts."""
        return Plan.of(effects, self.goals, self.units)


def faults(schedule: Schedule, effects: Effects, durations: Durations, resources: Resources) -> list[str]:
    """Return what is wrong with a schedule, each in a sentence; nothing if it can be carried out."""
    return [
        *_wrong_times(schedule, durations, resources),
        *_wrong_order(schedule, effects),
        *_wrong_places(schedule, resources),
        *_wrong_vessels(schedule, effects, resources),
    ]


def _wrong_times(schedule: Schedule, durations: Durations, resources: Resources) -> Iterator[str]:
    workers = {worker.name: worker for worker in resources.workers}
    for place, step in enumerate(schedule.steps, 1):
        unit = schedule.world.foon.units[step.unit]
        needed, seconds = resources.needed(unit), durations.seconds[step.unit]
        if needed:
            worker = workers.get(step.worker)
            if worker is None or worker not in resources.workers_for(unit):
                yield f"step {place}: {step.worker or 'nobody'} cannot do it"
                continue
            seconds = worker.time(seconds)
            known = set(range(1, worker.hands + 1))
            if len(set(step.hands)) != needed or not known.issuperset(step.hands):
                yield f"step {place} takes {needed} hands, not {step.hands}"
        elif step.worker or step.hands:
            yield f"step {place} takes no hands"
        if step.start < 0 or step.end - step.start != seconds:
            yield f"step {place} takes {seconds}, not from {step.start} to {step.end}"
        wanted = sorted(each.name for each in resources.stations_for(schedule.world, unit))
        if sorted(name for name, _ in step.stations) != wanted:
            yield f"step {place} takes the stations {wanted}, not {step.stations}"


class _Clock(Supply):
    """What is at hand while steps begin and end: what is used up goes first, what is made comes last."""

    def take(self, object_id: ObjectId) -> None:
        """Take away one object that is there."""
        if object_id in self.made:
            self.made.remove(object_id)
        else:
            self.left[object_id] -= 1

    def end(self, unit: UnitId) -> None:
        """Have what a unit makes."""
        effects = self.effects
        restored = [object_id for object_id in effects.restores(unit) if not self.has(object_id)]
        self.made.update(effects.adds(unit), restored)


def _wrong_order(schedule: Schedule, effects: Effects) -> Iterator[str]:
    """Carry steps out second by second, and yield what is not there when it must be."""
    steps, node = schedule.steps, schedule.world.node
    clock = _Clock(effects)
    kept = [set(effects.needs(step.unit)) - set(effects.deletes(step.unit)) for step in steps]
    running: dict[int, None] = {}

    def broken(places: Sequence[int]) -> Iterator[str]:
        for place in places:
            for object_id in sorted(each for each in kept[place] if not clock.has(each)):
                yield f"step {place + 1} lacks {node(object_id)}"

    for now in sorted({moment for step in steps for moment in (step.start, step.end)}):
        for place in [place for place in running if steps[place].end == now]:
            clock.end(steps[place].unit)
            del running[place]
        begun = [place for place, step in enumerate(steps) if step.start == now]
        running.update(dict.fromkeys(begun))
        yield from broken(begun)
        # Who needs what it uses up comes before whoever takes it away without a need.
        for place in sorted(begun, key=lambda place: not effects.deletes(steps[place].unit)):
            lacking = clock.lacks(steps[place].unit)
            yield from (f"step {place + 1} lacks {node(each)}" for each in lacking if each not in kept[place])
            needed = set(effects.needs(steps[place].unit))
            for object_id in needed.intersection(clock.used_up(steps[place].unit)):
                clock.take(object_id)
        for place in begun:
            for object_id in set(clock.used_up(steps[place].unit)) - set(effects.needs(steps[place].unit)):
                clock.take(object_id)
        yield from broken(list(running))
    yield from (f"{node(goal)} is not there in the end" for goal in schedule.goals if not clock.has(goal))


def _wrong_places(schedule: Schedule, resources: Resources) -> Iterator[str]:
    """Yield each two steps that take the same hand or station at once, and stations there are not."""
    counts = {station.name: station.count for station in resources.stations}
    taken: dict[tuple[str, ...], list[tuple[int, int, int]]] = {}
    for place, step in enumerate(schedule.steps, 1):
        for hand in step.hands:
            taken.setdefault(("hand", step.worker, str(hand)), []).append((step.start, step.end, place))
        for name, number in step.stations:
            if not 1 <= number <= counts.get(name, 0):
                yield f"step {place}: there is no {name} {number}"
            taken.setdefault(("station", name, str(number)), []).append((step.start, step.end, place))
    for what, spans in taken.items():
        yield from _overlaps(" ".join(what), spans)


def _overlaps(what: str, spans: list[tuple[int, int, int]]) -> Iterator[str]:
    spans.sort()
    for (_, end, place), (start, _, other) in pairwise(spans):
        if start < end:
            yield f"steps {place} and {other} take {what} at the same time"


def _wrong_vessels(schedule: Schedule, effects: Effects, resources: Resources) -> Iterator[str]:
    """Yield what is wrong with limited utensils: which are taken, and until when they are in use."""
    world, steps = schedule.world, schedule.steps
    for label, count in sorted(resources.utensils.items()):
        uses = Vessels(world, label)
        chosen = {place: dict(step.vessels).get(label, 0) for place, step in enumerate(steps)}
        takers: dict[int, list[int]] = {}
        for place, step in enumerate(steps):
            if uses.needs_one(step.unit) != (1 <= chosen[place] <= count):
                yield f"step {place + 1} is done with {label} {chosen[place]}"
            for object_id, maker in step.origins:
                if not 0 <= maker < len(steps) or steps[maker].end > step.start:
                    yield f"step {place + 1} takes what step {maker + 1} has not made yet"
                elif object_id not in effects.adds(steps[maker].unit):
                    yield f"step {place + 1} takes what step {maker + 1} does not make"
                elif uses.inside(object_id):
                    takers.setdefault(maker, []).append(place)
        spans: dict[int, list[tuple[int, int, int]]] = {}
        for place, step in enumerate(steps):
            if not chosen[place]:
                continue
            goes_on = any(
                place in later and chosen[maker] == chosen[place] for maker, later in takers.items()
            )
            until = step.end
            if uses.fills(step.unit):
                # What is never taken out stays to the end.
                until = max(
                    (steps[each].end for each in takers.get(place, ())), default=schedule.makespan + 1
                )
            begun = step.end if goes_on and uses.fills(step.unit) else step.start
            spans.setdefault(chosen[place], []).append((begun, max(begun, until), place + 1))
        for number, found in sorted(spans.items()):
            yield from _overlaps(f"{label} {number}", found)


@dataclass(frozen=True, slots=True)
class Vessels:
    """What units do with utensils of one label: fill them, empty them, or merely use them.

    The same stands in `encodings/planning/schedule.lp`.
    """

    world: World
    label: str

    def inside(self, object_id: ObjectId) -> bool:
        """Whether an object is in such a utensil, or is one that holds something."""
        node = self.world.node(object_id)
        return bool(node.label == self.label and node.contents) or self.label in node.containers

    def handles(self, unit: UnitId) -> bool:
        """Whether a unit lists such a utensil, or something in or on it."""
        reading = self.world.units
        listed = (*reading.takes[unit], *reading.gives[unit])
        return any(self.label in self.world.node(each).handled_labels for each in listed)

    def fills(self, unit: UnitId) -> bool:
        """Whether something is in such a utensil after a unit."""
        return any(map(self.inside, self.world.units.gives[unit]))

    def needs_one(self, unit: UnitId) -> bool:
        """Whether a unit takes a utensil of its own: not if it only takes something out of one."""
        if not self.handles(unit):
            return False
        return self.fills(unit) or not any(map(self.inside, self.world.units.needs[unit]))


def with_hands(
    world: World, steps: Iterable[ScheduledStep], resources: Resources
) -> tuple[ScheduledStep, ...]:
    """Give each step the first hands of its worker that are free; by their starts, and there are enough."""
    free = {worker.name: dict.fromkeys(range(1, worker.hands + 1), 0) for worker in resources.workers}
    found = []
    for step in steps:
        needed = resources.needed(world.foon.units[step.unit])
        hands = [hand for hand, moment in free.get(step.worker, {}).items() if moment <= step.start][:needed]
        free.get(step.worker, {}).update(dict.fromkeys(hands, step.end))
        found.append(replace(step, hands=tuple(hands)))
    return tuple(found)


def by_starts(steps: Mapping[int, ScheduledStep]) -> tuple[ScheduledStep, ...]:
    """Return steps with any numbers in the order of their starts, their origins renumbered to places."""
    order = sorted(steps, key=lambda each: (steps[each].start, steps[each].end, steps[each].unit, each))
    places = {number: place for place, number in enumerate(order)}
    found = []
    for number in order:
        origins = sorted((object_id, places[maker]) for object_id, maker in steps[number].origins)
        found.append(replace(steps[number], origins=tuple(origins)))
    return tuple(found)
