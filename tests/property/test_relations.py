"""Relations matched loosely: as if all were `in`, in Python and in `units.lp`."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

import foon_asp as fa
from foon_asp.asp.facts import facts
from foon_asp.asp.solver import open_solver
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectNode, State
from foon_asp.model.world import World
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.retrieval.methods.proven import solved
from foon_asp.retrieval.retrieve import retrieve
from support import brute_force
from support.examples import many
from support.small_foons import node

_PLACES = ("in", "on", "under")
_POOL = (
    *(ObjectNode("onion", (State(place, "bowl"),)) for place in _PLACES),
    *(ObjectNode("onion", (State("chopped"), State(place, "bowl"))) for place in _PLACES[:2]),
    *(ObjectNode("water", (State(place, "cup"), State("on", "table"))) for place in _PLACES[:2]),
    *map(node, ("bowl{onion}", "bowl[empty]", "cup{water}", "(knife)", "onion[whole]")),
)


def _in(thing: ObjectNode) -> ObjectNode:
    """Call all relations of an object `in`, by hand."""
    states = [State("in", each.relatum) if each.relatum else each for each in thing.states]
    return ObjectNode(thing.label, tuple(states))


def _foon(units: Iterable[tuple[list[ObjectNode], list[ObjectNode]]]) -> Foon:
    """Build a FOON in which no two units are the same."""
    builder = FoonBuilder()
    for place, (before, behind) in enumerate(units):
        inputs, outputs = ([builder.object(thing) for thing in side] for side in (before, behind))
        builder.unit(f"motion {place}", inputs, outputs, Annotation())
    return builder.build()


@st.composite
def _pairs(
    draw: st.DrawFn, tools: tuple[tuple[str, ...], ...] = ((), ("bowl",), ("bowl", "cup"))
) -> tuple[World, World]:
    """Draw a world in which relations are matched loosely, and one in which all are written `in`."""
    side = st.lists(st.sampled_from(_POOL), min_size=1, max_size=4, unique=True)
    units = draw(st.lists(st.tuples(side, side), min_size=1, max_size=5))
    counts = draw(st.dictionaries(st.sampled_from(_POOL), st.integers(1, 2), max_size=3))
    stock = draw(st.lists(st.sampled_from(_POOL), max_size=3, unique=True))
    utensils = draw(st.sampled_from(tools))
    strict = draw(st.booleans())
    kitchen = Kitchen((*stock, *(each for each in counts if each not in stock)), frozenset(utensils))
    loose = World.of(_foon(units), kitchen, strict=strict, match_relations="loose")
    folded = [([*map(_in, before)], [*map(_in, behind)]) for before, behind in units]
    there = Kitchen(tuple(dict.fromkeys(map(_in, kitchen.objects))), frozenset(utensils))
    return loose, World.of(_foon(folded), there, strict=strict)


@given(worlds=_pairs())
@many(200)
def test_loosely_is_as_if_all_relations_were_in(worlds: tuple[World, World]) -> None:
    loose, plain = worlds
    assert {_in(loose.node(each)) for each in loose.stock} == set(plain.kitchen.objects)
    for unit in loose.foon.units.ids:
        for read in ("takes", "gives", "needs", "makes"):
            rows = [getattr(where.units, read)[unit] for where in worlds]
            assert len(set(rows[0])) == len(rows[0])
            assert {_in(loose.node(each)) for each in rows[0]} == {plain.node(each) for each in rows[1]}
    reached = [{_in(where.node(each)) for each in where.closure.available} for where in worlds]
    assert reached[0] == reached[1]


@given(worlds=_pairs(), semantics=st.sampled_from(SEMANTICS))
@many(100)
def test_the_encodings_read_as_python_does(worlds: tuple[World, World], semantics: str) -> None:
    where = worlds[0]
    text = facts(Problem(where, (), whole=True)) + "#show needs/2. #show makes/2. #show deletes/2."
    constants: dict[str, str | int] = {"strict": int(where.strict), "semantics": semantics}
    model = open_solver(["consumption.lp"], text, constants).best()
    effects = Effects(where, semantics)
    for name, rows in (("needs", where.units.needs), ("makes", where.units.makes)):
        assert set(model.rows(name)) == {(unit, each) for unit in where.foon.units.ids for each in rows[unit]}
    deleted = {(unit, each) for unit in where.foon.units.ids for each in effects.deletes(unit)}
    assert set(model.rows("deletes")) == deleted


@pytest.mark.parametrize("by", ["inputs", "tools,inputs", "dirty,units", "success"])
@given(worlds=_pairs(tools=(("bowl",), ("bowl", "cup"))), data=st.data())
@many(80)
def test_the_optimum_is_that_of_trying_every_set_of_units(
    by: str, worlds: tuple[World, World], data: st.DataObject
) -> None:
    """What a tree costs is what its units list; whether it can be executed, what is read as `in`.

    Most of these questions need no solver once they are reduced, so clingo is asked of all units, too.
    """
    rates = {motion: data.draw(st.sampled_from([0.5, 0.9])) for motion in worlds[0].foon.motions}
    loose, plain = (replace(where, kitchen=replace(where.kitchen, rates=rates)) for where in worlds)
    makeable = [number for number in loose.closure.available if number not in loose.stock]
    goal = data.draw(st.sampled_from([*map(loose.node, makeable), *loose.foon.objects]))
    found = [
        brute_force.sums(loose, units) | {"depth": costs["depth"]}
        for units in brute_force.every_set(plain)
        if (costs := brute_force.costs(plain, _in(goal), units)) is not None
    ]
    event(f"{min(len(found), 3)} trees")
    names = by.split(",")
    for answer in (
        retrieve(loose, Query(goal, by=by)),
        solved(Problem.of(loose, [goal]), Objective.parse(by)),
    ):
        assert (answer.tree is None) == (not found)
        if answer.tree is not None:
            best = brute_force.best(found, names)
            shown = [getattr(answer.tree.costs, name) for name in names]
            assert shown == pytest.approx([float(best[name]) for name in names])


@pytest.mark.parametrize("matching", ["strict", "loose"])
def test_the_case_of_published_json(tmp_path: Path, matching: str) -> None:
    bread = "O\tbread\nS\t{}\nS\ton\t[plate]\n"
    foon = tmp_path / "bread.txt"
    foon.write_text(f"//\n{bread.format('whole')}M\tslice\n{bread.format('sliced')}//\n")
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text('[{"label": "bread", "states": ["whole"], "ingredients": [], "container": "plate"}]')
    world = fa.load(tmp_path, foon=[foon], kitchen=kitchen, match_relations=matching)  # type: ignore[arg-type]
    if matching == "loose":
        answer = world.retrieve("bread [sliced] in [plate]")
        assert str(answer.goal) == "bread [sliced] on [plate]"
        assert len(answer.tree or ()) == 1
        again = fa.Answer.from_json(answer.to_json())
        assert again.tree is not None
        assert again.tree.executable
    else:
        assert not world.retrieve("bread [sliced] on [plate]")
        with pytest.raises(fa.QueryError):
            world.retrieve("bread [sliced] in [plate]")


def test_there_is_no_third_way() -> None:
    with pytest.raises(fa.QueryError, match="strict or loose, not 'fuzzy'"):
        fa.load(match_relations="fuzzy")  # type: ignore[arg-type]
