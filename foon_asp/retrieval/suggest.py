"""What can be cooked from this kitchen, the best dishes first."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from foon_asp.asp.model import Model
from foon_asp.asp.program import optimisers, too_deep
from foon_asp.asp.solver import Solver
from foon_asp.asp.terms import quote
from foon_asp.errors import QueryError
from foon_asp.io.syntax import clean
from foon_asp.io.wire import dumps
from foon_asp.limits import Limit, LimitReachedError, check, limited, reached
from foon_asp.model.node import ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.checks import check_labels, check_objective, refuse_substitution
from foon_asp.query.method import Method
from foon_asp.query.objective import Costs
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.query.tariff import tariffs
from foon_asp.retrieval.decode import decode_tree
from foon_asp.retrieval.methods.found import NOTHING, Found
from foon_asp.retrieval.methods.optimal import optimal
from foon_asp.retrieval.tree import TaskTree
from foon_asp.retrieval.wire import suggestions_json
from foon_asp.values import a_list, said

if TYPE_CHECKING:
    import pandas as pd

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


@dataclass(frozen=True, slots=True, repr=False)
class Suggestions:
    """The dishes, the best first, those that are equally good by name. It is true if there is one.

    `candidates` is how many dishes there are, whatever the constraints and ingredients. What is `skipped`
    was not solved before the `limit`: any of these might be among the dishes, too. `seconds` is wall time.
    """

    query: Query
    using: tuple[str, ...]
    dishes: tuple[Suggestion, ...]
    candidates: int
    skipped: int
    seconds: float
    limit: Limit | None = None

    def __bool__(self) -> bool:
        return bool(self.dishes)

    def __repr__(self) -> str:
        return f"<Suggestions: {len(self.dishes)} dishes by {','.join(self.by)}, {self.status}>"

    def __str__(self) -> str:
        from foon_asp.render.suggest import suggestions_text

        return suggestions_text(self).rstrip()

    def to_json(self) -> str:
        """Return the answer as the command writes it with `--format json`."""
        return dumps(suggestions_json(self))

    def to_frame(self) -> pd.DataFrame:
        """Return the dishes and what each costs, a row each, the best first."""
        from foon_asp.render.frames import suggestions_frame

        return suggestions_frame(self)

    def _repr_html_(self) -> str:
        return str(self.to_frame().to_html())

    @property
    def by(self) -> tuple[str, ...]:
        """The criteria that the dishes are ranked by."""
        return self.query.objective.texts

    @property
    def status(self) -> Status:
        """`LIMIT` if something was skipped, else `OPTIMAL` or, without any dish, `UNREACHABLE`."""
        if self.skipped:
            return Status.LIMIT
        return Status.OPTIMAL if self.dishes else Status.UNREACHABLE


def suggest(
    world: World, query: Query, *, using: Iterable[str] = (), everything: bool = False
) -> Suggestions:
    """Suggest what to cook: dishes as `find_dishes` has them, ranked by what their best trees cost.

    The question has no goals. With `using` only dishes that are made with all these labels: for
    each label, the steps of the tree that take it, as an input, its contents or what it is in, are ones
    without which the other steps do not make the dish; and of such trees it is the best. The time limit is
    for all dishes together. Raises `QueryError`.
    """
    started = time.perf_counter()
    if not isinstance(query, Query):
        raise QueryError(f"suggestions take a Query without goals, not {said(query)}")
    if query.goals:
        raise QueryError("suggestions are for no goal in particular; leave it out")
    if query.method != Method.OPTIMAL or not query.founded:
        raise QueryError("suggestions are the best trees; leave out the method")
    refuse_substitution(query, "suggestions are")
    world = query.seen_in(world)
    query = query.checked(world)
    check_objective(Problem(world, (), whole=True), query.objective)
    takers = _takers(world, using)
    candidates = find_dishes(world, everything=everything)
    search = _Search(world, query, tuple(takers))
    dishes = _made_with(world, takers, candidates)
    if "time" in query.objective.names:
        dishes = [dish for dish in dishes if _timed(search.problem(dish))]
    found: list[Suggestion] = []
    left, limit = len(dishes), None
    with limited(query.time_limit, query.memory_limit):
        try:
            for dish, best in search.answers(dishes):
                limit = best.limit or limit
                left -= best.status != Status.LIMIT
                if best.status == Status.OPTIMAL and best.tree is not None:
                    found.append(Suggestion(world.node(dish), best.tree, best.tree.costs))
        except LimitReachedError as error:
            limit = error.limit
    found.sort(key=lambda each: (query.objective.costs(each.costs), str(each.dish)))
    seconds = time.perf_counter() - started
    return Suggestions(
        query, tuple(takers), tuple(found), len(candidates), left, seconds, limit if left else None
    )


def find_dishes(world: World, *, everything: bool = False) -> list[ObjectId]:
    """Return the ids of all dishes that the kitchen can make and does not have already.

    Dishes are the goals of the world, what the annotators marked as a goal, and the end products. With
    `everything` they are all that can be made.
    """
    makeable = [object_id for object_id in world.closure.available if object_id not in world.stock]
    if everything:
        return makeable
    named = (world.foon.id_of(node) for node in (*world.goals, *world.foon.marked_goals()))
    can_be_made = set(makeable)
    return list(
        dict.fromkeys(
            [*(object_id for object_id in named if object_id in can_be_made), *_end_products(world, makeable)]
        )
    )


def _end_products(world: World, makeable: Iterable[ObjectId]) -> list[ObjectId]:
    """Return what can be made, is food, and that no unit takes any further.

    No end product is an empty utensil, nor an object in something that is no utensil: it is a part of that.
    Units list what they make from all sides. `salt in [pot]`, of which no more is said, is no end product if
    `pot {salt, water}` is taken further; and `pot {soup}` is none beside `soup in [pot]`.
    """
    objects, utensils = world.foon.objects, world.kitchen.utensils
    taken = {object_id for unit in world.foon.units for object_id in unit.inputs}

    def food(node: ObjectNode) -> bool:
        if node.label in utensils and not any(state.contents for state in node.states):
            return False
        return not utensils or utensils.issuperset(node.containers)

    def in_place(node: ObjectNode, vessel: ObjectNode) -> bool:
        places = (state.relatum for state in node.states)
        return node.label in vessel.contents and vessel.label in places

    def shown_by(object_id: ObjectId, other: ObjectId) -> bool:
        node, side = objects[object_id], objects[other]
        view = node.label in utensils and len(set(node.contents)) == 1 and in_place(side, node)
        return view or (other in taken and in_place(node, side))

    def goes_on(object_id: ObjectId, unit: UnitId) -> bool:
        return any(shown_by(object_id, other) for other in world.foon.units[unit].outputs)

    ends = [object_id for object_id in makeable if object_id not in taken and food(objects[object_id])]
    makers = {
        object_id: [unit for unit in world.units.makers[object_id] if unit in world.closure.executable]
        for object_id in ends
    }
    return [
        object_id for object_id in ends if not all(goes_on(object_id, unit) for unit in makers[object_id])
    ]


def _takers(world: World, using: Iterable[str]) -> dict[str, set[UnitId]]:
    """Return for each label the units that take it, by label, contents or relatum of an input."""
    listed = a_list(using, "using", "labels")
    for label in listed:
        if not isinstance(label, str):
            raise QueryError(f"a label is a text, not {said(label)}")
    labels = dict.fromkeys(clean(label) for label in listed)
    if not labels:
        return {}
    check_labels(world, labels)
    named = [set(node.named_labels) for node in world.foon.objects]
    units = world.foon.units
    return {
        label: {unit.id for unit in units if any(label in named[object_id] for object_id in unit.inputs)}
        for label in labels
    }


def _made_with(
    world: World, takers: Mapping[str, set[UnitId]], dishes: Collection[ObjectId]
) -> list[ObjectId]:
    """Return the dishes to which units that take each of the labels can contribute."""
    for units in takers.values():
        reached = _downstream(world, units)
        dishes = [dish for dish in dishes if dish in reached]
    return list(dishes)


def _downstream(world: World, units: Iterable[UnitId]) -> set[ObjectId]:
    """Return all that some units, and the units behind them, make and the kitchen does not have."""
    reading, executable = world.units, world.closure.executable
    open_ = [unit for unit in units if unit in executable]
    seen = set(open_)
    found: set[ObjectId] = set()
    while open_:
        for object_id in reading.makes[open_.pop()]:
            if object_id in found or object_id in world.stock:
                continue
            found.add(object_id)
            for user in reading.users.of(object_id):
                if user in executable and user not in seen:
                    seen.add(user)
                    open_.append(user)
    return found


def _timed(problem: Problem) -> bool:
    """Say whether anything is known of the time that a dish takes."""
    units = problem.world.foon.units
    return any(units[unit].duration for unit in problem.units)


@dataclass(frozen=True, slots=True)
class _Search:
    """What is asked of every dish."""

    world: World
    query: Query
    using: tuple[str, ...]

    def problem(self, *dishes: ObjectId) -> Problem:
        return Problem(self.world, dishes, constraints=self.query.constraints)

    def answers(self, dishes: Sequence[ObjectId]) -> Iterator[tuple[ObjectId, Found]]:
        """Yield for each dish the best tree that uses all labels, if it is proven before a limit."""
        if self.using:
            for dish, model in self._models(dishes):
                yield dish, self._found(dish, model)
        else:
            # What clingo makes of a unit is kept from one dish to the next.
            for dish in dishes:
                yield dish, self._retrieved(dish)

    def _found(self, dish: ObjectId, model: Model) -> Found:
        if not model.proven:
            return Found(Status.LIMIT, limit=model.limit)
        if model.atoms is None:
            return NOTHING
        return Found(Status.OPTIMAL, decode_tree(self.problem(dish), model))

    def _retrieved(self, dish: ObjectId) -> Found:
        if limit := reached():
            return Found(Status.LIMIT, limit=limit)
        try:
            return optimal(self.problem(dish), self.query.objective)
        except LimitReachedError as error:
            return Found(Status.LIMIT, limit=error.limit)

    def _models(self, dishes: Sequence[ObjectId]) -> Iterator[tuple[ObjectId, Model]]:
        """Yield for each dish the best tree that uses all labels; not proven if the time ran out."""
        alone: list[ObjectId] = []
        if "depth" in self.query.objective.names or self.query.constraints.max_depth is not None:
            # Rounds are told apart for every object: the smallest programs are the quickest.
            alone += dishes
        else:
            for batch in self._batches(dishes):
                for dish, model in self._together(batch):
                    if model.proven:
                        yield dish, model
                    else:
                        alone.append(dish)
        for dish in alone:
            yield dish, self._alone(dish)

    def _batches(self, dishes: Iterable[ObjectId]) -> Iterator[list[ObjectId]]:
        """Yield dishes that mostly need the same units, together."""
        slices = {}
        for dish in dishes:
            check()
            slices[dish] = self.problem(dish).units
        batch: list[ObjectId] = []
        units: set[UnitId] = set()
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

    def _together(self, dishes: Sequence[ObjectId]) -> Iterator[tuple[ObjectId, Model]]:
        """Ground once what can matter for any of some dishes, and ask for one after the other."""
        try:
            control = next(self._optimisers(replace(self.problem(*dishes), switched=True)))
        except LimitReachedError as error:
            yield from ((dish, Model(None, False, limit=error.limit)) for dish in dishes)
            return
        for dish in dishes:
            try:
                control.switch("goal", dish, True)
                with limited(_PATIENCE):
                    model = self._best(control)
                control.switch("goal", dish, False)
            except LimitReachedError as error:
                model = Model(None, False, limit=error.limit)
            yield dish, model

    def _alone(self, dish: ObjectId) -> Model:
        model = Model(None, False)
        try:
            for control in self._optimisers(self.problem(dish)):
                model = self._best(control)
                if not too_deep(model):
                    break
        except LimitReachedError as error:
            return Model(None, False, limit=error.limit)
        return model

    def _best(self, control: Solver) -> Model:
        """Return the best answer; whether there is one at all is quick to know if nothing is optimised."""
        first = control.first()
        return first if first.proven else control.best()

    def _optimisers(self, problem: Problem) -> Iterator[Solver]:
        encodings = ("retrieval/suggest.lp",)
        extra_facts = "".join(f"using({quote(label)}).\n" for label in self.using)
        priced = tariffs(problem, self.query.objective.complete)
        return optimisers(problem, priced, encodings=encodings, extra_facts=extra_facts)
