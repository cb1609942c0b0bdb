"""`foon-asp retrieve`: task trees."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.messages import note, tell
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser, Renamed
from foon_asp.cli.question import asked_goals, question
from foon_asp.errors import QueryError
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.retrieve import retrieve

if TYPE_CHECKING:
    from foon_asp.retrieval.alternatives import Alternatives
    from foon_asp.retrieval.tree import TaskTree
    from foon_asp.retrieval.wire import AlternativesJson, RetrievalJson

_LONG = 0.3
"""Seconds after which a person wants to know how far it is."""


_ADVICE = "name one GOAL, or a file of them with --goals"


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "?", add.OR_MARKED)
    add.goals_file(parser)
    add.method(parser)
    add.criteria(parser, "; success or inputs alone for --method greedy")
    add.reference(parser)
    parser.add_argument(
        "--trace", action="store_true", help="with --method ids: what is explored at each limit of depth"
    )
    group = parser.add_argument_group(
        "several task trees (with the method optimal)"
    ).add_mutually_exclusive_group()
    add.how_many(group)
    group.add_argument("-k", dest="n", action=Renamed, new="-n", type=add.positive, metavar="N")
    group.add_argument("--all-optimal", action="store_true", help="all that are best, and their number")
    group.add_argument(
        "--diverse",
        type=add.positive,
        metavar="N",
        help="N that are as different as possible, within --factor",
    )
    group.add_argument(
        "--pareto", type=add.names, metavar="C1,C2,…", help="one for each trade-off between some criteria"
    )
    parser.add_argument(
        "--factor",
        type=add.factor,
        metavar="F",
        help="with --diverse: cost at most F times the best (default: 1.5)",
    )
    add.constraints(parser)
    add.substitute(parser)
    add.limits(parser, "for each goal")
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Retrieve task trees."""
    if options.goal is not None and options.goals is not None:
        raise QueryError(_ADVICE)
    query = question(options)
    if options.trace and options.method != "ids":
        raise QueryError("--trace shows the search of --method ids")
    if options.factor is not None and not options.diverse:
        raise QueryError("--factor says how dear --diverse trees may be; name both")
    if _several(options):
        _check_several(options)
    world = open_world(options)
    goals = asked_goals(options, world, _ADVICE)
    answers = _Answers(options, world, [query.replace(goals=[goal]) for goal in goals])
    return Reply(answers.text, answers.value, {"foon": answers.foon}, answers.statuses)


def _several(options: argparse.Namespace) -> bool:
    return bool(options.n or options.all_optimal or options.diverse or options.pareto is not None)


def _check_several(options: argparse.Namespace) -> None:
    if options.method != "optimal":
        raise QueryError("several trees are found by the method 'optimal' alone; leave out --method")
    if options.format == "foon":
        raise QueryError("--format foon writes one tree; take text or json for several")
    if options.pareto is not None and options.by:
        raise QueryError("--pareto names the criteria itself; leave out --by")


class _Answers:
    """The answers to some questions, each written as soon as it is there.

    Several trees, traces and JSON are imported when they are asked for: most questions are small and want
    none of them.
    """

    def __init__(self, options: argparse.Namespace, world: World, questions: list[Query]) -> None:
        self._options = options
        self._world = world
        self._questions = [each.checked(world) for each in questions]
        self.statuses: list[Status] = []

    def _found(self) -> Iterator[Answer | Alternatives]:
        for query in self._questions:
            answer = self._several(query) if _several(self._options) else self._one(query)
            self.statuses.append(answer.status)
            yield answer

    def _one(self, query: Query) -> Answer:
        """Retrieve a tree; where a person looks on, say what there is so far when it takes longer."""
        if self._options.quiet or not sys.stderr.isatty():
            return retrieve(self._world, query)
        from foon_asp.render.tree import costs_parts

        begun = time.monotonic()

        def say(tree: TaskTree) -> None:
            if time.monotonic() - begun >= _LONG:
                note(self._options, f"so far: {', '.join(costs_parts(tree, query.objective.texts))}")

        return retrieve(self._world, query, say)

    def _several(self, query: Query) -> Alternatives:
        from foon_asp.retrieval.alternatives import all_optimal_trees, best_trees, diverse_trees, pareto_trees

        options, world = self._options, self._world
        if options.n:
            return best_trees(world, query, options.n)
        if options.diverse:
            factor = 1.5 if options.factor is None else options.factor
            return diverse_trees(world, query, options.diverse, factor)
        return all_optimal_trees(world, query) if options.all_optimal else pareto_trees(world, query)

    def text(self) -> Iterator[str]:
        for place, answer in enumerate(self._found()):
            yield "\n" if place else ""
            if self._options.trace:
                yield self._trace(answer) + "\n"
            yield f"{answer}\n"

    def _trace(self, answer: Answer | Alternatives) -> str:
        from foon_asp.render.trace import trace_text
        from foon_asp.retrieval.trace import bounds

        return trace_text(self._world, bounds(self._world, self._world.id_of(answer.goal)))

    def value(self) -> Any:
        values = [self._value(answer) for answer in self._found()]
        return values[0] if self._options.goals is None and len(values) == 1 else values

    def _value(self, answer: Answer | Alternatives) -> RetrievalJson | AlternativesJson:
        from foon_asp.retrieval.trace import bounds
        from foon_asp.retrieval.wire import alternatives_json, retrieval_json, trace_json

        if not isinstance(answer, Answer):
            return alternatives_json(answer)
        if not self._options.trace:
            return retrieval_json(answer)
        world = self._world
        return retrieval_json(answer, trace_json(world, bounds(world, world.id_of(answer.goal))))

    def foon(self) -> Iterator[str]:
        for answer in self._found():
            if isinstance(answer, Answer):
                yield tree_as_foon(answer)


def tree_as_foon(answer: Answer) -> str:
    """Return a tree as FOON text; if there is none, nothing, and say why on standard error."""
    try:
        return answer.to_foon()
    except QueryError as error:
        tell(str(error))
        return ""
