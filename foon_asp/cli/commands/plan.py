"""`foon-asp plan`: plans, in which objects are used up."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.messages import tell
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import asked_goals
from foon_asp.io.text import write_text
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.plan import Plan
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.planning.wire import plan_answer_json
from foon_asp.query.query import Query
from foon_asp.render.plan import answer_text


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
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Plan."""
    world = open_world(options)
    goals = asked_goals(options, world, "name a GOAL: foon-asp plan GOAL…")
    query = Query(*goals, by=options.by, time_limit=options.time_limit, memory_limit=options.memory_limit)
    asked = PlanQuery(query, options.engine, options.semantics, options.max_steps)
    answer = plan(world, asked, _progress(options))
    return Reply(
        lambda: answer_text(answer),
        lambda: plan_answer_json(answer),
        {"foon": lambda: _answer_as_foon(answer)},
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


def _answer_as_foon(answer: PlanAnswer) -> str:
    if answer.plan is None:
        tell(f"no plan: {answer.reason or answer.status}")
        return ""
    return plan_as_foon(answer.plan, f"{answer.engine} {answer.semantics}")


def plan_as_foon(plan: Plan, how: str) -> str:
    """Return a plan as FOON text, with how it was made."""
    foon = plan.world.foon
    comments = [*(f"Goal:\t{plan.world.node(goal)}" for goal in plan.goals), f"Plan:\t{how}"]
    if not plan.executable:
        comments.append("NOT EXECUTABLE")
    return write_text(foon, [foon.units[unit] for unit in plan.units], comments)
