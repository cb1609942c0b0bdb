"""Generate FOONs of any size in the shape of the public universal FOON, from a seed.

    python benchmarks/generate.py --units N [--family random|dense|chain] [--seed S] DIR
    python benchmarks/shape.py        # prints the public FOON and generated ones side by side

DIR gets FOON.txt, kitchen.json, utensils.txt, motion.txt and goal_nodes.json: 100 goals that the kitchen
can make in 1 to 20 rounds or more, spread evenly, most of them dishes, which no unit uses. The same N,
family and seed give the same bytes.

Measured on the public FOON (2,376 units) and on random unions of its parts:

- how many inputs and outputs units have, how many of their needs the kitchen does not have, how many states
  and contents objects have;
- recipes: runs of units that use what the units before them made; half of the runs are single units, the
  others have 15 units on average and 50 at most; of what units need and the kitchen lacks, 57% was made by
  the unit before, 14% by that before it, 18% up to 20 units back;
- far needs, made by other recipes: 0.12 a unit, of shallow things (median 1 round, 90% at most 4);
- alternatives: outputs that another recipe made before, 0.09 a unit in the first half of the file and 0.18
  in the second; made again within a recipe 0.04, and made of itself 0.06 a unit, which gives the circles;
- growth with n units: made objects as n^0.92, objects of the kitchen in use as n^0.65 (n^0.78 if a part's
  kitchen is not completed by what no unit of it makes), labels as n^0.5, motions as n^0.4.

Tuned until the table of shape.py fitted at 2,376 units: the tables of needs and of steps back, the share of
far needs (0.16, as some of those drawn turn out near), how alternatives go with the round, how often the
popular is taken again, and how objects are named. The slices of parts of the FOON were not tuned for; they
come out alike.

Extrapolated is everything beyond 2,376 units, and there is no data to tell. In parts of the public FOON the
mean backward slice of an object that can be made is 12 units among 594, 18 among 1,188, 29 among 1,782 and
43 among 2,376: it grows about as the FOON does. This is what happens when each unit in a slice leads,
through alternatives and far needs, to about one more recipe. Whether it goes on decides what a query costs
among a million units. So there are two families:

- `random` takes a larger FOON to be a union of cuisines of about 2,376 units. Within a cuisine everything
  grows as measured, and no further. All cuisines share kitchen, tools, labels, motions and a pool of basics
  (things made directly from the kitchen and from nothing else), which get ever more producers. Slices stay
  as they are.
- `dense` takes it to be a single cuisine in which all trends go on: fewer and fewer outputs are new. From
  some 10^4 units on most goals have slices of a fifth to a third of it. This is the pessimistic case.

`chain` is a single chain of N/10 links, one round each. The other units make links in other ways from the
link before, or from that and an earlier one (short cuts that shorten nothing), or go in circles back from a
later link.
"""

from __future__ import annotations

import argparse
import json
import random
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import accumulate, islice
from pathlib import Path
from typing import Generic, TypeVar

FAMILIES = ("random", "dense", "chain")
GOALS = 100
CUISINE = 2376
"""The units of the public FOON: how far its growth was measured."""

_INPUTS = {1: 109, 2: 604, 3: 1096, 4: 419, 5: 71, 6: 43, 7: 14, 8: 11, 9: 2, 11: 5, 12: 2}
_OUTPUTS = {1: 721, 2: 1280, 3: 343, 4: 27, 5: 3, 6: 2}
_NEEDS = {0: 200, 1: 830, 2: 790, 3: 240, 4: 80, 5: 30, 6: 10, 7: 8, 8: 4, 9: 2, 11: 1}
_CONTENTS = {
    2: 304,
    3: 234,
    4: 176,
    5: 151,
    6: 121,
    7: 86,
    8: 64,
    9: 54,
    10: 41,
    11: 18,
    12: 16,
    13: 3,
    15: 9,
}
_BACK = {1: 2400, 2: 300, 3: 80, 5: 160, 10: 130, 20: 80}
_FAR_ROUNDS = {1: 150, 2: 75, 3: 25, 4: 20, 6: 18, 10: 16}
_EARLIER = {0: 40, 1: 20, 2: 15, 3: 10, 5: 10, 8: 5}

