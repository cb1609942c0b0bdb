"""`foon-asp check` and `fa.check`."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import foon_asp as fa
from foon_asp.io.json import write_units
from foon_asp.io.object_wire import object_to_json
from foon_asp.io.wire import dumps
from support.cli import run
from support.schemas import output

SCHEMA = "check.schema.json"
TREE = """//
O\tonion
S\twhole
O\tknife
M\tchop
O\tonion
S\tchopped
//
O\tonion
S\tfried
O\tbowl
S\tempty
M\tserve
O\tonion
S\tfried
S\tin\t[bowl]
//
O\tonion
S\tchopped
O\tpan
S\tempty
M\tfry
O\tonion
S\tfried
//
"""


@pytest.fixture
def tree(tmp_path: Path) -> str:
    path = tmp_path / "tree.txt"
    path.write_text(TREE, encoding="utf-8")
    return str(path)


@pytest.fixture
def good(tmp_path: Path) -> str:
    head, chop, serve, fry, end = TREE.split("//\n")
    path = tmp_path / "good.txt"
    path.write_text("//\n".join([head, chop, fry, serve, end]), encoding="utf-8")
    return str(path)


def test_one_tree_is_an_object_and_its_order_is_judged(tree: str, capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "check", tree, status=1)
    assert value["executable"] is False
    assert value["order"] == [1, 3, 2]
    step = value["steps"][1]
    assert step["missing"] == [{"label": "onion", "states": ["fried"], "ingredients": [], "container": None}]
    assert (step["source"]["file"], step["source"]["line"]) == (tree, 9)
    assert (step["nearest"][0]["difference"], step["nearest"][0]["step"]) == ("later", 3)
    assert [each["label"] for each in value["needs"]] == ["onion", "knife", "onion", "bowl", "pan"]
    assert "Step 2 (serve) needs onion [fried]" in value["prompt"]
    assert "\n" not in value["prompt"]


def test_several_trees_are_a_list_and_a_table(
    tree: str, good: str, capsys: pytest.CaptureFixture[str]
) -> None:
    values = output(capsys, "check", good, tree, good, status=1)
    assert [value["executable"] for value in values] == [True, False, True]
    status, out, _ = run(capsys, "check", good, tree)
    assert status == 1
    assert [line.split()[1:] for line in out.splitlines()[1:3]] == [
        ["3", "0", "0", "0", "0", "executable"],
        ["3", "1", "0", "0", "1", "in", "another", "order"],
    ]
    assert output(capsys, "check", good)["executable"] is True


def test_a_tree_comes_from_standard_input(tree: str) -> None:
    command = [sys.executable, "-m", "foon_asp", "check", "-"]
    ended = subprocess.run(command, input=Path(tree).read_bytes(), capture_output=True, check=False)
    assert ended.returncode == 1
    assert b"2. serve  [-:9]" in ended.stdout


def test_the_kitchen_that_is_written_makes_the_order_executable(
    tree: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kitchen = tmp_path / "kitchen.json"
    assert run(capsys, "check", tree, "--write-kitchen", kitchen)[0] == 1
    assert len(json.loads(kitchen.read_text(encoding="utf-8"))) == 5
    assert run(capsys, "check", tree, "--kitchen", kitchen)[0] == 0
    status, _, err = run(capsys, "check", tree, "--write-kitchen", kitchen)
    assert (status, "there already" in err) == (2, True)
    status, _, err = run(capsys, "check", tree, "--write-kitchen", tree, "--overwrite")
    assert (status, "would replace an input" in err) == (2, True)


def test_a_named_kitchen_is_all_there_is(
    tree: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text('[{"label": "onion", "states": ["whole"]}]', encoding="utf-8")
    value = output(capsys, "check", tree, "--kitchen", str(kitchen), status=1)
    assert [[each["label"] for each in step["missing"]] for step in value["steps"]] == [
        ["knife"],
        ["onion", "bowl"],
        ["pan"],
    ]


def test_a_step_of_the_known_foon_closes_a_gap(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What the built-in FOON knows of peeled onions."""
    world = fa.load()
    tree = world.retrieve("onion [chopped] on [cutting board]").tree
    assert tree is not None
    assert len(tree) > 1
    path = tmp_path / "short.json"
    rest = fa.read(list(tree.steps[1:]))
    path.write_text(write_units(rest, rest.units), encoding="utf-8")
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text(dumps([object_to_json(node) for node in world.kitchen.objects]), encoding="utf-8")
    value = output(capsys, "check", str(path), "--kitchen", str(kitchen), status=1)
    likely = [each["unit"]["motion"] for step in value["steps"] for each in step["likely"]]
    assert tree.steps[0].motion in likely


