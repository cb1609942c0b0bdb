"""`foon-asp adapt`: the nearest dish, with some ingredients and without others."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.commands.retrieve import tree_as_foon
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import question
from foon_asp.render.adapt import adaptation_text
from foon_asp.retrieval.adapt import adapt_dish
from foon_asp.retrieval.adapt_wire import adaptation_json


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument(
        "dish",
        metavar="DISH",
        help="a goal, what the dish is a kind of (salad), or a category of the files (15)",
    )
    parser.add_argument(
        "--with",
        dest="wanted",
        type=add.labels,
        action="extend",
        default=[],
        metavar="L1,L2,…",
        help="what the dish is to have; what it is to be without: --without, --diet",
    )
    add.criteria(parser)
    add.constraints(parser)
    add.substitute(parser, "; default: foon")
    add.limits(parser, "for all dishes")
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Adapt a dish."""
    query = question(options, options.dish)
    found = adapt_dish(open_world(options), query, options.wanted)
    return Reply(
        lambda: adaptation_text(found),
        lambda: adaptation_json(found),
        {"foon": lambda: tree_as_foon(found.answer)},
        [found.status],
    )