_OUTPUTS_A_UNIT = 1.87
_FAR_NEED = 0.16
_AGAIN_NEAR = 0.043
_ITSELF = 0.059
_LOCKED = 0.004
_BARE_OUTPUT = 0.097
_KITCHEN_OUTPUT = 0.22
_SINGLE_RUNS = 0.5
_GOAL_ROUNDS = 20
_MIXED_PAIR = 0.3
_BOTH = 0.9
_UNUSED = 0.8
_AGAIN_SHALLOW = 1.6
_AGAIN_DEEP = 0.7
_BASIC = 0.1
_BASIC_NEED = 0.2
_BASIC_AGAIN = 0.5
_POPULAR = 0.5
_POPULAR_AGAIN = 0.2
"""How often what is taken from elsewhere is something that was taken before."""

_STATES = (
    "whole chopped cooked uncooked hot mixed sliced liquid raw powder peeled granulated ground creamy halved "
    "diced unpeeled dried grated leaf washed softened fried baked cubed beaten frozen ready covered minced "
    "toasted melted rolled paste seasoned soaked heated crushed plain cold strained whipped"
)
_MOTIONS = (
    "pour mix chop pick-and-place scoop cut stir cook slice peel sprinkle bake crack spread fry boil wash "
    "open close grate whisk heat drain squeeze dip flip roll press fold blend serve fill shake remove"
)
_VESSELS = "bowl pot pan plate cup spoon knife tray jar bottle"
_THINGS = "onion salt water butter egg flour sugar oil garlic pepper milk tomato potato cheese rice"
_REMEMBERED = 200_000
"""How many draws are remembered of things that recur: enough that their shares hold."""

_SYLLABLES = [first + last for first in "bdfgklmnprstvz" for last in "aeiou"]


def word(number: int) -> str:
    """Return a word of three syllables or more that stands for a number, each number another word."""
    text = ""
    number += len(_SYLLABLES) ** 2
    while number:
        number, rest = divmod(number, len(_SYLLABLES))
        text = _SYLLABLES[rest] + text
    return text


T = TypeVar("T")


class Draw:
    """Draws keys of a table of counts."""

    def __init__(self, chance: random.Random, table: dict[int, int]) -> None:
        self._random = chance.random
        total = sum(table.values())
        self._cells: list[int] = []
        # 4,096 cells of one key each: a draw is one look-up.
        for key, upper in zip(table, accumulate(table.values()), strict=True):
            self._cells += [key] * (round(4096 * upper / total) - len(self._cells))

    def __call__(self) -> int:
        return self._cells[int(self._random() * 4096)]


class Recurring(Generic[T]):
    """Things that come up as words do in texts: new ones ever more rarely, old ones the more, the more often
    they came up before.

    There are about `at_cuisine * (n / events)**exponent` of them after n events: draws, unless counted
    elsewhere. `early` above 1 favours the first ones even more.
    """

    def __init__(
        self,
        chance: random.Random,
        at_cuisine: float,
        events: float,
        exponent: float,
        make: Callable[[int], T],
        early: float = 1.0,
    ) -> None:
        self.found: list[T] = []
        self._random = chance.random
        self._scale = at_cuisine / events**exponent
        self._exponent = exponent
        self._make = make
        self._early = early
        self._drawn: list[T] = []
        self._count = 0
        self._next = 0.0

    def draw(self, count: int = 0) -> T:
        """Return one, `count` events having come to pass."""
        self._count = count or self._count + 1
        drawn = self._drawn
        if self._count > self._next or not drawn:
            one = self._make(len(self.found))
            self.found.append(one)
            self._next = (len(self.found) / self._scale) ** (1 / self._exponent)
        else:
            one = drawn[int(self._random() ** self._early * len(drawn))]
        if len(drawn) < _REMEMBERED:
            drawn.append(one)
        else:
            drawn[int(self._random() * _REMEMBERED)] = one
        return one


def _from_list(known: Sequence[str], suffix: str = "") -> Callable[[int], str]:
    """Return what names a number: the known words first, then made-up ones."""
    return lambda number: known[number] if number < len(known) else word(number) + suffix


