"""`foon-asp plan`: plans, in which objects are used up."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from functools import partial

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.messages import tell
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import asked_goals
from foon_asp.errors import QueryError
from foon_asp.io.text import write_text
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.engines import TEMPORAL
from foon_asp.planning.pddl.ipc import ipc_text
from foon_asp.planning.pddl.styles import STYLES
from foon_asp.planning.plan import Plan
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.planning.wire import plan_answer_json
from foon_asp.query.query import Query
from foon_asp.render.plan import answer_text
from foon_asp.words import listed


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.goal(parser, "*", add.OR_MARKED)
    parser.add_argument(
        "--engine", default="clingo", metavar="NAME", help="see foon-asp engines (default: clingo)"
    )
    add.semantics(parser)
    add.criterion(parser, "units")
    parser.add_argument(
        "--max-steps", type=add.number, metavar="N", help="parallel steps that clingo tries at most"
    )
    add.limits(parser)
    add.actions(parser, STYLES, ", for --format ipc or an engine that plans in time")
    add.output(parser, "text", "json", "foon", "ipc")


def run(options: argparse.Namespace) -> Reply:
    """Plan."""
    if options.style and options.format != "ipc":
        raise QueryError("--style is for --format ipc")
    if options.durative and options.format != "ipc" and options.engine not in TEMPORAL:
        raise QueryError(
            f"--durative is for --format ipc, or an engine that plans in time: {listed(TEMPORAL)}"
        )
    if options.engine in TEMPORAL and not options.durative:
        raise QueryError(f"{options.engine} plans in time; add --durative")
    world = open_world(options)
    goals = asked_goals(options, world, "name a GOAL: foon-asp plan GOAL…")
    query = Query(*goals, by=options.by, time_limit=options.time_limit, memory_limit=options.memory_limit)
    asked = PlanQuery(query, options.engine, options.semantics, options.max_steps)
    answer = plan(world, asked, _progress(options))
    return Reply(
        lambda: answer_text(answer),
        lambda: plan_answer_json(answer),
        {
            "foon": lambda: _written(answer, _as_foon),
            "ipc": lambda: _written(answer, partial(_as_ipc, options.style or "objects", options.durative)),
        },
        [answer.status],
    )


def _progress(options: argparse.Namespace) -> Callable[[float], None] | None:
    """Return what shows a person that an engine is at work; nothing where nobody looks."""
    if options.quiet or not sys.stderr.isatty():
        return None

    def show(seconds: float) -> None:
        sys.stderr.write(f"\rfoon-asp: {options.engine} is at work, {seconds:.0f} s\x1b[K\r")
        sys.stderr.flush()

    return show


def _written(answer: PlanAnswer, write: Callable[[PlanAnswer, Plan], str]) -> str:
    """Write the plan of an answer; say it where there is none."""
    if answer.plan is None:
        tell(f"no plan: {answer.reason or answer.status}")
        return ""
    return write(answer, answer.plan)


def _as_foon(answer: PlanAnswer, plan: Plan) -> str:
    return plan_as_foon(plan, f"{answer.engine} {answer.semantics}")


def _as_ipc(style: str, durative: bool, answer: PlanAnswer, plan: Plan) -> str:
    return ipc_text(plan, answer.effects, answer.asked.criterion, style, durative=durative)


def plan_as_foon(plan: Plan, how: str) -> str:
    """Return a plan as FOON text, with how it was made."""
    foon = plan.world.foon
    comments = [*(f"Goal:\t{plan.world.node(goal)}" for goal in plan.goals), f"Plan:\t{how}"]
    if not plan.executable:
        comments.append("NOT EXECUTABLE")
    return write_text(foon, [foon.units[unit] for unit in plan.units], comments)
