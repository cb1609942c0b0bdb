"""Task trees that someone else made, replayed and judged: what is wrong, what is near, what likely lacks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from foon_asp.errors import QueryError
from foon_asp.io.trees import Listing, Trees
from foon_asp.io.wire import dumps
from foon_asp.limits import Limit, LimitReachedError, check, limited
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, Source, UnitId
from foon_asp.model.relations import Matching, check_matching
from foon_asp.model.world import World
from foon_asp.numbers import MEGABYTES, SECONDS
from foon_asp.query.status import Status
from foon_asp.retrieval.check_wire import checks_json
from foon_asp.retrieval.judge import (
    Judgement,
    inferred_kitchen,
    judge,
    purpose,
    raw_objects,
)
from foon_asp.retrieval.likely import Gap, Likely, likely_steps
from foon_asp.retrieval.mend import Mending, mend
from foon_asp.retrieval.nearest import NearObjects
from foon_asp.retrieval.order import other_order
from foon_asp.values import said
from foon_asp.words import counted

if TYPE_CHECKING:
    import pandas as pd

    from foon_asp.draw.formats import Drawing

Difference = Literal["later", "place", "state", "name"]
"""How what is near differs: it is the same but made later, elsewhere, in another state, or another name."""


@dataclass(frozen=True, slots=True)
class CheckQuery:
    """How trees are judged.

    `kitchen`: what is at hand; without one, all that no unit of a tree makes. `utensils`: their labels; what
    a tree puts something in is one there, too, unless `all_utensils` are named.
    `semantics`: what is used up. `match_relations`: whether what is on something counts as in it. `mend`:
    look for the fewest edits, too. `time_limit` (seconds) and `memory_limit` (megabytes) are for all trees
    together.
    """

    kitchen: Kitchen | None = None
    utensils: frozenset[str] = frozenset()
    all_utensils: bool = False
    semantics: str = "add"
    match_relations: Matching = "loose"
    strict: bool = False
    mend: bool = False
    time_limit: float | None = None
    memory_limit: float | None = None

    def __post_init__(self) -> None:
        if self.semantics not in SEMANTICS:
            raise QueryError(f"unknown semantics {said(self.semantics)}; there are {', '.join(SEMANTICS)}")
        check_matching(self.match_relations)
        if self.time_limit is not None:
            SECONDS.checked(self.time_limit, "time_limit")
        if self.memory_limit is not None:
            MEGABYTES.checked(self.memory_limit, "memory_limit")


@dataclass(frozen=True, slots=True)
class Nearest:
    """Something that resembles a missing object; `step` is the place of the step that makes it, if any."""

    node: ObjectNode
    difference: Difference
    step: int | None


@dataclass(frozen=True, slots=True)
class LikelyStep:
    """The known unit that most likely closes a gap, and the tools that it would need besides."""

    unit: FunctionalUnit
    lacks: tuple[ObjectNode, ...]


@dataclass(frozen=True, slots=True)
class Lack:
    """An object that a step lacks, what resembles it, and the step that likely is missing."""

    node: ObjectNode
    nearest: tuple[Nearest, ...]
    likely: LikelyStep | None


@dataclass(frozen=True, slots=True)
class CheckedStep:
    """A step of a tree, at its place (1, 2, …), and what is wrong with it.

    `missing` is what it needs and nothing has made by then. `doubtful` is what only a kitchen that nobody
    named may have, though steps before have had the same in another state or place. `idle`: it brings about
    nothing new. `unused`: no later step takes what it makes, and the tree is not for it.
    """

    place: int
    unit: FunctionalUnit
    source: Source
    missing: tuple[Lack, ...]
    doubtful: tuple[Lack, ...]
    idle: bool
    unused: bool

    @property
    def flawless(self) -> bool:
        """Whether nothing is to be said of it."""
        return not (self.missing or self.doubtful or self.idle or self.unused)


@dataclass(frozen=True, slots=True, repr=False)
class Check:
    """What is said of one tree; it is true if the tree can be executed in the order of its file.

    `goals` is what the tree is for: what it marks, else what its last step makes. `needs` is what it needs
    from a kitchen: what no step before makes. `order` are the places of its steps in another order that can
    be executed, if the order of the file cannot. `mending` are the fewest edits, if they were asked for and
    there is a step.
    """

    world: World
    listing: Listing
    query: CheckQuery
    steps: tuple[CheckedStep, ...]
    goals: tuple[ObjectNode, ...]
    needs: tuple[ObjectNode, ...]
    order: tuple[int, ...] | None
    mending: Mending | None = None

    def __bool__(self) -> bool:
        return self.executable

    def __repr__(self) -> str:
        verdict = "executable" if self.executable else "NOT EXECUTABLE"
        return f"<Check: {self.name}, {counted(len(self.steps), 'step')}, {verdict}>"

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return the tree as a picture, with what is wrong with it."""
        from foon_asp.draw.views import checks_drawing

        return checks_drawing((self,), dark)

    @property
    def name(self) -> str:
        """The file of the tree, with its place there if there are several."""
        return self.listing.name

    @property
    def executable(self) -> bool:
        """Whether each step has all that it needs, in the order of the file. A tree without steps has not."""
        return bool(self.steps) and not any(step.missing for step in self.steps)


