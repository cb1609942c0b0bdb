"""`foon-asp adapt` and `World.adapt`: dishes asked for by kind, category and ingredients."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import foon_asp as fa
from support.cli import check_same_bytes, run
from support.schemas import output

SCHEMA = "adapt.schema.json"
SWAP = fa.Replacement("banana", "mango", 0.8, "ripe and soft")
SAME = fa.Replacement("milk", "oat milk", 0.9)

MARKED = """\
O1\tapple\t0
S1\traw
M1\tmix\t0\t2
O2\tfruit salad\t1\t15
S2\tmixed
S3\tcontains\t{apple}
//
O1\tpotato\t0
S1\traw
M1\tmix\t0\t2
O3\tpotato salad\t1\t15
S2\tmixed
S3\tcontains\t{potato}
//
O3\tpotato salad\t0
S2\tmixed
S3\tcontains\t{potato}
M2\tchill\t2\t3
O3\tpotato salad\t0
S4\tcold
//
O1\tpotato\t0
S1\traw
M1\tboil\t0\t2
O4\tpotato soup\t1\t1
S2\thot
//
"""


@pytest.fixture
def marked(tmp_path: Path) -> Path:
    """A data folder whose files mark dishes with their categories."""
    (tmp_path / "FOON.txt").write_text(MARKED, encoding="utf-8")
    kitchen = [{"label": label, "states": ["raw"]} for label in ("apple", "potato")]
    (tmp_path / "kitchen.json").write_text(json.dumps(kitchen), encoding="utf-8")
    return tmp_path


def query(dish: str, **keys: object) -> fa.Query:
    return fa.Query(dish, substitute=[SWAP, SAME], **keys)  # type: ignore[arg-type]


def test_what_is_avoided_is_replaced_and_what_is_wanted_added() -> None:
    world = fa.load()
    found = world.adapt(
        query("smoothie", without=["banana"]), ["mango", "oat milk", "strawberry", "gold leaf"]
    )
    assert found.replaced == (SWAP,)
    assert found.additions == (SAME,)
    assert found.missing == ("gold leaf",)
    assert [str(node) for node in found.brought] == ["mango [whole]", "oat milk in [cup]"]
    assert found.distance == pytest.approx(0.201 + 0.1 + 1)
    assert found.tree is not None
    combine = next(step for step in found if step.motion == "combine")
    assert {"mango [peeled]", "milk in [cup]", "oat milk in [cup]"} <= set(map(str, combine.takes))
    assert [str(node) for node in combine.makes] == ["blender {mango, milk, oat milk, strawberry, yogurt}"]
    # The replay judges with the changes made; what it costs is what the steps cost as they were annotated.
    assert found.tree.executable
    assert found.answer.costs == world.retrieve("smoothie").costs
    assert "mango [peeled]" not in map(str, world.foon.objects)


def test_what_cannot_be_replaced_is_left_out_and_a_diet_is_met() -> None:
    found = fa.load().adapt(fa.Query("omelette", diets=["vegan"]))
    assert found.status == fa.Status.OPTIMAL
    assert found.tree is not None
    named = {label for step in found for node in step.takes for label in node.named_labels}
    assert not named & {"egg", "cheddar cheese", "butter"}
    assert {row.label: row.by for row in found.replaced} == {"cheddar cheese": None, "egg": None}
    assert found.distance == 2.002


@pytest.mark.parametrize(
    ("dish", "meant"),
    [
        ("15", ["fruit salad [mixed] {apple}", "potato salad [mixed] {potato}"]),
        ("salad", ["fruit salad [mixed] {apple}", "potato salad [mixed] {potato}"]),
        ("salad {potato}", ["potato salad [mixed] {potato}"]),
        ("potato salad [cold]", ["potato salad [cold]"]),
        ("soup", ["potato soup [hot]"]),
    ],
)
def test_dishes_are_named_by_kind_and_by_category(marked: Path, dish: str, meant: list[str]) -> None:
    found = fa.load(marked).adapt(dish)
    assert sorted(str(each.dish) for each in found.candidates) == meant


def test_the_dish_with_what_is_wanted_is_the_nearest(
    marked: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    value = output(capsys, "adapt", "15", "--data", str(marked), "--with", "potato")
    assert (value["answer"]["goal"]["label"], value["distance"]) == ("potato salad", 0)
    assert [each["distance"] for each in value["dishes"]] == [0, 0.713]
    for level in (1, 2):
        found = fa.load(marked).on_level(level).adapt("salad", ["potato"])
        assert (found.dish.label, found.distance) == ("potato salad", 0)
    status, out, _ = run(capsys, "adapt", "salad", "--data", marked, "--max-units", 0)
    assert status == 1
    assert (
        "no task tree: none of 2 dishes can be made so\n\n  fruit salad [mixed] {apple}: the constraints"
        in out
    )


def test_python_says_the_same_as_the_command(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    table = tmp_path / "swaps.tsv"
    table.write_text("banana\tmango\t0.8\tripe and soft\nmilk\toat milk\t0.9\n", encoding="utf-8")
    flags = ("smoothie", "--with", "mango,oat milk", "--without", "banana", "--substitute", str(table))
    found = fa.load().adapt(query("smoothie", without=["banana"]), ["mango", "oat milk"])
    status, out, _ = run(capsys, "adapt", *flags)
    assert (status, out.rstrip()) == (0, str(found))
    values = json.loads(found.to_json()), output(capsys, "adapt", *flags)
    for value in values:
        value["seconds"] = value["answer"]["seconds"] = 0
    assert values[0] == values[1]
    status, out, _ = run(capsys, "adapt", *flags, "--format", "foon")
    assert status == 0
    assert [step.motion for step in found] == [unit.motion for unit in fa.read(out).units]
    check_same_bytes(["adapt", *flags], tmp_path)


def test_rules_of_the_users_own_hold_beside_likeness(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    rule = tmp_path / "rule.lp"
    text = 'criterion("peeling",9). penalty("peeling",U,3) :- use(U), motion(U,"peel").'
    rule.write_text(text, encoding="utf-8")
    flags = ("smoothie", "--without", "banana", "--objective", str(rule))
    value = output(capsys, "adapt", *flags)
    # Nothing is left of the banana to be peeled, and how far that is from what was asked is no rule here.
    assert (value["distance"], value["answer"]["own"]) == (1.001, {"9": 0})
    rule.write_text("near(U,1,1) :- use(U).")
    status, _, err = run(capsys, "adapt", "smoothie", "--constraint", rule)
    assert status == 2
    assert "near/3" in err


def test_a_limit_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    """Without any time there is a first tree, or none; nothing is proven, and each dish is told."""
    value = output(capsys, "adapt", "salad", "--with", "potato", "--time-limit", "0", status=3)
    assert value["answer"]["status"] == "limit"
    assert value["answer"]["limit"] == "time"
    assert len(value["dishes"]) == 3


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["salod"], "nothing in this FOON is called 'salod'; closest: salad"),
        (["vinegar"], "no unit makes 'vinegar', nor anything that ends in this"),
        (["99"], "the files mark no dish with the category 99; they mark none at all"),
        (["smoothie [hot]"], "no dish is 'smoothie [hot]'; of this kind there is smoothie [smooth]"),
        (["smoothie", "--with", "knife"], "'knife' is a utensil; only food is added"),
        (
            ["smoothie", "--with", "egg", "--diet", "vegan"],
            "'egg' is wanted, and is not to be there: 'diet vegan'",
        ),
        ([" "], "the dish is empty"),
        (["smoothie", "--with", ","], "the value is empty"),
    ],
)
def test_what_cannot_be_meant_is_refused(
    capsys: pytest.CaptureFixture[str], arguments: list[str], said: str
) -> None:
    status, out, err = run(capsys, "adapt", *arguments)
    assert (status, out) == (2, "")
    assert said in err


def test_python_refuses_likewise() -> None:
    world = fa.load()
    with pytest.raises(fa.QueryError, match="one dish is adapted at a time"):
        world.adapt(fa.Query("smoothie", "hummus"))
    with pytest.raises(fa.QueryError, match="'wanted' is a list of labels"):
        world.adapt("smoothie", "milk")
    with pytest.raises(fa.QueryError, match="a label is a text"):
        world.adapt("smoothie", [3])  # type: ignore[list-item]
