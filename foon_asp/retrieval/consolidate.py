"""Several trees of one dish made into one: the best that their sound steps allow (Sakib and Sun, 2024)."""

from __future__ import annotations

import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

from foon_asp.errors import QueryError
from foon_asp.io.findings import Finding, Severity
from foon_asp.io.transitions import Orders
from foon_asp.io.trees import Trees
from foon_asp.io.wire import dumps
from foon_asp.limits import limited
from foon_asp.model.alignment import Measure
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, Source, UnitId
from foon_asp.model.relations import Matching, check_matching
from foon_asp.model.world import World
from foon_asp.query.goals import find_object
from foon_asp.query.objective import UNITS, Costs, Objective
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.unreachable import is_raw
from foon_asp.retrieval.answer import Answer, Answered
from foon_asp.retrieval.consolidate_wire import consolidation_json
from foon_asp.retrieval.explain import Explanation, explain
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.samples import Reworded, Sample, Samples, Words, read_samples
from foon_asp.retrieval.transitions import ASPECTS, Aspect, Models, Refusal, refusals
from foon_asp.retrieval.tree import TaskTree
from foon_asp.words import counted, shortened

if TYPE_CHECKING:
    import pandas as pd

Fault = Literal["unreadable", "incomplete", "state", "location", "motion"]
"""Why a step is left out."""

COST = Objective.parse("cost")
"""The least sum of what motions cost."""


@dataclass(frozen=True, slots=True)
class ConsolidateQuery:
    """How several trees are made into one.

    `query`: the goal, if one is named; what the tree is best by (what motions cost, where that is known, and
    then the number of steps); constraints and limits. `kitchen`: what is at hand, its utensils, and what
    motions cost; without objects, what the trees do not make. `orders`: which states, locations and motions
    may follow each other, with `adjacent` only the next word of an order. `measure` says which labels mean
    the same beside those that are spelt alike.
    """

    query: Query = field(default_factory=Query)
    kitchen: Kitchen = field(default_factory=lambda: Kitchen((), stated=False))
    orders: Mapping[Aspect, Orders] = field(default_factory=dict)
    adjacent: bool = False
    measure: Measure | None = None
    strict: bool = False
    match_relations: Matching = "loose"

    def __post_init__(self) -> None:
        check_matching(self.match_relations)
        if len(self.query.goals) > 1:
            raise QueryError("several trees are made into one for one goal")


@dataclass(frozen=True, slots=True)
class Dropped:
    """A step of a tree that is left out, where it stands, and why; `unit` is None if it could not be read."""

    tree: str
    source: Source
    fault: Fault
    reason: str
    unit: FunctionalUnit | None = None


@dataclass(frozen=True, slots=True)
class Vote:
    """Something that trees are for, and how many of them."""

    node: ObjectNode
    trees: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SampleReport:
    """What one of the trees is worth by itself, in the same kitchen and for the same goal.

    `steps` it has, of which `dropped` are left out. `whole` is what it costs as it stands, with all steps;
    None if it cannot be executed or does not make the goal. `alone` is the best tree of its own sound steps.
    """

    name: str
    steps: int
    dropped: int
    whole: Costs | None
    alone: Answer


@dataclass(frozen=True, slots=True)
class Backing:
    """The trees that have a step, and where."""

    trees: tuple[str, ...]
    sources: tuple[Source, ...]


