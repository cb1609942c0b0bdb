"""Answers as JSON values; docs/schema/ has the schemas."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from typing import Any

from foon_asp.alternatives import Alternatives
from foon_asp.compare import HumanTable, Row
from foon_asp.constraints import Constraints
from foon_asp.graph import Foon, FunctionalUnit
from foon_asp.menu import Menu
from foon_asp.problem import Domain
from foon_asp.retrieve import Retrieval
from foon_asp.state_syntax import object_to_json
from foon_asp.tree import TaskTree


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
    return {
        "goal": object_to_json(result.goal),
        "method": result.method,
        "by": list(result.by),
        "founded": result.founded,
        "constraints": constraint_names(result.constraints),
        "status": result.status,
        "reason": result.reason,
        "executable": tree.executable if tree else False,
        **tree_value(tree),
        "bound": result.bound or None,
        "own": {str(priority): paid for priority, paid in result.own.items()},
        "seconds": round(result.seconds, 6),
    }


def tree_value(tree: TaskTree | None) -> dict[str, Any]:
    """Return a task tree: what it costs, and its units in the order of execution, with who does them.

    Where there is no tree nothing is known of its costs, and it has no units.
    """
    if tree is None:
        return {"size": None, "depth": None, "costs": None, "units": []}
    costs = tree.costs
    units = [
        unit_value(tree.domain.foon, unit) | {"agent": "human" if unit.id in tree.human else "robot"}
        for unit in tree.steps
    ]
    return {"size": costs.units, "depth": costs.depth, "costs": asdict(costs), "units": units}


def constraint_names(constraints: Constraints) -> list[str]:
    """Return the names of constraints, as an explanation has them; rules of the user's own are one."""
    names = [name for _, name, _ in constraints.named()]
    return [*names, *(["rules"] if constraints.rules else [])]


def alternatives_value(result: Alternatives) -> dict[str, Any]:
    """Return the value that `retrieve` writes for one goal where several trees were asked for."""
    return {
        "goal": object_to_json(result.goal),
        "kind": result.kind,
        "by": list(result.by),
        "constraints": constraint_names(result.constraints),
        "status": result.status,
        "reason": result.reason,
        "complete": result.complete,
        "proven": result.proven,
        "trees": [tree_value(tree) for tree in result.trees],
        "seconds": round(result.seconds, 6),
    }


def menu_value(menu: Menu) -> dict[str, Any]:
    """Return the value that `menu --format json` writes."""
    steps = tree_value(menu.together.tree)
    for unit in steps["units"]:
        unit["dishes"] = [object_to_json(dish) for dish in menu.dishes[unit["id"]]]
    return {
        "by": list(menu.together.by),
        "constraints": constraint_names(menu.together.constraints),
        "status": menu.together.status,
        "reason": menu.together.reason,
        "together": steps,
        "bound": menu.together.bound or None,
        "apart": [
            {
                "goal": object_to_json(each.goal),
                "status": each.status,
                "reason": each.reason,
                "costs": asdict(each.tree.costs) if each.tree else None,
            }
            for each in menu.apart
        ],
        "left_out": [{"goal": object_to_json(each.goal), "reason": each.reason} for each in menu.left_out],
        "seconds": round(menu.together.seconds, 6),
    }


def human_value(table: HumanTable) -> dict[str, Any]:
    """Return the value that `compare --human --format json` writes for one goal."""
    return {
        "goal": object_to_json(table.goal),
        "reason": table.reason,
        "steps": [
            {
                "human_steps": count,
                "success": tree.costs.success if tree else None,
                "units": len(tree.units) if tree else None,
                "human": sorted(tree.human) if tree else [],
                "proven": proven,
            }
            for count, (tree, proven) in enumerate(table.trees)
        ],
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
