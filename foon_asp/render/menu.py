"""A menu: what sharing saves, each dish, and the steps for all of them."""

from __future__ import annotations

import math

from foon_asp.render.proof import limit_text, proof_text
from foon_asp.render.tree import costs_parts, not_executable, steps_text
from foon_asp.retrieval.menu import Menu
from foon_asp.words import chance_text, counted


def menu_text(menu: Menu) -> str:
    """Write what sharing saves, each dish, and the steps for all of them."""
    lines = []
    for each in menu.left_out:
        lines.append(f"left out: {each.goal}: {each.reason}")
    together = menu.together
    if together.tree is None:
        for each in menu.apart:
            if each.status == "unreachable":
                lines.append(f"{each.goal}: {each.reason}")
        why = together.reason or f"none was found before the {limit_text(together.limit)}"
        lines.append(f"no task tree for all of them together: {why}")
        return "\n".join(lines) + "\n"
    costs = together.tree.costs
    proof = proof_text(together.status, together.limit)
    by = ",".join(together.by)
    lines.append("1 dish" if len(menu.apart) == 1 else f"{len(menu.apart)} dishes")
    lines.append(f"together: {', '.join(costs_parts(together.tree, together.by))} (by {by}, {proof})")
    lines += not_executable(together.tree)
    apart = [each.tree.costs for each in menu.apart if each.tree]
    if len(apart) == len(menu.apart):
        units, inputs = sum(each.units for each in apart), sum(each.inputs for each in apart)
        text = f"apart:    {counted(units, 'step')}, {counted(inputs, 'input')}"
        chances = [each.success for each in apart if each.success is not None]
        if len(chances) == len(apart):
            text += f", success {chance_text(math.prod(chances))}"
        lines.append(text)
        if units > costs.units:
            lines.append(f"sharing saves {counted(units - costs.units, 'step')}")
    lines.append("")
    for place, each in enumerate(menu.apart, 1):
        alone = counted(each.tree.costs.units, "step") if each.tree else "no tree in time"
        own = sum(dishes == (each.goal,) for dishes in menu.dishes.values())
        lines.append(f"{place:3}) {each.goal}\n     {alone} alone; {own} here for it only")
    lines.append("")
    numbers = {each.goal: place for place, each in enumerate(menu.apart, 1)}
    notes = {
        unit: " for " + ", ".join(str(numbers[dish]) for dish in dishes)
        for unit, dishes in menu.dishes.items()
        if dishes
    }
    lines += steps_text(together.tree, notes)
    return "\n".join(lines) + "\n"