@dataclass(frozen=True, slots=True, repr=False)
class Consolidation(Answered):
    """One tree made of several; it is true if there is one that can be executed.

    `answer` is the best tree, proven, or why there is none; `backing` says of each of its units which trees
    have it. `votes` are what the trees are for, the goal first. `dropped` steps were left out; `reworded`
    words are written otherwise. `foon` has all steps, these too; `world` is that of the sound ones.
    `unpriced` are motions without a cost, which count as the dearest. `explanation` says what is missing
    where there is no tree.
    """

    world: World
    foon: Foon
    samples: tuple[SampleReport, ...]
    backing: Mapping[UnitId, Backing]
    votes: tuple[Vote, ...]
    dropped: tuple[Dropped, ...]
    reworded: tuple[Reworded, ...]
    unpriced: tuple[str, ...]
    explanation: Explanation | None
    seconds: float

    def __repr__(self) -> str:
        return f"<Consolidation: {counted(len(self.samples), 'tree')}, {self.answer!r}>"

    def __str__(self) -> str:
        from foon_asp.render.consolidate import consolidation_text

        return consolidation_text(self).rstrip()

    @property
    def goal(self) -> ObjectNode:
        """What the tree is for."""
        return self.answer.goal

    @property
    def kitchen(self) -> tuple[ObjectNode, ...]:
        """What is at hand."""
        return self.world.kitchen.objects

    @property
    def best_alone(self) -> SampleReport | None:
        """The one of the trees whose own sound steps make the goal best; None if none does."""
        by = self.answer.query.objective.complete
        able = [(by.costs(each.alone.costs), each) for each in self.samples if each.alone.costs is not None]
        return min(able, key=lambda pair: pair[0], default=(None, None))[1]

    def to_json(self) -> str:
        """Return what the command writes with `--format json`."""
        return dumps(consolidation_json(self))

    def to_frame(self) -> pd.DataFrame:
        """Return the steps, a row each, with their support: in how many trees they are, and in which."""
        from foon_asp.render.consolidate import consolidation_frame

        return consolidation_frame(self)


def consolidate_trees(trees: Trees, asked: ConsolidateQuery) -> Consolidation:
    """Make one tree of several.

    Raises `QueryError` if there is no step at all, or nothing that the trees know has the name of the goal.
    """
    started = time.perf_counter()
    samples = read_samples(trees, _words(asked), asked.measure)
    if not samples.foon.units:
        raise QueryError("there is no step in these trees that can be read")
    with limited(asked.query.time_limit, asked.query.memory_limit):
        made = _Consolidator(samples, asked).made()
    return replace(made, seconds=time.perf_counter() - started)


def _words(asked: ConsolidateQuery) -> Words:
    """Return the words of models and of what motions cost."""
    words = {
        aspect: dict.fromkeys(word for order in orders for word in order)
        for aspect, orders in asked.orders.items()
    }
    labels = dict.fromkeys(label for node in asked.kitchen.objects for label in node.named_labels)
    states = dict.fromkeys(name for node in asked.kitchen.objects for name in node.plain_states)
    return Words(
        tuple(words.get("location", {}) | labels),
        tuple(words.get("state", {}) | states),
        tuple(words.get("motion", {}) | dict.fromkeys(asked.kitchen.costs)),
    )


