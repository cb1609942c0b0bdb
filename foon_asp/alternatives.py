"""Several answers to one question: the best few task trees, all best ones, unlike ones, trade-offs."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from foon_asp.constraints import FREE, Constraints
from foon_asp.criteria import parse_by
from foon_asp.decode import decode_tree
from foon_asp.errors import InternalError, QueryError
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.program import all_levels, optimisers, too_deep
from foon_asp.reasons import unreachable_reason
from foon_asp.retrieve import check_constraints, check_levels, check_method, conflict_reason
from foon_asp.solve import Answer, Solver
from foon_asp.tree import TaskTree

KINDS = ("best", "all optimal", "diverse", "pareto")

_MOST = 10_000
"""How many best trees are counted; there can be exponentially many."""


@dataclass(frozen=True, slots=True)
class Alternatives:
    """Several task trees for a goal, all of them replayed; no two have the same units.

    `kind` is one of `KINDS`. `status` is `optimal` (every tree is proven to have its place in the list),
    `unreachable` (there is none; `reason` says why) or `limit` (the time ran out). Then those that are there
    are proven; if `proven` is false there is just some tree, so that there is one. `complete` says that there
    are known to be no other trees of this kind. `seconds` is wall time.
    """

    goal: ObjectNode
    kind: str
    by: tuple[str, ...]
    constraints: Constraints
    status: str
    trees: tuple[TaskTree, ...]
    proven: bool
    complete: bool
    reason: str
    seconds: float


def best_trees(
    domain: Domain,
    goal: ObjectNode,
    count: int,
    by: str | Sequence[str] = (),
    *,
    founded: bool = True,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Alternatives:
    """Return the best task trees, the best first; equal ones in the order of their units.

    Trees are sets of units: none is listed twice in another order, and none that has all units of a tree
    listed before it and superfluous ones on top. `by` as in `retrieve`. Raises `QueryError`.
    """
    question = _Question(domain, goal, by, founded, time_limit, constraints)
    return question.answer("best", _best(question, count), count)


def all_optimal_trees(
    domain: Domain,
    goal: ObjectNode,
    by: str | Sequence[str] = (),
    *,
    founded: bool = True,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Alternatives:
    """Return all task trees that are best by the criteria, and among those have the fewest units.

    There may be very many; it stops at ten thousand, and then is not complete. Raises `QueryError`.
    """
    question = _Question(domain, goal, by, founded, time_limit, constraints)
    return question.answer("all optimal", _all_optimal(question), _MOST)


def diverse_trees(
    domain: Domain,
    goal: ObjectNode,
    count: int,
    by: str | Sequence[str] = (),
    *,
    factor: float = 1.5,
    founded: bool = True,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Alternatives:
    """Return the best task tree, and then each time one that is as unlike those before as can be.

    As unlike as can be: the known tree with which it has most units in common has as few of them as
    possible; then it is best by the criteria. No tree costs more than `factor` times the best on the first
    level of `by`; for success, its chance is not below the best one divided by `factor`. Choosing the
    farthest from those before is within a factor of two of the best choice at once, where the distance is
    a metric (Gonzalez, Clustering to minimize the maximum intercluster distance, 1985). Raises `QueryError`.
    """
    if factor < 1:
        raise QueryError(f"no tree costs less than the best one; the factor is at least 1, not {factor:g}")
    question = _Question(domain, goal, by, founded, time_limit, constraints)
    return question.answer("diverse", _diverse(question, count, factor), count)


def pareto_trees(
    domain: Domain,
    goal: ObjectNode,
    by: str | Sequence[str],
    *,
    founded: bool = True,
    time_limit: float | None = None,
    constraints: Constraints = FREE,
) -> Alternatives:
    """Return one task tree for each trade-off between the criteria that no other tree improves on.

    Of trees that cost the same by all criteria there is one, with the fewest units. Each is found by
    lexicographic optimisation among the trees that none before is at least as good as, so it is best by the
    first criterion among the rest, and there are no others once nothing is left. Raises `QueryError`.
    """
    question = _Question(domain, goal, by, founded, time_limit, constraints)
    if len(question.levels) < 2:
        raise QueryError("a trade-off needs two criteria or more, like units,success")
    return question.answer("pareto", _pareto(question), None)


class _OutOfTimeError(Exception):
    """The deadline came before a proof."""


class _Question:
    """What is asked, and until when."""

    def __init__(
        self,
        domain: Domain,
        goal: ObjectNode,
        by: str | Sequence[str],
        founded: bool,
        time_limit: float | None,
        constraints: Constraints,
    ) -> None:
        self.started = time.perf_counter()
        self.deadline = None if time_limit is None else time.monotonic() + time_limit
        self.by = check_method("optimal", by, founded, constraints)
        check_constraints(domain, "optimal", constraints)
        self.problem: Problem = domain.problem([goal], founded=founded, constraints=constraints)
        self.reason = unreachable_reason(self.problem)
        self.levels = parse_by(self.by) if self.reason else check_levels(self.problem, self.by)
        self.every = all_levels(self.levels)
        self.goal = goal

    def solvers(self, encoding: str, extra_facts: str) -> Iterator[Solver]:
        """Yield solvers, as `optimisers` does, for the trees that one more encoding leaves."""
        encodings = ("task_tree.lp", encoding)
        return optimisers(self.problem, self.every, encodings=encodings, extra_facts=extra_facts)

    def best(self, encoding: str, extra_facts: str) -> Answer | None:
        """Return the best answer, proven, or nothing if there is none."""
        for solver in self.solvers(encoding, extra_facts):
            answer = solver.best(self.deadline)
            if not answer.proven:
                raise _OutOfTimeError
            if not too_deep(answer):
                return None if answer.atoms is None else answer
        raise InternalError("a tree is deeper than the number of its units")

    def all_best(self, extra_facts: str, most: int) -> list[TaskTree]:
        """Return all trees that are best and no known tree with units on top; at most so many."""
        for solver in self.solvers("alternatives.lp", extra_facts):
            answers = solver.all_best("use", self.deadline, most)
            if not too_deep(*answers.found):
                break
        trees = [decode_tree(self.problem, answer) for answer in answers.found]
        trees.sort(key=lambda tree: sorted(tree.units))
        if not answers.complete and len(trees) < most:
            raise _OutOfTimeError
        return trees

    def some_tree(self) -> TaskTree | None:
        """Return any task tree, whatever it costs."""
        answer = next(self.solvers("alternatives.lp", "")).first()
        return None if answer.atoms is None else decode_tree(self.problem, answer)

    def answer(self, kind: str, trees: Iterator[TaskTree], most: int | None) -> Alternatives:
        """Collect trees until there are enough, none is left, or the time is up."""
        found: list[TaskTree] = []
        status, complete = "optimal", False
        if not self.reason:
            try:
                for tree in trees:
                    found.append(tree)
                    if len(found) == most:
                        break
                else:
                    complete = True
            except _OutOfTimeError:
                status = "limit"
        proven = status == "optimal" or bool(found)
        if not proven and (some := self.some_tree()) is not None:
            found.append(some)
        if complete and not found:
            self.reason = conflict_reason(self.problem)
        if self.reason:
            status, complete = "unreachable", True
        seconds = time.perf_counter() - self.started
        constraints = self.problem.constraints
        return Alternatives(
            self.goal,
            kind,
            self.by,
            constraints,
            status,
            tuple(found),
            proven,
            complete,
            self.reason,
            seconds,
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
    encoding, text = "alternatives.lp", ""
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
            # Being unlike the others comes before all that was asked for.
            most = question.every[0].times(answer.costs[answer.priorities.index(first)], factor)
            encoding = "diverse.lp"
            text = f'criterion("overlap",{first + 1}). limit({first},{most}).\n'


def _pareto(question: _Question) -> Iterator[TaskTree]:
    points: list[str] = []
    priorities = [len(question.every) - place for place in range(len(question.levels))]
    for number in itertools.count():
        answer = question.best("pareto.lp", "".join(points))
        if answer is None:
            return
        yield decode_tree(question.problem, answer)
        paid = dict(zip(answer.priorities, answer.costs, strict=True))
        points += [f"point({number},{priority},{paid[priority]}).\n" for priority in priorities]
