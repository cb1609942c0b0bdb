"""Statistics as a page."""

from __future__ import annotations

from foon_asp.audit.stats import Centralities, Statistics
from foon_asp.render.table import Cell, table


def statistics_text(counts: Statistics, central: Centralities | None) -> str:
    """Write the statistics as a page."""
    findings = sum(counts.findings.values())
    levels: list[tuple[Cell, ...]] = [("level", "units", "objects")]
    levels += [(level, units, objects) for level, (units, objects) in counts.levels.items()]
    degrees: list[tuple[Cell, ...]] = [("degrees", "mean", "maximum")]
    degrees += [
        (name, f"{spread.mean:.2f}", spread.maximum)
        for name, spread in (
            ("units that make an object", counts.degrees.makers),
            ("units that use an object", counts.degrees.users),
            ("inputs of a unit", counts.degrees.inputs),
            ("outputs of a unit", counts.degrees.outputs),
        )
    ]
    lines = [
        f"units read  {counts.units_read:7}   (duplicates removed: {counts.duplicates})",
        f"units       {counts.units:7}",
        f"objects     {counts.objects:7}",
        f"labels      {counts.labels:7}",
        f"motions     {counts.motions:7}",
        f"findings    {findings:7}   (in reading; foon-asp audit finds more)",
        "",
        *table(levels, ">5", ">10", ">8", gap=" "),
        "",
        *table(degrees, "<25", ">8", ">8", gap=" "),
    ]
    lines += ["", "most used objects"]
    lines += table([(count, str(node)) for node, count in counts.most_used_objects], ">6")
    lines += ["", "most used motions"]
    lines += table([(count, motion) for motion, count in counts.most_used_motions], ">6")
    if central is not None:
        lines += ["", f"one-mode projection: {central.edges} edges, largest eigenvalue {central.eigenvalue}"]
        for title, measure in (
            ("degree centrality", central.degree),
            (f"Katz centrality (alpha {central.alpha})", central.katz),
            ("eigenvector centrality", central.eigenvector),
        ):
            lines += ["", title]
            lines += table([(f"{value:.6f}", str(node)) for node, value in measure.top], ">9")
    return "\n".join(lines) + "\n"
