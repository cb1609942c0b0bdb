"""Plans and engines as text and as JSON values."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from foon_asp.effects import Effects
from foon_asp.engines import Engine
from foon_asp.errors import counted
from foon_asp.plan import Plan
from foon_asp.planning import PlanAnswer
from foon_asp.render.json import unit_value
from foon_asp.render.text import failure_text, step_lines
from foon_asp.state_syntax import object_to_json


def answer_text(answer: PlanAnswer, effects: Effects) -> str:
    """Write what an engine found: the verdict, then the steps."""
    head = "".join(f"{goal}\n" for goal in answer.goals)
    how = f"({answer.engine}, {answer.semantics}, by {answer.by}"
    if answer.plan is None:
        words = {"unsolvable": "no plan", "failed": "the engine failed"}
        return head + f"{words.get(answer.status, 'no plan was found')}: {answer.reason} {how})\n"
    if not answer.plan.units:
        return head + "nothing to do: the kitchen has it\n"
    cost = "" if answer.cost is None or answer.by == "units" else f"{answer.by} {answer.cost:.4g}"
    proof = {"optimal": ", proven optimal", "limit": ", time limit, not proven"}.get(answer.status, "")
    return head + f"{costs_text(answer.plan, cost)} {how}{proof})\n\n" + plan_text(answer.plan, effects)


def answer_value(answer: PlanAnswer) -> dict[str, Any]:
    """Return the value that `plan --format json` writes."""
    return {
        "goals": [object_to_json(goal) for goal in answer.goals],
        "engine": answer.engine,
        "by": answer.by,
        "status": answer.status,
        "reason": answer.reason,
        "semantics": answer.semantics,
        "cost": answer.cost,
        "plan": None if answer.plan is None else plan_value(answer.plan),
        "seconds": round(answer.seconds, 6),
    }


def plan_text(plan: Plan, effects: Effects) -> str:
    """Write the steps of a plan, what each uses up, and whether it can be executed."""
    domain = plan.domain
    lines: list[str] = []
    maker: dict[int, int] = {}
    for place, unit in enumerate(plan.units, 1):
        used_up = effects.deletes(unit)
        lines += step_lines(domain, domain.foon.units[unit], place, maker, used_up=used_up)
        for thing in used_up:
            maker.pop(thing, None)
        maker.update((thing, place) for thing in effects.adds(unit) if thing not in effects.endless)
    if not plan.executable:
        lines.append(f"CANNOT BE EXECUTED under '{plan.semantics}': {failure_text(plan.replay)}")
    return "".join(f"{line}\n" for line in lines)


def costs_text(plan: Plan, cost: str = "") -> str:
    """Write how long a plan is: its steps, its parallel steps, and what it costs."""
    again = len(plan.units) - len(set(plan.units))
    parts = [counted(len(plan.units), "step"), f"{plan.makespan} in parallel"]
    if again:
        parts.append(f"{again} of them again")
    if cost:
        parts.append(cost)
    return ", ".join(parts)


def plan_value(plan: Plan) -> dict[str, Any]:
    """Return a plan as a JSON value: the units in order, each with its parallel step."""
    foon = plan.domain.foon
    return {
        "semantics": plan.semantics,
        "executable": plan.executable,
        "length": len(plan.units),
        "makespan": plan.makespan,
        "units": [
            unit_value(foon, foon.units[unit]) | {"step": step}
            for unit, step in zip(plan.units, plan.steps, strict=True)
        ],
        "missing": [object_to_json(node) for node in plan.replay.missing],
    }


def engines_text(engines: Sequence[Engine]) -> str:
    """Write which engines there are, what they promise, and how to install the others."""
    width = max(len(engine.name) for engine in engines)
    lines = []
    for engine in engines:
        state = "installed" if engine.installed else engine.install
        lines.append(f"{engine.name:{width}}  {engine.promises}  [{engine.licence}; {state}]")
    lines.append("Any other engine that unified_planning finds can be named, too.")
    return "\n".join(lines) + "\n"


def engines_value(engines: Iterable[Engine]) -> list[dict[str, Any]]:
    """Return the value that `engines --format json` writes."""
    return [
        {
            "name": engine.name,
            "promises": engine.promises,
            "licence": engine.licence,
            "installed": engine.installed,
            "package": engine.package,
        }
        for engine in engines
    ]