class _Consolidator:
    """Several trees in the same words, on their way to one."""

    def __init__(self, samples: Samples, asked: ConsolidateQuery) -> None:
        self._samples = samples
        self._asked = asked
        self._write = samples.alignment.rewriter()
        self._kitchen, self.unpriced = self._priced()
        world = self._seen(samples.foon, self._kitchen)
        if not asked.kitchen.stated:
            taken = tuple(map(world.node, taken_from_kitchen(world)))
            self._kitchen = replace(self._kitchen, objects=taken, stated=True)
        elif asked.kitchen.labels:
            self._kitchen = replace(self._kitchen, objects=world.kitchen.objects, labels=())
        # All steps, also those that are dropped: what one of them makes is not at hand for that.
        self._world = self._seen(samples.foon, self._kitchen)

    def _seen(self, foon: Foon, kitchen: Kitchen) -> World:
        asked = self._asked
        return World.of(foon, kitchen, strict=asked.strict, match_relations=asked.match_relations)

    def _priced(self) -> tuple[Kitchen, tuple[str, ...]]:
        """Return the kitchen in the words of the trees, and the motions without a cost of their own."""
        given, write, foon = self._asked.kitchen, self._write, self._samples.foon
        costs = {write.motion(motion): cost for motion, cost in given.costs.items()}
        # The words of the table itself are the likelier ones.
        costs |= {motion: cost for motion, cost in given.costs.items() if write.motion(motion) == motion}
        unpriced = (
            tuple(each for each in foon.motions if each.rstrip("*").rstrip() not in costs) if costs else ()
        )
        default = given.default_cost
        vessels = frozenset(vessel for node in foon.objects for vessel in node.containers)
        kitchen = replace(
            given,
            objects=tuple(dict.fromkeys(map(write.node, given.objects))),
            labels=tuple(map(write.label, given.labels)),
            utensils=frozenset(map(write.label, given.utensils)) | vessels,
            costs=costs,
            default_cost=max(costs.values()) if costs and default is None else default,
            quantities={},
        )
        return kitchen, unpriced if default is None else ()

    def made(self) -> Consolidation:
        """Return the one tree."""
        asked, world = self._asked, self._world
        dropped, kept = self._sorted_out()
        union = foon_of(self._samples.foon, sorted({unit for units in kept for unit in units}))
        votes = self._votes(self._seen(union, self._kitchen))
        goal = find_object(world, asked.query.goals[0]) if asked.query.goals else votes[0].node
        query = asked.query.replace(
            goals=[goal], by=asked.query.by or self._default_objective, time_limit=None
        )
        seen = self._seen(_knowing(union, goal), self._kitchen)
        answer = retrieve(seen, query)
        reports = tuple(
            self._report(sample, units, query)
            for sample, units in zip(self._samples.trees, kept, strict=True)
        )
        return Consolidation(
            answer,
            seen,
            self._samples.foon,
            reports,
            self._backing(kept),
            tuple(sorted(votes, key=lambda vote: vote.node != goal)),
            tuple(dropped),
            self._samples.reworded,
            self.unpriced,
            explain(seen, query) if answer.status is Status.UNREACHABLE else None,
            0.0,
        )

    @property
    def _default_objective(self) -> Objective:
        kitchen = self._kitchen
        return COST if kitchen.costs or kitchen.default_cost is not None else UNITS

    def _sorted_out(self) -> tuple[list[Dropped], list[list[UnitId]]]:
        """Return the steps that are left out, and the units of each tree that stay."""
        trees = self._samples.trees
        refused: defaultdict[int, list[Refusal]] = defaultdict(list)
        for refusal in refusals(self._world, [sample.units for sample in trees], self._models()):
            refused[refusal.step].append(refusal)
        dropped = list(_unread(trees))
        kept: list[list[UnitId]] = []
        number = 0
        for sample in trees:
            kept.append([])
            for unit, source in zip(sample.units, sample.sources, strict=True):
                faults = [self._incomplete(unit), *(self._refused(each) for each in refused[number])]
                number += 1
                said = [fault for fault in faults if fault is not None]
                if said:
                    [(fault, _), *_] = said
                    reason = "; ".join(text for _, text in said)
                    dropped.append(Dropped(sample.name, source, fault, reason, self._world.foon.units[unit]))
                else:
                    kept[-1].append(unit)
        return dropped, kept

    def _incomplete(self, unit: UnitId) -> tuple[Fault, str] | None:
        world = self._world
        if not world.foon.units[unit].inputs:
            return "incomplete", "it takes nothing"
        if not world.foon.units[unit].outputs:
            return "incomplete", "it brings about nothing"
        if not world.units.makes[unit]:
            return "incomplete", "nothing is said of the state of what it brings about"
        return None

    def _refused(self, refusal: Refusal) -> tuple[Fault, str]:
        """Say what is wrong with a transition."""
        orders = self._models().orders[refusal.aspect]
        earlier = {word for order in orders for word in _earlier(order, refusal.word, self._asked.adjacent)}
        known = f"which comes after {shortened(sorted(earlier), 6)}" if earlier else "which is a beginning"
        return refusal.aspect, f"{refusal.label}: {_SAID[refusal.aspect]} {refusal.word!r}, {known}"

    def _models(self) -> Models:
        """Return the models in the words of the trees."""
        write = self._write
        ways = {"state": write.state, "location": write.label, "motion": write.motion}
        orders = self._asked.orders
        return Models(
            {
                aspect: tuple(tuple(map(ways[aspect], order)) for order in orders.get(aspect, ()))
                for aspect in ASPECTS
            },
            self._asked.adjacent,
        )

    def _votes(self, sound: World) -> list[Vote]:
        """Return what the trees are for, the goal first.

        What is not at hand already comes before all else. What most trees are for wins; next what the sound
        steps of all can make, what is no utensil, what has the label that most trees are for, and what stands
        first.
        """
        world, utensils = self._world, self._kitchen.utensils
        voters: defaultdict[ObjectNode, list[str]] = defaultdict(list)
        for sample in self._samples.trees:
            for number in _purpose(world, sample):
                voters[world.node(number)].append(sample.name)
        labels = Counter(node.label for node, names in voters.items() for _ in names)
        made = {sound.node(number) for number in sound.closure.available}

        def worth(vote: Vote) -> tuple[bool, int, bool, bool, int]:
            node = vote.node
            at_hand = world.id_of(node) in world.stock
            return not at_hand, len(vote.trees), node in made, node.label not in utensils, labels[node.label]

        votes = [Vote(node, tuple(names)) for node, names in voters.items()]
        if not votes and not self._asked.query.goals:
            raise QueryError("no step of these trees makes anything; name a goal with --goal")
        return sorted(votes, key=worth, reverse=True)

    def _report(self, sample: Sample, units: Sequence[UnitId], query: Query) -> SampleReport:
        """Say what one tree is worth by itself."""
        world, [goal] = self._world, query.nodes
        every = set(sample.units)
        whole = TaskTree.of(world, [world.id_of(goal)], every)
        alone = self._seen(_knowing(foon_of(world.foon, sorted(set(units))), goal), self._kitchen)
        return SampleReport(
            sample.name,
            len(sample.units),
            len(sample.units) - len(units),
            whole.costs if whole.executable else None,
            retrieve(alone, query),
        )

    def _backing(self, kept: Sequence[Sequence[UnitId]]) -> dict[UnitId, Backing]:
        """Return for each unit of the one FOON the trees that have it, and where."""
        places: defaultdict[UnitId, dict[str, list[Source]]] = defaultdict(dict)
        numbers = {
            number: place for place, number in enumerate(sorted({unit for units in kept for unit in units}))
        }
        for sample, units in zip(self._samples.trees, kept, strict=True):
            for unit, source in zip(sample.units, sample.sources, strict=True):
                if unit in units:
                    places[UnitId(numbers[unit])].setdefault(sample.name, []).append(source)
        return {
            unit: Backing(tuple(by), tuple(source for each in by.values() for source in each))
            for unit, by in places.items()
        }


