"""Small inputs of which each has a fault of public files: what must come out of each."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import foon_asp as fa
from foon_asp.io.findings import Severity
from foon_asp.io.folder import Dataset
from foon_asp.io.trees import TreeBuilder
from foon_asp.model.world import World
from support.cli import run, run_json
from support.paths import PUBLIC_DATA
from support.reading_checks import check_mending, check_storing, check_writing, notes, read

CASES = PUBLIC_DATA.parent / "cases"
pytestmark = pytest.mark.skipif(not CASES.exists(), reason=f"no {CASES}")

EGG = {"egg [raw]", "egg [boiled]"}
WATER = {"cup {water}", "bowl [empty]", "cup [empty]", "bowl {water} on [table]"}


@pytest.mark.parametrize(
    ("name", "objects", "code"),
    [
        ("none-container.json", EGG, "word-for-none"),
        ("fenced.json", EGG, "text-around-json"),
        ("trailing.json", EGG, "text-around-json"),
        ("truncated.json", {"a [b]", "a [c]"}, "broken-json"),
        ("units.jsonl", WATER, "duplicate-unit"),
        ("wrapped-task-tree.json", WATER, "state-without-brackets"),
        ("wrapped-units.json", WATER, "state-without-brackets"),
        ("nested-lists.json", WATER, "duplicate-unit"),
        ("json-states-contains.json", WATER, "state-without-brackets"),
        ("empty.json", set(), "no-units"),
        ("unit-without-input-nodes.json", set(), "unit-without-inputs"),
        ("none-ids.txt", {"filter [unused]", "filter in [machine]"}, "word-for-none"),
        ("two-motions.txt", {"a [x]", "a [y]"}, "two-motions"),
        ("lower.txt", {"onion [whole]", "onion [chopped]"}, "lower-case"),
        ("space-dialect.txt", {"onion [whole]", "knife", "onion [ring shaped]"}, "missing-tab"),
        ("backslash-ends.txt", {"onion [whole]", "onion [chopped]", "bowl", "bowl [full]"}, "other-end"),
    ],
)
def test_what_is_read_and_found(name: str, objects: set[str], code: str) -> None:
    files = read((CASES / name).read_bytes(), name)
    assert set(map(str, files.foon.objects)) == objects
    assert code in {finding.code for finding in files.findings}
    if name.endswith(".txt"):
        mended = read(check_mending((CASES / name).read_text(), files))
        assert all(not finding.mend for finding in mended.findings)


@pytest.mark.parametrize(
    ("name", "times", "found"),
    [
        ("comma-times.txt", [((22, 24),)], []),
        ("two-intervals.txt", [((114, 117), (118, 121))], []),
        ("times-ragged.txt", [((114, 117),), (), ((5, 9),)], [4, 10, 16]),
    ],
)
def test_times(name: str, times: list[Any], found: list[int], capsys: pytest.CaptureFixture[str]) -> None:
    """They are read, told where they are odd, kept by both formats that have times, and added up."""
    files = read((CASES / name).read_bytes(), name)
    assert [[(each.start, each.end) for each in unit.annotation.times] for unit in files.foon.units] == [
        list(each) for each in times
    ]
    assert sorted({finding.line for finding in files.findings if finding.severity > Severity.NOTE}) == found
    durations = [sum(end - start for start, end in each) for each in times]
    assert [unit.duration or 0 for unit in files.foon.units] == durations
    assert files.foon.units.notes.durations.tolist() == durations
    check_writing(files.foon)
    check_storing(files)
    _, out, _ = run(capsys, "convert", CASES / name, "-o", "-", "--to", "api-json")
    assert notes(read(out).foon) == notes(files.foon)


def test_what_is_marked_is_the_goal() -> None:
    assert list(map(str, fa.load(foon=[CASES / "marked-goal.txt"]).goals)) == ["a [y]"]


def test_a_tree_is_converted_with_what_it_repeats(capsys: pytest.CaptureFixture[str]) -> None:
    tree = CASES / "repeated-step.txt"
    assert run(capsys, "convert", tree, "-o", "-", "--to", "text")[:2] == (0, tree.read_text())


@pytest.mark.parametrize(("name", "trees"), [("nested-lists.json", 2), ("units.jsonl", 1), ("empty.json", 1)])
def test_several_trees_stay_several(name: str, trees: int) -> None:
    assert len(TreeBuilder().read_file(CASES / name).parts) == trees


@pytest.mark.parametrize(
    "command",
    [
        ("check",),
        ("convert", "-o", "-", "--to", "text"),
        ("merge",),
        ("retrieve", "a [c]", "--foon"),
        ("reach", "--foon"),
    ],
    ids=lambda command: command[0],
)
def test_what_is_cut_off_is_told_by_the_status(
    capsys: pytest.CaptureFixture[str], command: tuple[str, ...]
) -> None:
    name = CASES / "truncated.json"
    words = (*command, name) if command[-1] == "--foon" else (command[0], name, *command[1:])
    status, out, err = run(capsys, *words)
    assert status == 1
    assert out
    assert "the rest is left out" in err


@pytest.mark.parametrize("kitchen", ["none-kitchen.json", "kitchen.txt", "kitchen-labels.txt"])
def test_a_kitchen_in_every_form(capsys: pytest.CaptureFixture[str], kitchen: str) -> None:
    """The egg of the kitchen is the egg that is needed."""
    files = ("--foon", CASES / "none-container.json", "--kitchen", CASES / kitchen)
    status, out, err = run(capsys, "retrieve", "egg [boiled]", *files)
    assert (status, "1 step" in out) == (0, True)
    assert ("'egg' is egg [raw]" in err) == (kitchen == "kitchen-labels.txt")


TEA = """O\tcup
S\tcontains\t{tea}
O\tmug
S\tempty
M\tpour
O\tcup
S\tempty
O\tmug
S\tcontains\t{tea}
//
"""


def test_a_data_folder_of_texts(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """A list of labels as the kitchen, FOON text as the goals, and a table in JSON as the rates."""
    (tmp_path / "tea.txt").write_text(TEA, encoding="utf-8")
    for case, name in (
        ("kitchen-list.txt", "kitchen.txt"),
        ("goals-text.txt", "goal_nodes.txt"),
        ("rates.json", "motion.json"),
    ):
        (tmp_path / name).write_bytes((CASES / case).read_bytes())
    status, out, err = run(capsys, "goals", "--data", tmp_path)
    assert (status, out) == (0, "mug {tea}\n")
    assert "the kitchen has tea, which the FOON does not know" in err
    assert f"{tmp_path / 'kitchen.txt'}: 'cup' is cup {{tea}}" in err
    assert f"{tmp_path / 'kitchen.txt'}: 'mug' is mug [empty]" in err
    goals = ("--goals", tmp_path / "goal_nodes.txt")
    status, out, _ = run(capsys, "retrieve", *goals, "--by", "success", "--data", tmp_path)
    assert (status, "success 0.1 " in out) == (0, True)


@pytest.mark.parametrize(("matching", "status"), [("loose", 0), ("strict", 2)])
def test_what_is_on_a_plate_and_what_it_contains(
    capsys: pytest.CaptureFixture[str], matching: str, status: int
) -> None:
    files = ("--foon", CASES / "on-vs-container.txt", "--kitchen", CASES / "k-on-vs-container.json")
    asked = ("--goals", CASES / "g-on.json", "--match-relations", matching)
    assert run(capsys, "retrieve", *asked, *files)[0] == status


def test_an_empty_file_among_good_ones(capsys: pytest.CaptureFixture[str]) -> None:
    files = [CASES / name for name in ("empty.json", "trailing.json")]
    status, _, err = run(capsys, "convert", *files, "-o", "-", "--to", "text")
    assert (status, "1 unit " in err) == (0, True)


# A product without states

BARE = ("--foon", CASES / "bare-product.txt", "--kitchen", CASES / "bare-kitchen.json", "--default-rate", 1)


def test_a_product_without_states_is_made(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_json(capsys, "retrieve", "glass {smoothie}", *BARE)["size"] == 2
    assert run_json(capsys, "retrieve", "smoothie", *BARE)["size"] == 1
    for semantics in ("add", "transform", "consume"):
        found = run_json(capsys, "plan", "glass {smoothie}", *BARE, "--semantics", semantics)
        assert (found["plan"]["length"], found["plan"]["executable"]) == (2, True)
    audited = run_json(capsys, "audit", *BARE[1:2], *BARE[2:4])
    assert "error" not in {finding["severity"] for finding in audited["findings"]}


def test_of_the_bare_outputs_of_the_universal_foon_one_is_a_product(
    universal: Dataset, universal_world: World
) -> None:
    """Which the kitchen has, so that nothing else can be made by it."""
    bare = [
        (unit.id, number)
        for unit in universal.foon.units
        for number in unit.outputs
        if universal.foon.objects[number].bare
    ]
    made = [(unit, number) for unit, number in bare if number in universal_world.units.makes[unit]]
    assert len(bare) == 230
    assert [str(universal.foon.objects[number]) for _, number in made] == ["wrapping paper"]
    assert all(number in universal_world.stock for _, number in made)


# Plans of other planners


@pytest.mark.parametrize("name", ["lpg-plan.txt", "up-plan.txt"])
def test_a_plan_of_another_planner_is_decoded(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, name: str
) -> None:
    assert run(capsys, "pddl", "export", "whipped cream", "-o", tmp_path)[0] == 0
    found = run_json(capsys, "pddl", "decode", CASES / name, "--names", tmp_path / "names.json")
    assert [unit["id"] for unit in found["units"]] == [45, 46, 47, 48, 49]
    assert found["executable"]


@pytest.mark.parametrize(
    "name",
    [
        f"{name}.txt"
        for name in ("bare_names", "ff", "numbered", "plansys2_terminal", "unified_planning_print")
    ],
)
def test_a_plan_is_decoded_with_its_names_alone(capsys: pytest.CaptureFixture[str], name: str) -> None:
    names = ("--names", CASES / "plans" / "names.json")
    status, out, err = run(capsys, "pddl", "decode", CASES / "plans" / name, *names)
    assert (status, "the plan was not replayed" in err) == (0, True)
    assert out.splitlines() == [
        "  1. and  [keywords.txt:2, unit 0]",
        "  2. 2 fold  [keywords.txt:10, unit 1]",
    ]
    found = run_json(capsys, "pddl", "decode", CASES / "plans" / name, *names)
    assert [unit["motion"] for unit in found["units"]] == ["and", "2 fold"]
    assert found["executable"] is None
    given = ("--foon", CASES / "bare-product.txt")
    status, _, err = run(capsys, "pddl", "decode", CASES / "plans" / name, *names, *given)
    assert (status, "the FOON or kitchen is not that of this export" in err) == (2, True)
