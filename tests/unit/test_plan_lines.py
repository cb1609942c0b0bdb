"""Plans as planners print them: every dialect, between the lines of a log, and what is no action."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.errors import InputError
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.planning.pddl.names import Names
from foon_asp.planning.pddl.plan_file import read_plan, read_plans
from foon_asp.planning.pddl.plan_lines import DIALECTS, read_lines
from support.examples import many

NAMES = Names(
    {"jar-empty": ObjectId(0)},
    {"pour-45": UnitId(45), "add-46": UnitId(46), "shake-without-sugar-3": UnitId(3)},
    {"take-jar-empty-1": "take a jar"},
    arguments={"pour-45": ("jar-empty",)},
)
ACTIONS = ("pour-45 jar-empty", "add-46", "shake-without-sugar-3", "take-jar-empty-1")
UNITS = {"pour-45 jar-empty": 45, "add-46": 46, "shake-without-sugar-3": 3}

# What stands between actions, in the words of planners.
NOISE = (
    "",
    "; Time 0.01",
    "[t=0.002347s, 10412 KB] Plan length: 5 step(s).",
    "Parsing: [0.000s CPU, 0.005s wall-clock]",
    "41 relevant atoms",
    "INFO     search time limit: None",
    "0.0",
    "Cueing down from goal distance:    5 into depth [1]",
    "time spent:    0.00 seconds instantiating 14 easy, 0 hard action templates",
    " Time: (ACTION) [action Duration; action Cost]",
    "b (3.000 | 5.000)b (2.000 | 15.001)",
    "* All goal deadlines now no later than 10.003",
    "(Pre Simplification) - |A|+|P|+|E|: 14",
    "2026-11-27 12:09:54,037 INFO     Plan length: 5",
    "  constraints:",
    "    0 < 1 ,2",
    "1:",
    "(pour-45 jar-empty) - end",
    "Adding (jar-heavy-cream)",
)
ANNOUNCEMENTS = (
    "ff: found legal plan as follows",
    "[t=0.002317s, 10412 KB] Solution found!",
    "Plan computed:",
    ";;;; Solution Found",
    "; Plan found with metric 15.003",
    "Found Plan:",
    "plan:",
    "plan: SequentialPlan:",
    "TimeTriggeredPlan:",
    "Plan to validate:",
)


def _written(action: str, place: int) -> list[str]:
    """Return an action as the step of a place in each dialect that has one line a step."""
    name, *arguments = action.split()
    call = name.replace("-", "_") + (f"({', '.join(arguments)})" if arguments else "")
    return [
        f"({action})",
        f"( {action.upper()} ) ; as it is",
        action,
        f"{action}  (1)",
        f"({action}) - start",
        f"    {call}",
        f"{place}: {action.upper()}",
        f"step    {place}: {action.upper()}",
        f"{place}. ({action})",
        f"    {place}) {call}",
        f"{place}.000:   ({action.upper()}) [D:1.0000; C:0.1000]",
        f"{place}:\t({action})\t[5.000]",
        f"    {place}.0: {call} [5.0]",
        f"{place}: ({action})[5]",
    ]


DRAWN = st.lists(
    st.tuples(st.sampled_from(ACTIONS), st.lists(st.sampled_from(NOISE), max_size=2)), min_size=1
)


@many(200)
@given(DRAWN, DRAWN, st.integers(0, 13), st.sampled_from(ANNOUNCEMENTS))
def test_the_last_plan_of_a_log_is_read(
    tmp_path_factory: pytest.TempPathFactory,
    first: list[tuple[str, list[str]]],
    last: list[tuple[str, list[str]]],
    dialect: int,
    announced: str,
) -> None:
    path = tmp_path_factory.getbasetemp() / "log.txt"
    lines = []
    for steps in (first, last):
        lines.append(announced)
        for place, (action, noise) in enumerate(steps):
            lines += [_written(action, place)[dialect], *noise]
    path.write_text("\n".join(lines))
    plans = read_plans(path, NAMES)
    assert plans == [[UNITS[action] for action, _ in steps if action in UNITS] for steps in (first, last)]
    assert read_plan(path, NAMES) == plans[-1]


@pytest.mark.parametrize("name", DIALECTS)
def test_every_dialect_has_the_same_action(tmp_path: Path, name: str) -> None:
    path = tmp_path / "plan"
    path.write_text(f"{DIALECTS[name]}\n")
    assert read_plan(path, NAMES) == [45]
    assert [line.words for line in read_lines(DIALECTS[name]).lines] == [("pour-45", "jar-empty")]
    # It is the dialect that is read, and not a name that is found somewhere.
    path.write_text(DIALECTS[name].replace("45", "46"))
    with pytest.raises(InputError, match="plan:1: unknown action 'pour-46'"):
        read_plan(path, NAMES)


def test_numbers_and_times_order_the_steps(tmp_path: Path) -> None:
    path = tmp_path / "plan"
    for one, other in (("10:", "9.5:"), ("1e-05:", "0:"), ("2.", "1."), ("step 3:", "2:")):
        path.write_text(f"{one} (add-46)\n{other} (shake_without_sugar_3)\n{other} (add-46)\n")
        assert read_plan(path, NAMES) == [3, 46, 46]


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("(boil-999)", "unknown action 'boil-999'"),
        ("boil-999  (1)", "unknown action 'boil-999'"),
        ("3: BOIL-999", "unknown action 'boil-999'"),
        ("(pour-44 jar-empty)", "unknown action 'pour-44'; closest: pour-45"),
        ("(boil jar", "'(boil jar' is no step of a plan"),
        ("(", "'(' is no step of a plan"),
        ("0.000: (add-46) [5.000", "no step of a plan"),
        ("0.000: () [5.000]", "no step of a plan"),
        ("0.000 (add-46) [5.000]", "no step of a plan"),
        ("add-46)", "no step of a plan"),
        ("add-46 [1.0", "no step of a plan"),
        ("(pour-45)", "'pour-45' takes jar-empty, not nothing; write (pour-45 jar-empty)"),
        ("pour_45(jar_full)", "'pour-45' takes jar-empty, not jar-full"),
        ("add-46 jar-empty", "'add-46' takes no arguments"),
    ],
)
def test_a_broken_action_is_an_error_of_its_line(tmp_path: Path, line: str, complaint: str) -> None:
    path = tmp_path / "plan"
    path.write_text(f"; a plan\n(add-46)\n{line}\n(add-46)\n")
    with pytest.raises(InputError) as raised:
        read_plan(path, NAMES)
    assert "plan:3: " in str(raised.value)
    assert complaint in str(raised.value)


@pytest.mark.parametrize(
    "text", ["", "; cost = 0\n", "ff: goal can be simplified to TRUE. The empty plan solves it"]
)
def test_an_empty_plan(tmp_path: Path, text: str) -> None:
    (tmp_path / "plan").write_text(text)
    assert read_plan(tmp_path / "plan", NAMES) == []


@pytest.mark.parametrize(
    "text", ["Search stopped without finding a solution.\n", "No plan found.\n", "time:\n", "(define\n)"]
)
def test_a_log_without_a_plan_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "plan").write_text(text)
    with pytest.raises(InputError, match=r"plan: there is no plan in it|plan:1: '\(define' is no step"):
        read_plan(tmp_path / "plan", NAMES)
