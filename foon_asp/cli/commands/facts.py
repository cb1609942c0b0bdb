"""`foon-asp facts`: what clingo is given."""

from __future__ import annotations

import argparse

from foon_asp.asp.facts import facts
from foon_asp.cli import options as add
from foon_asp.cli.inputs import find_goals, open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.query.problem import Problem


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "*", "; without one, the facts of the whole FOON")
    add.whole(parser)
    add.reference(parser)
    add.output(parser)


def run(options: argparse.Namespace) -> Reply:
    """Write facts."""
    world = open_world(options)
    goals = tuple(map(world.id_of, find_goals(options, world)))
    problem = Problem(world, goals, founded=not options.reference, whole=options.whole or not goals)
    return Reply(lambda: facts(problem))
