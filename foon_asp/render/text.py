"""Answers as text that a person can follow."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from textwrap import wrap

from foon_asp.alternatives import Alternatives
from foon_asp.compare import COLUMNS, PAPER_COLUMNS, HumanTable, Row
from foon_asp.criteria import Level
from foon_asp.errors import counted
from foon_asp.graph import FunctionalUnit, ObjectNode, Source
from foon_asp.menu import Menu
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval
from foon_asp.tree import Replay, TaskTree

_WIDTH = 100


def retrieval_text(result: Retrieval) -> str:
    """Write a task tree as numbered steps, or say why there is none."""
    lines = [str(result.goal), _verdict(result)]
    if result.tree is not None:
        lines.append("")
        lines += steps_text(result.tree)
    return "\n".join(lines) + "\n"


def _verdict(result: Retrieval) -> str:
    how = result.method + (f" by {','.join(result.by)}" if result.by else "")
    if not result.founded:
        how += ", reference reading"
    tree = result.tree
    if tree is None:
        if result.status == "limit":
            return f"no task tree was found before the time limit ({how})"
        return f"no task tree: {result.reason}"
    if not tree.units:
        return "nothing to do: the kitchen has it"
    parts = _costs(tree, result.by)
    proof = {"optimal": "proven optimal", "limit": "time limit, not proven"}.get(result.status, "")
    parts += [f"{paid} by your rules at priority {priority}" for priority, paid in result.own.items()]
    text = ", ".join(parts) + f" ({how}{', ' + proof if proof else ''})"
    for name, value in result.bound.items():
        word = "at most" if Level.parse(name).names == ("success",) else "at least"
        text += f"\nproven so far: {name} {word} {value:.3g}"
    if not tree.executable:
        text += f"\nNOT EXECUTABLE in any order: {failure_text(tree.replay)}"
    return text


def failure_text(replay: Replay) -> str:
    """Say where a replay failed, and what was missing there."""
    step = "in the end" if replay.failed_at is None else f"at step {replay.failed_at + 1}"
    return f"{step} it lacks {'; '.join(map(str, replay.missing))}"


_UNITS = {
    "tools": "tool",
    "dirty": "container",
    "motions": "motion",
    "time": "second",
    "human": "human step",
}
"""How criteria are counted that are only shown where they were asked for."""


def _costs(tree: TaskTree, by: Iterable[str]) -> list[str]:
    """Return what a tree costs by the usual criteria and by those that were asked for."""
    costs = tree.costs
    parts = [counted(costs.units, "step")]
    if costs.depth is not None:
        parts.append(counted(costs.depth, "round"))
    parts.append(counted(costs.inputs, "input"))
    if costs.success is not None:
        parts.append(f"success {costs.success:.3g}")
    asked = {name for text in by for name in Level.parse(text).names}
    for name, word in _UNITS.items():
        if name in asked or (name == "human" and tree.human):
            parts.append(counted(getattr(costs, name), word))
    return parts


def alternatives_text(result: Alternatives) -> str:
    """Write several task trees: a line for each, then their steps."""
    by = ",".join(result.by)
    lines = [str(result.goal)]
    count = len(result.trees)
    if result.status == "unreachable":
        return "\n".join([*lines, f"no task tree: {result.reason}"]) + "\n"
    lines.append(_HEADINGS[result.kind].format(trees=counted(count, "task tree"), by=by))
    if result.status == "limit" and not result.proven:
        lines[-1] = "the best task tree before the time limit, not proven" if count else "none found in time"
    elif result.status == "limit":
        lines[-1] += ", before the time limit; there may be others"
    elif result.complete:
        lines[-1] += "; there are no others"
    elif result.kind == "all optimal":
        lines[-1] += ", and there are more"
    shown = result.trees
    if result.kind == "all optimal" and count > 1:
        common = frozenset.intersection(*(frozenset(tree.units) for tree in result.trees))
        lines.append(f"they have {counted(len(common), 'step')} in common; this is one of them:")
        shown = result.trees[:1]
    for place, tree in enumerate(shown, 1):
        head = f"{place}) " if len(shown) > 1 else ""
        lines += ["", head + (", ".join(_costs(tree, result.by)) if tree.units else "nothing to do")]
        if place > 1:
            same = len({*tree.units} & {*result.trees[0].units})
            lines[-1] += f" ({counted(same, 'step')} as in 1)"
        lines += steps_text(tree)
    return "\n".join(lines) + "\n"


_HEADINGS = {
    "best": "the {trees} that are best by {by}, proven",
    "all optimal": "{trees} optimal by {by}, proven",
    "diverse": "{trees} as different as possible, the first one optimal by {by}, proven",
    "pareto": "{trees} that nothing beats by {by} at once, proven",
}


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
        lines.append(f"no task tree for all of them together: {together.reason or 'none was found in time'}")
        return "\n".join(lines) + "\n"
    costs = together.tree.costs
    proof = "proven optimal" if together.status == "optimal" else "time limit, not proven"
    by = ",".join(together.by)
    lines.append("1 dish" if len(menu.apart) == 1 else f"{len(menu.apart)} dishes")
    lines.append(f"together: {', '.join(_costs(together.tree, together.by))} (by {by}, {proof})")
    apart = [each.tree.costs for each in menu.apart if each.tree]
    if len(apart) == len(menu.apart):
        units, inputs = sum(each.units for each in apart), sum(each.inputs for each in apart)
        text = f"apart:    {counted(units, 'step')}, {counted(inputs, 'input')}"
        chances = [each.success for each in apart if each.success is not None]
        if len(chances) == len(apart):
            text += f", success {math.prod(chances):.3g}"
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


def human_text(tables: Sequence[HumanTable]) -> str:
    """Write for each goal the chance of success, the more steps a human does."""
    columns = max((len(table.trees) for table in tables), default=0)
    width, names = _column([table.goal for table in tables])
    lines = ["goal".ljust(width) + "".join(f"{count:>9}" for count in range(columns)) if columns else "goal"]
    for name, table in zip(names, tables, strict=True):
        if not table.trees:
            lines.append(f"{name}  -  {table.reason}")
            continue
        cells = [_chance(tree, proven) for tree, proven in table.trees]
        lines.append(name + "".join(f"{cell:>9}" for cell in cells))
    lines += ["", "highest chance of success with at most so many steps done by a human; ? not proven"]
    return "\n".join(lines) + "\n"


def _column(goals: Iterable[ObjectNode]) -> tuple[int, list[str]]:
    """Return the width of a column of goals, and each goal cut or filled to that width."""
    names = [str(goal) for goal in goals]
    width = min(44, max(map(len, names), default=4))
    return width, [(name if len(name) <= width else name[: width - 1] + "…").ljust(width) for name in names]


def _chance(tree: TaskTree | None, proven: bool) -> str:
    if tree is None or tree.costs.success is None:
        return "?"
    return f"{tree.costs.success:.2g}{'' if proven else '?'}"


def steps_text(tree: TaskTree, notes: Mapping[int, str] | None = None) -> list[str]:
    """Write each unit: the motion, what it takes (and from which step), what it makes, where it stands.

    `notes` are written behind the motions of some units.
    """
    maker: dict[int, int] = {}
    lines: list[str] = []
    for place, unit in enumerate(tree.steps, 1):
        head, *rest = _step(tree, unit, place, maker)
        lines += [head + (notes or {}).get(unit.id, ""), *rest]
        for thing in tree.domain.reading.makes[unit.id]:
            if thing not in tree.domain.stock:
                maker.setdefault(thing, place)
    return lines


def _step(tree: TaskTree, unit: FunctionalUnit, place: int, maker: Mapping[int, int]) -> list[str]:
    return step_lines(tree.domain, unit, place, maker, " (human)" if unit.id in tree.human else "")


def step_lines(
    domain: Domain,
    unit: FunctionalUnit,
    place: int,
    maker: Mapping[int, int],
    note: str = "",
    used_up: Iterable[int] = (),
) -> list[str]:
    """Write one unit as the step at a place; `maker` are the places of the steps that made what there is.

    `note` is written behind the motion; `used_up` are objects that are not there afterwards.
    """
    foon = domain.foon
    things: list[str] = []
    tools: list[str] = []
    for number in unit.inputs:
        node = foon.objects[number]
        name = str(node) + (f" (step {maker[number]})" if number in maker else "")
        (tools if node.bare else things).append(name)
    makes = [str(foon.objects[number]) for number in domain.reading.makes[unit.id]]
    head = f"{place:3}. {unit.motion}{note}"
    head += f"  [{short_source(unit.source)}, unit {unit.id}]" if unit.source.file else f"  [unit {unit.id}]"
    lines = [head]
    lines += _listed("take", things)
    lines += _listed("with", tools)
    lines += _listed("get", makes)
    lines += _listed("gone", [str(foon.objects[number]) for number in used_up])
    return lines


def _listed(word: str, names: Sequence[str]) -> list[str]:
    if not names:
        return []
    return wrap(
        "; ".join(names),
        _WIDTH,
        initial_indent=f"     {word:5}",
        subsequent_indent=" " * 12,
        break_long_words=False,
        break_on_hyphens=False,
    )


def short_source(source: Source) -> str:
    """Name the file without its folders."""
    name = Path(source.file).name
    return f"{name}:{source.line}" if source.line else name


def reach_text(domain: Domain, available: Iterable[int], executable: Iterable[int], *, listing: bool) -> str:
    """Say how much of the FOON the kitchen can execute and make."""
    available = list(available)
    made = [thing for thing in available if thing not in domain.stock]
    lines = [
        f"units    {len(list(executable)):6} of {len(domain.foon.units)} can be executed",
        f"objects  {len(available):6} available: {len(domain.stock)} in the kitchen,"
        f" {len(made)} can be made (the FOON knows {len(domain.foon.objects)})",
    ]
    if listing:
        lines += sorted(str(domain.node(thing)) for thing in made)
    return "\n".join(lines) + "\n"


_HEADS = {
    "paper_ids": "IDS",
    "paper_success": "h1",
    "paper_inputs": "h2",
    "first_reference": "first",
    "greedy_success_reference": "success",
    "greedy_inputs_reference": "inputs",
    "first": "first",
    "ids": "ids",
    "greedy_success": "success",
    "greedy_inputs": "inputs",
    "optimal": "optimal",
}
_GROUPS = (
    ("paper", PAPER_COLUMNS),
    ("reference", tuple(name for name, column in COLUMNS.items() if not column[2])),
    ("founded", tuple(name for name, column in COLUMNS.items() if column[2])),
)


def comparison_text(rows: Sequence[Row]) -> str:
    """Write the table of units per method: `!` cannot be executed, `*` is proven, `-` no tree."""
    width, names = _column(row.goal for row in rows)
    present = {name for row in rows for name in row.cells}
    groups = [(title, [name for name in columns if name in present]) for title, columns in _GROUPS]
    groups = [(title, columns) for title, columns in groups if columns]
    heads, titles = [" " * width], ["goal".ljust(width)]
    for title, columns in groups:
        heads.append(title.ljust(9 * len(columns) - 1))
        titles.append(" ".join(f"{_HEADS[name]:>8}" for name in columns))
    lines = [" | ".join(heads).rstrip(), " | ".join(titles)]
    for name, row in zip(names, rows, strict=True):
        parts = [name]
        parts += [" ".join(_cell(row, column) for column in columns) for _, columns in groups]
        lines.append(" | ".join(parts))
    lines.append("")
    lines.append(
        "functional units in the tree; ! cannot be executed, * proven optimal, - no tree exists, ? time limit"
    )
    if any(title == "paper" for title, _ in groups):
        lines.append("paper: as published (IDS, heuristic 1: success rate, heuristic 2: fewest inputs)")
    return "\n".join(lines) + "\n"


def _cell(row: Row, name: str) -> str:
    cell = row.cells.get(name)
    if cell is None:
        return " " * 8
    if cell.units is None:
        return f"{'-' if cell.proven else '?':>8}"
    mark = "!" if cell.executable is False else "*" if cell.proven else " "
    return f"{cell.units:>7}{mark}"
