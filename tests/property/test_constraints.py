"""Constraints against trying every set of units."""

from __future__ import annotations

import itertools
from collections.abc import Collection

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.model.node import FunctionalUnit, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support import brute_force
from support.examples import many
from support.small_foons import queries


def touched(where: World, unit: FunctionalUnit) -> set[str]:
    return handled(where, unit) | {c for o in listed(where, unit) for s in o.states for c in s.contents or ()}


def handled(where: World, unit: FunctionalUnit) -> set[str]:
    things = listed(where, unit)
    return {o.label for o in things} | {s.relatum for o in things for s in o.states if s.relatum}


def listed(where: World, unit: FunctionalUnit) -> list[ObjectNode]:
    return [where.foon.objects[number] for number in (*unit.inputs, *unit.outputs)]


@st.composite
def constrained(draw: st.DrawFn) -> tuple[World, ObjectNode, Constraints]:
    where, goal = draw(queries())
    labels = sorted({label for o in where.foon.objects for label in o.named_labels})
    units = brute_force.every_unit(where)
    motions = where.foon.motions
    some_labels = st.lists(st.sampled_from(labels), max_size=2, unique=True).map(tuple)
    return (
        where,
        goal,
        Constraints(
            without=draw(st.sampled_from([(), ()]) | some_labels),
            without_tools=draw(st.just(()) | some_labels),
            avoid_motions=draw(
                st.just(()) | st.lists(st.sampled_from(motions), max_size=2, unique=True).map(tuple)
            ),
            only_motions=draw(
                st.none() | st.lists(st.sampled_from(motions), min_size=1, unique=True).map(tuple)
            ),
            use_units=draw(st.just(()) | st.lists(st.sampled_from(list(units)), max_size=1).map(tuple)),
            max_units=draw(st.none() | st.integers(0, 5)),
            max_depth=draw(st.none() | st.integers(0, 4)),
            min_success=draw(st.none() | st.sampled_from([0.05, 0.3, 0.6, 0.9])),
        ),
    )


def allowed(where: World, units: Collection[UnitId], costs: brute_force.Costs, c: Constraints) -> bool:
    used = [where.foon.units[number] for number in units]
    return (
        not any(set(c.without) & touched(where, unit) for unit in used)
        and not any(set(c.without_tools) & handled(where, unit) for unit in used)
        and not any(unit.motion in c.avoid_motions for unit in used)
        and (c.only_motions is None or all(unit.motion in c.only_motions for unit in used))
        and set(c.use_units) <= set(units)
        and (c.max_units is None or len(used) <= c.max_units)
        and (c.max_depth is None or costs["depth"] <= c.max_depth)
        and (c.min_success is None or costs["success"] >= c.min_success)
    )


@pytest.mark.parametrize("by", [("units",), ("success",), ("depth", "inputs"), ("inputs", "depth")])
@many(120)
@given(query=constrained())
def test_the_best_tree_under_constraints_is_found(
    by: tuple[str, ...], query: tuple[World, ObjectNode, Constraints]
) -> None:
    where, goal, constraints = query
    numbers = brute_force.every_unit(where)
    possible = []
    for size in range(len(numbers) + 1):
        for units in itertools.combinations(numbers, size):
            costs = brute_force.costs(where, goal, units)
            if costs is not None and allowed(where, units, costs, constraints):
                possible.append(costs)
    result = retrieve(where, Query(goal, method="optimal", by=by, constraints=constraints))
    event(result.status)
    assert (result.status == "optimal") == bool(possible), result.reason
    if result.tree is not None:
        found = brute_force.costs(where, goal, result.tree.units)
        assert found is not None
        assert allowed(where, result.tree.units, found, constraints)
        assert result.tree.costs.depth == found["depth"]
        best = brute_force.best(possible, by)
        for name in by:
            assert float(found[name]) == pytest.approx(float(best[name]), rel=1e-4)


@many(150)
@given(query=constrained())
def test_the_constraints_that_must_give_way_are_the_fewest(
    query: tuple[World, ObjectNode, Constraints],
) -> None:
    where, goal, constraints = query
    result = retrieve(where, Query(goal, constraints=constraints))
    prefix = "the constraints leave no task tree; one exists without: "
    if not result.reason.startswith(prefix):
        return
    named = set(result.reason.removeprefix(prefix).split("; "))
    kept = {name for _, name, _ in constraints.named()}
    assert named <= kept
    assert retrieve(where, Query(goal, constraints=_without(constraints, named))).tree is not None
    for fewer in itertools.combinations(sorted(kept), len(named) - 1):
        assert retrieve(where, Query(goal, constraints=_without(constraints, set(fewer)))).tree is None


def _without(constraints: Constraints, names: set[str]) -> Constraints:
    """Drop constraints by name."""

    def keep(pattern: str, items: tuple[object, ...]) -> tuple[object, ...]:
        return tuple(item for item in items if pattern.format(item) not in names)

    def unless(name: str, value: object) -> object:
        return None if name in names else value

    return Constraints(
        without=keep("without {}", constraints.without),  # type: ignore[arg-type]
        without_tools=keep("without tool {}", constraints.without_tools),  # type: ignore[arg-type]
        avoid_motions=keep("avoid motion {}", constraints.avoid_motions),  # type: ignore[arg-type]
        only_motions=unless("only these motions", constraints.only_motions),  # type: ignore[arg-type]
        use_units=keep("use unit {}", constraints.use_units),  # type: ignore[arg-type]
        max_units=unless(_at_most(constraints.max_units, "unit"), constraints.max_units),  # type: ignore[arg-type]
        max_depth=unless(_at_most(constraints.max_depth, "round"), constraints.max_depth),  # type: ignore[arg-type]
        min_success=unless(f"success at least {constraints.min_success}", constraints.min_success),  # type: ignore[arg-type]
    )


def _at_most(count: int | None, what: str) -> str:
    return f"at most {count} {what}{'' if count == 1 else 's'}"
