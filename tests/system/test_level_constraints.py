"""What a level cannot see it does not promise to leave out."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.constraints import Constraints
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from support.cli import run
from support.examples import many
from support.level_checks import on
from support.small_foons import node, queries, world

UNITS = ("bowl{egg} -mix-> dough", "bowl{flour} -mix-> dough", "dough -bake-> cake")


@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize(
    "constraints",
    [
        Constraints(diets=(("no egg", ("egg", "unicorn")),)),
        Constraints(without=("egg",)),
        Constraints(without=("flour",)),
    ],
)
def test_a_forbidden_content_is_refused(level: int, constraints: Constraints) -> None:
    where = world(UNITS, "bowl{egg} + bowl{flour}")
    with pytest.raises(QueryError, match=f"level {level} does not show all .*; ask on level 3"):
        retrieve(on(level, where), Query(node("cake"), constraints=constraints))
    tree = retrieve(where, Query(node("cake"), constraints=constraints)).tree
    assert tree is not None
    assert len(tree) == 2


def test_a_relatum_is_seen_on_level_2_alone() -> None:
    where = world(["egg@bowl -mix-> dough", "dough -bake-> cake"], "egg@bowl")
    for key in ("without", "without_tools"):
        query = Query(node("cake"), constraints=Constraints(**{key: ("bowl",)}))  # type: ignore[arg-type]
        assert "without" in retrieve(on(2, where), query).reason
        with pytest.raises(QueryError, match="level 1 does not show"):
            retrieve(on(1, where), query)


def test_the_command_says_so_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "foon.txt").write_text("O\tbowl\nS\tcontains\t{egg}\nM\tmix\nO\tcake\nS\tdone\n//\n")
    (tmp_path / "kitchen.json").write_text(json.dumps([{"label": "bowl", "ingredients": ["egg"]}]))
    files = ["--foon", str(tmp_path / "foon.txt"), "--kitchen", str(tmp_path / "kitchen.json")]
    status, out, err = run(capsys, "retrieve", "cake", *files, "--diet", "vegan", "--level", "2")
    assert (status, out) == (2, "")
    assert "'egg'" in err.splitlines()[-1]
    assert "diet vegan" in err


def listed_labels(where: World, unit: UnitId, *, contents: bool) -> set[str]:
    """Return what a unit of the full FOON has to do with."""
    ports = where.foon.units[unit]
    things = [where.foon.objects[number] for number in (*ports.inputs, *ports.outputs)]
    found = {thing.label for thing in things}
    found |= {state.relatum for thing in things for state in thing.states if state.relatum}
    return found | {c for thing in things for s in thing.states for c in s.contents or () if contents}


@pytest.mark.parametrize("level", [1, 2])
@many(150)
@given(query=queries(), data=st.data())
def test_what_is_answered_on_a_level_leaves_the_label_out(
    level: int, query: tuple[World, ObjectNode], data: st.DataObject
) -> None:
    """No unit that becomes one of the tree has to do with the label on level 3."""
    full, goal = query
    labels = sorted({label for thing in full.foon.objects for label in thing.named_labels})
    label, tool = data.draw(st.sampled_from(labels)), data.draw(st.booleans())
    constraints = Constraints(without_tools=(label,)) if tool else Constraints(without=(label,))
    view = on(level, full)
    try:
        answer = retrieve(view, Query(goal, constraints=constraints))
    except QueryError:
        event("refused")
        return
    event(answer.status)
    for unit in answer.tree.units if answer.tree else ():
        origins = [
            number for number, image in zip(full.foon.units.ids, view.images, strict=True) if image == unit
        ]
        assert not any(label in listed_labels(full, each, contents=not tool) for each in origins)