@dataclass(frozen=True, slots=True, eq=False)
class Thing:
    """An object node: label, plain states, relatum of `in`, contents of `contains`, and its lines."""

    label: str
    states: tuple[str, ...]
    place: str
    contents: tuple[str, ...]
    text: str

    @classmethod
    def of(
        cls, label: str, states: tuple[str, ...] = (), place: str = "", contents: tuple[str, ...] = ()
    ) -> Thing:
        text = f"O\t{label}\n"
        for state in states:
            text += f"S\t{state}\n"
        if place:
            text += f"S\tin\t[{place}]\n"
        if contents:
            text += f"S\tcontains\t{{{','.join(contents)}}}\n"
        return cls(label, states, place, contents, text)

    def json(self) -> dict[str, object]:
        return {
            "label": self.label,
            "states": list(self.states),
            "ingredients": list(self.contents),
            "container": self.place or None,
        }


class Names:
    """Makes object nodes, each another one, out of labels, states and motions that recur."""

    def __init__(self, chance: random.Random) -> None:
        self._random = chance.random
        self._contents = Draw(chance, _CONTENTS)
        things, vessels = 405, 97
        self._things = Recurring(chance, things, 2700, 0.5, _from_list(_THINGS.split()))
        self._vessels = Recurring(chance, vessels, 4600, 0.5, _from_list(_VESSELS.split(), " pan"))
        self._states = Recurring(chance, 156, 2700, 0.4, _from_list(_STATES.split(), "ed"))
        self._motions = Recurring(chance, 129, CUISINE, 0.4, _from_list(_MOTIONS.split(), "ise"))
        self._taken: set[str] = set()

    def motion(self) -> str:
        return self._motions.draw()

    @property
    def motions(self) -> list[str]:
        return self._motions.found

    @property
    def vessels(self) -> list[str]:
        return self._vessels.found

    def products(self, count: int) -> list[Thing]:
        """Return things made by one unit; two of them are mostly a vessel and what is in it."""
        if count < 2:
            return [self.product() for _ in range(count)]
        return [*self.pair(), *(self.product() for _ in range(count - 2))]

    def tool(self, number: int) -> Thing:
        """Return the kitchen's object of this number: a bare tool or, more often, one with a state."""
        bare = number % (5 if number < 200 else 40) == 0
        return self._new(lambda: Thing.of(self._vessels.draw(), () if bare else self._some_states(0.1)))

    def ingredient(self) -> Thing:
        """Return an ingredient as a kitchen has it, in its container or not, or a full container."""

        def draw() -> Thing:
            if self._random() < 0.2:
                return Thing.of(self._vessels.draw(), (), "", (self._things.draw(),))
            return Thing.of(self._things.draw(), self._some_states(0.3), self._place(0.6))

        return self._new(draw)

    def product(self) -> Thing:
        """Return something made: a vessel with contents, or a thing, mostly in a vessel."""

        def draw() -> Thing:
            if self._random() < 0.6:
                single = self._random() < 0.3
                contents = (self._things.draw(),) if single else self._contents_of()
                return Thing.of(self._vessels.draw(), self._rarely(), "", contents)
            mixed = self._contents_of() if self._random() < 0.35 else ()
            return Thing.of(self._things.draw(), self._some_states(0.4), self._place(0.75), mixed)

        return self._new(draw)

    def link(self) -> Thing:
        """Return a thing that is no vessel, so that nothing implies it."""
        return self._new(lambda: Thing.of(self._things.draw(), self._some_states(0.4), self._place(0.75)))

    def pair(self) -> tuple[Thing, Thing]:
        """Return one thing seen twice: the vessel that holds it, and the thing in the vessel."""
        second = self._new(
            lambda: Thing.of(self._things.draw(), self._some_states(0.4), self._vessels.draw())
        )
        mixed = self._random() < _MIXED_PAIR

        def draw() -> Thing:
            contents = self._contents_of() if mixed else (second.label,)
            return Thing.of(second.place, self._rarely(), "", contents)

        return self._new(draw), second

    def _some_states(self, more: float) -> tuple[str, ...]:
        found = {self._states.draw()}
        while len(found) < 3 and self._random() < more:
            found.add(self._states.draw())
        return tuple(sorted(found))

    def _rarely(self) -> tuple[str, ...]:
        return self._some_states(0) if self._random() < 0.12 else ()

    def _place(self, chance: float) -> str:
        return self._vessels.draw() if self._random() < chance else ""

    def _contents_of(self) -> tuple[str, ...]:
        return tuple(sorted({self._things.draw() for _ in range(self._contents())}))

    def _new(self, draw: Callable[[], Thing]) -> Thing:
        """Draw until something is new; if all is taken, something of another state, or of a new label."""
        for _ in range(10):
            thing = draw()
            if thing.text not in self._taken:
                break
        for _ in range(10):
            if thing.text not in self._taken:
                break
            states = {*thing.states, self._states.draw()} if thing.states or thing.contents else ()
            thing = Thing.of(thing.label, tuple(sorted(states)), thing.place, thing.contents)
        if thing.text in self._taken:
            label = f"{word(len(self._taken))} {thing.label}"
            thing = Thing.of(label, thing.states, thing.place, thing.contents)
        self._taken.add(thing.text)
        return thing


