"""`foon-asp pddl decode`: a plan that another planner made from an export."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.commands.plan import plan_as_foon
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.model.consumption import Effects
from foon_asp.planning.pddl.names import read_names
from foon_asp.planning.pddl.plan_file import read_plan
from foon_asp.planning.plan import Plan
from foon_asp.planning.wire import plan_json
from foon_asp.render.plan import plan_text


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument("plan", metavar="PLAN", help="plan file in the IPC format")
    parser.add_argument("--names", required=True, metavar="FILE", help="names.json of the export")
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Read the plan, and replay it."""
    world = open_world(options)
    names = read_names(Path(options.names), world)
    effects = Effects(world, names.semantics)
    plan = Plan.of(effects, names.goals, read_plan(Path(options.plan), names))
    return Reply(
        lambda: plan_text(plan, effects),
        lambda: plan_json(plan),
        {"foon": lambda: plan_as_foon(plan, names.semantics)},
        failed=not plan.executable,
    )
