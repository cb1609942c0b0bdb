"""`foon-asp goals`: the goals of the data folder, or what the FOON marks as such."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_data
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.io.object_wire import object_to_json
from foon_asp.io.unknown_words import nearest, unknown_goals
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """List the goals."""
    dataset, world = open_data(options)
    goals = list(dict.fromkeys(map(world.project, dataset.goals)))
    return Reply(
        lambda: [_line(world, goal) for goal in goals],
        lambda: [object_to_json(goal) for goal in goals],
    )


def _line(world: World, goal: ObjectNode) -> str:
    if goal in unknown_goals(world):
        note = f"  (no object of this FOON{nearest(world, goal)})"
    elif world.id_of(goal) in world.closure.available:
        note = ""
    else:
        note = "  (this kitchen cannot make it)"
    return f"{goal}{note}\n"
