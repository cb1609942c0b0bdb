"""`foon-asp pddl export`: a planning domain, a problem and a map of their names."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import Reply, check_targets, folder_to_write
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import asked_goals
from foon_asp.model.consumption import Effects
from foon_asp.planning.pddl.plansys2 import for_plansys2
from foon_asp.planning.pddl.styles import STYLES, document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.write import FILES, export
from foon_asp.query.goals import find_object
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from foon_asp.words import counted


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "*", add.OR_MARKED)
    add.semantics(parser)
    add.criterion(parser)
    add.actions(parser, STYLES)
    parser.add_argument(
        "--dialect",
        choices=("standard", "plansys2"),
        default="standard",
        help="plansys2: lifted, durative, with names that PlanSys2 reads (default: standard)",
    )
    add.whole(parser)
    add.files(parser, "DIR", f"a folder for {', '.join(FILES)}")


def run(options: argparse.Namespace) -> Reply:
    """Write the files."""
    folder = folder_to_write(options)
    check_targets(options, *(folder / name for name in FILES))
    world = open_world(options)
    named = asked_goals(options, world, "name a GOAL: foon-asp pddl export GOAL…")
    goals = tuple(world.id_of(find_object(world, goal)) for goal in named)
    problem = Problem(world, goals, whole=options.whole)
    criterion = None if options.by is None else Criterion.parse(options.by)
    task = planning_task(problem, Effects(world, options.semantics), criterion)
    if options.dialect == "plansys2":
        written = for_plansys2(document(task, options.style or "lifted", durative=True))
    else:
        written = document(task, options.style or "objects", options.durative)
    export(written, folder)
    return Reply(summary=f"{folder}/: {', '.join(FILES)} ({counted(len(written.actions), 'action')})")
