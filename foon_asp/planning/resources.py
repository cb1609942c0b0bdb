"""What a schedule may use: who works with how many hands, stations, how many there are of utensils."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from foon_asp.errors import QueryError
from foon_asp.model.node import FunctionalUnit, check_label
from foon_asp.model.world import World
from foon_asp.numbers import QUANTITY, SOME, SPEED
from foon_asp.values import said
from foon_asp.words import closest

_MOST = 1000
"""How many hands, stations or utensils of one kind are told apart; more are as good as any number."""


@dataclass(frozen=True, slots=True)
class Worker:
    """Somebody with so many hands, each of which does one step at a time: a cook, a robot.

    `rate`: how much faster than the videos it works; 0.5 takes twice as long. `motions`: what it can do, None
    for everything. `cannot`: what it cannot do.
    """

    name: str
    hands: int = 1
    rate: float = 1.0
    motions: frozenset[str] | None = None
    cannot: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        """Raise `QueryError` for what no worker can be."""
        check_label(self.name, "the name of a worker")
        SOME.checked(self.hands, f"the hands of {self.name}")
        SPEED.checked(self.rate, f"the rate of {self.name}")

    def can(self, motion: str) -> bool:
        """Whether it can do a motion."""
        return motion not in self.cannot and (self.motions is None or motion in self.motions)

    def time(self, seconds: int) -> int:
        """Return how long it takes for what takes so many seconds in the videos: whole seconds, from 1."""
        return max(1, math.ceil(round(seconds / self.rate, 6)))


@dataclass(frozen=True, slots=True)
class Station:
    """A place that a step takes while it lasts, as a burner or an oven, of which there are `count`.

    A step takes one if it has one of the motions, or lists an object with one of the labels.
    """

    name: str
    count: int = 1
    motions: frozenset[str] = frozenset()
    labels: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        """Raise `QueryError` for what no station can be."""
        check_label(self.name, "the name of a station")
        SOME.checked(self.count, f"the number of {self.name}")


@dataclass(frozen=True, slots=True)
class Resources:
    """Workers, stations, utensils with how many there are, and the hands that motions take, 1 if not said.

    What is not limited here there is enough of. By default there is one cook with two hands, no station is
    limited and no utensil. A motion of 0 hands goes by itself.
    """

    workers: tuple[Worker, ...] = (Worker("cook", 2),)
    stations: tuple[Station, ...] = ()
    utensils: Mapping[str, int] = field(default_factory=dict)
    hands: Mapping[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raise `QueryError` if two have the same name, or a number is none."""
        for kind, names in (
            ("workers", [worker.name for worker in self.workers]),
            ("stations", [station.name for station in self.stations]),
        ):
            if len(set(names)) < len(names):
                raise QueryError(f"two {kind} have the same name; give each its own")
        for label, count in self.utensils.items():
            check_label(label, "a utensil")
            SOME.checked(count, f"the number of {label}")
        for motion, hands in self.hands.items():
            check_label(motion, "a motion")
            QUANTITY.checked(hands, f"the hands of {motion}")

    def needed(self, unit: FunctionalUnit) -> int:
        """Return how many hands a unit takes."""
        return self.hands.get(plain_motion(unit.motion), 1)

    def workers_for(self, unit: FunctionalUnit) -> tuple[Worker, ...]:
        """Return who can do a unit that takes hands."""
        motion, needed = plain_motion(unit.motion), self.needed(unit)
        return tuple(each for each in self.workers if each.hands >= needed and each.can(motion))

    def stations_for(self, world: World, unit: FunctionalUnit) -> tuple[Station, ...]:
        """Return the stations that a unit takes one of each of."""
        motion = plain_motion(unit.motion)
        listed = {*unit.inputs, *unit.outputs}
        labels = {label for each in listed for label in world.node(each).handled_labels}
        return tuple(
            each for each in self.stations if motion in each.motions or not each.labels.isdisjoint(labels)
        )

    def with_hands(self, hands: int) -> Resources:
        """Return the same with so many hands of the only worker; raise `QueryError` if there are several."""
        if len(self.workers) != 1:
            raise QueryError("--hands is for one worker; say the hands of each in the file of resources")
        return replace(self, workers=(replace(self.workers[0], hands=min(hands, _MOST)),))

    def with_passive(self, world: World, motions: Iterable[str]) -> Resources:
        """Return the same where some motions go by themselves; raise `QueryError` if the FOON has not one."""
        known = set(map(plain_motion, world.foon.motions))
        motions = [motion.strip().lower() for motion in motions]
        for motion in motions:
            if motion not in known:
                raise QueryError(f"no unit has the motion {said(motion)}{closest(motion, known)}")
        return replace(self, hands={**self.hands, **dict.fromkeys(motions, 0)})

    def with_counts(self, world: World, counts: Iterable[tuple[str, int]]) -> Resources:
        """Return the same with so many of some labels: utensils of the kitchen; all others are stations."""
        utensils, stations = dict(self.utensils), {each.name: each for each in self.stations}
        for label, count in counts:
            SOME.checked(count, f"the number of {label}")
            if label in stations:
                stations[label] = replace(stations[label], count=min(count, _MOST))
            elif label in world.kitchen.utensils or label in utensils:
                utensils[label] = min(count, _MOST)
            elif label in world.labels:
                stations[label] = Station(label, min(count, _MOST), labels=frozenset({label}))
            else:
                raise QueryError(
                    f"{said(label)} is no utensil, no station and no label of the FOON; name one of them"
                )
        return replace(self, stations=tuple(stations.values()), utensils=utensils)


def plain_motion(motion: str) -> str:
    """Return a motion without the mark of a composite one."""
    return motion.rstrip("*").rstrip()
