"""The questions of docs/querying.md, asked of the solver and answered by plain Python."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from functools import cache
from itertools import combinations
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator
from msgspec import to_builtins

from foon_asp.asp.ask import RulesAnswer
from foon_asp.asp.ask import ask as ask_rules
from foon_asp.asp.wire import asked_json
from foon_asp.io.folder import Dataset
from foon_asp.model.node import FunctionalUnit, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from support import brute_force
from support.paths import ROOT

PAGE = (ROOT / "docs" / "querying.md").read_text(encoding="utf-8")
FILES = {name: text for text, name in re.findall(r"```prolog\n(% ([\w.]+): .*?)```", PAGE, re.DOTALL)}
SCHEMA = json.loads((ROOT / "docs" / "schema" / "query.schema.json").read_text(encoding="utf-8"))


def ask(tmp_path: Path, where: World, text: str, *goals: ObjectNode, **options: Any) -> RulesAnswer:
    path = tmp_path / "rules.lp"
    path.write_text(text, encoding="utf-8")
    return ask_rules(where, Query(*goals, **options), path)


Rows = list[tuple[object, ...]]


def tables(answer: RulesAnswer) -> dict[str, Rows]:
    assert answer.tables is not None
    return {f"{each.heading.name}/{each.heading.arity}": list(each.rows) for each in answer.tables}


# --- The questions, answered without any solver ----------------------------------------------------


class Plain:
    """A FOON with what follows from it, worked out from the definitions alone."""

    def __init__(self, where: World) -> None:
        self.where = where
        self.units = where.foon.units
        self.needs = [brute_force.needs(where, unit) for unit in self.units]
        self.makes = [brute_force.makes(where, unit) for unit in self.units]
        self.stock = set(where.kitchen.objects)
        self.tools = where.kitchen.utensils
        at_hand, self.runs = brute_force.closure(where, brute_force.every_unit(where))
        self.available = set(at_hand)

    def inputs(self, unit: FunctionalUnit) -> list[ObjectNode]:
        return [self.where.foon.objects[number] for number in unit.inputs]

    def listed(self, unit: FunctionalUnit) -> list[ObjectNode]:
        return [self.where.foon.objects[number] for number in (*unit.inputs, *unit.outputs)]

    def makers(self, thing: ObjectNode) -> list[FunctionalUnit]:
        return [self.units[number] for number in sorted(self.runs) if thing in self.makes[number]]

    @property
    def made(self) -> set[ObjectNode]:
        return {thing for number in self.runs for thing in self.makes[number]}

    @property
    def dishes(self) -> set[ObjectNode]:
        taken = {thing for unit in self.units for thing in self.inputs(unit)}
        return {thing for thing in self.made - taken if thing.label not in self.tools}


Answers = dict[str, set[tuple[object, ...]]]


def dirty(plain: Plain, label: str = "bowl", state: str = "dirty") -> Answers:
    def has_dirty_bowl(things: Collection[ObjectNode]) -> bool:
        return any(thing.label == label and state in thing.plain_states for thing in things)

    counts = Counter(
        unit.motion
        for unit in plain.units
        if has_dirty_bowl(plain.makes[unit.id]) and not has_dirty_bowl(plain.inputs(unit))
    )
    return {"makes_dirty/2": {(motion, count) for motion, count in counts.items()}}


def bottleneck(plain: Plain, least: int = 5) -> Answers:
    makers: dict[ObjectNode, list[FunctionalUnit]] = {}
    for number in plain.runs:
        for thing in plain.makes[number]:
            makers.setdefault(thing, []).append(plain.units[number])
    users = Counter(thing for things in plain.needs for thing in things)
    return {
        "bottleneck/3": {
            (users[thing], units[0].motion, str(thing))
            for thing, units in makers.items()
            if len(units) == 1 and thing not in plain.stock and users[thing] >= least
        }
    }


def tools(plain: Plain) -> Answers:
    return {
        "tool/2": {
            (unit.motion, thing.label)
            for unit in plain.units
            for thing in plain.needs[unit.id]
            if not thing.states
        }
    }


def ingredients(plain: Plain, least: int = 10) -> Answers:
    makers: dict[ObjectNode, list[UnitId]] = {}
    for number in plain.runs:
        for thing in plain.makes[number]:
            makers.setdefault(thing, []).append(number)
    counts: Counter[str] = Counter()
    for dish in plain.dishes:
        seen, open_ = {dish}, [dish]
        while open_:
            thing = open_.pop()
            if thing in plain.stock:
                continue
            for number in makers.get(thing, ()):
                open_ += plain.needs[number] - seen
                seen |= plain.needs[number]
        counts.update({o.label for o in seen & plain.stock if o.states and o.label not in plain.tools})
    return {"common/2": {(count, label) for label, count in counts.items() if count >= least}}


def seldom(plain: Plain) -> Answers:
    users = Counter(thing for things in plain.needs for thing in things)
    return {"seldom/2": {(users[thing], str(thing)) for thing in plain.stock if users[thing] <= 1}}


def never(plain: Plain) -> Answers:
    return {
        "never/4": {
            (Path(source.file).name, source.line, unit.motion, str(thing))
            for unit in plain.units
            if unit.id not in plain.runs
            for thing in plain.needs[unit.id] - plain.available
            for source in unit.annotation.sources
        }
    }


def chain(plain: Plain) -> Answers:
    makers = Counter(thing for number in plain.runs for thing in plain.makes[number])
    only = {
        thing: number
        for number in plain.runs
        for thing in plain.makes[number]
        if makers[thing] == 1 and thing not in plain.stock
    }
    before = {u: {only[o] for o in plain.needs[u] if o in only} for u in plain.runs}

    @cache
    def length(number: UnitId) -> int:
        return 1 + max(map(length, before[number]), default=0)

    longest = max(map(length, plain.runs), default=0)
    links = {(number, longest) for number in plain.runs if length(number) == longest}
    for place in range(longest, 1, -1):
        ends = {number for number, at in links if at == place}
        links |= {(u, place - 1) for v in ends for u in before[v] if length(u) == place - 1}
    return {
        "step/3": {
            (place, plain.units[number].motion, source.line)
            for number, place in links
            for source in plain.units[number].annotation.sources
        }
    }


def oven(plain: Plain, broken: str = "oven") -> Answers:
    free = [
        unit.id
        for unit in plain.units
        if not any(
            broken in (thing.label, *(state.relatum for state in thing.states))
            for thing in plain.listed(unit)
        )
    ]
    left, _ = brute_force.closure(plain.where, free)
    return {"lost/1": {(str(dish),) for dish in plain.dishes if dish not in left}}


def rates(plain: Plain, below: float = 0.5) -> Answers:
    counts = Counter(unit.motion for unit in plain.units)
    known = {unit.motion: plain.where.kitchen.known_rate(unit) for unit in plain.units}
    return {
        "unrated/1": {(motion,) for motion, rate in known.items() if rate is None},
        "risky/3": {
            (round(rate * 1000), motion, counts[motion])
            for motion, rate in known.items()
            if rate is not None and rate < below
        },
    }


PLAIN: dict[str, Callable[..., Answers]] = {
    f"{each.__name__}.lp": each
    for each in (dirty, bottleneck, tools, ingredients, seldom, never, chain, oven, rates)
}


@cache
def plain(where: World) -> Plain:
    return Plain(where)


def check_same_answer(name: str, where: World, tmp_path: Path) -> bool:
    """Answer a question twice; return whether the answer is more than nothing."""
    found = tables(ask(tmp_path, where, FILES[name]))
    expected = PLAIN[name](plain(where))
    assert {key: set(rows) for key, rows in found.items()} == expected
    assert all(len(rows) == len(set(rows)) for rows in found.values())
    return any(expected.values())


def check_ways(dataset: Dataset, tmp_path: Path) -> int:
    """Find the ways to make each goal twice; return how many goals have several."""
    where = dataset.world()
    several = 0
    for goal in dict.fromkeys(dataset.goals):
        if goal not in plain(where).available:
            continue
        units = plain(where).makers(goal)
        expected = {
            (unit.source.line, unit.motion, str(thing))
            for unit in units
            for thing in plain(where).needs[unit.id]
        }
        (rows,) = tables(ask(tmp_path, where, FILES["ways.lp"], goal)).values()
        assert set(rows) == expected
        several += len(units) > 1
    return several


Units = Sequence[FunctionalUnit]


def check_skills(dataset: Dataset, tmp_path: Path) -> None:
    """No robot does with fewer skills than the answer names."""
    where = dataset.world()
    checked: list[tuple[int, bool | None]] = []
    for goal in dict.fromkeys(dataset.goals):
        if goal not in plain(where).available:
            continue
        answer = ask(tmp_path, where, FILES["skills.lp"], goal)
        assert answer.status == "optimal"
        (rows,) = tables(answer).values()
        skills = {str(motion) for (motion,) in rows}
        assert answer.costs == (len(skills),)
        units = [where.foon.units[number] for number in Problem.of(where, [goal]).units]

        def suffices(some: Collection[str], goal: ObjectNode = goal, units: Units = units) -> bool:
            at_hand, _ = brute_force.closure(where, [unit.id for unit in units if unit.motion in some])
            return goal in at_hand

        assert suffices(skills)
        motions = {unit.motion for unit in units}
        if len(skills) <= 5 and len(motions) <= 15:
            smaller = (combinations(motions, size) for size in range(len(skills)))
            assert not any(suffices(some) for sets in smaller for some in sets)
            as_good = [some for some in combinations(motions, len(skills)) if suffices(some)]
            assert answer.more == (len(as_good) > 1)
            checked.append((len(skills), answer.more))
    assert len(checked) >= 4


def unused(dataset: Dataset, tmp_path: Path) -> int:
    """Count what is in the kitchen and in no unit."""
    rows = tables(ask(tmp_path, dataset.world(), FILES["seldom.lp"]))["seldom/2"]
    return sum(row[0] == 0 for row in rows)


# --- Facts and errors -----------------------------------------------------------------------------


def checked(answer: RulesAnswer) -> dict[str, Any]:
    """Return the JSON value of an answer, as it is read, after checking it against the schema."""
    value: dict[str, Any] = json.loads(json.dumps(to_builtins(asked_json(answer))))
    Draft202012Validator(SCHEMA).validate(value)
    return value
