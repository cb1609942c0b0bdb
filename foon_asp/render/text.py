"""Answers as text that a person can follow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from textwrap import wrap

from foon_asp.compare import COLUMNS, PAPER_COLUMNS, Row
from foon_asp.errors import counted
from foon_asp.graph import FunctionalUnit, Source
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval
from foon_asp.tree import TaskTree

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
    costs = tree.costs
    parts = [counted(costs.units, "step")]
    if costs.depth is not None:
        parts.append(counted(costs.depth, "round"))
    parts.append(counted(costs.inputs, "input"))
    if costs.success is not None:
        parts.append(f"success {costs.success:.3g}")
    proof = {"optimal": "proven optimal", "limit": "time limit, not proven"}.get(result.status, "")
    text = ", ".join(parts) + f" ({how}{', ' + proof if proof else ''})"
    for name, value in result.bound.items():
        word = "at most" if name == "success" else "at least"
        text += f"\nproven so far: {name} {word} {value:.3g}"
    if not tree.executable:
        missing = "; ".join(str(node) for node in tree.replay.missing)
        step = "in the end" if tree.replay.failed_at is None else f"at step {tree.replay.failed_at + 1}"
        text += f"\nNOT EXECUTABLE in any order: {step} it lacks {missing}"
    return text


def steps_text(tree: TaskTree) -> list[str]:
    """Write each unit: the motion, what it takes (and from which step), what it makes, where it stands."""
    maker: dict[int, int] = {}
    lines: list[str] = []
    for place, unit in enumerate(tree.steps, 1):
        lines += _step(tree.domain, unit, place, maker)
        for thing in tree.domain.reading.makes[unit.id]:
            if thing not in tree.domain.stock:
                maker.setdefault(thing, place)
    return lines


def _step(domain: Domain, unit: FunctionalUnit, place: int, maker: dict[int, int]) -> list[str]:
    foon = domain.foon
    things: list[str] = []
    tools: list[str] = []
    for number in unit.inputs:
        node = foon.objects[number]
        name = str(node) + (f" (step {maker[number]})" if number in maker else "")
        (tools if node.bare else things).append(name)
    makes = [str(foon.objects[number]) for number in domain.reading.makes[unit.id]]
    head = f"{place:3}. {unit.motion}"
    if unit.source.file:
        head += f"  [{short_source(unit.source)}]"
    lines = [head]
    lines += _listed("take", things)
    lines += _listed("with", tools)
    lines += _listed("get", makes)
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
    names = [str(row.goal) for row in rows]
    width = min(44, max(map(len, names), default=4))
    present = {name for row in rows for name in row.cells}
    groups = [(title, [name for name in columns if name in present]) for title, columns in _GROUPS]
    groups = [(title, columns) for title, columns in groups if columns]
    heads, titles = [" " * width], ["goal".ljust(width)]
    for title, columns in groups:
        heads.append(title.ljust(9 * len(columns) - 1))
        titles.append(" ".join(f"{_HEADS[name]:>8}" for name in columns))
    lines = [" | ".join(heads).rstrip(), " | ".join(titles)]
    for name, row in zip(names, rows, strict=True):
        cut = name if len(name) <= width else name[: width - 1] + "…"
        parts = [cut.ljust(width)]
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
