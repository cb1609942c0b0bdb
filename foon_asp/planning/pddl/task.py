"""Planning over a FOON as ground steps and facts: what is exported, before it is spelled in any style."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from foon_asp import limits
from foon_asp.errors import InternalError, QueryError
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World
from foon_asp.planning.pddl.names import DomainNames, Names, plain
from foon_asp.planning.plan import Plan, held_in_order
from foon_asp.planning.prices import Prices
from foon_asp.query.constraints import FREE
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from foon_asp.words import short_source

_NO_OBJECT = ObjectId(-1)

_AGAIN = 4
"""How often units are done at most, on the average over all of them, if all costs are to fit into 32 bits."""

UNKNOWN_DURATION = 1
"""The seconds that a step takes if no annotation says how long it took."""


@dataclass(frozen=True, slots=True)
class Fact:
    """Something that is true or not while a plan is executed.

    `there`: object `object_id` is at hand. `out`: what is at hand of it was taken out of the kitchen. `left`:
    the kitchen holds `count` more of it. `paid`: the fee `key` is paid.
    """

    kind: str
    object_id: ObjectId = _NO_OBJECT
    count: int = 0
    key: str = ""


@dataclass(frozen=True, slots=True)
class Step:
    """A ground action: a functional unit, or a helper that takes something out (`unit` is None).

    `words` says in lines of text what it does. `cost` is None if nothing is to be minimised.
    """

    name: str
    unit: UnitId | None
    words: tuple[str, ...]
    needs: tuple[Fact, ...]
    adds: tuple[Fact, ...]
    deletes: tuple[Fact, ...]
    cost: int | None
    duration: int


@dataclass(frozen=True, slots=True)
class Task:
    """All steps of a problem with what is true at first and what is wanted.

    `names` maps steps and objects back; `fees` has the name of the fact for each fee.
    """

    world: World
    goals: tuple[ObjectId, ...]
    semantics: str
    criterion: Criterion | None
    names: Names
    fees: dict[str, str]
    used_names: DomainNames
    steps: tuple[Step, ...]
    initially: tuple[Fact, ...]
    wanted: tuple[Fact, ...]

    @property
    def object_ids(self) -> list[ObjectId]:
        """The objects that the facts are about, sorted."""
        return sorted(set(self.names.objects.values()))

    @property
    def facts(self) -> dict[Fact, None]:
        """Every fact that matters, in the order in which they come up."""
        found = dict.fromkeys((*self.initially, *self.wanted))
        for step in self.steps:
            found.update(dict.fromkeys((*step.needs, *step.adds, *step.deletes)))
        return found


def exported_units(problem: Problem, effects: Effects) -> list[UnitId]:
    """Return the units that an export holds, in file order.

    Where objects are used up, what makes an object that the kitchen counts matters, too. What only gives back
    what it takes does not. If a goal cannot be reached, all units that lead to it are there, so that a
    planner sees for itself that there is no plan.
    """
    world = problem.world
    if problem.whole:
        return list(world.foon.units.ids)
    closure = world.closure
    reachable = problem.founded and all(goal in closure.available for goal in problem.goals)
    allowed = closure.executable if reachable else None
    units = backward(world.units, problem.goals, effects.endless, allowed)
    return [unit for unit in units if effects.makes_a_difference(unit)]


def planning_task(
    problem: Problem,
    effects: Effects,
    criterion: Criterion | None = None,
    seconds: Mapping[UnitId, int] | None = None,
) -> Task:
    """Spell a problem out as ground steps, with costs if a criterion is given.

    `seconds`: how long units take; if that is not given, as long as their videos, or 1.
    Raises `QueryError` for criteria that are no sum over steps, and for constraints: PDDL has no place for
    them.
    """
    if problem.constraints != FREE:
        raise QueryError("PDDL has no place for constraints on a task tree; export without them")
    if effects.world is not problem.world:
        raise InternalError("the effects are those of another domain")
    return _Builder(problem, effects, criterion, seconds or {}).task()


class _Builder:
    def __init__(
        self,
        problem: Problem,
        effects: Effects,
        criterion: Criterion | None,
        seconds: Mapping[UnitId, int],
    ) -> None:
        self.seconds = seconds
        self.problem = problem
        self.world = problem.world
        self.effects = effects
        self.criterion = criterion
        self.units = exported_units(problem, effects)
        self.prices = None if criterion is None else Prices.of(problem, criterion, self.units, _AGAIN)
        gone = {object_id for unit in self.units for object_id in effects.deletes(unit)}
        # What the kitchen counts but nothing uses up is as good as endless.
        self.counted = {object_id: many for object_id, many in effects.counted.items() if object_id in gone}
        made = {object_id for unit in self.units for object_id in effects.adds(unit)}
        self.mixed = self.counted.keys() & made
        self.at_hand = self.world.stock.keys() - self.counted.keys()
        self.naming = DomainNames.of(self.world)

    def task(self) -> Task:
        world, effects = self.world, self.effects
        object_ids = set(self.problem.goals)
        for unit in self.units:
            object_ids.update(effects.needs(unit), effects.adds(unit), effects.deletes(unit))
            object_ids.update(effects.restores(unit))
        order = sorted(object_ids)
        # Names that depend on the goal come last, so that they change none of the others.
        fees = self._fees()
        steps = [step for unit in self.units for step in self._ways(unit)]
        helpers = [self._pay(key) for key in fees]
        for object_id in order:
            helpers += self._stock(object_id)
        initially = [Fact("there", object_id) for object_id in order if object_id in self.at_hand]
        initially += [
            Fact("left", object_id, self.counted[object_id])
            for object_id in order
            if object_id in self.counted
        ]
        names = Names(
            {self.naming.objects[object_id]: object_id for object_id in order},
            {step.name: step.unit for step in steps if step.unit is not None},
            {step.name: " ".join(step.words) for step in helpers},
            self.problem.goals,
            effects.semantics,
        )
        wanted = tuple(Fact("there", goal) for goal in self.problem.goals)
        return Task(
            world,
            self.problem.goals,
            effects.semantics,
            self.criterion,
            names,
            fees,
            self.naming,
            (*helpers, *steps),
            tuple(initially),
            wanted,
        )

    def _fees(self) -> dict[str, str]:
        """Return the name of the fact that each fee is paid."""
        return {} if self.prices is None else {key: self._fee_name(key) for key in self.prices.fees}

    def _fee_name(self, key: str) -> str:
        criterion, _, label = key.partition(" ")
        start = {
            "tools": "taken-out",
            "dirty": "may-get-dirty",
            "motions": "set-up-for",
            "success": "accepted",
        }[criterion]
        return self.naming.namer.name(f"{start}-{plain(label)}")

    def _cost(self, paid: int) -> int | None:
        return None if self.prices is None else paid

    def _pay(self, key: str) -> Step:
        criterion, _, label = key.partition(" ")
        words = {
            "tools": f"Take out {label}, which the units below handle.",
            "dirty": f"Let {label} get dirty: it is washed once, however often it is filled.",
            "motions": f"Set up for the motion {label}.",
            "success": f"Accept {label}: some unit below never succeeds.",
        }[criterion]
        start = {"tools": "take-out", "dirty": "dirty", "motions": "set-up", "success": "accept"}[criterion]
        name = self.naming.namer.name(f"{start}-{plain(label)}")
        cost = self.prices.fees[key] if self.prices else 0
        paid = (Fact("paid", key=key),)
        return Step(name, None, (words,), (), paid, (), self._cost(cost), UNKNOWN_DURATION)

    def _stock(self, object_id: ObjectId) -> list[Step]:
        """Return the steps that take one of a counted object out of the kitchen, and put it back.

        Putting back is for what units make, too: before they make it, so that the kitchen's is not taken for
        the new one.
        """
        steps: list[Step] = []
        there, out = Fact("there", object_id), Fact("out", object_id)
        text, base = str(self.world.node(object_id)), self.naming.objects[object_id]
        present = (there, out) if object_id in self.mixed else (there,)
        name, free = self.naming.namer.name, self._cost(0)
        for count in range(self.counted.get(object_id, 0), 0, -1):
            more, less = Fact("left", object_id, count), Fact("left", object_id, count - 1)
            words = (f"Take {text} out of the kitchen, which holds {count}.",)
            take, after = name(f"take-{base}-{count}"), (*present, less)
            steps.append(Step(take, None, words, (more,), after, (more,), free, UNKNOWN_DURATION))
            if object_id in self.mixed:
                words = (f"Put {text} back: the kitchen holds {count} again.",)
                back, gone = name(f"return-{base}-{count}"), (there, out, less)
                steps.append(Step(back, None, words, (out, less), (more,), gone, free, UNKNOWN_DURATION))
        return steps

    def _ways(self, unit: UnitId) -> list[Step]:
        """Return the steps that stand for a unit, without one that only gives back what is there."""
        steps = [self._unit(unit, missing) for missing in self._variants(unit)]
        return steps if len(steps) == 1 else [step for step in steps if step.adds or step.deletes]

    def _variants(self, unit: UnitId) -> Iterable[tuple[ObjectId, ...]]:
        """Yield which counted objects, of those a unit takes without needing them, there are none of.

        Such an object is an implied view. If there is one left, it is used up, or it is the one that is given
        back; so the unit has two ways.
        """
        views = self._views(unit)
        for missing in product((False, True), repeat=len(views)):
            yield tuple(object_id for object_id, none in zip(views, missing, strict=True) if none)

    def _views(self, unit: UnitId) -> list[ObjectId]:
        needs = self.effects.needs(unit)
        taken = (*self.effects.deletes(unit), *self.effects.restores(unit))
        return [object_id for object_id in taken if object_id in self.counted and object_id not in needs]

    def _brought(self, unit: UnitId, missing: Sequence[ObjectId]) -> list[ObjectId]:
        """Return what is there after a unit, and was not before."""
        restored = self.effects.restores(unit)
        fresh = [object_id for object_id in restored if object_id in missing or object_id not in self.counted]
        return [*self.effects.adds(unit), *fresh]

    def _unit(self, unit: UnitId, missing: Sequence[ObjectId]) -> Step:
        limits.check()
        effects, node = self.effects, self.world.node
        listed = self.world.foon.units[unit]
        needs = [Fact("there", object_id) for object_id in effects.needs(unit)]
        needs += [
            Fact("left", object_id, 0) if object_id in missing else Fact("there", object_id)
            for object_id in self._views(unit)
        ]
        brought = self._brought(unit, missing)
        adds = [Fact("there", object_id) for object_id in brought]
        deletes = [Fact("there", object_id) for object_id in effects.deletes(unit)]
        # What is made, or gone, is no longer what was taken out of the kitchen.
        changed = (*brought, *effects.deletes(unit))
        deletes += [Fact("out", object_id) for object_id in changed if object_id in self.mixed]
        cost = 0
        if self.prices is not None:
            needs += [Fact("paid", key=key) for key in self.prices.once.get(unit, ())]
            cost = self.prices.per_unit[unit]
        words = [
            f"{short_source(listed.source.file, listed.source.line)} {listed.motion}".strip(),
            f"take {_or_nothing(node(object_id) for object_id in effects.needs(unit))}",
            f"get {_or_nothing(node(object_id) for object_id in self.world.units.makes[unit])}",
        ]
        if effects.deletes(unit):
            words.append(f"use up {_or_nothing(node(object_id) for object_id in effects.deletes(unit))}")
        name = self.naming.units[unit]
        if missing:
            words.append(f"when there is no {_or_nothing(node(object_id) for object_id in missing)}")
            name = self.naming.namer.name(f"{name}-without-{'-'.join(map(str, missing))}")
        return Step(
            name,
            unit,
            tuple(words),
            tuple(needs),
            tuple(adds),
            tuple(deletes),
            self._cost(cost),
            self.seconds.get(unit) or listed.duration or UNKNOWN_DURATION,
        )


def executed_steps(task: Task, effects: Effects, units: Iterable[UnitId]) -> list[Step]:
    """Return the steps that execute units in the given order, with the helpers that must come between.

    Fees are paid when they are first due. One of a counted object is taken out when it is needed and none
    is at hand, or wanted, and put back before another is made. Stops short of the first unit that cannot be
    executed.
    """
    true = set(task.initially)
    ways: dict[UnitId, list[Step]] = {}
    helpers: dict[Fact, list[Step]] = {}
    returns: dict[ObjectId, list[Step]] = {}
    for step in task.steps:
        if step.unit is not None:
            ways.setdefault(step.unit, []).append(step)
        elif step.adds[0].kind == "left":
            returns.setdefault(step.adds[0].object_id, []).append(step)
        else:
            helpers.setdefault(step.adds[0], []).append(step)
    done: list[Step] = []

    def execute(steps: Iterable[Step]) -> bool:
        for step in steps:
            if true.issuperset(step.needs):
                true.difference_update(step.deletes)
                true.update(step.adds)
                done.append(step)
                return True
        return False

    for unit in units:
        for object_id in effects.adds(unit):
            execute(returns.get(object_id, ()))
        for step in ways.get(unit, ()):
            for fact in step.needs:
                if fact not in true:
                    execute(helpers.get(fact, ()))
            if execute([step]):
                break
        else:
            return done
    for fact in task.wanted:
        if fact not in true:
            execute(helpers.get(fact, ()))
    return done


def all_steps(plan: Plan, task: Task, effects: Effects) -> list[Step]:
    """Return the steps that execute a plan, with the helpers that it takes.

    Raises `QueryError` if it cannot be executed in this task.
    """
    steps = executed_steps(task, effects, plan.units)
    done = [step.unit for step in steps if step.unit is not None]
    if done != list(plan.units):
        raise QueryError(
            f"step {len(done) + 1} of the plan cannot be executed in this export;"
            " export the same kitchen, semantics and units"
        )
    return steps


def step_orderings(steps: Sequence[Step], initially: Iterable[Fact]) -> list[tuple[int, int]]:
    """Return pairs of places: the first step must be executed before the second.

    As `plan.orderings`, with helpers and the facts that they are about. What is true at first and never
    deleted orders nothing.
    """
    deleted = {fact for step in steps for fact in step.deletes}
    lasting = set(initially) - deleted
    needs = [set(step.needs) - lasting for step in steps]
    adds = [set(step.adds) - lasting for step in steps]
    return held_in_order(needs, adds, [set(step.deletes) for step in steps])


def _or_nothing(nodes: Iterable[object]) -> str:
    return "; ".join(map(str, nodes)) or "nothing"
