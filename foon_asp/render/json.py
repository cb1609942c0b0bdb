"""Answers as JSON values; docs/schema/ has the schemas."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from foon_asp.compare import Row
from foon_asp.graph import Foon, FunctionalUnit
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval
from foon_asp.state_syntax import object_to_json


def dumps(value: object) -> str:
    """Write a JSON value with stable formatting."""
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"


def unit_value(foon: Foon, unit: FunctionalUnit) -> dict[str, Any]:
    return {
        "id": unit.id,
        "motion": unit.motion,
        "inputs": [object_to_json(foon.objects[number]) for number in unit.inputs],
        "outputs": [object_to_json(foon.objects[number]) for number in unit.outputs],
        "source": {
            "file": unit.source.file,
            "line": unit.source.line,
            "video": unit.source.video,
        },
    }


def retrieval_value(result: Retrieval) -> dict[str, Any]:
    """Return the value that `retrieve --format json` writes for one goal."""
    tree = result.tree
    costs = tree.costs if tree else None
    return {
        "goal": object_to_json(result.goal),
        "method": result.method,
        "by": list(result.by),
        "founded": result.founded,
        "status": result.status,
        "reason": result.reason,
        "executable": tree.executable if tree else False,
        "size": costs.units if costs else None,
        "depth": costs.depth if costs else None,
        "costs": {
            "units": costs.units,
            "inputs": costs.inputs,
            "success": costs.success,
            "depth": costs.depth,
        }
        if costs
        else None,
        "bound": result.bound or None,
        "units": [unit_value(tree.domain.foon, unit) for unit in tree.steps] if tree else [],
        "seconds": round(result.seconds, 6),
    }


def reach_value(domain: Domain, available: Iterable[int], executable: Iterable[int]) -> dict[str, Any]:
    """Return the value that `reach --format json` writes."""
    available = list(available)
    return {
        "objects": len(domain.foon.objects),
        "available": len(available),
        "units": len(domain.foon.units),
        "executable": len(list(executable)),
        "makeable": [object_to_json(domain.node(thing)) for thing in available if thing not in domain.stock],
    }


def comparison_value(rows: Iterable[Row]) -> list[Mapping[str, Any]]:
    """Return the value that `compare --format json` writes."""
    return [
        {
            "goal": object_to_json(row.goal),
            **{
                name: {
                    "units": cell.units,
                    "executable": cell.executable,
                    "proven": cell.proven,
                }
                for name, cell in row.cells.items()
            },
        }
        for row in rows
    ]
