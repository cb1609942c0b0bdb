"""`foon-asp reach`: what the kitchen can make."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.render.reach import reach_text
from foon_asp.retrieval.reach import reach
from foon_asp.retrieval.wire import reach_json


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument("--list", action="store_true", help="name everything that can be made")
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """Say what can be reached."""
    world = open_world(options)
    available, executable = reach(world)
    return Reply(
        lambda: reach_text(world, available, executable, listing=options.list),
        lambda: reach_json(world, available, executable),
    )