def test_repeated_steps_stay(tmp_path: Path) -> None:
    cup = [(["cup [empty]"], "fill", ["cup [full]"]), (["cup [full]"], "drink", ["cup [empty]"])]
    checks = fa.check([*cup, *cup], kitchen=["cup [empty]"])
    assert [step.unit.motion for step in checks[0].steps] == ["fill", "drink", "fill", "drink"]
    assert [step.idle for step in checks[0].steps] == [False, True, True, True]
    used_up = fa.check([*cup, *cup], kitchen=["cup [empty]"], semantics="consume")
    assert used_up.executable
    two_lines = tmp_path / "cups.json"
    unit = '{"input_nodes": [{"label": "a", "states": ["b"]}], "motion_node": "x", "output_nodes": []}'
    two_lines.write_text(f"[{unit}, {unit}]", encoding="utf-8")
    assert len(fa.check(two_lines)[0].steps) == 2


def test_the_time_limit_leaves_trees_out(good: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "check", *[good] * 3000, "--time-limit", "0", "--quiet")
    assert status == 3
    assert "the time ran out:" in out


def test_what_is_refused(tree: str, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for arguments in (["--level", "2"], ["--match-relations", "fuzzy"], ["--semantics", "none"]):
        assert run(capsys, "check", tree, *arguments)[0] == 2
    assert run(capsys, "check", tmp_path / "none.txt")[0] == 2
    with pytest.raises(fa.QueryError):
        fa.check(tree, semantics="none")
    with pytest.raises(fa.QueryError):
        fa.check(tree, known="universal")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unexpected keyword argument 'kitchens'"):
        fa.check(tree, kitchens=())  # type: ignore[call-arg]
    with pytest.raises(fa.QueryError, match="time_limit"):
        fa.check(tree, time_limit=-1)


def test_the_views_of_checks(tree: str, good: str) -> None:
    checks = fa.check(tree, good)
    assert repr(checks) == "<Checks: 2 trees, 1 executable>"
    assert repr(checks[0]) == f"<Check: {tree}, 3 steps, NOT EXECUTABLE>"
    assert list(checks.to_frame()["executable"]) == [False, True]
    assert str(fa.check(good)).startswith(f"{good}\n3 steps, can be executed in this order (add)")
    assert json.loads(fa.check(good).to_json())["executable"] is True
    assert not checks
    assert fa.check(good)


def test_a_mended_tree_is_written_and_can_be_executed(
    tree: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "mended.txt"
    status, _, err = run(capsys, "check", tree, "--mend", "-o", out)
    assert status == 1
    assert err.splitlines() == [
        f"{tree}:9: move step 2 (serve) to place 3",
        "foon-asp: 1 edit (proven fewest)",
    ]
    assert run(capsys, "check", out)[0] == 0
    as_json = tmp_path / "mended.json"
    assert run(capsys, "check", tree, "--mend", "-o", as_json, "--quiet")[1:] == ("", "")
    assert [each["motion_node"] for each in json.loads(as_json.read_text(encoding="utf-8"))] == [
        "chop",
        "fry",
        "serve",
    ]


def test_edits_in_json(tree: str, good: str, capsys: pytest.CaptureFixture[str]) -> None:
    first, second = output(capsys, "check", tree, good, "--mend", status=1)
    [edit] = first["mend"]["edits"]
    assert (edit["edit"], edit["step"], edit["to"], edit["source"]["line"]) == ("move", 2, 3, 9)
    assert (second["mend"]["cost"], second["mend"]["edits"]) == (0, [])
    assert [unit["motion"] for unit in second["mend"]["units"]] == ["chop", "fry", "serve"]


def test_changes_inserts_and_removals(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    world = fa.load()
    whole = world.retrieve("macaroni").tree
    assert whole is not None
    short = [step for step in whole if step.place != 4]
    [checked] = fa.check(short, kitchen=world.kitchen, mend=True, known=world)
    assert checked.mending is not None
    assert checked.mending.proven
    assert [edit.kind for edit in checked.mending.edits or ()] == ["insert"]
    assert [unit.motion for unit in checked.mending.functional_units] == [step.motion for step in whole]
    cut = [(["egg [raw]"], "boil", ["egg [boiled]"]), (["egg [hard boiled]"], "peel", ["egg [peeled]"])]
    [checked] = fa.check(cut, kitchen=["egg [raw]"], known=world, mend=True)
    [edit] = (checked.mending and checked.mending.edits) or ()
    assert (edit.kind, edit.cost) == ("change", 1)
    assert f"change what step {edit.step}" in str(fa.check(cut, kitchen=["egg [raw]"], mend=True))
    path = tmp_path / "nothing.txt"
    path.write_text("//\nO\tegg\nS\traw\nM\tboil\nO\tegg\nS\tboiled\n//\n", encoding="utf-8")
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text("[]", encoding="utf-8")
    status, out, err = run(capsys, "check", path, "--mend", "--kitchen", kitchen, "--foon", path)
    assert (status, out) == (1, "")
    assert "no mended tree: no edits do" in err


def test_what_mending_refuses(tree: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "check", tree, tree, "--mend")[0] == 2


def test_mending_where_objects_are_used_up(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    peel = (["onion [whole]"], "peel", ["onion [peeled]"])
    chop, slice_ = (["onion [peeled]"], "chop", ["cubes"]), (["onion [peeled]"], "slice", ["rings"])
    tree = [peel, chop, slice_, (["cubes", "rings"], "mix", ["salad"])]
    assert fa.check(tree)
    [checked] = fa.check(tree, semantics="consume", mend=True)
    assert not checked
    mending = checked.mending
    assert mending is not None
    assert [(edit.kind, edit.step) for edit in mending.edits or ()] == [("change", 2)]
    path = tmp_path / "mended.json"
    path.write_text(write_units(mending.foon, mending.functional_units), encoding="utf-8")
    assert run(capsys, "check", path, "--semantics", "consume")[0] == 0
    # However often the one onion is peeled, nothing but trying tells that there is no second one.
    known = fa.World(fa.read([peel]), ["onion [whole]"])
    [onion] = known.kitchen.objects
    single = replace(known.kitchen, quantities={onion: 1})
    asked = fa.check(tree, kitchen=single, known=known, semantics="consume", mend=True)
    assert asked.status is fa.Status.LIMIT
    assert "To mend it: no edits were found: 16 and fewer do not do" in str(asked)


def test_mending_ends_at_the_time_limit(tree: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "check", tree, "--mend", "--time-limit", "0")
    assert status in (1, 3)
    assert out or "no mended tree: " in err


def test_a_tree_is_judged_alike_whatever_is_beside_it() -> None:
    taken = [
        (["yogurt [creamy]"], "spoon", ["cup [full]"]),
        (["yogurt [creamy] in bowl"], "mix", ["dip [mixed]"]),
    ]
    other = [(["fruit [cut]"], "put", ["fruit [cut] in yogurt"])]
    alone, beside = fa.check(taken), fa.check(taken, other)
    said = [
        [[str(lack.node) for lack in step.doubtful] for step in each[0].steps] for each in (alone, beside)
    ]
    assert said == [[[], ["yogurt [creamy] in [bowl]"]]] * 2
