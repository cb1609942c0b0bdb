"""`foon-asp schedule`: who does what when, in the least time."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.messages import tell
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import asked_goals
from foon_asp.draw.gantt import gantt_svg
from foon_asp.io.motions import read_durations
from foon_asp.model.world import World
from foon_asp.planning.pddl.styles import document
from foon_asp.planning.pddl.task import planning_task
from foon_asp.planning.pddl.timed import TimedPlan
from foon_asp.planning.problem import PlanProblem
from foon_asp.planning.resource_file import read_resources
from foon_asp.planning.resources import Resources
from foon_asp.planning.schedule_answer import ScheduleAnswer
from foon_asp.planning.schedule_query import ScheduleQuery
from foon_asp.planning.schedule_wire import schedule_json
from foon_asp.planning.scheduler import schedule
from foon_asp.query.query import Query
from foon_asp.render.schedule import schedule_text


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "*", add.OR_MARKED)
    group = parser.add_argument_group("resources (default: one cook with two hands, enough of all else)")
    group.add_argument("--resources", metavar="FILE", help="who works, stations, utensils: a JSON object")
    group.add_argument("--hands", type=add.positive, metavar="N", help="hands of the worker, if there is one")
    group.add_argument(
        "--have",
        action="append",
        default=[],
        type=add.counted_label,
        metavar="LABEL=N",
        help="so many utensils or stations with a label (several times)",
    )
    group.add_argument(
        "--passive",
        type=add.labels,
        default=[],
        metavar="M1,M2,…",
        help="motions that go by themselves, as baking does, and leave the hands free",
    )
    group.add_argument(
        "--durations", metavar="FILE", help="seconds of motions without a video, JSON or motion<tab>seconds"
    )
    add.semantics(parser)
    add.criterion(parser)
    parser.add_argument(
        "--front", action="store_true", help="longer schedules, too, that are better by the criterion"
    )
    add.limits(parser)
    add.output(parser, "text", "json", "svg", "ipc")


def run(options: argparse.Namespace) -> Reply:
    """Schedule."""
    world = open_world(options)
    goals = asked_goals(options, world, "name a GOAL: foon-asp schedule GOAL…")
    by = options.by or ()
    query = Query(*goals, by=by, time_limit=options.time_limit, memory_limit=options.memory_limit)
    table = {} if options.durations is None else read_durations(Path(options.durations))
    asked = ScheduleQuery(query, _resources(options, world), options.semantics, table, options.front)
    answer = schedule(world, asked)
    return Reply(
        lambda: schedule_text(answer),
        lambda: schedule_json(answer),
        {"svg": lambda: gantt_svg(answer), "ipc": lambda: timed_plan(answer)},
        [answer.status],
    )


def _resources(options: argparse.Namespace, world: World) -> Resources:
    """Return the resources of the file, with what the flags say besides."""
    found = Resources() if options.resources is None else read_resources(Path(options.resources))
    if options.hands is not None:
        found = found.with_hands(options.hands)
    return found.with_passive(world, options.passive).with_counts(world, options.have)


def timed_plan(answer: ScheduleAnswer) -> str:
    """Return a schedule as a plan of PDDL 2.1, in the names of `pddl export --durative`."""
    if answer.schedule is None:
        tell(f"no schedule: {answer.reason or answer.status}")
        return ""
    problem = PlanProblem(answer.effects, answer.schedule.goals)
    task = planning_task(problem, answer.effects, seconds=answer.durations.seconds)
    return TimedPlan(answer.schedule, document(task, "objects", durative=True)).text()
