"""What is said of task trees as text: one in full, several as a table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from foon_asp.io.findings import Severity
from foon_asp.limits import ended
from foon_asp.render.table import table
from foon_asp.retrieval.check import Check, CheckedStep, Checks, Lack
from foon_asp.retrieval.mend import MOST_TRIED, Mending, edit_rows
from foon_asp.retrieval.prompt import joined, named, near_text, unit_text
from foon_asp.words import counted, short_source, wrapped

if TYPE_CHECKING:
    import pandas as pd


def checks_text(checks: Checks) -> str:
    """Write a tree in full, or a table of several."""
    if len(checks) == 1 and not checks.skipped:
        return "\n".join(_tree_lines(checks[0])) + "\n"
    heads = ("tree", "steps", "missing", "doubtful", "idle", "unused", "verdict")
    lines = table([heads, *map(_row, checks)], "<", ">", ">", ">", ">", ">")
    good, other = sum(map(bool, checks)), sum(each.order is not None for each in checks)
    lines.append(f"{counted(len(checks), 'tree')}: {good} executable, {other} in another order alone")
    if checks.skipped:
        lines.append(f"{ended(checks.limit)}: {counted(checks.skipped, 'more tree')} not looked at")
    return "\n".join(lines) + "\n"


def mending_head(mending: Mending) -> str:
    """Say how many edits it takes, and whether fewer would do."""
    if mending.edits is None:
        many = f"{MOST_TRIED} and fewer do not do" if mending.limit is None else ended(mending.limit)
        return "no edits do" if mending.proven else f"no edits were found: {many}"
    proof = "proven fewest" if mending.proven else f"{ended(mending.limit)}, not proven"
    return f"{counted(mending.cost, 'edit')} ({proof})"


def checks_frame(checks: Checks) -> pd.DataFrame:
    """Return a row for each tree: how many steps it has, and how many are wrong in which way."""
    import pandas as pd

    columns = ("steps", "missing", "doubtful", "idle", "unused")
    rows = [dict(zip(columns, _counts(each), strict=True)) for each in checks]
    frame = pd.DataFrame(rows, columns=[*columns], index=[each.name for each in checks])
    frame.insert(0, "executable", [each.executable for each in checks])
    return frame.rename_axis("tree")


def _counts(found: Check) -> tuple[int, int, int, int, int]:
    steps = found.steps
    return (
        len(steps),
        sum(bool(step.missing) for step in steps),
        sum(bool(step.doubtful) for step in steps),
        sum(step.idle for step in steps),
        sum(step.unused for step in steps),
    )


def _row(found: Check) -> tuple[str | int, ...]:
    return (found.name, *_counts(found), _verdict(found))


def _verdict(found: Check) -> str:
    if not found.steps:
        return "no step"
    if found.executable:
        return "executable"
    return "in another order" if found.order is not None else "not executable"


def _tree_lines(found: Check) -> Iterator[str]:
    yield found.name
    lost = [each for each in found.listing.findings if each.severity is Severity.ERROR]
    if not found.steps:
        yield "no step that can be read: there is nothing to execute"
    else:
        can = "can" if found.executable else "CANNOT"
        steps = counted(len(found.steps), "step")
        yield f"{steps}, {can} be executed in this order ({found.query.semantics})"
    if found.goals:
        yield from wrapped(joined(found.goals), "for ", "    ")
    for finding in lost:
        yield f"not read: {finding}"
    for step in found.steps:
        if not step.flawless:
            yield ""
            yield from _step_lines(found, step)
    if found.order is not None:
        yield ""
        yield from wrapped(" ".join(map(str, found.order)), "Another order would do: ", "  ")
    if found.mending is not None:
        yield ""
        yield f"To mend it: {mending_head(found.mending)}"
        yield from (f"  {row}" for row in edit_rows(found.mending, found.listing.sources))
    if found.needs:
        yield ""
        yield "It needs from the kitchen:"
        yield from (f"  {node}" for node in found.needs)


def _step_lines(found: Check, step: CheckedStep) -> Iterator[str]:
    where = short_source(step.source.file, step.source.line)
    yield f"{step.place:3}. {step.unit.motion}" + (f"  [{where}]" if where else "")
    for word, lacks in (("lacks", step.missing), ("doubt", step.doubtful)):
        for lack in lacks:
            yield from wrapped(str(lack.node), f"     {word} ", " " * 13)
            yield from _hint_lines(found, lack)
    if step.idle:
        yield "     idle: it brings about nothing that was not there"
    if step.unused:
        yield from wrapped(named(found.world, step.unit), "     unused: no later step takes ", " " * 13)


def _hint_lines(found: Check, lack: Lack) -> Iterator[str]:
    if lack.nearest:
        yield from wrapped(joined(map(near_text, lack.nearest)), "       there is ", " " * 9)
    if lack.likely is not None:
        unit = lack.likely.unit
        where = short_source(unit.source.file, unit.source.line)
        text = unit_text(found.world, unit) + (f" [{where}]" if where else "")
        yield from wrapped(text, "       likely missing: ", " " * 9)
        if lack.likely.lacks:
            yield from wrapped(joined(lack.likely.lacks), "         with ", " " * 11)
