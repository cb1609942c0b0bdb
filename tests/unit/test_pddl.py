"""PDDL exports: names, text, slices, prices, effects, durations."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from foon_asp.errors import InputError, QueryError
from foon_asp.model.consumption import Effects
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, Interval, UnitId
from foon_asp.model.world import World
from foon_asp.planning.pddl.names import DomainNames, read_names
from foon_asp.planning.pddl.plan_file import read_plan
from foon_asp.planning.pddl.styles import STYLES, document
from foon_asp.planning.pddl.task import executed_steps, exported_units, planning_task
from foon_asp.planning.pddl.write import domain_text, export, problem_text, written_names
from foon_asp.planning.plan import Plan
from foon_asp.planning.prices import Prices
from foon_asp.query.constraints import Constraints
from foon_asp.query.objective import Criterion
from foon_asp.query.problem import Problem
from support import small_foons
from support.pddl_exports import can_execute, counted, exported, soup, whole_task

# The translator of Fast Downward leaves its files open; the others warn of what is theirs alone.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")


# Names


def test_names_do_not_depend_on_the_goal() -> None:
    where = soup()
    small = exported(where, [small_foons.node("onion[chopped]")])
    large = exported(where, [small_foons.node("soup")], criterion="units+tools", style="lifted")
    assert small.task.names.units.items() <= large.task.names.units.items()
    assert small.task.names.objects.items() <= large.task.names.objects.items()
    assert DomainNames.of(where).objects == DomainNames.of(World.of(where.foon, where.kitchen)).objects


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[]", "no names of a PDDL export"),
        ('{"format": "foon-asp pddl names", "version": 2}', "version 2"),
        ('{"format": "foon-asp pddl names", "version": 1}', "'objects'"),
        ('{"format": "foon-asp pddl names", "version": 1, "objects": {"A": 1}}', "'A' is no name"),
    ],
)
def test_unreadable_names(tmp_path: Path, text: str, complaint: str) -> None:
    (tmp_path / "names.json").write_text(text)
    with pytest.raises(InputError, match=complaint):
        read_names(tmp_path / "names.json", soup())


def test_names_of_another_foon(tmp_path: Path) -> None:
    where = soup()
    (tmp_path / "names.json").write_text(written_names(exported(where, [small_foons.node("soup")])))
    read_names(tmp_path / "names.json", where)
    other = small_foons.world(["onion[raw] -fry-> onion[fried]"], "onion[raw]")
    with pytest.raises(InputError, match=r"is not of this FOON|here, not"):
        read_names(tmp_path / "names.json", other)


@pytest.mark.parametrize("style", STYLES)
def test_names_know_the_foon_and_the_kitchen_of_their_export(tmp_path: Path, style: str) -> None:
    """Whatever changes what the actions do, or what there is of their objects; and nothing else."""
    path, where = tmp_path / "names.json", soup()
    path.write_text(written_names(exported(where, [small_foons.node("soup")], style=style)))
    value = json.loads(path.read_text())
    same = World.of(where.foon, replace(where.kitchen, rates={}, default_rate=0.1))
    assert read_names(path, same).units == read_names(path, where).units
    onion = small_foons.node("onion[whole]")
    for other in (
        replace(where.kitchen, objects=tuple(node for node in where.kitchen.objects if node != onion)),
        replace(where.kitchen, quantities={onion: 3}),
        replace(where.kitchen, objects=(*where.kitchen.objects, small_foons.node("soup"))),
    ):
        with pytest.raises(InputError, match="the kitchen is not that of this export"):
            read_names(path, World.of(where.foon, other))
    with pytest.raises(InputError, match="the FOON is not that of this export"):
        read_names(path, World.of(where.foon, where.kitchen, strict=True))
    # A file of before has neither hashes nor arguments, and says as much as it did.
    old = {key: part for key, part in value.items() if key not in ("foon", "kitchen", "arguments")}
    path.write_text(json.dumps(old))
    names = read_names(path, World.of(where.foon, where.kitchen, strict=True))
    assert names.arguments == ({} if style == "objects" else None)


@pytest.mark.parametrize("style", STYLES)
def test_an_action_takes_its_own_objects_alone(tmp_path: Path, style: str) -> None:
    where = soup()
    written = exported(where, [small_foons.node("soup")], style=style)
    (tmp_path / "names.json").write_text(written_names(written))
    names = read_names(tmp_path / "names.json", where)
    path = tmp_path / "plan.txt"
    every = [(step.name, *written.arguments[step.name]) for step in written.task.steps]
    path.write_text("\n".join(f"({' '.join(words)})" for words in every).upper())
    assert read_plan(path, names) == [step.unit for step in written.task.steps if step.unit is not None]
    known = list(names.objects)
    for place, (action, *taken) in enumerate(every):
        wrong = [[*taken, known[0]], taken[1:], [*reversed(taken)], [known[-1], *taken[1:]], ["nothing"]]
        for given in wrong:
            if given == taken:
                continue
            lines = [f"({' '.join(words)})" for words in every[:place]]
            path.write_text("\n".join([*lines, f"({' '.join((action, *given))})"]))
            with pytest.raises(
                InputError, match=rf"plan\.txt:{place + 1}: '{action}' takes .*; write \({action}"
            ):
                read_plan(path, names)


# Text

GOLDEN_DOMAIN = """\
; Functional units as actions (style objects, semantics consume). Costs: units.
; names.json says which unit or object each name stands for.
(define (domain foon)
  (:requirements :strips :action-costs)

  (:predicates
    (onion-whole)
    (knife)
    (onion-chopped)
    (onion-whole-left-1)  ; onion [whole]: 1 in the kitchen
    (onion-whole-left-0)  ; onion [whole]: 0 in the kitchen
  )

  (:functions (total-cost) - number)

  ; Take onion [whole] out of the kitchen, which holds 1.
  (:action take-onion-whole-1
    :parameters ()
    :precondition (and (onion-whole-left-1))
    :effect (and
      (onion-whole)
      (onion-whole-left-0)
      (not (onion-whole-left-1))
      (increase (total-cost) 0)))

  ; chop
  ; take onion [whole]; knife
  ; get onion [chopped]
  ; use up onion [whole]
  (:action chop-0
    :parameters ()
    :precondition (and (onion-whole) (knife))
    :effect (and (onion-chopped) (not (onion-whole)) (increase (total-cost) 1)))
)
"""
GOLDEN_PROBLEM = """\
; Get onion [chopped].
(define (problem get-onion-chopped)
  (:domain foon)

  (:init
    (= (total-cost) 0)
    (knife)
    (onion-whole-left-1)
  )

  (:goal (and (onion-chopped)))
  (:metric minimize (total-cost))
)
"""


def test_format() -> None:
    where = small_foons.world(["onion[whole] + (knife) -chop-> onion[chopped]"], "onion[whole] + (knife)")
    written = exported(counted(where, onion=1), [small_foons.node("onion[chopped]")], criterion="units")
    assert domain_text(written) == GOLDEN_DOMAIN
    assert problem_text(written) == GOLDEN_PROBLEM
    value = json.loads(written_names(written))
    assert {len(value.pop(kind)) for kind in ("foon", "kitchen")} == {64}
    assert value == {
        "format": "foon-asp pddl names",
        "version": 1,
        "style": "objects",
        "semantics": "consume",
        "durative": False,
        "goals": [{"id": 2, "text": "onion [chopped]"}],
        "objects": {
            "onion-whole": {"id": 0, "text": "onion [whole]"},
            "knife": {"id": 1, "text": "knife"},
            "onion-chopped": {"id": 2, "text": "onion [chopped]"},
        },
        "actions": {"chop-0": {"unit": 0, "motion": "chop", "source": ""}},
        "helpers": {
            "take-onion-whole-1": "Take onion [whole] out of the kitchen, which holds 1.",
        },
        "arguments": {},
    }


def test_lines_are_short() -> None:
    for style in STYLES:
        written = exported(soup(), [small_foons.node("soup")], criterion="units+tools", style=style)
        assert max(map(len, (domain_text(written) + problem_text(written)).splitlines())) <= 100


# Reading back


def test_files(tmp_path: Path) -> None:
    where = soup()
    problem, effects = Problem.of(where, [small_foons.node("soup")]), Effects(where, "transform")
    written = document(planning_task(problem, effects, Criterion.parse("time")), "lifted", True)
    export(written, tmp_path / "new")
    names = ["domain.pddl", "names.json", "problem.pddl"]
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == names
    assert (tmp_path / "new" / "domain.pddl").read_text() == domain_text(written)
    first = {name: (tmp_path / "new" / name).read_bytes() for name in names}
    again = document(planning_task(problem, effects, Criterion.parse("time")), "lifted", True)
    export(again, tmp_path / "new")
    assert {name: (tmp_path / "new" / name).read_bytes() for name in names} == first


# Slices


def test_makers_of_what_the_kitchen_counts_are_exported() -> None:
    where = soup()
    goal = Problem.of(where, [small_foons.node("soup")])
    assert small_foons.motions(where, exported_units(goal, Effects(where, "add"))) == {"chop", "put", "cook"}
    # There is one empty bowl; to have another it must be washed.
    assert "wash" in small_foons.motions(where, exported_units(goal, Effects(where, "consume")))


def test_goals_that_cannot_be_reached_are_exported_with_all_that_leads_to_them() -> None:
    where = small_foons.world(["a -mix-> b", "b -fry-> c"], "")
    problem = Problem.of(where, [small_foons.node("c")])
    assert problem.units == []
    assert exported_units(problem, Effects(where, "add")) == [0, 1]


def test_no_place_for_constraints() -> None:
    where = soup()
    problem = Problem.of(where, [small_foons.node("soup")], constraints=Constraints(max_units=3))
    with pytest.raises(QueryError, match="no place for constraints"):
        planning_task(problem, Effects(where, "add"))


# Prices


@pytest.mark.parametrize(("criterion", "instead"), [("depth", "durative"), ("units+human", "task tree")])
def test_criteria_without_a_price(criterion: str, instead: str) -> None:
    with pytest.raises(QueryError, match=instead):
        Prices.of(Problem.of(soup(), [small_foons.node("soup")]), Criterion.parse(criterion))


# Effects


def test_a_view_that_the_kitchen_counts_is_used_up_if_there_is_one() -> None:
    where = small_foons.world(
        ["bowl{onion} + onion@bowl -tip-> onion[raw]", "bowl{onion} -scrape-> onion@bowl"],
        "bowl{onion} + onion@bowl",
        utensils=["bowl"],
    )
    where = counted(where, bowl=1, onion=2)
    effects = Effects(where, "consume")
    task = whole_task(where, effects)
    assert [step.name for step in task.steps if step.unit == 0] == ["tip-0", "tip-0-without-0"]
    assert can_execute(task, [0, 0])
    assert not can_execute(task, [0, 1])
    assert can_execute(task, [1, 0])


def test_what_is_made_does_not_swallow_what_the_kitchen_has() -> None:
    units = [
        "bowl[empty] -name-> map",
        "clay -form-> bowl[empty]",
        "bowl[empty] + stone -smash-> bowl[broken]",
    ]
    where = counted(small_foons.world(units, "bowl[empty] + clay + stone"), bowl=1)
    # Under `transform` a bowl is smashed, but not used up by giving it a name.
    effects = Effects(where, "transform")
    task = whole_task(where, effects)
    for numbers, possible in (([0, 1, 2, 2], True), ([0, 1, 1, 2, 2], True), ([0, 1, 2, 2, 2], False)):
        units_done = [UnitId(number) for number in numbers]
        assert Plan.of(effects, (), units_done).executable is possible
        assert can_execute(task, units_done) is possible
        steps = [step.unit for step in executed_steps(task, effects, units_done) if step.unit is not None]
        assert (steps == units_done) is possible


# The lifted style


def test_the_same_twice_is_told_from_the_same_once() -> None:
    where = small_foons.world(["bowl{egg} + egg -crack-> bowl{egg,egg}"], "bowl{egg} + egg")
    text = problem_text(exported(where, [small_foons.node("bowl{egg,egg}")], style="lifted"))
    assert "(contains-2-times bowl-egg-egg the-egg)" in text
    assert "known-as" not in text


# Durative actions


def test_durations_come_from_the_annotation() -> None:
    builder = FoonBuilder()
    a, b, c = (builder.object(small_foons.node(text)) for text in ("a", "b", "c"))
    builder.unit("mix", [a], [b], Annotation(times=(Interval(10.0, 70.0), Interval(80.0, 82.0))))
    builder.unit("fry", [b], [c], Annotation())
    where = World.of(builder.build(), Kitchen((small_foons.node("a"),)))
    written = exported(where, [small_foons.node("c")], durative=True)
    assert [action.duration for action in written.actions] == [62, 1]
    assert ":duration (= ?duration 62)" in domain_text(written)
    assert "(:metric minimize (total-time))" in problem_text(written)


def test_what_is_needed_and_kept_must_last() -> None:
    where = small_foons.world(
        ["(knife) -get-> pan[hot]", "pan[hot] + egg -fry-> egg[fried] + pan[hot]", "pan[hot] -cool-> pan"],
        "(knife) + egg",
    )
    written = exported(where, [small_foons.node("egg[fried]"), small_foons.node("pan")], durative=True)
    lasting = {action.name: action.lasting for action in written.actions}
    assert lasting == {"get-0": (), "fry-1": (("pan-hot",),), "cool-2": ()}
