"""Plans as the planning competitions (IPC) have them and VAL reads them, with the names of an export."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from foon_asp.model.consumption import Effects
from foon_asp.planning.pddl.styles import document
from foon_asp.planning.pddl.task import Step, Task, all_steps, planning_task, step_orderings
from foon_asp.planning.pddl.write import comment
from foon_asp.planning.plan import Plan
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem

_APART = 10
"""The milliseconds between two steps of which the second must wait for the first: what VAL tells apart."""


def ipc_text(plan: Plan, effects: Effects, criterion: Criterion, style: str, *, durative: bool) -> str:
    """Write a plan for the export of its goals with this criterion, style and kind of actions.

    A line is `(action argument …)`; with durative actions `start: (action argument …) [duration]`, in
    seconds, where each step starts once all steps are done that it must wait for. Helper actions are put in.
    Raises `QueryError` if the plan cannot be executed.
    """
    task = planning_task(Problem(plan.world, plan.goals), effects, criterion)
    steps = all_steps(plan, task, effects)
    arguments = document(task, style, durative).arguments
    lines = [line for goal in plan.goals for line in comment(f"Goal: {plan.world.node(goal)}")]
    lines += comment(f"Names are those of the export with style {style}, semantics {plan.semantics}.")
    words = [f"({' '.join((step.name, *arguments[step.name]))})" for step in steps]
    lines += _timed(words, steps, task) if durative else words
    return "".join(f"{line}\n" for line in lines)


def _timed(words: Sequence[str], steps: Sequence[Step], task: Task) -> Iterator[str]:
    starts = _starts(steps, task)
    for place in sorted(range(len(steps)), key=starts.__getitem__):
        seconds, rest = divmod(starts[place], 1000)
        yield f"{seconds}.{rest:03}: {words[place]} [{steps[place].duration}.000]"


def _starts(steps: Sequence[Step], task: Task) -> list[int]:
    """Return the millisecond in which each step starts."""
    starts = [0] * len(steps)
    # Whatever comes before a step stands before it in the list, with all that comes before that.
    for before, after in sorted(step_orderings(steps, task.initially), key=lambda pair: pair[1]):
        starts[after] = max(starts[after], starts[before] + 1000 * steps[before].duration + _APART)
    return starts
