"""Plans as text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.supply import Supply
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.pddl.names import ListedUnit
from foon_asp.planning.plan import Plan
from foon_asp.render.proof import proof_text
from foon_asp.render.tree import failure_text, head_line, port_lines
from foon_asp.words import chance_text, counted


def answer_text(answer: PlanAnswer) -> str:
    """Write what an engine found: the verdict, then the steps."""
    head = "".join(f"{goal}\n" for goal in answer.goals)
    how = f"({answer.engine}, {answer.semantics}, by {answer.by}"
    if answer.plan is None:
        words = {"unsolvable": "no plan", "failed": "the engine failed"}
        return head + f"{words.get(answer.status, 'no plan was found')}: {answer.reason} {how})\n"
    if not answer.plan.units:
        return head + "nothing to do: the kitchen has it\n"
    if answer.by == "success" and answer.cost is not None:
        cost = f"success {chance_text(answer.cost, 4)}"
    elif answer.cost is None:
        cost = "success 0"
    else:
        cost = "" if answer.by == "units" else f"{answer.by} {answer.cost:.4g}"
    proof = proof_text(answer.status, answer.limit)
    how += f", {proof}" if proof else ""
    if answer.span is not None:
        cost += f"{', ' * bool(cost)}makespan {answer.span:.6g}"
    return head + f"{costs_text(answer.plan, cost)} {how})\n\n" + plan_text(answer.plan, answer.effects)


def plan_text(plan: Plan, effects: Effects) -> str:
    """Write the steps of a plan, what each uses up, and whether it can be executed."""
    world = plan.world
    lines: list[str] = []
    maker: dict[ObjectId, int] = {}
    supply = Supply(effects)
    for place, number in enumerate(plan.units, 1):
        unit = world.foon.units[number]
        used_up = supply.used_up(number)
        supply.execute(number)
        lines += [head_line(unit, place), *port_lines(world, unit, maker, used_up)]
        for object_id in used_up:
            maker.pop(object_id, None)
        makes = world.units.makes[number]
        maker.update((object_id, place) for object_id in makes if object_id not in effects.endless)
    if not plan.executable:
        lines.append(f"CANNOT BE EXECUTED under '{plan.semantics}': {failure_text(plan.replay)}")
    return "".join(f"{line}\n" for line in lines)


def named_plan_text(units: Sequence[UnitId], listed: Mapping[UnitId, ListedUnit]) -> str:
    """Write the steps of a plan of which there are only names, without what they take and make."""
    lines = []
    for place, unit in enumerate(units, 1):
        where = ", ".join(filter(None, (listed[unit].source, f"unit {unit}")))
        lines.append(f"{place:3}. {listed[unit].motion}  [{where}]\n")
    return "".join(lines)


def costs_text(plan: Plan, cost: str = "") -> str:
    """Write how long a plan is: its steps, its parallel steps, and what it costs."""
    again = len(plan.units) - len(set(plan.units))
    parts = [counted(len(plan.units), "step"), f"{plan.makespan} in parallel"]
    if again:
        parts.append(f"{again} of them again")
    if cost:
        parts.append(cost)
    return ", ".join(parts)
