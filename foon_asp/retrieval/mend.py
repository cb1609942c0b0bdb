"""The fewest edits after which a task tree can be executed: `encodings/retrieval/mend.lp`, replayed.

Where objects are used up it is `mend_in_order.lp`, in the same folder.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, cast

from foon_asp import limits
from foon_asp.asp.facts import facts, mend_facts
from foon_asp.asp.model import Model
from foon_asp.asp.program import OPTIMISE
from foon_asp.asp.solver import open_solver
from foon_asp.errors import InternalError
from foon_asp.limits import Limit, LimitReachedError
from foon_asp.model.consumption import Effects
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, Source, UnitId
from foon_asp.model.reachability import forward
from foon_asp.model.supply import Supply
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.retrieval.variants import Variants, all_variants

Kind = Literal["move", "insert", "remove", "change"]
Side = Literal["input", "output"]

_MOST = 2
"""How many edits are allowed at first, and twice as many each time that so many do not do."""

_ALL = 1 << 30
"""More edits than there can be any use for."""

MOST_TRIED = 16
"""How many edits are allowed at last where objects are used up and steps may be inserted again and again."""

_IN_ORDER = (*OPTIMISE, "--opt-usc-shrink=bin")
"""Steps compete for times: cores that are made small prove that best, as in planning."""


@dataclass(frozen=True, slots=True)
class Edit:
    """One edit of a tree; `cost` is how many it counts as: one for each state or place that is changed.

    `step` is the place of the step in its file, None for one that is inserted, and `to` its place in the
    mended tree, None for one that is removed. `unit` is what it was, or what is inserted. What is changed is
    `before` on a `side`, and becomes `after`.
    """

    kind: Kind
    unit: FunctionalUnit
    step: int | None
    to: int | None
    side: Side | None = None
    before: ObjectNode | None = None
    after: ObjectNode | None = None
    cost: int = 1


@dataclass(frozen=True, slots=True)
class Mending:
    """A tree that can be executed, its units in the order of execution, and the edits that lead there.

    `edits` are None if no edits do. `proven`: there are no fewer, or none at all. Else a `limit` was reached,
    or it takes more than `MOST_TRIED` edits, if any do.
    """

    edits: tuple[Edit, ...] | None
    foon: Foon
    units: tuple[UnitId, ...]
    proven: bool
    limit: Limit | None = None

    @property
    def cost(self) -> int:
        """How many edits there are."""
        return sum(edit.cost for edit in self.edits or ())

    @property
    def functional_units(self) -> list[FunctionalUnit]:
        """The units of the mended tree."""
        return [self.foon.units[unit] for unit in self.units]


@dataclass(frozen=True, eq=False)
class _MendProblem(Problem):
    """A problem with the known units that may be inserted, and all that steps may list."""

    listed: tuple[ObjectId, ...] = ()

    @cached_property
    def objects(self) -> list[ObjectId]:
        """Ids of the objects given to the solver, sorted."""
        known = Problem(self.world, self.goals, among=self.among).objects
        return sorted({*known, *self.listed, *map(self.world.units.read, self.listed)})


@dataclass(frozen=True, slots=True)
class _Slice:
    """What may be done with so many edits at most."""

    variants: tuple[tuple[ObjectId, ObjectId, int], ...]
    inserts: tuple[UnitId, ...]


def mend(effects: Effects, known: int, units: Sequence[UnitId], goals: Collection[ObjectId]) -> Mending:
    """Return the fewest edits after which units can be executed from the kitchen in order, and make goals.

    A step is moved or removed; one of the first `known` units of the FOON is inserted; a state or place of a
    node is changed, so that it becomes one that the FOON or the kitchen has. A goal that was made may be used
    up by a later step.
    """
    tree = _Tree(effects, known, units, goals)
    model = _fewest(tree, _MOST, timed=False)
    found = _Mender(tree, model).mending()
    if found is None and effects.semantics != "add":
        # What can be executed if objects are used up can be executed if none are: fewer edits do not do.
        model = _fewest(tree, max(_MOST, *model.costs[:1]), timed=True)
        found = _Mender(tree, model).mending()
    if found is None:
        raise InternalError("a mended tree fails its replay")
    return found


def _fewest(tree: _Tree, most: int, *, timed: bool) -> Model:
    """Return the best edits, at first so many at most; no atoms if no edits do, or none were found."""
    best, before = Model(None, False), None
    while True:
        try:
            allowed = tree.slice(most, timed=timed)
            if timed or allowed != before:
                model = tree.solved(allowed, most if timed else None)
        except LimitReachedError as error:
            if best.atoms is None:
                raise
            return replace(best, proven=False, limit=error.limit)
        if not model.proven:
            # Nothing was weighed as yet, where there are no costs.
            better = best.atoms is None or () < model.costs < best.costs
            return replace(model if better else best, proven=False, limit=model.limit)
        # With more edits than these something else might be done, and that would be more edits.
        if model.atoms is not None and model.costs[0] <= most:
            return model
        # If nothing can be inserted, no more times are needed than for each step to be moved.
        enough = not timed or (not allowed.inserts and most >= len(tree.units))
        if model.atoms is None and enough and allowed == tree.slice(_ALL, timed=timed):
            return model
        if model.atoms is None and timed and most >= MOST_TRIED:
            return replace(model, proven=False)
        best, before = model, allowed
        most = 2 * most if model.atoms is None else model.costs[0]


def edit_rows(mending: Mending, sources: Sequence[Source]) -> list[str]:
    """Write each edit in a line, with the place where its step stands, or the unit that is inserted."""
    rows = []
    for edit in mending.edits or ():
        source = edit.unit.source if edit.step is None else sources[edit.step - 1]
        rows.append((f"{source}: " if source.file else "") + _edit_text(edit))
    return rows


def _edit_text(edit: Edit) -> str:
    name = f"step {edit.step} ({edit.unit.motion})"
    if edit.kind == "insert":
        return f"insert {edit.unit.motion} as step {edit.to}"
    if edit.kind == "move":
        return f"move {name} to place {edit.to}"
    if edit.kind == "remove":
        return f"remove {name}"
    what = "takes" if edit.side == "input" else "makes"
    times = f", {edit.cost} changes" if edit.cost > 1 else ""
    return f"change what {name} {what}: {edit.before} becomes {edit.after}{times}"


@dataclass(frozen=True, eq=False)
class _Tree:
    """A tree that is to be mended, and the question what are the fewest edits."""

    effects: Effects
    known: int
    units: Sequence[UnitId]
    goals: Collection[ObjectId]

    @property
    def world(self) -> World:
        return self.effects.world

    @cached_property
    def variants(self) -> Variants:
        return Variants(self.world)

    def slice(self, most: int, *, timed: bool) -> _Slice:
        """Return what can matter if no more than so many edits are allowed.

        As many units must be inserted before one can be executed as rounds go before it, and as many behind
        it as rounds go by until something that a step lists, or a goal, is made.
        """
        world = self.world
        reading = world.units
        listed = [world.foon.units[unit] for unit in dict.fromkeys(self.units)]
        before = {number for unit in listed for number in unit.inputs}
        behind = {number for unit in listed for number in unit.outputs}
        changed = tuple(all_variants(self.variants, sorted(before | behind), most))
        becomes: dict[ObjectId, set[ObjectId]] = {}
        for one, other, _ in changed:
            becomes.setdefault(one, set()).add(other)
        made, wanted = (
            {reading.read(each) for each in side}.union(*(becomes.get(each, set()) for each in side))
            for side in (behind, before)
        )
        rounds = forward(reading, sorted({*world.stock, *made})).executable
        ahead: dict[UnitId, int] = {}
        fresh = wanted.union(self.goals)
        seen = set(fresh)
        for turn in range(1, most + 1):
            makers = {unit for each in fresh for unit in reading.makers.of(each) if unit < self.known}
            new = {unit for unit in makers if unit not in ahead and rounds.get(unit, most) + turn - 1 <= most}
            new = {unit for unit in new if unit in rounds}
            if not new:
                break
            ahead |= dict.fromkeys(new, turn)
            fresh = {need for unit in new for need in reading.needs[unit]} - seen
            seen |= fresh
        if timed:
            # Something else may be taken or made so that less is used up.
            return _Slice(changed, tuple(sorted(ahead)))
        there = {*world.stock, *made}.union(*(reading.makes[unit] for unit in ahead))
        needed = seen.union(*(reading.needs[unit] for unit in ahead))
        useful = tuple(
            (one, other, cost)
            for one, other, cost in changed
            if (one in before and other in there) or (one in behind and other in needed)
        )
        return _Slice(useful, tuple(sorted(ahead)))

    def solved(self, allowed: _Slice, extra: int | None) -> Model:
        """Ask for the best edits among those that are allowed.

        Where objects are used up, `extra` steps at most are moved or inserted.
        """
        constants: dict[str, str | int] = {"strict": int(self.world.strict)}
        if extra is None:
            solver = open_solver(["retrieval/mend.lp"], self._facts(allowed), constants, OPTIMISE)
        else:
            times = len(self.units) + extra
            constants |= {"semantics": self.effects.semantics, "horizon": times}
            solver = open_solver(["retrieval/mend_in_order.lp"], self._facts(allowed), constants, _IN_ORDER)
            for time in range(1, times + 1):
                solver.ground("step", time)
            solver.ground("whole", times)
        first = solver.first() if limits.limited_now() else None
        best = solver.best()
        return first if best.atoms is None and first is not None and first.atoms is not None else best

    def _facts(self, allowed: _Slice) -> str:
        world = self.world
        base = len(world.foon.units)
        steps = {}
        for place, number in enumerate(self.units, 1):
            unit = world.foon.units[number]
            steps[base + place] = (unit.inputs, unit.outputs)
        listed = {number for sides in steps.values() for side in sides for number in side}
        listed |= {other for _, other, _ in allowed.variants}
        problem = _MendProblem(world, tuple(self.goals), among=allowed.inserts, listed=tuple(sorted(listed)))
        return facts(problem) + mend_facts(steps, allowed.variants)


@dataclass(frozen=True, slots=True)
class _Step:
    """A step of the mended tree: the unit that it was, its sides now, its place in the file or None."""

    unit: FunctionalUnit
    inputs: tuple[ObjectId, ...]
    outputs: tuple[ObjectId, ...]
    place: int | None
    moved: bool = False


class _Mender:
    """Makes the mended tree of a model."""

    def __init__(self, tree: _Tree, model: Model) -> None:
        self._world = tree.world
        self._semantics = tree.effects.semantics
        self._units = tree.units
        self._goals = tree.goals
        self._model = model
        self._base = len(tree.world.foon.units)
        changed = cast(list[tuple[int, Side, ObjectId, ObjectId]], model.rows("changed"))
        self._changes = {(step - self._base, side, one): other for step, side, one, other in changed}

    def _places(self, predicate: str) -> set[int]:
        return {number - self._base for number in self._model.column(predicate)}

    def mending(self) -> Mending | None:
        """Return the tree, replayed; None if that fails. There may be no edits that do."""
        if self._model.atoms is None:
            return Mending(None, self._world.foon, (), self._model.proven, self._model.limit)
        world, removed, moved = self._world, self._places("removed"), self._places("moved")
        done = cast(list[tuple[int, int]], self._model.rows("do"))
        times = {number - self._base: time for number, time in done}
        steps = [
            self._changed(place, world.foon.units[unit], moved=place in moved)
            for place, unit in enumerate(self._units, 1)
            if place not in removed
        ]
        at = [times.get(step.place or 0, 0) for step in steps]
        for number, time in cast(list[tuple[UnitId, int]], self._model.rows("inserted")):
            unit = world.foon.units[number]
            steps.append(_Step(unit, unit.inputs, unit.outputs, None))
            at.append(time)
        foon, ids = _built(world, steps)
        view = World.of(foon, world.kitchen, strict=world.strict, match_relations=world.match_relations)
        tools = frozenset(number for number in view.ids if world.id_of(view.node(number)) in world.lasting)
        effects = Effects(view, self._semantics, tools)
        if self._semantics != "add" and any(tools.intersection(effects.adds(unit)) for unit in ids):
            # What nobody made was no tool any more once it is made.
            return None
        goals = [view.id_of(world.node(goal)) for goal in self._goals]
        for order in (_ordered(view, steps, ids), sorted(range(len(steps)), key=at.__getitem__)):
            if _executable(effects, goals, [ids[each] for each in order]):
                edits = self._edits(steps, order, removed)
                proven, limit = self._model.proven, self._model.limit
                return Mending(edits, foon, tuple(ids[each] for each in order), proven, limit)
        return None

    def _changed(self, place: int, unit: FunctionalUnit, *, moved: bool) -> _Step:
        def side(name: Side, objects: Iterable[ObjectId]) -> tuple[ObjectId, ...]:
            return tuple(self._changes.get((place, name, number), number) for number in objects)

        return _Step(unit, side("input", unit.inputs), side("output", unit.outputs), place, moved)

    def _edits(
        self, steps: Sequence[_Step], order: Sequence[int], removed: Iterable[int]
    ) -> tuple[Edit, ...]:
        """Return all edits in the order of the file, inserted steps last."""
        now = {number: place for place, number in enumerate(order, 1)}
        to = {step.place: now[number] for number, step in enumerate(steps)}
        found = [Edit("remove", self._unit(place), place, None) for place in removed]
        for number, step in enumerate(steps):
            if step.place is None:
                found.append(Edit("insert", step.unit, None, now[number]))
            elif step.moved:
                found.append(Edit("move", step.unit, step.place, now[number]))
        costs = Variants(self._world)
        node = self._world.node
        for (place, side, one), other in self._changes.items():
            cost = dict(costs.of(one, len(node(one).states) + len(node(other).states)))[other]
            found.append(
                Edit("change", self._unit(place), place, to[place], side, node(one), node(other), cost)
            )
        return tuple(
            sorted(found, key=lambda edit: (edit.step or len(self._units) + 1, edit.to or 0, str(edit)))
        )

    def _unit(self, place: int) -> FunctionalUnit:
        return self._world.foon.units[self._units[place - 1]]


def _executable(effects: Effects, goals: Iterable[ObjectId], units: Iterable[UnitId]) -> bool:
    """Replay units from the kitchen: each must have all that it needs, and each goal must be there once."""
    supply = Supply(effects)
    seen = set(supply.at_hand)
    for unit in units:
        if supply.execute(unit):
            return False
        seen |= supply.at_hand
    return seen.issuperset(goals)


def _built(world: World, steps: Iterable[_Step]) -> tuple[Foon, list[UnitId]]:
    """Return a FOON of some steps, and the unit of each."""
    builder = FoonBuilder()
    ids = []
    for step in steps:
        sides = [
            [builder.object(world.node(number)) for number in side] for side in (step.inputs, step.outputs)
        ]
        ids.append(builder.unit(step.unit.motion, sides[0], sides[1], step.unit.annotation)[0])
    return builder.build(), ids


def _ordered(view: World, steps: Sequence[_Step], ids: Sequence[UnitId]) -> list[int]:
    """Return steps, by their numbers, in an order that can be executed; those that stay are as in the file.

    A step that was moved or inserted comes when one that stays lacks what it leads to; else one that was
    moved comes as near to its old place as it can, and the rest at the end.
    """
    needs = [set(view.units.needs[unit]) - view.stock.keys() for unit in ids]
    makes = [set(view.units.makes[unit]) for unit in ids]
    staying = [number for number, step in enumerate(steps) if step.place is not None and not step.moved]
    others = [number for number, step in enumerate(steps) if step.place is None or step.moved]
    there: set[ObjectId] = set()
    order: list[int] = []

    def done(number: int) -> None:
        there.update(makes[number])
        order.append(number)

    def next_of(which: Callable[[int], bool]) -> bool:
        """Do the first of the others that can be done; say whether there was one."""
        ready = next((each for each in others if needs[each] <= there and which(each)), None)
        if ready is not None:
            others.remove(ready)
            done(ready)
        return ready is not None

    for number in staying:
        leads = _leading(needs[number] - there, others, needs, makes)
        while not needs[number] <= there and next_of(leads.__contains__):
            pass
        place = steps[number].place or 0
        while next_of(lambda each, place=place: (steps[each].place or place) < place):  # type: ignore[misc]
            pass
        done(number)
    while next_of(lambda _: True):
        pass
    return [*order, *others]


def _leading(
    wanted: Iterable[ObjectId],
    others: Iterable[int],
    needs: Sequence[Collection[ObjectId]],
    makes: Sequence[Collection[ObjectId]],
) -> set[int]:
    """Return the steps that lead to something wanted."""
    maker: dict[ObjectId, list[int]] = {}
    for other in others:
        for each in makes[other]:
            maker.setdefault(each, []).append(other)
    found: set[int] = set()
    open_ = list(wanted)
    while open_:
        for other in maker.get(open_.pop(), ()):
            if other not in found:
                found.add(other)
                open_ += needs[other]
    return found
