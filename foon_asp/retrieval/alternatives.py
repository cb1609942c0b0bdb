"""Several answers to one question: the best few task trees, all best ones, unlike ones, trade-offs."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from foon_asp.asp.model import Model
from foon_asp.asp.program import optimisers, too_deep
from foon_asp.asp.solver import Solver
from foon_asp.errors import InternalError, QueryError
from foon_asp.io.wire import dumps
from foon_asp.limits import Limit, LimitReachedError, limited, limited_now
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.numbers import FACTOR
from foon_asp.query.checks import check_objective, refuse_substitution
from foon_asp.query.goals import Named
from foon_asp.query.method import Method
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.reduction import reducible, without_superfluous
from foon_asp.query.status import Status
from foon_asp.query.tariff import Tariff, tariffs
from foon_asp.query.unreachable import unreachable_reason
from foon_asp.retrieval.conflict import conflict_reason
from foon_asp.retrieval.decode import decode_tree
from foon_asp.retrieval.own_criteria import refuse_criteria
from foon_asp.retrieval.prune import pruned
from foon_asp.retrieval.tree import TaskTree
from foon_asp.retrieval.wire import alternatives_json
from foon_asp.words import counted

if TYPE_CHECKING:
    import pandas as pd

    from foon_asp.draw.formats import Drawing

KINDS = ("best", "all optimal", "diverse", "pareto")

_MOST = 10_000
"""How many best trees are counted; there can be exponentially many."""


@dataclass(frozen=True, slots=True, repr=False)
class Alternatives:
    """Several task trees for a goal, all of them replayed; no two have the same units.

    It is true if there is one.

    `kind` is one of `KINDS`. `status` is `OPTIMAL` (every tree is proven to have its place in the list),
    `UNREACHABLE` (there is none; `reason` says why) or `LIMIT` (`limit` was reached). Then those that
    are there are proven; if `proven` is false there is just some tree, so that there is one. `complete` says
    that there are known to be no other trees of this kind. `seconds` is wall time.
    """

    query: Query
    kind: str
    status: Status
    trees: tuple[TaskTree, ...]
    proven: bool
    complete: bool
    reason: str
    seconds: float
    limit: Limit | None = None

    def __bool__(self) -> bool:
        return bool(self.trees)

    def __repr__(self) -> str:
        return f"<Alternatives: {self.goal}, {self.kind}, {self.status}, {counted(len(self.trees), 'tree')}>"

    def __str__(self) -> str:
        from foon_asp.render.alternatives import alternatives_text

        return alternatives_text(self).rstrip()

    def to_json(self) -> str:
        """Return the answer as the command writes it with `--format json`."""
        return dumps(alternatives_json(self))

    def to_frame(self) -> pd.DataFrame:
        """Return what each tree costs, a row each."""
        from foon_asp.render.frames import alternatives_frame

        return alternatives_frame(self)

    def draw(self, *, dark: bool | None = None) -> Drawing:
        """Return trade-offs as a plot, other trees beside each other."""
        from foon_asp.draw.views import alternatives_drawing

        return alternatives_drawing(self, dark)

    def _repr_html_(self) -> str:
        return str(self.to_frame().to_html())

    @property
    def goal(self) -> ObjectNode:
        """The goal, or the first of several."""
        return self.query.nodes[0]

    @property
    def by(self) -> tuple[str, ...]:
        """The criteria that the trees are best by."""
        return self.query.objective.texts


def best_trees(world: World, query: Query | Named, count: int) -> Alternatives:
    """Return the best task trees, the best first; equal ones in the order of their units.

    Trees are sets of units: none is listed twice in another order, and none that has all units of a tree
    listed before it and superfluous ones on top. Raises `QueryError`.
    """
    question = _Question(world, query)
    return question.answer("best", _best(question, count), count)


def all_optimal_trees(world: World, query: Query | Named) -> Alternatives:
    """Return all task trees that are best by the criteria, and among those have the fewest units.

    There may be very many; it stops at ten thousand, and then is not complete. Raises `QueryError`.
    """
    question = _Question(world, query)
    return question.answer("all optimal", _all_optimal(question), _MOST)


def diverse_trees(world: World, query: Query | Named, count: int, factor: float = 1.5) -> Alternatives:
    """Return the best task tree, and then each time one that is as unlike those before as can be.

    As unlike as can be: the known tree with which it has most units in common has as few of them as
    possible; then it is best by the criteria. No tree costs more than `factor` times the best by the first
    criterion; for success, its chance is not below the best one divided by `factor`. Choosing the
    farthest from those before is within a factor of two of the best choice at once, where the distance is
    a metric (Gonzalez, Clustering to minimize the maximum intercluster distance, 1985). Raises `QueryError`.
    """
    FACTOR.checked(factor, "factor")
    question = _Question(world, query)
    return question.answer("diverse", _diverse(question, count, factor), count)


def pareto_trees(world: World, query: Query | Named) -> Alternatives:
    """Return one task tree for each trade-off between the criteria that no other tree improves on.

    Of trees that cost the same by all criteria there is one, with the fewest units. Each is found by
    lexicographic optimisation among the trees that none before is at least as good as, so it is best by the
    first criterion among the rest, and there are no others once nothing is left. Raises `QueryError`.
    """
    question = _Question(world, query)
    if len(question.objective) < 2:
        raise QueryError("a trade-off needs two criteria or more, like units,success")
    refuse_criteria(question.query.constraints, "trade-offs are between built-in criteria")
    return question.answer("pareto", _pareto(question), None)


class _Question:
    """What is asked, and until when."""

    def __init__(self, world: World, query: Query | Named) -> None:
        query = Query.of(query)
        self.started = time.perf_counter()
        if query.method != Method.OPTIMAL:
            raise QueryError("several trees are found by the method 'optimal' alone; leave out --method")
        refuse_substitution(query, "several trees are found")
        world = query.seen_in(world)
        self.query = query.checked(world)
        self.problem = Problem.posed(world, self.query)
        self.reason = unreachable_reason(self.problem)
        self.objective = query.objective
        if not self.reason:
            check_objective(self.problem, self.objective)
        self.every = self.objective.complete
        self.some: Model | None = None
        self.asked = self.problem
        if not self.reason and reducible(self.problem, self.every):
            self.problem = without_superfluous(self.problem, self.every)

    @cached_property
    def priced(self) -> list[Tariff]:
        """The tariff of each criterion."""
        return tariffs(self.problem, self.every)

    def solvers(self, encoding: str, extra_facts: str) -> Iterator[Solver]:
        """Yield solvers, as `optimisers` does, for the trees that one more encoding leaves."""
        encodings = ("retrieval/task_tree.lp", encoding)
        return optimisers(self.problem, self.priced, encodings=encodings, extra_facts=extra_facts)

    def best(self, encoding: str, extra_facts: str) -> Model | None:
        """Return the best answer, proven, or nothing if there is none."""
        for solver in self.solvers(encoding, extra_facts):
            self._have_some(solver)
            answer = solver.best()
            if answer.limit is not None:
                self.some = answer if answer.atoms is not None else self.some
                raise LimitReachedError(answer.limit)
            if not too_deep(answer):
                return None if answer.atoms is None else answer
        raise InternalError("a tree is deeper than the number of its units")

    def all_best(self, extra_facts: str, most: int) -> list[TaskTree]:
        """Return all trees that are best and no known tree with units on top; at most so many."""
        for solver in self.solvers("retrieval/alternatives.lp", extra_facts):
            self._have_some(solver)
            answers = solver.all_best("use", most)
            if not too_deep(*answers.found):
                break
        trees = [decode_tree(self.problem, answer) for answer in answers.found]
        trees.sort(key=lambda tree: sorted(tree.units))
        if answers.limit is not None and len(trees) < most:
            raise LimitReachedError(answers.limit)
        return trees

    def _have_some(self, solver: Solver) -> None:
        """Where there is a limit, have any task tree, whatever it costs."""
        if limited_now() and self.some is None:
            first = solver.first()
            self.some = first if first.atoms is not None else None

    def answer(self, kind: str, trees: Iterator[TaskTree], most: int | None) -> Alternatives:
        """Collect trees until there are enough, none is left, or a limit is reached."""
        limit = self.query.time_limit
        left = None if limit is None else max(0.0, self.started + limit - time.perf_counter())
        with limited(left, self.query.memory_limit):
            return self._answer(kind, trees, most)

    def _answer(self, kind: str, trees: Iterator[TaskTree], most: int | None) -> Alternatives:
        found: list[TaskTree] = []
        status, complete, limit = Status.OPTIMAL, False, None
        if not self.reason:
            try:
                for tree in trees:
                    found.append(tree)
                    if len(found) == most:
                        break
                else:
                    complete = True
            except LimitReachedError as error:
                status, limit = Status.LIMIT, error.limit
        proven = status == Status.OPTIMAL or bool(found)
        if not proven and self.some is not None:
            found.append(pruned(self.problem, decode_tree(self.problem, self.some), self.every))
        if complete and not found:
            self.reason = conflict_reason(self.asked)
        if self.reason:
            status, complete = Status.UNREACHABLE, True
        seconds = time.perf_counter() - self.started
        return Alternatives(
            self.query, kind, status, tuple(found), proven, complete, self.reason, seconds, limit
        )


def _known(trees: Iterable[TaskTree]) -> str:
    """Return the facts about trees that are known."""
    atoms = (f"known({place},{unit})." for place, tree in enumerate(trees) for unit in tree.units)
    return "\n".join(atoms) + "\n"


def _best(question: _Question, count: int) -> Iterator[TaskTree]:
    found: list[TaskTree] = []
    while len(found) < count:
        trees = question.all_best(_known(found), count - len(found))
        yield from trees
        found += trees
        if not trees or not trees[0].units:
            return


def _all_optimal(question: _Question) -> Iterator[TaskTree]:
    yield from question.all_best("", _MOST)


def _diverse(question: _Question, count: int, factor: float) -> Iterator[TaskTree]:
    found: list[TaskTree] = []
    first = len(question.every)
    encoding, text = "retrieval/alternatives.lp", ""
    while len(found) < count:
        answer = question.best(encoding, text + _known(found))
        if answer is None:
            return
        tree = decode_tree(question.problem, answer)
        found.append(tree)
        yield tree
        if not tree.units:
            return
        if len(found) == 1:
            most = question.priced[0].times(answer.costs[answer.priorities.index(first)], factor)
            encoding = "retrieval/diverse.lp"
            text = f"limit({first},{most}).\n"


def _pareto(question: _Question) -> Iterator[TaskTree]:
    points: list[str] = []
    priorities = [len(question.every) - place for place in range(len(question.objective))]
    for number in itertools.count():
        answer = question.best("retrieval/pareto.lp", "".join(points))
        if answer is None:
            return
        yield decode_tree(question.problem, answer)
        paid = dict(zip(answer.priorities, answer.costs, strict=True))
        points += [f"point({number},{priority},{paid[priority]}).\n" for priority in priorities]
