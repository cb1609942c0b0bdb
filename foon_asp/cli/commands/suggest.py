"""`foon-asp suggest`: what can be cooked, the best dishes first."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.messages import warn
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser, Renamed
from foon_asp.cli.question import question
from foon_asp.io.unknown_words import nearest, unknown_goals
from foon_asp.render.suggest import suggestions_text
from foon_asp.retrieval.suggest import suggest
from foon_asp.retrieval.wire import suggestions_json

_SHOWN = 20
"""How many dishes are shown as text."""


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument(
        "--using",
        type=add.labels,
        default=[],
        metavar="L1,L2,…",
        help="only dishes that are made with these",
    )
    add.criteria(parser)
    parser.add_argument(
        "--everything", action="store_true", help="everything that can be made, not just dishes"
    )
    parser.add_argument(
        "--all", dest="everything", action=Renamed, new="--everything", nargs=0, default=False
    )
    add.how_many(parser, f"{_SHOWN}; json: all")
    add.constraints(parser)
    add.limits(parser, "for all dishes")
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """Suggest dishes."""
    query = question(options)
    world = open_world(options)
    for goal in () if options.everything else unknown_goals(world):
        warn(options, f"the goal {goal} is no object of this FOON{nearest(world, goal)}")
    found = suggest(world, query, using=options.using, everything=options.everything)
    return Reply(
        lambda: suggestions_text(found, options.n or _SHOWN),
        lambda: suggestions_json(found, options.n),
        statuses=[found.status],
    )
