"""Schedules as text."""

from __future__ import annotations

from foon_asp.model.node import ObjectId
from foon_asp.planning.durations import SECONDS
from foon_asp.planning.schedule import Schedule, ScheduledStep
from foon_asp.planning.schedule_answer import ScheduleAnswer
from foon_asp.query.status import Status
from foon_asp.render.proof import limit_text
from foon_asp.render.tree import head_line, port_lines
from foon_asp.words import chance_text, counted, shortened


def schedule_text(answer: ScheduleAnswer) -> str:
    """Write what was found: how long it takes and whether that is proven, then who does what when."""
    lines = [*map(str, answer.goals), _verdict(answer)]
    if answer.schedule is not None and answer.schedule.steps:
        lines += ["", *_steps(answer, answer.schedule)]
        for longer, cost in answer.front:
            lines += ["", _headed(answer, longer, cost), "", *_steps(answer, longer)]
    return "\n".join(lines) + "\n"


def _verdict(answer: ScheduleAnswer) -> str:
    schedule = answer.schedule
    if schedule is None:
        words = "no schedule" if answer.status is Status.UNSOLVABLE else "no schedule was found"
        return f"{words}: {answer.reason} ({_how(answer)})"
    if not schedule.steps:
        return "nothing to do: the kitchen has it"
    proof = "proven optimal" if answer.status is Status.OPTIMAL else f"{limit_text(answer.limit)}, not proven"
    if answer.limit is None and answer.status is Status.LIMIT:
        proof = "not proven"
    text = _headed(answer, schedule, answer.cost)[:-1] + f", {proof})"
    if not answer.proven:
        text += f"\nproven so far: no schedule takes less than {_time(answer, answer.bound)}"
    guessed = [step for step in schedule.steps if step.unit in answer.durations.guessed]
    if guessed:
        text += f"\nguessed: how long {len(guessed)} of {counted(len(schedule.steps), 'step')} take (~)"
    return text


def _headed(answer: ScheduleAnswer, schedule: Schedule, cost: float | None) -> str:
    parts = [f"makespan {_time(answer, schedule.makespan)}", counted(len(schedule.steps), "step")]
    if answer.asked.criterion is not None:
        name = str(answer.asked.criterion)
        if cost is None:
            parts.append("success 0")
        else:
            parts.append(f"{name} {chance_text(cost, 4) if name == 'success' else format(cost, '.4g')}")
    return f"{', '.join(parts)} ({_how(answer)})"


def _time(answer: ScheduleAnswer, value: int) -> str:
    """Return a time with its unit; where each step takes 1, a number says it."""
    return f"{value} s" if answer.durations.unit == SECONDS else str(value)


def _how(answer: ScheduleAnswer) -> str:
    workers = ", ".join(
        f"{worker.name} with {counted(worker.hands, 'hand')}" for worker in answer.asked.resources.workers
    )
    return f"{workers}, {answer.asked.semantics}"


def _steps(answer: ScheduleAnswer, schedule: Schedule) -> list[str]:
    world = schedule.world
    lines: list[str] = []
    for place, step in enumerate(schedule.steps, 1):
        mark = "~" if step.unit in answer.durations.guessed else ""
        maker: dict[ObjectId, int] = {object_id: number + 1 for object_id, number in step.origins}
        unit = world.foon.units[step.unit]
        lines += [
            head_line(unit, place, f" {step.start} to {mark}{step.end}{_by(step)}"),
            *port_lines(world, unit, maker),
        ]
    return lines


def _by(step: ScheduledStep) -> str:
    who = f", {step.worker} {shortened(step.hands, 9)}" if step.hands else ", by itself"
    return who + "".join(f", {name} {number}" for name, number in (*step.stations, *step.vessels))
