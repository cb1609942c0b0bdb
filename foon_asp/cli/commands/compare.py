"""`foon-asp compare`: all methods side by side, or what a human's help is worth."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.inputs import find_goals, open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.limits import limited
from foon_asp.query.status import Status
from foon_asp.render.compare import comparison_text, human_text
from foon_asp.retrieval.compare import compare, compare_human
from foon_asp.retrieval.wire import comparison_json, human_json


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "*")
    add.goals_file(parser)
    parser.add_argument(
        "--human",
        action="store_true",
        help="instead, the highest success with 0, 1, 2, … steps done by a human, who never fails",
    )
    add.constraint(parser, "human_steps")
    add.limits(parser, "for each tree")
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """Compare methods."""
    if options.human_steps is not None and not options.human:
        raise QueryError("--human-steps limits the table of --human; name both")
    world = open_world(options)
    goals = find_goals(options, world) or list(world.goals)
    if not goals:
        raise QueryError("no goals: name some, or a file of them with --goals")
    if options.human:
        with limited(megabytes=options.memory_limit):
            tables = compare_human(world, goals, most=options.human_steps, time_limit=options.time_limit)
        return Reply(
            lambda: human_text(tables),
            lambda: [human_json(table) for table in tables],
            statuses=[
                Status.OPTIMAL if proven else Status.LIMIT for table in tables for _, proven in table.trees
            ],
        )
    with limited(megabytes=options.memory_limit):
        comparison = compare(world, goals, time_limit=options.time_limit)
    return Reply(
        lambda: comparison_text(comparison.rows),
        lambda: comparison_json(comparison.rows),
        statuses=[comparison.status],
    )
