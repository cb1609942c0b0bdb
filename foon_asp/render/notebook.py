"""Answers as HTML, as notebooks show them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from foon_asp.model.foon import Foon
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.plan import Plan
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.tree import TaskTree


def table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return an HTML table; every cell is escaped."""
    lines = ["<table>", "<tr>" + "".join(f"<th>{escape(head)}</th>" for head in heads) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows]
    return "\n".join([*lines, "</table>"])


def pictured(svg: str | None, below: str) -> str:
    """Return a picture, if there is one, which is scrolled where it is too wide, and what stands below it."""
    return below if svg is None else f'<div style="overflow:auto">{svg}</div>\n{below}'


def _folded(summary: str, svg: str | None, below: str) -> str:
    """Return a picture with the rest folded away below it; without one the rest is open."""
    if svg is None:
        return below
    return pictured(svg, f"<details><summary>{escape(summary)}</summary>{below}</details>")


def tree_html(tree: TaskTree) -> str:
    """Return a task tree as a picture, and its steps as a table."""
    return _folded("steps", tree._repr_svg_(), _steps_table(tree))


def _steps_table(tree: TaskTree) -> str:
    rows = (
        (
            step.place,
            step.motion + (" (human)" if step.human else ""),
            "; ".join(
                str(node) + (f" (step {origin})" if origin is not None else "")
                for node, origin in zip(step.takes, step.origins, strict=True)
            ),
            "; ".join(map(str, step.makes)),
        )
        for step in tree.steps
    )
    return table(("step", "motion", "takes", "makes"), rows)


def answer_html(answer: Answer) -> str:
    """Return the verdict of an answer, its tree as a picture, and its steps as a table."""
    _, verdict, *_ = str(answer).split("\n")
    head = _head(answer.goals, verdict)
    return head if answer.tree is None else head + tree_html(answer.tree)


def _head(goals: Iterable[object], verdict: str) -> str:
    return f"<p><b>{escape('; '.join(map(str, goals)))}</b><br>{escape(verdict)}</p>"


def plan_html(plan: Plan) -> str:
    """Return a plan as a picture, and its steps as a table."""
    return _folded("steps", plan._repr_svg_(), str(plan.to_frame().to_html()))


def plan_answer_html(answer: PlanAnswer) -> str:
    """Return the verdict of a question about plans, the plan as a picture, and its steps as a table."""
    lines = str(answer).split("\n")[len(answer.goals) :]
    head = _head(answer.goals, lines[0])
    return head if answer.plan is None else head + plan_html(answer.plan)


def foon_html(foon: Foon) -> str:
    """Return what a FOON has as a table; a small one as a picture, too."""
    rows = [
        ("functional units", f"{len(foon.units):,}"),
        ("object nodes", f"{len(foon.objects):,}"),
        ("motions", f"{len(foon.motions):,}"),
    ]
    return pictured(foon._repr_svg_(), table(("FOON", ""), rows))
