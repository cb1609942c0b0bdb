"""Schedules with few bowls against all schedules of small FOONs, each looked at as a whole."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from random import Random

import pytest

from foon_asp.model.world import World
from foon_asp.planning.resources import Resources, Worker
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.planning.scheduler import schedule
from foon_asp.query.query import Query
from support.small_foons import MOTIONS, node, world

HANDS = 2
SPAN = tuple[int, float]


class Recipe:
    """Things made one of another, some in a bowl, each by a unit of its own; the last one is wanted."""

    def __init__(self, random: Random) -> None:
        self.inputs: list[list[int]] = []
        self.in_bowl: list[bool] = []
        for place in range(random.choice([4, 5])):
            # Of what comes before; what is not made is from the kitchen, which has all of it.
            self.inputs.append(sorted(random.sample(range(place), min(place, random.choice([0, 1, 2])))))
            self.in_bowl.append(random.random() < 0.6)
        # Who makes the last thing of nothing would make it alone.
        last = len(self.inputs) - 1
        used = {each for inputs in self.inputs for each in inputs}
        self.inputs[last] = sorted({*self.inputs[last], *set(range(last)) - used})
        self.seconds = {motion: random.choice([1, 1, 2]) for motion in MOTIONS[: last + 1]}

    def world(self) -> World:
        """Return it as a FOON in a kitchen."""
        units = [
            f"{' + '.join(['water', *(self.written(each) for each in inputs)])} -{MOTIONS[place]}-> "
            f"{self.written(place)}"
            for place, inputs in enumerate(self.inputs)
        ]
        return world(units, "water", utensils=["bowl"])

    def written(self, place: int) -> str:
        return f"thing{place}@bowl" if self.in_bowl[place] else f"thing{place}"

    def time(self, place: int) -> int:
        return self.seconds[MOTIONS[place]]

    def least(self, bowls: int) -> int | None:
        """Return the least makespan, by trying all starts; all units are done, each once."""
        places = range(len(self.inputs))
        for makespan in range(1, sum(map(self.time, places)) + 1):
            ranges = [range(makespan - self.time(place) + 1) for place in places]
            if any(self.fits(starts, bowls) for starts in product(*ranges)):
                return makespan
        return None

    def fits(self, starts: tuple[int, ...], bowls: int) -> bool:
        """Whether everything is there in time, two hands are enough, and so many bowls."""
        ends = [start + self.time(place) for place, start in enumerate(starts)]
        if any(ends[each] > starts[place] for place, inputs in enumerate(self.inputs) for each in inputs):
            return False
        if any(sum(s <= now < e for s, e in zip(starts, ends, strict=True)) > HANDS for now in starts):
            return False
        return any(most_at_once(spans) <= bowls for spans in self.bowls_taken(starts, ends))

    def bowls_taken(self, starts: tuple[int, ...], ends: list[int]) -> Iterator[list[SPAN]]:
        """Yield when a bowl is taken, for each way in which steps go on in a bowl that they take from."""
        takers: Mapping[int, list[int]] = {
            place: [each for each, inputs in enumerate(self.inputs) if place in inputs]
            for place in range(len(self.inputs))
        }
        filled = [place for place in takers if self.in_bowl[place]]
        until = {place: max((ends[each] for each in takers[place]), default=float("inf")) for place in filled}
        # Nobody else may still take from the bowl in which a step goes on.
        ways = [
            [
                None,
                *(each for each in self.inputs[place] if self.in_bowl[each] and until[each] == ends[place]),
            ]
            for place in filled
        ]
        for chosen in product(*ways):
            taken = [each for each in chosen if each is not None]
            if len(set(taken)) == len(taken):
                yield [
                    (starts[place] if before is None else ends[place], until[place])
                    for place, before in zip(filled, chosen, strict=True)
                ]


def most_at_once(spans: list[SPAN]) -> int:
    return max((sum(begun <= now < end for begun, end in spans) for now, _ in spans), default=0)


@pytest.mark.parametrize("seed", range(25))
def test_the_shortest_schedule_with_few_bowls_is_that_of_trying_all(seed: int) -> None:
    recipe = Recipe(Random(seed))
    where = recipe.world()
    goal = node(recipe.written(len(recipe.inputs) - 1))
    for bowls in (1, 2):
        resources = Resources((Worker("cook", HANDS),), utensils={"bowl": bowls})
        for semantics in ("add", "consume"):
            # What is taken twice would have to be made twice, if it were used up.
            shared = [each for inputs in recipe.inputs for each in inputs]
            if semantics == "consume" and len(set(shared)) < len(shared):
                continue
            answer = schedule(where, ScheduleQuery(Query(goal), resources, semantics, recipe.seconds))
            assert answer.makespan == recipe.least(bowls)
