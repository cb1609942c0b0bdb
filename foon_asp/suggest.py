"""What can be cooked from this kitchen, the best dishes first."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass

from foon_asp.constraints import FREE, Constraints
from foon_asp.criteria import Costs, Level, parse_by
from foon_asp.decode import decode_tree
from foon_asp.facts import quote
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.program import all_levels, optimisers, too_deep
from foon_asp.retrieve import check_constraints, check_labels, check_levels, check_method
from foon_asp.solve import Answer, Solver
from foon_asp.state_syntax import clean
from foon_asp.tree import TaskTree

_BATCH = 300
"""How many units are grounded at once, unless one dish needs about as many: fewer are grounded too often,
and among more the solver gets slow."""

_PATIENCE = 1.0
"""How many seconds a dish has in a batch. Core-guided optimisation takes long where luck is bad, so what is
not solved by then is asked again alone."""


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A dish and its best task tree, proven and replayed, with what it costs."""

    dish: ObjectNode
    tree: TaskTree
    costs: Costs


@dataclass(frozen=True, slots=True)
class Suggestions:
    """The dishes, the best first, those that are equally good by name.

    `candidates` is how many dishes there are, whatever the constraints and ingredients. What is `skipped`
    was not solved before the time ran out: any of these might be among the dishes, too. `seconds` is wall
    time.
    """

    by: tuple[str, ...]
    using: tuple[str, ...]
    constraints: Constraints
    dishes: tuple[Suggestion, ...]
    candidates: int
    skipped: int
    seconds: float