def taken_from_kitchen(world: World) -> list[ObjectId]:
    """Return what units need and no other one makes, and utensils with nothing in them, in file order.

    A unit that lists a thing again behind its motion makes it of itself alone.
    """
    needs, makers = world.units.needs, world.units.makers

    def made(need: ObjectId) -> bool:
        return need in makers and any(need not in needs[unit] for unit in makers[need])

    needed = dict.fromkeys(need for unit in world.foon.units.ids for need in needs[unit])
    return [need for need in needed if not made(need) or is_raw(world, need)]


def _purpose(world: World, sample: Sample) -> list[ObjectId]:
    """Return what a tree is for: what it marks and makes, else what its last step makes anew."""
    needs, makes = world.units.needs, world.units.makes
    fresh = [[number for number in makes[unit] if number not in needs[unit]] for unit in sample.units]
    marked = [number for node in sample.goals if any((number := world.id_of(node)) in each for each in fresh)]
    return marked or next((each for each in reversed(fresh) if each), [])


def foon_of(foon: Foon, units: Iterable[UnitId]) -> Foon:
    """Return a FOON of some units of another one, in their order, each once."""
    builder = FoonBuilder()
    for unit in (foon.units[number] for number in units):
        before, behind = (
            [builder.object(foon.objects[port]) for port in side] for side in (unit.inputs, unit.outputs)
        )
        builder.unit(unit.motion, before, behind, unit.annotation)
    return builder.build()


def _knowing(foon: Foon, goal: ObjectNode) -> Foon:
    """Return a FOON that knows a goal, whether or not a unit of it does."""
    builder = FoonBuilder()
    builder.include(foon)
    builder.object(goal)
    return builder.build()


def _unread(samples: Iterable[Sample]) -> Iterator[Dropped]:
    """Yield what could not be read, each once: a file with several trees has its findings for all of them."""
    told: set[Finding] = set()
    for sample in samples:
        for finding in sample.listing.findings:
            if finding.severity is Severity.ERROR and finding not in told:
                told.add(finding)
                yield Dropped(sample.name, Source(finding.file, finding.line), "unreadable", finding.message)


def _earlier(order: Sequence[str], word: str, adjacent: bool) -> Iterator[str]:
    """Yield the words of an order that lead to a word."""
    for place, each in enumerate(order):
        if each == word:
            yield from order[max(0, place - 1) : place] if adjacent else order[:place]


_SAID: Mapping[Aspect, str] = {
    "state": "it becomes",
    "location": "it comes to",
    "motion": "the next motion is",
}
"""How a transition is said."""
