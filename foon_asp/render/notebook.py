"""Answers as HTML, as notebooks show them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.tree import TaskTree


def table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return an HTML table; every cell is escaped."""
    lines = ["<table>", "<tr>" + "".join(f"<th>{escape(head)}</th>" for head in heads) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows]
    return "\n".join([*lines, "</table>"])


def tree_html(tree: TaskTree) -> str:
    """Return the steps of a task tree as a table."""
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
    """Return the verdict of an answer, and its steps as a table."""
    _, verdict, *_ = str(answer).split("\n")
    head = f"<p><b>{escape('; '.join(map(str, answer.goals)))}</b><br>{escape(verdict)}</p>"
    return head if answer.tree is None else head + tree_html(answer.tree)