@dataclass(frozen=True, slots=True, repr=False)
class Checks(Sequence[Check]):
    """What is said of some trees, in their order; it is true if all of them can be executed.

    `skipped` trees were not looked at before the `limit`.
    """

    found: tuple[Check, ...]
    skipped: int = 0
    limit: Limit | None = None

    def __len__(self) -> int:
        return len(self.found)

    def __getitem__(self, place: int) -> Check:  # type: ignore[override]
        return self.found[place]

    def __iter__(self) -> Iterator[Check]:
        return iter(self.found)

    def __bool__(self) -> bool:
        return self.executable

    def __repr__(self) -> str:
        return f"<Checks: {counted(len(self), 'tree')}, {sum(map(bool, self))} executable>"

    def __str__(self) -> str:
        from foon_asp.render.check import checks_text

        return checks_text(self).rstrip()

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return the trees as a picture, with what is wrong with them."""
        from foon_asp.draw.views import checks_drawing

        return checks_drawing(self, dark)

    @property
    def executable(self) -> bool:
        """Whether all trees can be executed, in the order of their files."""
        return not self.skipped and all(self)

    @property
    def status(self) -> Status:
        """`LIMIT` if something was not proven in time, else `UNSOLVABLE` if some tree is not executable."""
        if self.skipped or any(each.mending is not None and not each.mending.proven for each in self):
            return Status.LIMIT
        return Status.SOLVED if self.executable else Status.UNSOLVABLE

    def to_json(self) -> str:
        """Return what the command writes with `--format json`: an object for one tree, a list for several."""
        return dumps(checks_json(self))

    def to_frame(self) -> pd.DataFrame:
        """Return a row for each tree: how many steps it has, and how many are wrong in which way."""
        from foon_asp.render.check import checks_frame

        return checks_frame(self)


def check_trees(trees: Trees, query: CheckQuery) -> Checks:
    """Judge some trees, each in the order of its file, beside a FOON that is known."""
    judge_ = _Judge(trees, query)
    found: list[Check] = []
    with limited(query.time_limit, query.memory_limit):
        try:
            for listing in trees.listings:
                check()
                found.append(judge_.check(listing))
        except LimitReachedError as error:
            return Checks(tuple(found), len(trees.listings) - len(found), error.limit)
    return Checks(tuple(found))


class _Judge:
    """What is the same for all trees."""

    def __init__(self, trees: Trees, query: CheckQuery) -> None:
        self._trees = trees
        self._known = trees.known
        self._query = query
        self._worlds: dict[frozenset[str], World] = {}

    def _world(self, listing: Listing) -> World:
        """Return the world of a tree, which knows its utensils, and not those of the trees beside it."""
        query = self._query
        utensils = query.utensils if query.all_utensils else query.utensils | _vessels(self._trees, listing)
        if utensils not in self._worlds:
            kitchen = replace(query.kitchen or Kitchen(()), utensils=utensils)
            self._worlds[utensils] = World.of(
                self._trees.foon, kitchen, strict=query.strict, match_relations=query.match_relations
            )
        return self._worlds[utensils]

    def check(self, listing: Listing) -> Check:
        world, query, units = self._world(listing), self._query, listing.units
        if query.kitchen is None:
            raw = raw_objects(world, query.semantics, units)
            world = world.with_stock(map(world.node, raw))
        effects = Effects(world, query.semantics)
        goals = purpose(world, units, listing.goals)
        judged = judge(effects, units, goals, named=query.kitchen is not None)
        executable = not any(each.missing for each in judged)
        lacks = _Lacks(effects, units, self._known, judged)
        return Check(
            world,
            listing,
            query,
            tuple(map(lacks.step, judged, listing.sources)),
            tuple(map(world.node, goals)),
            tuple(map(world.node, inferred_kitchen(world, query.semantics, units))),
            None if executable else other_order(effects, units),
            mend(effects, self._known, units, goals) if query.mend and units else None,
        )


def _vessels(trees: Trees, listing: Listing) -> frozenset[str]:
    """Return the labels of what the units of a tree put something in."""
    units = [trees.foon.units[unit] for unit in dict.fromkeys(listing.units)]
    ports = {number for unit in units for number in (*unit.inputs, *unit.outputs)}
    return frozenset(vessel for number in ports for vessel in trees.foon.objects[number].containers)


class _Lacks:
    """What is said of the things that the steps of one tree lack."""

    def __init__(
        self, effects: Effects, units: Sequence[UnitId], known: int, judged: Sequence[Judgement]
    ) -> None:
        self._world = effects.world
        self._places: dict[ObjectId, list[int]] = {}
        for place, unit in enumerate(units, 1):
            for object_id in effects.adds(unit):
                self._places.setdefault(object_id, []).append(place)
        gaps = [(each.place, need) for each in judged for need in (*each.missing, *each.doubtful)]
        there = {each.place: each.there for each in judged}
        asked = [Gap(need, there[place]) for place, need in gaps]
        self._likely = dict(zip(gaps, likely_steps(self._world, known, asked), strict=True))

    @cached_property
    def _near(self) -> NearObjects:
        return NearObjects(self._world, {*self._world.stock, *self._places})

    def step(self, judged: Judgement, source: Source) -> CheckedStep:
        unit = self._world.foon.units[judged.unit]
        read, node = self._world.units.read, self._world.node
        listed = {read(number): node(number) for number in reversed(unit.inputs)}

        def lack(need: ObjectId) -> Lack:
            likely = self._likely[judged.place, need]
            return Lack(
                listed.get(need, node(need)),
                tuple(self._nearest(judged.place, need)),
                None if likely is None else self._likely_step(likely),
            )

        missing, doubtful = (tuple(map(lack, needs)) for needs in (judged.missing, judged.doubtful))
        return CheckedStep(judged.place, unit, source, missing, doubtful, judged.idle, judged.unused)

    def _likely_step(self, likely: Likely) -> LikelyStep:
        return LikelyStep(self._world.foon.units[likely.unit], tuple(map(self._world.node, likely.lacks)))

    def _nearest(self, place: int, need: ObjectId) -> Iterator[Nearest]:
        node = self._world.node
        for later in self._places.get(need, ()):
            if later >= place:
                yield Nearest(node(need), "later", later)
                break
        for other in self._near.ids(need):
            yield Nearest(node(other), _difference(node(need), node(other)), self._made(other, place))

    def _made(self, object_id: ObjectId, place: int) -> int | None:
        """Return the place of the last step before that makes an object, else of the first one."""
        if object_id in self._world.stock:
            return None
        places = self._places.get(object_id, ())
        return max((each for each in places if each < place), default=min(places, default=None))


def _difference(wanted: ObjectNode, other: ObjectNode) -> Difference:
    if wanted.label != other.label:
        together = {wanted.label, *wanted.contents} & {other.label, *other.contents}
        return "place" if together else "name"
    changed = {*wanted.states} ^ {*other.states}
    return "place" if all(state.relatum is not None for state in changed) else "state"
