"""`foon-asp explain`: why there is no task tree, or what its steps are for."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import asked_goals, question
from foon_asp.errors import QueryError
from foon_asp.render.explain import explanation_text
from foon_asp.retrieval.explain import MOST, explain, explain_step
from foon_asp.retrieval.explain_wire import explanation_json


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "?", add.OR_MARKED)
    add.criteria(parser)
    parser.add_argument("--all", action="store_true", help="all smallest sets of missing objects")
    parser.add_argument("--step", type=int, metavar="ID", help="only what this unit of the tree is for")
    parser.add_argument("--instead", action="store_true", help="with --step, the best tree without it")
    add.constraints(parser)
    add.limits(parser)
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """Explain a goal."""
    if options.instead and options.step is None:
        raise QueryError("name the step to do without: --step ID")
    query = question(options)
    world = open_world(options)
    goals = asked_goals(options, world, "name a GOAL: foon-asp explain GOAL")
    if len(goals) > 1:
        raise QueryError(f"the FOON marks {len(goals)} goals; name one of them: foon-asp explain GOAL")
    query = query.replace(goals=goals)
    if options.step is None:
        explanation = explain(world, query, most=MOST if options.all else 1)
    else:
        explanation = explain_step(world, query, options.step, instead=options.instead)
    return Reply(
        lambda: explanation_text(explanation),
        lambda: explanation_json(explanation),
        statuses=[explanation.status],
    )
