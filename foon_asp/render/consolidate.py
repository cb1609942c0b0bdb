"""One tree made of several as text: its steps with their support, and what became of the rest."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from foon_asp.model.node import Source
from foon_asp.query.objective import Costs
from foon_asp.render.explain import explanation_text
from foon_asp.render.table import table
from foon_asp.render.tree import retrieval_text
from foon_asp.retrieval.consolidate import Consolidation, Dropped, SampleReport
from foon_asp.retrieval.samples import Reworded
from foon_asp.words import counted, short_source, shortened, wrapped

if TYPE_CHECKING:
    import pandas as pd


def consolidation_text(found: Consolidation) -> str:
    """Write the tree, or why there is none; then what was left out or written otherwise, and each tree."""
    parts = [_tree(found), _support(found), _goals(found), _dropped(found), _reworded(found), _trees(found)]
    return "\n\n".join("\n".join(lines) for lines in parts if lines) + "\n"


def consolidation_frame(found: Consolidation) -> pd.DataFrame:
    """Return the steps, a row each, with their support: in how many trees they are, and in which."""
    import pandas as pd

    backings = [found.backing[step.unit] for step in found]
    rows = [
        {
            "step": step.place,
            "motion": step.motion,
            "takes": "; ".join(map(str, step.takes)),
            "makes": "; ".join(map(str, step.makes)),
            "support": len(backing.trees),
            "trees": "; ".join(backing.trees),
        }
        for step, backing in zip(found, backings, strict=True)
    ]
    return pd.DataFrame(rows, columns=["step", "motion", "takes", "makes", "support", "trees"]).set_index(
        "step"
    )


def _tree(found: Consolidation) -> list[str]:
    if found.explanation is not None:
        return explanation_text(found.explanation).rstrip().splitlines()
    return retrieval_text(found.answer).rstrip().splitlines()


def _support(found: Consolidation) -> list[str]:
    """Say of each step how many of the trees have it, and where it stands in these."""
    count = len(found.samples)
    lines: list[str] = []
    for step in found:
        backing = found.backing[step.unit]
        places = ", ".join(map(_place, backing.sources))
        lines += wrapped(places, f"{step.place:3}. {len(backing.trees)} of {count}: ", "     ")
    return ["Support:", *lines] if lines else []


def _place(source: Source) -> str:
    """Write a place with the last folder of its file: samples often have one name, in several folders."""
    *_, folder, _ = ("", *source.file.replace("\\", "/").split("/"))
    return f"{folder}/" * bool(folder) + short_source(source.file, source.line)


def _goals(found: Consolidation) -> list[str]:
    """Say what the trees are for, if they do not agree."""
    count = len(found.samples)
    lines = [f"  {len(vote.trees)} of {count}  {vote.node}" for vote in found.votes]
    return ["The trees are for:", *lines] if len(found.votes) > 1 else []


def _dropped(found: Consolidation) -> list[str]:
    lines = [line for each in found.dropped for line in _dropped_lines(each)]
    return [f"Left out: {counted(len(found.dropped), 'step')}", *lines] if lines else []


def _dropped_lines(dropped: Dropped) -> Iterator[str]:
    motion = "" if dropped.unit is None else f"{dropped.unit.motion}: "
    yield from wrapped(f"{motion}{dropped.reason}", f"  {_place(dropped.source)}  ", "      ")


def _reworded(found: Consolidation) -> list[str]:
    lines = [line for each in found.reworded for line in _reworded_lines(each)]
    lines += [f"  the motion {motion} has no cost, and counts as the dearest" for motion in found.unpriced]
    return ["Taken for the same:", *lines] if lines else []


def _reworded_lines(reworded: Reworded) -> list[str]:
    each = reworded.aligned
    places = [_place(source) for source in reworded.sources]
    return wrapped(
        f"{each.word} is {each.instead} ({reworded.kind}, by {each.why}): {shortened(places, 4)}",
        "  ",
        "      ",
    )


def _trees(found: Consolidation) -> list[str]:
    heads = ("tree", "steps", "left out", "as it stands", "its best")
    rows = [_row(found, report) for report in found.samples]
    return table([heads, *rows], "<", ">", ">", ">", ">")


def _row(found: Consolidation, report: SampleReport) -> tuple[str | int, ...]:
    alone = report.alone.costs
    return (report.name, report.steps, report.dropped, _paid(found, report.whole), _paid(found, alone))


def _paid(found: Consolidation, costs: Costs | None) -> str:
    """Write what a tree costs by the first criterion."""
    if costs is None:
        return "not made"
    first = found.answer.query.objective.criteria[0]
    return f"{first.bound(first.cost(costs)):.6g}"
