"""`retrieve --substitute`: what constraints forbid is replaced, on levels, under limits, in processes."""

from __future__ import annotations

from pathlib import Path

import pytest

import foon_asp as fa
from support.cli import run
from support.schemas import output

VEGAN = (
    "egg\ttofu\t0.3\tscrambled",
    "cheddar cheese\tparmesan cheese\t0.8",
    "butter\tyogurt\t0.9",
    "butter\t-\t0.2",
)


@pytest.fixture
def table(tmp_path: Path) -> str:
    path = tmp_path / "vegan.tsv"
    path.write_text("\n".join(VEGAN), encoding="utf-8")
    return str(path)


def forbidden(diet: str) -> set[str]:
    [(_, labels)] = fa.Query("ice", diets=[diet]).constraints.diets
    return set(labels)


def test_a_diet_is_met_by_what_replaces_what_it_forbids(
    capsys: pytest.CaptureFixture[str], table: str
) -> None:
    """Nor is it replaced by anything that the diet forbids, too, however like it that is."""
    question = ("retrieve", "pancake", "--diet", "vegan")
    assert output(capsys, *question, status=1)["status"] == "unreachable"
    value = output(capsys, *question, "--substitute", table)
    assert [(row["label"], row["by"]) for row in value["replacements"]] == [("butter", None)]
    _, tree, _ = run(capsys, *question, "--substitute", table, "--format", "foon")
    named = fa.read(tree).named_labels
    assert not named & forbidden("vegan")


@pytest.mark.parametrize("level", [1, 2, 3])
def test_what_the_kitchen_lacks_is_replaced_on_every_level(level: int) -> None:
    cream, bowl, dish = "cream [cold] in [cup]", "bowl [empty]", "whipped cream [stiff] in [bowl]"
    foon = fa.read([([cream, bowl], "whip", [dish, "bowl {whipped cream}"])])
    world = fa.World(foon, ["milk [cold] in [cup]", bowl], utensils=["bowl", "cup"]).on_level(level)
    swap = fa.Replacement("cream", "milk", 0.7)
    assert not world.retrieve("whipped cream")
    answer = world.retrieve(fa.Query("whipped cream", substitute=[swap]))
    assert answer.status == fa.Status.OPTIMAL
    assert answer.tree is not None
    assert answer.tree.replacements == (swap,)
    assert answer.tree.executable
    assert "milk" in {node.label for node in answer.tree.steps[0].takes}


def test_processes_send_the_tree_with_its_replacements() -> None:
    world = fa.load()
    swap = fa.Replacement("cheddar cheese", "parmesan cheese", 0.8)
    query = fa.Query("omelette [cooked]", without=["cheddar cheese"], substitute=[swap])
    alone = world.retrieve(query)
    for answer in world.answer_many([query, query], jobs=2):
        assert answer.tree is not None
        assert (answer.tree.replacements, answer.costs) == ((swap,), alone.costs)
        assert [str(step) for step in answer] == [str(step) for step in alone]


def test_a_limit_is_told_and_what_is_found_until_then_is_whole(
    capsys: pytest.CaptureFixture[str], table: str
) -> None:
    question = ("retrieve", "omelette [cooked]", "--without", "cheddar cheese", "--substitute", table)
    value = output(capsys, *question, "--time-limit", "0", status=3)
    assert (value["status"], value["limit"]) == ("limit", "time")
    assert value["executable"] == bool(value["units"])
    ample = output(capsys, *question, "--time-limit", "1000")
    plain = output(capsys, *question)
    assert (ample["replacements"], ample["status"]) == (plain["replacements"], "optimal")


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["-n", "2"], "several trees are found without replacements; leave out 'substitute'"),
        (["--all-optimal"], "several trees are found without replacements"),
        (["--diverse", "2"], "several trees are found without replacements"),
        (["--pareto", "units,success"], "several trees are found without replacements"),
        (["--method", "greedy"], "replacements are chosen by the method 'optimal' alone"),
        (["--reference"], "for trees that can be executed"),
    ],
)
def test_where_nothing_is_replaced_the_flag_is_refused(
    capsys: pytest.CaptureFixture[str], table: str, flags: list[str], said: str
) -> None:
    status, out, err = run(capsys, "retrieve", "omelette", "--substitute", table, *flags)
    assert (status, out) == (2, "")
    assert said in err


def test_so_is_it_from_python() -> None:
    world = fa.load()
    query = fa.Query("omelette", substitute="foon")
    for ask in (world.menu, world.explain, lambda asked: world.suggest(query=asked.replace(goals=[]))):
        with pytest.raises(fa.QueryError, match="without replacements; leave out 'substitute'"):
            ask(query)
