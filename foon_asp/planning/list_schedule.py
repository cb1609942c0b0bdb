"""A schedule of a plan at once: whatever can begin does, that with the longest rest first; plain Python."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from foon_asp import limits
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId
from foon_asp.planning.durations import Durations
from foon_asp.planning.plan import Plan
from foon_asp.planning.resources import Resources, Worker
from foon_asp.planning.schedule import Place, Schedule, ScheduledStep, Vessels, by_starts


def list_schedule(plan: Plan, effects: Effects, durations: Durations, resources: Resources) -> Schedule:
    """Return a schedule of the steps of a plan; limited utensils may be too few for it.

    Everybody who is needed must be there.
    """
    steps = _List(plan, effects, durations, resources).steps()
    return Schedule(plan.world, plan.goals, plan.semantics, _with_vessels(plan, by_starts(steps), resources))


class _List:
    def __init__(self, plan: Plan, effects: Effects, durations: Durations, resources: Resources) -> None:
        self.plan, self.effects, self.resources = plan, effects, resources
        world, self.units = plan.world, plan.units
        foon_units = [world.foon.units[unit] for unit in self.units]
        self.needed = [resources.needed(unit) for unit in foon_units]
        self.workers = [
            resources.workers_for(unit) if needed else ()
            for unit, needed in zip(foon_units, self.needed, strict=True)
        ]
        self.stations = [resources.stations_for(world, unit) for unit in foon_units]
        self.seconds = [durations.seconds[unit] for unit in self.units]
        # Before it is known who does a step, the quickest is assumed.
        self.lengths = [
            min((worker.time(seconds) for worker in workers), default=seconds)
            for seconds, workers in zip(self.seconds, self.workers, strict=True)
        ]
        self.before, self.origins = self.ordered()
        self.rests = list(self.lengths)
        for later in reversed(range(len(self.units))):
            for place, ended in self.before[later]:
                whole = self.lengths[place] if ended else 0
                self.rests[place] = max(self.rests[place], whole + self.rests[later])

    def ordered(self) -> tuple[list[list[tuple[int, bool]]], list[list[tuple[ObjectId, int]]]]:
        """Return what must have ended, or begun at least, before each step, and where what it takes is from.

        The order is that of the plan, for all that must not be swapped.
        """
        effects = self.effects
        makers: dict[ObjectId, list[int]] = {}
        users: dict[ObjectId, list[int]] = {}
        takers: dict[ObjectId, list[int]] = {}
        before: list[dict[int, bool]] = []
        origins: list[list[tuple[ObjectId, int]]] = []
        first: dict[ObjectId, int] = {}
        for place, unit in enumerate(self.units):
            limits.check()
            found: dict[int, bool] = {}
            needs = [each for each in effects.needs(unit) if each not in effects.endless]
            deletes = effects.deletes(unit)
            for object_id in needs:
                found.update(dict.fromkeys(makers.get(object_id, ()), True))
            origins.append([(each, first[each]) for each in needs if each in first])
            for object_id in deletes:
                found.update((each, found.get(each, False)) for each in takers.get(object_id, ()))
                found.update(dict.fromkeys(makers.get(object_id, ()), True))
                found.update(dict.fromkeys(users.get(object_id, ()), True))
            made = [
                each for each in (*effects.adds(unit), *effects.restores(unit)) if each not in effects.endless
            ]
            for object_id in made:
                found.update((each, found.get(each, False)) for each in takers.get(object_id, ()))
            for object_id in deletes:
                # Whoever comes after a step that uses something up comes after all that went before it.
                makers[object_id], users[object_id], takers[object_id] = [], [], [place]
                first.pop(object_id, None)
            for object_id in needs:
                users.setdefault(object_id, []).append(place)
            for object_id in made:
                makers.setdefault(object_id, []).append(place)
                first.setdefault(object_id, place)
            before.append(found)
        return [list(each.items()) for each in before], origins

    def steps(self) -> dict[int, ScheduledStep]:
        """Begin at each moment what can begin."""
        done: dict[int, ScheduledStep] = {}
        free: dict[tuple[str, int], int] = {}
        now = 0
        while len(done) < len(self.units):
            limits.check()
            ready = [
                place
                for place in range(len(self.units))
                if place not in done
                and all(
                    earlier in done and (done[earlier].end if ended else done[earlier].start) <= now
                    for earlier, ended in self.before[place]
                )
            ]
            begun = False
            for place in sorted(ready, key=lambda place: (-self.rests[place], place)):
                step = self.begin(place, now, free)
                if step is not None:
                    done[place] = step
                    begun = True
            # What only had to wait for a start can begin at once, too.
            if not begun:
                ends = [step.end for step in done.values() if step.end > now]
                now = min(ends)
        return done

    def begin(self, place: int, now: int, free: dict[tuple[str, int], int]) -> ScheduledStep | None:
        """Begin a step, if somebody and what it takes is free; `free` says from when each is."""
        stations: list[Place] = []
        for station in self.stations[place]:
            numbers = range(1, station.count + 1)
            number = next(
                (each for each in numbers if free.get((f"at {station.name}", each), 0) <= now), None
            )
            if number is None:
                return None
            stations.append((station.name, number))
        worker, hands = self.somebody(place, now, free)
        if self.needed[place] and worker is None:
            return None
        seconds = self.seconds[place] if worker is None else worker.time(self.seconds[place])
        end = now + seconds
        for name, number in stations:
            free[f"at {name}", number] = end
        name = "" if worker is None else worker.name
        for hand in hands:
            free[f"by {name}", hand] = end
        origins = tuple(self.origins[place])
        return ScheduledStep(self.units[place], now, end, name, hands, tuple(stations), (), origins)

    def somebody(
        self, place: int, now: int, free: Mapping[tuple[str, int], int]
    ) -> tuple[Worker | None, tuple[int, ...]]:
        """Return the quickest who has enough free hands, and these."""
        needed = self.needed[place]
        for worker in sorted(self.workers[place], key=lambda each: each.time(self.seconds[place])):
            hands = [
                hand for hand in range(1, worker.hands + 1) if free.get((f"by {worker.name}", hand), 0) <= now
            ]
            if len(hands) >= needed:
                return worker, tuple(hands[:needed])
        return None, ()


def _with_vessels(
    plan: Plan, steps: tuple[ScheduledStep, ...], resources: Resources
) -> tuple[ScheduledStep, ...]:
    """Give each step the utensils that it takes, the first that is free; the last one where none is."""
    for label, count in sorted(resources.utensils.items()):
        uses = Vessels(plan.world, label)
        end = max((step.end for step in steps), default=0) + 1
        takers: dict[int, list[int]] = {}
        for place, step in enumerate(steps):
            for object_id, maker in step.origins:
                if uses.inside(object_id):
                    takers.setdefault(maker, []).append(place)
        chosen: dict[int, int] = {}
        free = dict.fromkeys(range(1, count + 1), 0)
        for place, step in enumerate(steps):
            if not uses.needs_one(step.unit):
                continue
            fills = uses.fills(step.unit)
            until = (
                max((steps[each].end for each in takers.get(place, ())), default=end) if fills else step.end
            )
            same = [
                chosen[maker]
                for maker, later in takers.items()
                if place in later and maker in chosen and free[chosen[maker]] <= step.end
            ]
            ready = [number for number, moment in free.items() if moment <= step.start]
            number = (same if fills and same else ready or [count])[0]
            chosen[place] = number
            free[number] = max(until, step.end)
        steps = tuple(
            replace(step, vessels=(*step.vessels, (label, chosen[place]))) if place in chosen else step
            for place, step in enumerate(steps)
        )
    return steps