def suggest(
    domain: Domain,
    goals: Iterable[ObjectNode] = (),
    by: str | Sequence[str] = (),
    *,
    using: Iterable[str] = (),
    everything: bool = False,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Suggestions:
    """Suggest what to cook: dishes as `find_dishes` has them, ranked by what their best trees cost.

    `by` is as for the method `optimal`. With `using` only dishes that are made with all these labels: for
    each label, the steps of the tree that take it, as an input, its contents or what it is in, are ones
    without which the other steps do not make the dish; and of such trees it is the best. `time_limit` is in
    seconds, for all dishes together. Raises `QueryError`.
    """
    started = time.perf_counter()
    deadline = None if time_limit is None else time.monotonic() + time_limit
    by = check_method("optimal", by, True, constraints)
    levels = parse_by(by)
    check_constraints(domain, "optimal", constraints)
    check_levels(Problem(domain, (), whole=True), by)
    takers = _takers(domain, using)
    candidates = find_dishes(domain, goals, everything=everything)
    search = _Search(domain, levels, tuple(takers), constraints, deadline)
    dishes = _made_with(domain, takers, candidates)
    if any("time" in level.names for level in levels):
        dishes = [dish for dish in dishes if _timed(search.problem(dish))]
    found: list[Suggestion] = []
    skipped = 0
    for dish, answer in search.answers(dishes):
        if not answer.proven:
            skipped += 1
        elif answer.atoms is not None:
            tree = decode_tree(search.problem(dish), answer)
            found.append(Suggestion(domain.node(dish), tree, tree.costs))
    found.sort(key=lambda each: (_key(each.costs, levels), str(each.dish)))
    seconds = time.perf_counter() - started
    return Suggestions(by, tuple(takers), constraints, tuple(found), len(candidates), skipped, seconds)


def find_dishes(domain: Domain, goals: Iterable[ObjectNode] = (), *, everything: bool = False) -> list[int]:
    """Return the ids of all dishes that the kitchen can make and does not have already.

    Dishes are the goals, what the annotators marked as a goal, and the end products. With `everything` they
    are all that can be made.
    """
    makeable = [thing for thing in domain.closure.available if thing not in domain.stock]
    if everything:
        return makeable
    named = (domain.foon.id_of(node) for node in (*map(domain.project, goals), *domain.foon.marked_goals()))
    can_be_made = set(makeable)
    return list(
        dict.fromkeys([*(thing for thing in named if thing in can_be_made), *_end_products(domain, makeable)])
    )


def _end_products(domain: Domain, makeable: Iterable[int]) -> list[int]:
    """Return what can be made, is food, and that no unit takes any further.

    No end product is an empty utensil, nor a thing in something that is no utensil: it is a part of that.
    Units list what they make from all sides. `salt in [pot]`, of which no more is said, is no end product if
    `pot {salt, water}` is taken further; and `pot {soup}` is none beside `soup in [pot]`.
    """
    objects, utensils = domain.foon.objects, domain.kitchen.utensils
    taken = {thing for unit in domain.foon.units for thing in unit.inputs}

    def food(node: ObjectNode) -> bool:
        if node.label in utensils and not any(state.contents for state in node.states):
            return False
        return not utensils or utensils.issuperset(node.containers)

    def in_place(node: ObjectNode, vessel: ObjectNode) -> bool:
        places = (state.relatum for state in node.states)
        return node.label in vessel.contents and vessel.label in places

    def shown_by(thing: int, other: int) -> bool:
        node, side = objects[thing], objects[other]
        view = node.label in utensils and len(set(node.contents)) == 1 and in_place(side, node)
        return view or (other in taken and in_place(node, side))

    def goes_on(thing: int, unit: int) -> bool:
        return any(shown_by(thing, other) for other in domain.foon.units[unit].outputs)

    ends = [thing for thing in makeable if thing not in taken and food(objects[thing])]
    makers = {
        thing: [unit for unit in domain.reading.makers[thing] if unit in domain.closure.executable]
        for thing in ends
    }
    return [thing for thing in ends if not all(goes_on(thing, unit) for unit in makers[thing])]


def _takers(domain: Domain, using: Iterable[str]) -> dict[str, set[int]]:
    """Return for each label the units that take it, by label, contents or relatum of an input."""
    labels = dict.fromkeys(clean(label) for label in using)
    if not labels:
        return {}
    check_labels(domain, labels)
    named = [set(node.named_labels) for node in domain.foon.objects]
    units = domain.foon.units
    return {
        label: {unit.id for unit in units if any(label in named[thing] for thing in unit.inputs)}
        for label in labels
    }


def _made_with(domain: Domain, takers: dict[str, set[int]], dishes: Collection[int]) -> list[int]:
    """Return the dishes to which units that take each of the labels can contribute."""
    for units in takers.values():
        reached = _downstream(domain, units)
        dishes = [dish for dish in dishes if dish in reached]
    return list(dishes)


def _downstream(domain: Domain, units: Iterable[int]) -> set[int]:
    """Return all that some units, and the units behind them, make and the kitchen does not have."""
    reading, executable = domain.reading, domain.closure.executable
    open_ = [unit for unit in units if unit in executable]
    seen = set(open_)
    found: set[int] = set()
    while open_:
        for thing in reading.makes[open_.pop()]:
            if thing in found or thing in domain.stock:
                continue
            found.add(thing)
            for user in reading.users.of(thing):
                if user in executable and user not in seen:
                    seen.add(user)
                    open_.append(user)
    return found


def _timed(problem: Problem) -> bool:
    """Say whether anything is known of the time that a dish takes."""
    units = problem.domain.foon.units
    return any(units[unit].duration for unit in problem.units)


@dataclass(frozen=True, slots=True)
class _Search:
    """What is asked of every dish."""

    domain: Domain
    levels: tuple[Level, ...]
    using: tuple[str, ...]
    constraints: Constraints
    deadline: float | None

    def problem(self, *dishes: int) -> Problem:
        return Problem(self.domain, dishes, constraints=self.constraints)

    def answers(self, dishes: Sequence[int]) -> Iterator[tuple[int, Answer]]:
        """Yield for each dish the best tree that uses all labels; not proven if the time ran out."""
        names = {name for level in self.levels for name in level.names}
        alone: list[int] = []
        if "depth" in names or self.constraints.max_depth is not None:
            # Rounds are told apart for every object: the smallest programs are the quickest.
            alone += dishes
        else:
            for batch in self._batches(dishes):
                for dish, answer in self._together(batch):
                    if answer.proven:
                        yield dish, answer
                    else:
                        alone.append(dish)
        for dish in alone:
            yield dish, self._alone(dish)

    def _batches(self, dishes: Iterable[int]) -> Iterator[list[int]]:
        """Yield dishes that mostly need the same units, together."""
        slices = {dish: self.problem(dish).units for dish in dishes}
        batch: list[int] = []
        units: set[int] = set()
        room = 0
        for dish in sorted(slices, key=slices.__getitem__):
            if len(units.union(slices[dish])) > room:
                if batch:
                    yield batch
                batch, units = [], set()
                room = max(_BATCH, 5 * len(slices[dish]) // 4)
            batch.append(dish)
            units.update(slices[dish])
        if batch:
            yield batch

    def _together(self, dishes: Sequence[int]) -> Iterator[tuple[int, Answer]]:
        """Ground once what can matter for any of some dishes, and ask for one after the other."""
        if self._late():
            yield from ((dish, Answer(None, False)) for dish in dishes)
            return
        all_goals, no_goal = self.problem(*dishes), self.problem()
        no_goal.units, no_goal.objects = all_goals.units, all_goals.objects
        control = next(self._optimisers(no_goal, "".join(f"#external goal({dish}).\n" for dish in dishes)))
        for dish in dishes:
            control.switch("goal", dish, True)
            patience = time.monotonic() + _PATIENCE
            yield (
                dish,
                self._best(control, patience if self.deadline is None else min(patience, self.deadline)),
            )
            control.switch("goal", dish, False)

    def _alone(self, dish: int) -> Answer:
        answer = Answer(None, False)
        if not self._late():
            for control in self._optimisers(self.problem(dish)):
                answer = self._best(control, self.deadline)
                if not too_deep(answer):
                    break
        return answer

    def _late(self) -> bool:
        return self.deadline is not None and time.monotonic() >= self.deadline

    def _best(self, control: Solver, deadline: float | None) -> Answer:
        """Return the best answer; whether there is one at all is quick to know if nothing is optimised."""
        if not self._late() and (self.using or self.constraints != FREE):
            first = control.first()
            if first.atoms is None:
                return first
        return control.best(deadline)

    def _optimisers(self, problem: Problem, extra_facts: str = "") -> Iterator[Solver]:
        encodings = ("suggest.lp",) if self.using else ("task_tree.lp",)
        extra_facts += "".join(f"using({quote(label)}).\n" for label in self.using)
        return optimisers(problem, all_levels(self.levels), encodings=encodings, extra_facts=extra_facts)


def _key(costs: Costs, levels: Sequence[Level]) -> list[float]:
    # Chances are products of floating-point numbers: the last digits depend on the order.
    return [round(level.cost(costs), 9) for level in levels]
