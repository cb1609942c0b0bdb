"""`foon-asp consolidate` and `fa.consolidate`."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

import foon_asp as fa
from support.cli import check_same_bytes, run
from support.paths import ROOT
from support.schemas import output

SCHEMA = "consolidate.schema.json"
PAGE = (ROOT / "docs" / "consolidating.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", PAGE, re.DOTALL))
TREES = ("first.txt", "second.txt", "third.txt")
MODELS = ("--costs", "motion_cost.json", "--states", "states.json")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with the files of the page."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_answer_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "consolidate", *TREES, *MODELS)
    assert [unit["motion"] for unit in value["answer"]["units"]] == ["chop", "fry", "serve"]
    assert value["answer"]["costs"]["cost"] == 0.9
    assert value["answer"]["status"] == "optimal"
    assert [each["support"] for each in value["support"]] == [1, 2, 3]
    assert [(s["file"], s["line"]) for s in value["support"][1]["sources"]] == [
        ("second.txt", 9),
        ("third.txt", 9),
    ]
    [dropped] = value["dropped"]
    assert (dropped["tree"], dropped["source"]["line"], dropped["fault"]) == ("third.txt", 2, "state")
    [reworded] = value["reworded"]
    assert (reworded["kind"], reworded["word"], reworded["instead"]) == ("label", "onions", "onion")
    assert [each["alone"] and each["alone"]["cost"] for each in value["trees"]] == [1.1, 0.9, None]
    assert [each["object"]["label"] for each in value["votes"]] == ["onion"]
    assert value["explanation"] is None


def test_no_tree_is_left(capsys: pytest.CaptureFixture[str]) -> None:
    value = output(capsys, "consolidate", "third.txt", "--states", "states.json", status=1)
    assert value["answer"]["status"] == "unreachable"
    assert [each["object"]["label"] for each in value["explanation"]["missing"]["things"]] == ["onion"]
    assert value["support"] == []


def test_python_says_the_same_as_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "consolidate", *TREES, *MODELS)
    made = fa.consolidate(*TREES, costs="motion_cost.json", states="states.json")
    assert (status, out.rstrip()) == (0, str(made))
    values = json.loads(made.to_json()), output(capsys, "consolidate", *TREES, *MODELS)
    for value in values:
        value["seconds"] = value["answer"]["seconds"] = 0
    assert values[0] == values[1]


def test_several_trees_of_one_file_are_several(folder: Path) -> None:
    """Each list of units is a tree by itself, and so has a vote and a support of its own."""
    unit = {"input_nodes": [{"label": "egg", "states": ["raw"]}], "motion_node": "boil"}
    boil = unit | {"output_nodes": [{"label": "egg", "states": ["hard"]}]}
    (folder / "two.json").write_text(json.dumps([[boil], [boil]]), encoding="utf-8")
    made = fa.consolidate("two.json")
    assert [each.name for each in made.samples] == ["two.json#1", "two.json#2"]
    assert [made.backing[step.unit].trees for step in made] == [("two.json#1", "two.json#2")]


def test_the_goal_is_voted_for_or_named() -> None:
    egg = [(["egg [raw]"], "boil", ["egg [hard]"])]
    fried = [(["egg [raw]"], "fry", ["egg [fried]"])]
    assert str(fa.consolidate(egg, fried, fried).goal) == "egg [fried]"
    assert str(fa.consolidate(egg, fried, fried, goal="egg [hard]").goal) == "egg [hard]"
    assert [len(vote.trees) for vote in fa.consolidate(egg, fried, fried, goal="egg [hard]").votes] == [1, 2]
    with pytest.raises(fa.QueryError, match="unknown goal 'egg \\[scrambled\\]'"):
        fa.consolidate(egg, goal="egg [scrambled]")


def test_what_only_a_dropped_step_makes_is_not_at_hand() -> None:
    """Nothing can chop what is fried; that the onion is chopped is needed all the same."""
    chop = [(["onion [fried]"], "chop", ["onion [chopped]"]), (["onion [chopped]"], "mix", ["salad [mixed]"])]
    made = fa.consolidate(chop, states=[["chopped", "fried"]])
    assert not made
    assert made.explanation is not None
    assert [str(each.node) for each in made.explanation.missing_objects] == ["onion [chopped]"]


def test_models_are_read_in_the_words_of_the_trees() -> None:
    move = [(["egg in bowl"], "place", ["egg in cuttingboard"])]
    assert fa.consolidate(move, locations=[["bowls", "cutting board"]])
    refused = fa.consolidate(move, locations=[["cutting board", "bowls"]])
    assert [each.fault for each in refused.dropped] == ["location"]


def test_adjacent_words() -> None:
    dice = [(["egg [whole]"], "dice", ["egg [diced]"])]
    orders = [["whole", "peeled", "diced"]]
    assert fa.consolidate(dice, states=orders)
    assert not fa.consolidate(dice, states=orders, adjacent=True)


def test_motions_follow_each_other() -> None:
    eat = [(["egg [raw]"], "boil", ["egg [hard]"]), (["egg [hard]"], "crack", ["egg [cracked]"])]
    assert fa.consolidate(eat, motions=[["boil", "crack"]])
    [dropped] = fa.consolidate(eat, motions=[["crack", "boil"]]).dropped
    assert (dropped.fault, dropped.unit and dropped.unit.motion) == ("motion", "crack")


def test_incomplete_steps_are_left_out() -> None:
    whole = [(["egg [raw]"], "boil", ["egg [hard]"])]
    made = fa.consolidate(whole, [([], "conjure", ["egg [hard]"])], [(["egg [raw]"], "drop", ["egg"])])
    assert [(each.tree, each.fault) for each in made.dropped] == [
        ("tree 2", "incomplete"),
        ("tree 3", "incomplete"),
    ]
    assert [step.motion for step in made] == ["boil"]


def test_what_cannot_be_read_is_told_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    egg = {"label": "egg", "states": ["raw"]}
    boil = {"input_nodes": [egg], "motion_node": "boil", "output_nodes": [egg | {"states": ["hard"]}]}
    (folder / "two.json").write_text(
        json.dumps([[boil, boil | {"motion_node": ""}], [boil]]), encoding="utf-8"
    )
    value = output(capsys, "consolidate", "two.json")
    assert [(each["tree"], each["fault"], each["unit"]) for each in value["dropped"]] == [
        ("two.json#1", "unreadable", None)
    ]
    assert [each["support"] for each in value["support"]] == [2]


def test_a_motion_without_a_cost_counts_as_the_dearest() -> None:
    egg = [(["egg [raw]"], "boil", ["egg [hard]"])]
    made = fa.consolidate(egg, costs={"fry": 0.4, "cut": 0.7})
    assert (made.unpriced, made.answer.costs and made.answer.costs.cost) == (("boil",), 0.7)
    made = fa.consolidate(egg, costs={"fry": 0.4}, default_cost=0.1)
    assert (made.unpriced, made.answer.costs and made.answer.costs.cost) == ((), 0.1)


def test_likeness_is_a_function_of_the_users() -> None:
    one = [(["aubergine [raw]"], "fry", ["aubergine [fried]"])]
    other = [(["eggplant [raw]"], "cut", ["eggplant [cut]"])]
    assert len(fa.consolidate(one, other).votes) == 2
    made = fa.consolidate(one, other, goal="aubergine [cut]", likeness=lambda *_: 0.9)
    assert [(each.aligned.word, each.aligned.why) for each in made.reworded] == [("eggplant", "likeness")]
    assert made


TWO_WORDS = (
    "O\taubergine\nS\traw\nM\tfry\nO\taubergine\nS\tfried\n//\n",
    "O\teggplant\nS\traw\nM\tcut\nO\teggplant\nS\tcut\n//\nO\teggplant\nS\tcut\nM\tfry\nO\teggplant\nS\tfried\n//\n",
)


@pytest.mark.parametrize(
    ("row", "flags", "joined"),
    [
        ("eggplant\taubergine\t0.9", [], True),
        ("aubergine\teggplant\t0.8", [], True),
        ("aubergine\teggplant\t0.7", [], False),
        ("aubergine\teggplant\t0.7", ["--least-likeness", "0.7"], True),
        ("aubergine\ttomato\t1", [], False),
    ],
)
def test_similar_labels_are_taken_for_one(
    folder: Path, capsys: pytest.CaptureFixture[str], row: str, flags: list[str], joined: bool
) -> None:
    for name, text in zip(("one.txt", "other.txt"), TWO_WORDS, strict=True):
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "words.tsv").write_text(row, encoding="utf-8")
    value = output(capsys, "consolidate", "one.txt", "other.txt", "--similar", "words.tsv", *flags)
    found = [(each["word"], each["instead"], each["why"]) for each in value["reworded"]]
    assert found == [("aubergine", "eggplant", "likeness")] * joined
    label, other, likeness = row.split("\t")
    made = fa.consolidate(
        "one.txt",
        "other.txt",
        likeness=[fa.Replacement(label, other, float(likeness))],
        least_likeness=float(flags[-1]) if flags else 0.8,
    )
    assert json.loads(made.to_json())["reworded"] == value["reworded"]


def test_what_cannot_say_which_labels_are_the_same_is_refused(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "words.tsv").write_text("salt\t-\t0.5\n", encoding="utf-8")
    for given, said in (
        ("foon", "by a table or by vectors, not by foon"),
        ("words.tsv", "'salt' is the same as nothing; name two labels a line"),
        ("none.tsv", "none.tsv: no such file"),
    ):
        status, out, err = run(capsys, "consolidate", *TREES, "--similar", given)
        assert (status, out) == (2, "")
        assert said in err
    assert run(capsys, "consolidate", *TREES, "--similar", "words.tsv", "--least-likeness", 0)[0] == 2


@pytest.mark.parametrize("name", ["tree.txt", "tree.json"])
def test_the_tree_is_written_by_its_suffix(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = run(capsys, "consolidate", *TREES, *MODELS, "--write-tree", name)
    assert status == 0
    assert f"{name}: 3 units" in err
    again = fa.consolidate(name, costs="motion_cost.json")
    assert [step.motion for step in again] == ["chop", "fry", "serve"]
    status, _, err = run(capsys, "consolidate", *TREES, *MODELS, "--write-tree", name)
    assert (status, "this is there already" in err) == (2, True)


def test_the_answer_as_foon(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    assert run(capsys, "consolidate", *TREES, *MODELS, "--format", "foon", "-o", "made.txt")[0] == 0
    assert [step.motion for step in fa.consolidate(folder / "made.txt")] == ["chop", "fry", "serve"]


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["missing.txt"], "missing.txt: no such file"),
        (["first.txt", "--states", "motion_cost.json"], "expected a list of orders"),
        (["first.txt", "--costs", "states.json"], "states.json"),
        (["first.txt", "--costs", "bad.json"], "cannot read 'chop', -1"),
        (["first.txt", "--costs", "twice.json"], "two costs of 'chop'"),
        (["first.txt", "--states", "flat.json"], "an order is a list of words"),
        (["first.txt", "--states", "numbers.json"], "1 in an order is no word"),
        (["first.txt", "--write-tree", "tree.foo"], "the suffix does not tell the format"),
        (["first.txt", "--goal", "onoin"], "unknown goal"),
        (["empty.json"], "no step in these trees that can be read"),
        (["first.txt", "--by", "price"], "there is no criterion 'price'"),
    ],
)
def test_bad_input_is_one_line(
    arguments: list[str], problem: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in {
        "bad.json": '{"chop": -1}',
        "twice.json": '{"chop": 1, "Chop": 2}',
        "flat.json": '["whole"]',
        "numbers.json": "[[1]]",
        "empty.json": "[]",
    }.items():
        (folder / name).write_text(text, encoding="utf-8")
    status, out, err = run(capsys, "consolidate", *arguments)
    assert (status, out) == (2, "")
    assert problem in err
    told = [line for line in err.splitlines() if not line.startswith("foon-asp: warning: ")]
    assert len(told) == 1


def test_costs_as_lines(folder: Path) -> None:
    (folder / "costs.txt").write_text(
        "# seconds\nchop\t0.3\nfry\t0.4\nsimmer\t0.9\nserve\t0.2\n", encoding="utf-8"
    )
    made = fa.consolidate(*TREES, costs="costs.txt")
    assert made.answer.costs is not None
    assert made.answer.costs.cost == 0.9


def test_the_same_is_printed_each_time(folder: Path) -> None:
    shutil.copy("first.txt", "fifth.txt")
    check_same_bytes(["consolidate", *TREES, "fifth.txt", *MODELS], folder)
