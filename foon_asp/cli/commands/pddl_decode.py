"""`foon-asp pddl decode`: a plan that another planner made from an export."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.commands.plan import plan_as_foon
from foon_asp.cli.inputs import open_world
from foon_asp.cli.messages import note, warn
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.io.trees import STDIN
from foon_asp.model.consumption import Effects
from foon_asp.model.node import UnitId
from foon_asp.planning.pddl.names import Names, OtherFoonError, read_names, read_names_alone
from foon_asp.planning.pddl.plan_file import read_plans
from foon_asp.planning.plan import Plan
from foon_asp.planning.wire import named_plan_json, plan_json
from foon_asp.render.plan import named_plan_text, plan_text


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument(
        "plan", metavar="PLAN", help="plan, or output of a planner; a file, or - for standard input"
    )
    parser.add_argument("--names", required=True, metavar="FILE", help="names.json of the export")
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Read the plan, and replay it; without the FOON that it is about its steps are named alone."""
    world = open_world(options)
    path = Path(options.names)
    try:
        names = read_names(path, world)
    except OtherFoonError:
        if options.foon or options.data is not None:
            raise
        return _named(options, path)
    effects = Effects(world, names.semantics)
    plan = Plan.of(effects, names.goals, _units(options, names))
    return Reply(
        lambda: plan_text(plan, effects),
        lambda: plan_json(plan),
        {"foon": lambda: plan_as_foon(plan, names.semantics)},
        failed=not plan.executable,
    )


def _named(options: argparse.Namespace, path: Path) -> Reply:
    """Return the steps as names.json has them: nobody has named the FOON, and the built-in one is another."""
    names, listed = read_names_alone(path)
    if options.format == "foon":
        raise QueryError(f"{path} is of another FOON than the built-in one; name it with --foon")
    units = _units(options, names)
    warn(
        options,
        f"{path} is of another FOON than the built-in one: the plan was not replayed; name it with --foon",
    )
    return Reply(
        lambda: named_plan_text(units, listed), lambda: named_plan_json(units, listed, names.semantics)
    )


def _units(options: argparse.Namespace, names: Names) -> list[UnitId]:
    """Return the units of the plan, of several plans the last one, and say so."""
    plans = read_plans(Path("/dev/stdin") if options.plan == STDIN else Path(options.plan), names)
    if len(plans) > 1:
        note(options, f"{options.plan} has {len(plans)} plans; this is the last one")
    return plans[-1] if plans else []
