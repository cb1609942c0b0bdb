"""The command line: what it prints, how it ends, what it says of bad input."""

from __future__ import annotations

import json
from pathlib import Path

import clingo
import pytest

from foon_asp.io.folder import Dataset, load
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.tree import replay
from support.cli import check_same_bytes, run, run_json
from support.paths import ROOT

UNIT = "O\tonion\nS\twhole\nO\tknife\nM\tchop\nO\tonion\nS\tchopped\n//\n"
ONION = [{"label": "onion", "states": ["whole"], "ingredients": [], "container": None}]
KNIFE: list[dict[str, object]] = [{"label": "knife", "states": [], "ingredients": [], "container": None}]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A data folder with one unit that the kitchen can execute."""
    (tmp_path / "FOON.txt").write_text(UNIT)
    (tmp_path / "kitchen.json").write_text(json.dumps(ONION + KNIFE))
    (tmp_path / "motion.txt").write_text("chop\t0.5\n")
    return tmp_path


def test_retrieve_prints_steps(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    status, out, err = run(capsys, "retrieve", "onion [chopped]", "--data", folder)
    assert (status, err) == (0, "")
    assert out == (
        "onion [chopped]\n"
        "1 step, 1 round, 2 inputs, success 0.5 (optimal by units, proven optimal)\n"
        "\n"
        "  1. chop  [FOON.txt:1, unit 0]\n"
        "     take onion [whole]\n"
        "     with knife\n"
        "     get  onion [chopped]\n"
    )


def test_retrieve_json_has_what_the_replay_needs(
    capsys: pytest.CaptureFixture[str], built_in: Dataset
) -> None:
    value = run_json(capsys, "retrieve", "greek salad", "--by", "success")
    assert (value["status"], value["executable"], value["founded"]) == ("optimal", True, True)
    world = built_in.world()
    ids = [unit["id"] for unit in value["units"]]
    assert len(ids) == value["size"] == value["costs"]["units"]
    assert replay(world, [world.id_of(built_in.goals[1])], ids).executable


def test_foon_output_is_a_foon_that_makes_the_goal(
    capsys: pytest.CaptureFixture[str], built_in: Dataset, tmp_path: Path
) -> None:
    status, out, _ = run(capsys, "retrieve", "hummus", "--format", "foon")
    assert status == 0
    path = tmp_path / "tree.txt"
    path.write_text(out)
    tree = load(foon=[path])
    goal = next(goal for goal in built_in.goals if goal.label == "hummus")
    result = retrieve(tree.world(), Query(goal))
    assert result.tree is not None
    assert len(result.tree.units) == len(tree.foon.units)


def test_no_tree_is_exit_1_with_the_reason(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "kitchen.json").write_text(json.dumps(KNIFE))
    status, out, _ = run(capsys, "retrieve", "onion [chopped]", "--data", folder)
    assert status == 1
    assert "no task tree: the kitchen lacks onion [whole], and no unit makes it" in out


def test_a_circle_is_named_with_its_lines(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "FOON.txt").write_text("O\ta\nS\t1\nM\tx\nO\tb\nS\t1\n//\nO\tb\nS\t1\nM\ty\nO\ta\nS\t1\n//\n")
    status, out, _ = run(capsys, "retrieve", "a [1]", "--data", folder)
    assert status == 1
    assert "locked in a circle: a [1] is needed to make itself" in out
    assert "FOON.txt:1" in out
    assert "FOON.txt:7" in out
    status, out, _ = run(capsys, "retrieve", "a [1]", "--data", folder, "--reference")
    assert status == 0
    assert "NOT EXECUTABLE in any order" in out


def test_what_the_kitchen_has_needs_no_step(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    value = run_json(capsys, "retrieve", "onion [whole]", "--data", folder)
    assert (value["status"], value["size"], value["executable"]) == ("optimal", 0, True)


def test_time_limit_prints_the_best_so_far(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(
        capsys, "retrieve", "chicken curry", "--by", "success", "--time-limit", 0, "--format", "json"
    )
    value = json.loads(out)
    assert status == 3
    assert (value["status"], value["executable"]) == ("limit", True)
    assert value["costs"]["success"] <= value["bound"]["success"] <= 1


def test_goals_from_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    values = run_json(capsys, "retrieve", "--goals", ROOT / "data" / "goal_nodes.json")
    assert len(values) == 35
    assert all(value["executable"] for value in values)


def test_facts_feed_clingo_without_python(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "facts")
    assert status == 0
    control = clingo.Control(message_limit=0)
    control.load(str(ROOT / "encodings" / "reachability.lp"))
    control.add(out)
    control.ground()
    shown: list[clingo.Symbol] = []
    control.solve(on_model=lambda model: shown.extend(model.symbols(shown=True)))
    value = run_json(capsys, "reach")
    assert sum(symbol.name == "available" for symbol in shown) == value["available"]
    assert sum(symbol.name == "executable" for symbol in shown) == value["executable"]


def test_facts_of_a_goal_are_its_slice(capsys: pytest.CaptureFixture[str]) -> None:
    _, sliced, _ = run(capsys, "facts", "whipped cream")
    _, whole, _ = run(capsys, "facts", "whipped cream", "--whole")
    assert 0 < sliced.count("unit(") < whole.count("unit(")
    assert "goal(" in sliced


@pytest.mark.parametrize(
    ("files", "arguments", "message"),
    [
        ({}, ["retrieve", "onoin"], "unknown goal 'onoin': no object has this label; closest: onion"),
        ({}, ["retrieve", "onion"], "ambiguous goal 'onion': onion [whole]; onion [chopped]"),
        ({}, ["retrieve"], "name one GOAL"),
        ({}, ["retrieve", "onion [chopped]", "--method", "magic"], "invalid choice: 'magic'"),
        ({}, ["retrieve", "onion [chopped]", "--by", "speed"], "no criterion 'speed'"),
        ({}, ["retrieve", "onion [chopped]", "--time-limit", "-1"], "number of seconds"),
        ({}, ["retrieve", "--goals", "{}/none.json"], "none.json: no such file"),
        ({}, ["retrieve", "onion [chopped]", "--kitchen", "{}"], "this is a folder"),
        ({"FOON.txt": ""}, ["retrieve", "onion"], "an empty FOON"),
        ({"FOON.txt": "soup\n"}, ["retrieve", "onion"], "FOON.txt:1: not a FOON file"),
        ({"kitchen.json": b"\xff"}, ["retrieve", "onion"], "kitchen.json:1: byte 0xff is not UTF-8"),
        ({"kitchen.json": "[\n{,"}, ["retrieve", "onion"], "kitchen.json:2: not JSON"),
        ({"kitchen.json": "{}"}, ["retrieve", "onion"], "kitchen.json:1: expected a JSON list"),
        (
            {"kitchen.json": '[{"label": "a"},\n {"states": []}]'},
            ["retrieve", "onion"],
            "kitchen.json:2: object 2: 'label' is missing",
        ),
        (
            {"kitchen.json": '[{"label": "a", "states": "hot"}]'},
            ["reach"],
            "kitchen.json:1: object 1: 'states' is not a list",
        ),
        ({"motion.txt": "chop\t2\n"}, ["reach"], "motion.txt:1: cannot read 'chop\\t2'"),
        (
            {"motion.txt": "cut\t0.5\n"},
            ["retrieve", "onion [chopped]", "--by", "success"],
            "FOON.txt:1: the motion 'chop' has no success rate",
        ),
        (
            {"goals.json": '[{"label": "onoin"}]'},
            ["retrieve", "--goals", "{}/goals.json"],
            "unknown goal 'onoin'; closest: onion",
        ),
    ],
)
def test_bad_input_is_one_line_and_exit_2(
    capsys: pytest.CaptureFixture[str],
    folder: Path,
    files: dict[str, str | bytes],
    arguments: list[str],
    message: str,
) -> None:
    for name, content in files.items():
        (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    arguments = [argument.replace("{}", str(folder)) for argument in arguments]
    status, out, err = run(capsys, *arguments, "--data", folder)
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1


def test_a_star_does_not_matter_to_the_rate(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "FOON.txt").write_text(UNIT.replace("chop\n", "chop*\n", 1))
    value = run_json(capsys, "retrieve", "onion [chopped]", "--by", "success", "--data", folder)
    assert value["costs"]["success"] == 0.5


def test_a_default_rate_fills_the_gaps(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "motion.txt").unlink()
    value = run_json(
        capsys,
        *("retrieve", "onion [chopped]", "--by", "success", "--default-rate", "0.25"),
        *("--data", folder),
    )
    assert value["costs"]["success"] == 0.25


def test_an_unknown_kitchen_object_is_a_warning(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "kitchen.json").write_text(json.dumps(ONION + KNIFE + [{"label": "onoin"}]))
    status, _, err = run(capsys, "retrieve", "onion [chopped]", "--data", folder)
    assert status == 0
    assert err == ("foon-asp: warning: the kitchen has onoin, which the FOON does not know; closest: onion\n")


def test_same_bytes_whatever_the_hash_seed(tmp_path: Path) -> None:
    commands: list[list[object]] = [
        ["retrieve", "greek salad", "--method", "greedy", "--format", "foon"],
        ["compare", "whipped cream", "hummus", "--format", "json"],
        ["reach", "--format", "json"],
        ["facts"],
    ]
    for command in commands:
        check_same_bytes(command, tmp_path)


def test_explain_says_what_is_missing_and_what_steps_are_for(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "explain", "whipped cream", "--step", "48")
    assert status == 0
    assert "step 4 of 5: shake" in out
    assert run_json(capsys, "explain", "whipped cream")["status"] == "reachable"
    assert run(capsys, "explain", "whipped cream", "--step", "3")[0] == 2
    assert run(capsys, "explain", "whipped cream", "--instead")[0] == 2
    status, out, _ = run(capsys, "explain", "omelette", "--diet", "vegan")
    assert status == 1
    assert "diet vegan" in out


def test_explain_tells_its_first_sentence_once(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text('[{"label": "ice crusher"}]')
    status, out, _ = run(capsys, "explain", "ice", "--kitchen", kitchen)
    assert status == 1
    assert out.count("no task tree") == 1
    assert "drinking glass [empty]" in out


def test_suggest_ranks_dishes(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "suggest", "--using", "egg", "-n", "3")
    assert status == 0
    assert "made with egg" in out
    assert run(capsys, "suggest", "--using", "eggg")[0] == 2


def test_query_prints_what_rules_show(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    rules = tmp_path / "shakes.lp"
    rules.write_text('shakes(U) :- motion(U,"shake").')
    status, out, _ = run(capsys, "query", rules)
    assert status == 0
    assert "shakes" in out
    assert "48" in out.split()
    rules.write_text("shakes(U) :- use(U).")
    assert run(capsys, "query", rules)[0] == 2


def test_the_trace_is_printed_before_the_tree(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "retrieve", "ice", "--method", "ids", "--trace")
    assert status == 0
    assert out.startswith("limit 0: ice [crushed, frozen] in [drinking glass]\nlimit 1: ")
    value = run_json(capsys, "retrieve", "ice", "--method", "ids", "--trace")
    assert [bound["reached"] for bound in value["trace"]] == [False, True]
    assert run(capsys, "retrieve", "ice", "--trace")[0] == 2


NAMES = "x" * 20_000
"""What is too long to be said again."""

FOR_EACH_OPTION = {
    "--factor nan --diverse 2": "expected a number",
    "--factor inf --diverse 2": "expected a number",
    "--factor 0.5 --diverse 2": "expected a number",
    "--level 2 --level 2": "--level: given twice",
    "--time-limit 1 --time-limit 2": "--time-limit: given twice",
    "--kitchen a.json --kitchen b.json": "--kitchen: given twice",
    "--by units --by inputs": "--by: given twice",
    "-n 1 -n 2": "-n: given twice",
    "-o a -o b": "-o/--output: given twice",
    "--meth greedy": "unknown option '--meth'; did you mean --method?",
    "--methd=greedy": "unknown option '--methd'; did you mean --method?",
    "--max-unit 3": "unknown option '--max-unit'; did you mean --max-units?",
    "-z": "unknown option '-z'",
    "--method gredy": "invalid choice: 'gredy'; did you mean greedy?",
    "--method magic": "invalid choice: 'magic'; there are optimal, greedy, ids, first",
    "-o ": "-o/--output: the value is empty",
    "--output=": "-o/--output: the value is empty",
    "--by ": "--by: the value is empty",
    "--by ,": "--by: the value is empty",
    "--pareto ": "--pareto: the value is empty",
    "--kitchen ": "--kitchen: the value is empty",
    "--foon ": "--foon: the value is empty",
    "--without ": "--without: the value is empty",
    "--max-units -1": "whole number from 0",
    "--max-units nan": "whole number from 0",
    f"--max-units {'9' * 5_000}": "whole number from 0",
    f"--by {'9' * 5_000}*units": "too many digits",
    f"--by {NAMES}": "there is no criterion 'xxx",
    f"--method {NAMES}": "invalid choice: 'xxx",
    f"--{NAMES}": "unknown option '--xxx",
    f"--without {NAMES}": "nothing in this FOON is called 'xxx",
    f"--avoid-motion {NAMES}": "no unit has the motion 'xxx",
    f"--diet {NAMES}": "no diet 'xxx",
    NAMES: "one argument too many",
}


@pytest.mark.parametrize(("given", "said"), FOR_EACH_OPTION.items(), ids=lambda text: str(text)[:30])
def test_a_careless_option_is_one_line(capsys: pytest.CaptureFixture[str], given: str, said: str) -> None:
    status, out, err = run(capsys, "retrieve", "onion [peeled]", *given.split(" "))
    assert (status, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1
    assert len(err) < 1_000


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["retreive", "onion"], "invalid choice: 'retreive'; did you mean retrieve?"),
        (["--versoin"], "unknown option '--versoin'; did you mean --version?"),
        (["pddl", "exprot"], "invalid choice: 'exprot'; did you mean export?"),
        (["suggest", "--using", ""], "--using: the value is empty"),
        (["suggest", "--using", " , "], "--using: the value is empty"),
        (["retrieve", "whipped", "cream"], "put a goal of several words into quotes: 'whipped cream'"),
        (["explain", "whipped", "cream", "--all"], "of several words into quotes: 'whipped cream'"),
        (["menu", "whipped", "cream"], "of several words into quotes: 'whipped cream'"),
        (["plan", "onion", "[peeled]"], "of several words into quotes: 'onion [peeled]'"),
        (["facts", "whipped", "cream"], "of several words into quotes: 'whipped cream'"),
        (["menu", "whipped", "dream"], "unknown goal 'whipped'"),
        (["goals", "--dat", "x"], "unknown option '--dat'; did you mean --data?"),
        (["batch", "--querie", "x"], "unknown option '--querie'; did you mean --queries?"),
        (["retrieve", "apple " * 1_500], "unknown goal 'apple apple"),
        (["retrieve", "onion [" + "a, " * 3_000 + "]"], "unknown goal 'onion [a, a"),
        (["retrieve", "ice [a]" + " in a" * 1_900 + " [b"], "cannot read '[b' in the goal 'ice [a] in"),
        (["retrieve", "ice [a]" + " in a" * 20_000 + " [b"], "… has 100,010 characters; an object is"),
    ],
)
def test_what_was_meant_is_said(capsys: pytest.CaptureFixture[str], words: list[str], said: str) -> None:
    status, out, err = run(capsys, *words)
    assert (status, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1
    assert len(err) < 1_000


def test_every_constraint_that_is_given_holds(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    goal = "whipped cream"
    least = run_json(capsys, "retrieve", goal)["size"]
    for limits in ([least, least + 3], [least + 3, least]):
        flags = [word for limit in limits for word in ("--max-units", limit)]
        assert run_json(capsys, "retrieve", goal, *flags)["constraints"] == [f"at most {least} units"]
    status, out, _ = run(capsys, "retrieve", goal, "--max-units", least + 3, "--max-units", least - 1)
    assert (status, "no task tree" in out) == (1, True)
    limits = ["--min-success", 0.2, "--min-success", 0.1]
    assert run_json(capsys, "retrieve", goal, *limits)["constraints"] == ["success at least 0.2"]
    motions = sorted({unit["motion"] for unit in run_json(capsys, "retrieve", goal)["units"]})
    one, other = tmp_path / "one.txt", tmp_path / "other.txt"
    one.write_text("\n".join([*motions, "fly"]))
    other.write_text("\n".join([*motions, "swim"]))
    both = ["--only-motions", one, "--only-motions", other]
    assert run_json(capsys, "retrieve", goal, *both)["size"] == least
    other.write_text("\n".join(motions[1:]))
    assert run(capsys, "retrieve", goal, *both)[0] == 1


def test_foon_files_may_be_named_one_by_one(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"{name}.txt").write_text(f"O\tegg\nM\tboil\nO\t{name}\nS\tdone\n//\n")
    files = [str(tmp_path / name) for name in ("a.txt", "b.txt")]
    _, at_once, _ = run(capsys, "facts", "--foon", *files)
    _, one_by_one, _ = run(capsys, "facts", "--foon", files[0], "--foon", files[1])
    assert at_once == one_by_one
    assert at_once.count("unit(") == 2
