"""`foon-asp query`: rules of the user's own over the facts."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.asp.ask import ask
from foon_asp.asp.wire import asked_json
from foon_asp.cli import options as add
from foon_asp.cli.inputs import named_goals, open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.query.query import Query
from foon_asp.render.ask import query_text


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument("file", metavar="FILE", help="answer-set rules over the vocabulary")
    add.goal(parser, "*", "; without one, the facts of the whole FOON")
    add.goals_file(parser)
    add.limits(parser)
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """Run the rules."""
    world = open_world(options)
    query = Query(*named_goals(options), time_limit=options.time_limit, memory_limit=options.memory_limit)
    answer = ask(world, query, Path(options.file))
    return Reply(lambda: query_text(answer), lambda: asked_json(answer), statuses=[answer.status])
