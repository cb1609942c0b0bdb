"""Planning over a FOON as ground steps and facts: what is exported, before it is spelled in any style."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product

from foon_asp.constraints import FREE
from foon_asp.criteria import Level
from foon_asp.effects import Effects
from foon_asp.errors import InternalError, QueryError
from foon_asp.pddl_names import DomainNames, Names, place, plain
from foon_asp.plan import held_in_order
from foon_asp.prices import Prices
from foon_asp.problem import Domain, Problem

UNKNOWN_DURATION = 1
"""The seconds that a step takes if no annotation says how long it took."""


@dataclass(frozen=True, slots=True)
class Fact:
    """Something that is true or not while a plan is executed.

    `there`: object `thing` is at hand. `out`: what is at hand of it was taken out of the kitchen. `left`:
    the kitchen holds `count` more of it. `paid`: the fee `key` is paid.
    """

    kind: str
    thing: int = -1
    count: int = 0
    key: str = ""


@dataclass(frozen=True, slots=True)
class Step:
    """A ground action: a functional unit, or a helper that takes something out (`unit` is None).

    `words` says in lines of text what it does. `cost` is None if nothing is to be minimised.
    """

    name: str
    unit: int | None
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

    domain: Domain
    goals: tuple[int, ...]
    semantics: str
    level: Level | None
    names: Names
    fees: dict[str, str]
    used_names: DomainNames
    steps: tuple[Step, ...]
    initially: tuple[Fact, ...]
    wanted: tuple[Fact, ...]

    @property
    def things(self) -> list[int]:
        """The objects that the facts are about, sorted."""
        return sorted(set(self.names.objects.values()))

    @property
    def facts(self) -> dict[Fact, None]:
        """Every fact that matters, in the order in which they come up."""
        found = dict.fromkeys((*self.initially, *self.wanted))
        for step in self.steps:
            found.update(dict.fromkeys((*step.needs, *step.adds, *step.deletes)))
        return found


def exported_units(problem: Problem, effects: Effects) -> list[int]:
    """Return the units that an export holds, in file order.

    Where things are used up, what makes a thing that the kitchen counts matters, too. If a goal cannot be
    reached, all units that lead to it are there, so that a planner sees for itself that there is no plan.
    """
    domain = problem.domain
    if problem.whole:
        return list(range(len(domain.foon.units)))
    closure = domain.closure
    reachable = problem.founded and all(goal in closure.available for goal in problem.goals)
    allowed = closure.executable if reachable else None
    return domain.reading.backward(problem.goals, effects.endless, allowed)


def planning_task(problem: Problem, effects: Effects, level: Level | None = None) -> Task:
    """Spell a problem out as ground steps, with costs if a level is given.

    Raises `QueryError` for criteria that are no sum over steps, and for constraints: PDDL has no place for
    them.
    """
    if problem.constraints != FREE:
        raise QueryError("PDDL has no place for constraints on a task tree; export without them")
    if effects.domain is not problem.domain:
        raise InternalError("the effects are those of another domain")
    return _Builder(problem, effects, level).task()


class _Builder:
    def __init__(self, problem: Problem, effects: Effects, level: Level | None) -> None:
        self.problem = problem
        self.domain = problem.domain
        self.effects = effects
        self.level = level
        self.units = exported_units(problem, effects)
        self.prices = None if level is None else Prices.of(problem, level, self.units)
        gone = {thing for unit in self.units for thing in effects.deletes(unit)}
        # What the kitchen counts but nothing uses up is as good as endless.
        self.counted = {thing: many for thing, many in effects.counted.items() if thing in gone}
        made = {thing for unit in self.units for thing in effects.adds(unit)}
        self.mixed = self.counted.keys() & made
        self.at_hand = self.domain.stock.keys() - self.counted.keys()
        self.naming = DomainNames.of(self.domain)

    def task(self) -> Task:
        domain, effects = self.domain, self.effects
        things = set(self.problem.goals)
        for unit in self.units:
            things.update(effects.needs(unit), effects.adds(unit), effects.deletes(unit))
        order = sorted(things)
        # Names that depend on the goal come last, so that they change none of the others.
        fees = self._fees()
        steps = [self._unit(unit, missing) for unit in self.units for missing in self._variants(unit)]
        helpers = [self._pay(key) for key in fees]
        for thing in order:
            helpers += self._stock(thing)
        initially = [Fact("there", thing) for thing in order if thing in self.at_hand]
        initially += [Fact("left", thing, self.counted[thing]) for thing in order if thing in self.counted]
        names = Names(
            {self.naming.objects[thing]: thing for thing in order},
            {step.name: step.unit for step in steps if step.unit is not None},
            {step.name: " ".join(step.words) for step in helpers},
            self.problem.goals,
            effects.semantics,
        )
        wanted = tuple(Fact("there", goal) for goal in self.problem.goals)
        return Task(
            domain,
            self.problem.goals,
            effects.semantics,
            self.level,
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
        criterion, _, thing = key.partition(" ")
        start = {"tools": "taken-out", "dirty": "may-get-dirty", "motions": "set-up-for"}[criterion]
        return self.naming.namer.name(f"{start}-{plain(thing)}")

    def _cost(self, paid: int) -> int | None:
        return None if self.prices is None else paid

    def _pay(self, key: str) -> Step:
        criterion, _, thing = key.partition(" ")
        words = {
            "tools": f"Take out {thing}, which the units below handle.",
            "dirty": f"Let {thing} get dirty: it is washed once, however often it is filled.",
            "motions": f"Set up for the motion {thing}.",
        }[criterion]
        start = {"tools": "take-out", "dirty": "dirty", "motions": "set-up"}[criterion]
        name = self.naming.namer.name(f"{start}-{plain(thing)}")
        cost = self.prices.fees[key] if self.prices else 0
        paid = (Fact("paid", key=key),)
        return Step(name, None, (words,), (), paid, (), self._cost(cost), UNKNOWN_DURATION)

    def _stock(self, thing: int) -> list[Step]:
        """Return the steps that take one of a counted object out of the kitchen, and put it back.

        Putting back is for what units make, too: before they make it, so that the kitchen's is not taken for
        the new one.
        """
        steps: list[Step] = []
        there, out = Fact("there", thing), Fact("out", thing)
        text, base = str(self.domain.node(thing)), self.naming.objects[thing]
        present = (there, out) if thing in self.mixed else (there,)
        name, free = self.naming.namer.name, self._cost(0)
        for count in range(self.counted.get(thing, 0), 0, -1):
            more, less = Fact("left", thing, count), Fact("left", thing, count - 1)
            words = (f"Take {text} out of the kitchen, which holds {count}.",)
            take, after = name(f"take-{base}-{count}"), (*present, less)
            steps.append(Step(take, None, words, (more,), after, (more,), free, UNKNOWN_DURATION))
            if thing in self.mixed:
                words = (f"Put {text} back: the kitchen holds {count} again.",)
                back, gone = name(f"return-{base}-{count}"), (there, out, less)
                steps.append(Step(back, None, words, (out, less), (more,), gone, free, UNKNOWN_DURATION))
        return steps

    def _variants(self, unit: int) -> Iterable[tuple[int, ...]]:
        """Yield which counted objects, of those a unit uses up without needing them, there are none of.

        Such an object is an implied view. If there is one left, it is used up; so the unit has two ways.
        """
        needs = self.effects.needs(unit)
        views = [
            thing for thing in self.effects.deletes(unit) if thing in self.counted and thing not in needs
        ]
        for missing in product((False, True), repeat=len(views)):
            yield tuple(thing for thing, none in zip(views, missing, strict=True) if none)

    def _unit(self, unit: int, missing: Sequence[int]) -> Step:
        effects, node = self.effects, self.domain.node
        listed = self.domain.foon.units[unit]
        needs = [Fact("there", thing) for thing in effects.needs(unit)]
        needs += [
            Fact("left", thing, 0) if thing in missing else Fact("there", thing)
            for thing in effects.deletes(unit)
            if thing in self.counted and thing not in effects.needs(unit)
        ]
        adds = [Fact("there", thing) for thing in effects.adds(unit)]
        deletes = [Fact("there", thing) for thing in effects.deletes(unit)]
        # What is made, or gone, is no longer what was taken out of the kitchen.
        changed = (*effects.adds(unit), *effects.deletes(unit))
        deletes += [Fact("out", thing) for thing in changed if thing in self.mixed]
        cost = 0
        if self.prices is not None:
            needs += [Fact("paid", key=key) for key in self.prices.once.get(unit, ())]
            cost = self.prices.per_unit[unit]
        words = [
            f"{place(self.domain, unit)} {listed.motion}".strip(),
            f"take {_listed(node(thing) for thing in effects.needs(unit))}",
            f"get {_listed(node(thing) for thing in effects.adds(unit))}",
        ]
        if effects.deletes(unit):
            words.append(f"use up {_listed(node(thing) for thing in effects.deletes(unit))}")
        name = self.naming.units[unit]
        if missing:
            words.append(f"when there is no {_listed(node(thing) for thing in missing)}")
            name = self.naming.namer.name(f"{name}-without-{'-'.join(map(str, missing))}")
        return Step(
            name,
            unit,
            tuple(words),
            tuple(needs),
            tuple(adds),
            tuple(deletes),
            self._cost(cost),
            listed.duration or UNKNOWN_DURATION,
        )


def executed_steps(task: Task, effects: Effects, units: Iterable[int]) -> list[Step]:
    """Return the steps that execute units in the given order, with the helpers that must come between.

    Fees are paid when they are first due. One of a counted object is taken out when it is needed and none
    is at hand, or wanted, and put back before another is made. Stops short of the first unit that cannot be
    executed.
    """
    true = set(task.initially)
    ways: dict[int, list[Step]] = {}
    helpers: dict[Fact, list[Step]] = {}
    returns: dict[int, list[Step]] = {}
    for step in task.steps:
        if step.unit is not None:
            ways.setdefault(step.unit, []).append(step)
        elif step.adds[0].kind == "left":
            returns.setdefault(step.adds[0].thing, []).append(step)
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
        for thing in effects.adds(unit):
            execute(returns.get(thing, ()))
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


def _listed(nodes: Iterable[object]) -> str:
    return "; ".join(map(str, nodes)) or "nothing"