@dataclass(slots=True, eq=False)
class Made:
    """Something that units make, with the round in which it can be had at the latest; 0: perhaps never.

    `again`: a unit of its recipe makes it again. `shared`: other cuisines take it, so that none does.
    """

    thing: Thing
    round: int
    uses: int = 0
    again: bool = False
    shared: bool = False


@dataclass(slots=True)
class Pool:
    """What can be taken from elsewhere, by round; what was taken before is taken more often."""

    chance: random.Random
    rounds: list[list[Made]] = field(default_factory=list)
    taken: list[list[Made]] = field(default_factory=list)

    def add(self, made: Made) -> None:
        while len(self.rounds) <= made.round:
            self.rounds.append([])
            self.taken.append([])
        self.rounds[made.round].append(made)

    def take(self, depth: int, popular: float) -> Made | None:
        """Return something of this round, or of the deepest there is before it."""
        depth = min(depth, len(self.rounds) - 1)
        while depth > 0 and not self.rounds[depth]:
            depth -= 1
        if depth <= 0:
            return None
        among = (
            self.taken[depth] if self.taken[depth] and self.chance.random() < popular else self.rounds[depth]
        )
        made = among[int(self.chance.random() * len(among))]
        self.taken[depth].append(made)
        return made


def _kitchen(chance: random.Random, names: Names) -> Recurring[Thing]:
    """Return the objects at hand; they grow with the units."""

    def make(number: int) -> Thing:
        tool = number < 10 or chance.random() < 0.35
        return names.tool(number) if tool else names.ingredient()

    return Recurring(chance, 1125, CUISINE, 0.65, make, early=2.5)


@dataclass(frozen=True, slots=True)
class Unit:
    """A functional unit as it is written."""

    inputs: tuple[Thing, ...]
    motion: str
    outputs: tuple[Thing, ...]

    @property
    def text(self) -> str:
        inputs = "".join(thing.text for thing in self.inputs)
        return f"{inputs}M\t{self.motion}\n{''.join(thing.text for thing in self.outputs)}//\n"


