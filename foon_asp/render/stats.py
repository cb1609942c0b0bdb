"""Statistics as text and as a JSON value."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from foon_asp.state_syntax import object_to_json
from foon_asp.stats import Centralities, Statistics


def statistics_value(counts: Statistics, central: Centralities | None) -> dict[str, Any]:
    """Return the value that `stats --format json` writes."""
    value: dict[str, Any] = {
        "units_read": counts.units_read,
        "units": counts.units,
        "duplicates": counts.duplicates,
        "objects": counts.objects,
        "labels": counts.labels,
        "motions": counts.motions,
        "findings": dict(counts.findings),
        "levels": {
            str(level): {"units": units, "objects": objects}
            for level, (units, objects) in counts.levels.items()
        },
        "degrees": asdict(counts.degrees),
        "most_used": {
            "objects": [
                {"object": object_to_json(node), "count": count} for node, count in counts.most_used_objects
            ],
            "motions": [{"motion": motion, "count": count} for motion, count in counts.most_used_motions],
        },
    }
    if central is not None:
        value["centrality"] = {
            "edges": central.edges,
            "eigenvalue": central.eigenvalue,
            "alpha": central.alpha,
            **{
                name: [
                    {"object": object_to_json(node), "value": number}
                    for node, number in getattr(central, name).top
                ]
                for name in ("degree", "katz", "eigenvector")
            },
        }
    return value


def statistics_text(counts: Statistics, central: Centralities | None) -> str:
    """Write the statistics as a page."""
    findings = sum(counts.findings.values())
    lines = [
        f"units read  {counts.units_read:7}   (duplicates removed: {counts.duplicates})",
        f"units       {counts.units:7}",
        f"objects     {counts.objects:7}",
        f"labels      {counts.labels:7}",
        f"motions     {counts.motions:7}",
        f"findings    {findings:7}   (in reading; foon-asp audit finds more)",
        "",
        "level      units  objects",
        *(f"{level:5} {units:10} {objects:8}" for level, (units, objects) in counts.levels.items()),
        "",
        "degrees                      mean  maximum",
    ]
    for name, spread in (
        ("units that make an object", counts.degrees.makers),
        ("units that use an object", counts.degrees.users),
        ("inputs of a unit", counts.degrees.inputs),
        ("outputs of a unit", counts.degrees.outputs),
    ):
        lines.append(f"{name:25} {spread.mean:8.2f} {spread.maximum:8}")
    lines += ["", "most used objects"]
    lines += [f"{count:6}  {node}" for node, count in counts.most_used_objects]
    lines += ["", "most used motions"]
    lines += [f"{count:6}  {motion}" for motion, count in counts.most_used_motions]
    if central is not None:
        lines += ["", f"one-mode projection: {central.edges} edges, largest eigenvalue {central.eigenvalue}"]
        for title, measure in (
            ("degree centrality", central.degree),
            (f"Katz centrality (alpha {central.alpha})", central.katz),
            ("eigenvector centrality", central.eigenvector),
        ):
            lines += ["", title]
            lines += [f"{value:9.6f}  {node}" for node, value in measure.top]
    return "\n".join(lines) + "\n"
