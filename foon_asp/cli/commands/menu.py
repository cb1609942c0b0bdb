"""`foon-asp menu`: several dishes at once."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.commands.retrieve import tree_as_foon
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import asked_goals, question
from foon_asp.render.menu import menu_text
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.wire import menu_json


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "*", add.OR_MARKED)
    add.goals_file(parser)
    add.criteria(parser)
    parser.add_argument("--leave-out", action="store_true", help="leave out goals that cannot be made")
    add.constraints(parser)
    add.limits(parser, "for all of it")
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Plan a menu."""
    query = question(options)
    world = open_world(options)
    advice = "name the dishes: foon-asp menu GOAL GOAL…, or a file of them with --goals"
    goals = asked_goals(options, world, advice)
    menu = plan_menu(world, query.replace(goals=goals), leave_out=options.leave_out)
    return Reply(
        lambda: menu_text(menu),
        lambda: menu_json(menu),
        {"foon": lambda: tree_as_foon(menu.together)},
        [menu.status],
    )