class Sample:
    """A fair sample of a stream of goals, as many from each round; rather dishes, which no unit uses."""

    def __init__(self, chance: random.Random) -> None:
        self._chance = chance
        self._kept: dict[tuple[int, bool], list[Made]] = {}
        self._seen: dict[tuple[int, bool], int] = {}

    def offer(self, made: Made) -> None:
        kind = (min(made.round, _GOAL_ROUNDS), made.uses > 0)
        kept = self._kept.setdefault(kind, [])
        seen = self._seen[kind] = self._seen.get(kind, 0) + 1
        if len(kept) < GOALS:
            kept.append(made)
        elif (place := int(self._chance.random() * seen)) < GOALS:
            kept[place] = made

    def goals(self) -> list[Made]:
        kinds = sorted(self._kept, key=lambda kind: (kind[1], kind[0]))
        found: dict[Made, None] = {}
        for share in range(GOALS // _GOAL_ROUNDS, GOALS + 1):
            for kind in kinds:
                if share > GOALS // _GOAL_ROUNDS or not kind[1]:
                    found |= dict.fromkeys(self._kept[kind][:share])
            if len(found) >= GOALS:
                break
        return sorted(list(found)[:GOALS], key=lambda made: (made.round, made.thing.text))


class Cook:
    """Makes up the recipes of the families `random` and `dense`."""

    def __init__(self, units: int, family: str, seed: int) -> None:
        chance = random.Random(f"{family} {units} {seed}")
        self.names = Names(chance)
        self.kitchen = _kitchen(chance, self.names)
        self.sample = Sample(chance)
        self._units = units
        self._cuisines = 1 if family == "dense" else max(1, round(units / CUISINE))
        self._chance = chance
        self._random = chance.random
        self._inputs = Draw(chance, _INPUTS)
        self._outputs = Draw(chance, _OUTPUTS)
        self._needs = Draw(chance, _NEEDS)
        self._back = Draw(chance, _BACK)
        self._far_rounds = Draw(chance, _FAR_ROUNDS)
        self._earlier = Draw(chance, _EARLIER)
        self._basics = Pool(chance)
        self._pool = Pool(chance)
        self._repeats: set[tuple[frozenset[Thing], str, frozenset[Thing]]] = set()
        self._count = 0
        self._here = 0

    def units(self) -> Iterator[Unit]:
        """Yield the units, cuisine by cuisine."""
        for number in range(self._cuisines):
            end = self._units * (number + 1) // self._cuisines
            self._pool = Pool(self._chance)
            self._here = 0
            made: list[Made] = []
            while self._count < end:
                steps: list[list[Made]] = []
                yield from self._recipe(min(self._length(), end - self._count), steps)
                made += self._share(steps)
            for one in made:
                self.sample.offer(one)

    def _length(self) -> int:
        if self._random() < _SINGLE_RUNS:
            return 1
        return min(50, max(2, round(self._chance.gauss(16, 11))))

    def _share(self, steps: list[list[Made]]) -> list[Made]:
        """Let other recipes take what this one made; return it, without what can perhaps never be had."""
        made = [one for step in steps for one in step if one.round]
        for one in made:
            first = one.round == 1 and not one.again
            one.shared = first and self._cuisines > 1 and self._random() < _BASIC
            (self._basics if one.shared else self._pool).add(one)
        return made

    def _recipe(self, length: int, steps: list[list[Made]]) -> Iterator[Unit]:
        """Yield the units of a recipe; fill in, for each, what it is the first to make."""
        locked: Made | None = None
        for place in range(length):
            needs = self._choose(steps)
            if locked is not None and steps[-1][0] not in needs:
                needs.append(steps[-1][0])
            key = None
            if locked is None and place < length - 1 and self._random() < _LOCKED:
                # The next unit makes it out of what this one makes, so that neither can ever run.
                key = Made(self.names.product(), 0)
                needs.append(key)
            depth = 1 + max((one.round for one in needs), default=0)
            if any(one.round == 0 for one in needs):
                depth = 0
            stock = self._stock(len(needs))
            outputs, new = self._outcome(needs, stock, depth, steps)
            if locked is not None:
                outputs.append(locked.thing)
            if key is not None and not new:
                new.append(Made(self.names.product(), 0))
                outputs.append(new[0].thing)
            locked = key
            for one in needs:
                one.uses += 1
            steps.append(new)
            self._count += 1
            self._here += 1
            yield self._unit([*(one.thing for one in needs), *stock], outputs, new, depth)

    def _choose(self, steps: list[list[Made]]) -> list[Made]:
        """Return what a unit needs of what is made: mostly by the units before it, sometimes elsewhere."""
        wanted = self._needs() if steps else 0
        chosen: list[Made] = []
        if self._random() < _FAR_NEED:
            basic = self._random() < _BASIC_NEED
            far = (self._basics if basic else self._pool).take(1 if basic else self._far_rounds(), _POPULAR)
            if far is not None:
                chosen.append(far)
        count = len(chosen)
        for _ in range(3 * wanted + 3):
            if count >= wanted:
                break
            step = self._step_back(steps)
            taken = [one for one in step if not one.uses and one not in chosen]
            if not taken and self._random() < _UNUSED:
                near = (one for step in steps[:-20:-1] for one in step if not one.uses and one not in chosen)
                taken = list(islice(near, 1))
            taken = taken or [one for one in step if one not in chosen]
            if len(taken) > 1 and _is_pair(taken) and self._random() < _BOTH:
                chosen += taken[:2]
                count += 1
            else:
                chosen += taken[: wanted - count]
                count += len(taken)
        return chosen

    def _step_back(self, steps: list[list[Made]]) -> list[Made]:
        """Return what a unit some steps before made first."""
        back = self._back()
        if back > 3:
            back = 1 + int(back * (0.5 + self._random() / 2))
        place = len(steps) - back if back <= len(steps) else int(self._random() * len(steps))
        while place > 0 and not steps[place]:
            place -= 1
        return steps[place]

    def _stock(self, made: int) -> list[Thing]:
        """Return what a unit uses of the kitchen."""
        count = max(self._inputs() - made, 0 if made else 1)
        found: list[Thing] = []
        for _ in range(count):
            thing = self.kitchen.draw(self._count + 1)
            if thing not in found:
                found.append(thing)
        return found

    def _outcome(
        self, needs: list[Made], stock: list[Thing], depth: int, steps: list[list[Made]]
    ) -> tuple[list[Thing], list[Made]]:
        """Return the outputs of a unit, and those that no unit made before."""
        outputs: list[Thing] = []
        fresh = 0
        again = self._again_rate() * (_AGAIN_SHALLOW if depth <= 3 else _AGAIN_DEEP)
        for _ in range(self._outputs()):
            draw = self._random() * _OUTPUTS_A_UNIT
            old: Thing | None = None
            if draw < (edge := _BARE_OUTPUT):
                bare = (thing for thing in stock if not thing.states and not thing.contents)
                old = next(bare, None) or self.kitchen.draw(self._count + 1)
            elif draw < (edge := edge + _KITCHEN_OUTPUT):
                old = self.kitchen.draw(self._count + 1)
            elif draw < (edge := edge + _ITSELF):
                old = _again(needs)
            elif draw < (edge := edge + _AGAIN_NEAR):
                old = _again(self._step_back(steps)) if steps else None
            elif draw < edge + again:
                old = self._made_elsewhere(depth)
            if old is None:
                fresh += 1
            elif old not in outputs:
                outputs.append(old)
        fresh = fresh if outputs else max(1, fresh)
        new = [Made(thing, depth) for thing in self.names.products(fresh)]
        return [*(made.thing for made in new), *outputs], new

    def _again_rate(self) -> float:
        """Return how many outputs of a unit another recipe made before, by how much there is.

        Units make 1.55 objects; how many of them are new follows from made objects growing as n^0.92.
        """
        new: float = 1.213 * ((self._here + 1) / CUISINE) ** -0.08
        return max(0.02, 1.55 - new - _AGAIN_NEAR - _ITSELF)

    def _made_elsewhere(self, depth: int) -> Thing | None:
        """Return something that another recipe makes, too, and not in a later round than this one."""
        if depth == 1 and self._random() < _BASIC_AGAIN:
            basic = self._basics.take(1, _POPULAR_AGAIN)
            if basic is not None:
                return basic.thing
        found = self._pool.take(max(1, depth - self._earlier()), _POPULAR_AGAIN)
        return None if found is None else found.thing

    def _unit(self, inputs: list[Thing], outputs: list[Thing], new: list[Made], depth: int) -> Unit:
        """Return a unit that was not there before: with nothing new in it, it gets something if it was."""
        motion = self.names.motion()
        if not new:
            key = (frozenset(inputs), motion, frozenset(outputs))
            if key in self._repeats:
                new.append(Made(self.names.product(), depth))
                outputs = [new[0].thing, *outputs][:6]
            self._repeats.add(key)
        return Unit(tuple(inputs[:12]), motion, tuple(outputs[:6]))


def _again(made: list[Made]) -> Thing | None:
    """Return the first of some things that is not shared, for a unit that makes it again."""
    for one in made:
        if not one.shared:
            one.again = True
            return one.thing
    return None


def _is_pair(made: list[Made]) -> bool:
    """Say whether the first two are one thing seen twice."""
    vessel, thing = made[0].thing, made[1].thing
    return vessel.contents == (thing.label,) and thing.place == vessel.label


class Chain:
    """Makes up the units of the family `chain`."""

    def __init__(self, units: int, family: str, seed: int) -> None:
        chance = random.Random(f"{family} {units} {seed}")
        self.names = Names(chance)
        self.kitchen = _kitchen(chance, self.names)
        self.sample = Sample(chance)
        self._chance = chance
        self._units = units
        self._length = max(1, units // 10)

    def units(self) -> Iterator[Unit]:
        """Yield the units, link by link."""
        length = self._length
        start = Made(self.names.link(), 0)
        self.kitchen.found.append(start.thing)
        links = [start, *(Made(self.names.link(), place) for place in range(1, length + 1))]
        for made in _spread(links[1:]):
            self.sample.offer(made)
        count = 0
        for place in range(1, length + 1):
            end = self._units * place // length
            seen: set[tuple[frozenset[Thing], str]] = set()
            others = [links[place - 1].thing]
            while count < end:
                inputs = [*others, *self._tools(count)]
                motion = self.names.motion()
                if (key := (frozenset(inputs), motion)) not in seen:
                    seen.add(key)
                    yield Unit(tuple(inputs), motion, (links[place].thing,))
                    count += 1
                others = [made.thing for made in self._way(links, place)]

    def _tools(self, count: int) -> list[Thing]:
        found = {id(thing): thing for thing in (self.kitchen.draw(count + 1) for _ in range(2))}
        return list(found.values())

    def _way(self, links: list[Made], place: int) -> list[Made]:
        """Return the links from which another way leads to a link."""
        draw = self._chance.random()
        if draw < 0.2 and place > 2:
            earlier = self._chance.randrange(max(1, place - 20), place - 1)
            return [links[place - 1], links[earlier]]
        end = min(len(links) - 1, -(-place // 10) * 10)
        if draw < 0.4 and place < end:
            # Only within a stretch of ten: else all slices would go to the end of the chain.
            return [links[self._chance.randrange(place + 1, end + 1)]]
        return [links[place - 1]]


def _spread(links: list[Made]) -> list[Made]:
    """Return links from the first to the last, at most as many as there are goals, most of them shallow."""
    last = len(links)
    if last <= GOALS:
        return links
    places = {round(last ** (number / (GOALS - 1))) for number in range(GOALS)}
    places |= set([place for place in range(1, last) if place not in places][: GOALS - len(places)])
    return [links[place - 1] for place in sorted(places)]


def generate(units: int, family: str, seed: int, folder: Path) -> None:
    """Write a FOON and what belongs to it into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    maker = Chain(units, family, seed) if family == "chain" else Cook(units, family, seed)
    with (folder / "FOON.txt").open("w", encoding="utf-8", newline="\n") as file:
        file.write(f"# generated: {units} units, family {family}, seed {seed}\n//\n")
        for unit in maker.units():
            file.write(unit.text)
    kitchen, names = maker.kitchen, maker.names
    _write_objects(folder / "kitchen.json", kitchen.found)
    _write_objects(folder / "goal_nodes.json", [made.thing for made in maker.sample.goals()])
    _write(folder / "utensils.txt", sorted(names.vessels))
    chance = random.Random(f"rates {family} {units} {seed}")
    rates = (f"{motion}\t{chance.randint(1, 19) / 20:.2f}" for motion in sorted(names.motions))
    _write(folder / "motion.txt", rates)


def _write_objects(path: Path, things: Iterable[Thing]) -> None:
    rows = (json.dumps(thing.json()) for thing in things)
    path.write_text("[\n" + ",\n".join(rows) + "\n]\n", encoding="utf-8", newline="\n")


def _write(path: Path, rows: Iterable[str]) -> None:
    path.write_text("".join(f"{row}\n" for row in rows), encoding="utf-8", newline="\n")


def main() -> None:
    parser = argparse.ArgumentParser(description="Generate a FOON in the shape of the public one.")
    parser.add_argument("folder", type=Path, metavar="DIR", help="where it is written")
    parser.add_argument("--units", type=int, required=True, metavar="N", help="functional units, at least 20")
    parser.add_argument("--family", choices=FAMILIES, default="random")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.units < 20:
        parser.error("--units must be at least 20")
    generate(options.units, options.family, options.seed, options.folder)


if __name__ == "__main__":
    main()
